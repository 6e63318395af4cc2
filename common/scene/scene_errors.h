#pragma once
// What is wrong with a scene file, all of it at once.

#include <cstddef>
#include <stdexcept>
#include <string>
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

}  // namespace talus
