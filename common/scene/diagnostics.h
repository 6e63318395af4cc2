#pragma once
// What is wrong with a scene file, all of it at once.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace talus {

/// One thing that is wrong.
struct SceneError {
  std::string file;        // or the text of a `--set`
  int line = 0;            // from 1; 0: no place in a file
  int column = 0;          // from 1
  std::string field;       // as `source[0].rate`; empty where the file is no TOML at all
  std::string value;       // as written; empty where nothing is written
  std::string rule;        // what would be right
  std::string suggestion;  // the known name nearest to a wrong one, or empty

  bool operator==(const SceneError&) const = default;
};

/// `file:line:column: field = value: rule (did you mean "x"?)`
std::string to_string(const SceneError& error);

/// Most errors that what() of SceneErrors has.
inline constexpr std::size_t max_printed_errors = 50;

/// Thrown for a scene that cannot be run; what() has one line for each of the first errors in the order of the file,
/// then how many more there are.
class SceneErrors : public std::runtime_error {
 public:
  explicit SceneErrors(std::vector<SceneError> errors);
  const std::vector<SceneError>& errors() const { return errors_; }

 private:
  struct InOrder {};
  SceneErrors(std::vector<SceneError> errors, InOrder order);

  std::vector<SceneError> errors_;
};

/// A table of a scene file with all keys that it may have.
struct FilledTable {
  std::string head;                                         // as `[world]`; empty: the root
  std::vector<std::pair<std::string, std::string>> values;  // keys with their values as TOML
};

/// What a read of a scene file collects, shared by the readers of all its tables.
struct Diagnostics {
  std::string file = {};
  std::set<std::string, std::less<>> included = {};  // files whose values hold where this one gives none
  std::vector<SceneError> errors = {};
  std::set<std::string> keys = {};       // every key that the reader looked for, as `source[].rate` or `shape.*.kind`
  bool fills = false;                    // whether keys and filled are collected
  std::vector<FilledTable> filled = {};  // the file with the defaults of the keys that it does not give
  std::vector<std::filesystem::path> referred = {};  // files that it names, as it names them
  std::vector<std::string> warnings = {};            // of what is allowed but seldom meant, each with its place
  std::vector<std::function<void()>> later = {};     // checks that wait until the whole scene is read
  std::size_t suggestion_budget = 2'000'000;         // pairs of letters that may still be compared to suggest names
};

}  // namespace talus
