#pragma once
// Reads the values of one TOML table into plain variables and remembers what was wrong.

#include <toml++/toml.h>

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "common/scene/range.h"
#include "common/scene/scene_errors.h"

namespace talus {

/// What comes to light while a file is read, shared by the readers of all its tables.
struct Findings {
  std::string file;
  std::vector<SceneError> errors;
  bool keys_wanted = false;                     // whether `keys` is filled
  std::set<std::string> keys;                   // every key that is looked for, as `source[].rate` or `shape.*.kind`
  std::vector<std::filesystem::path> referred;  // files that it names, as it names them
  std::vector<std::string> warnings;            // of what is allowed but seldom meant, each with its place
  std::size_t suggestion_budget = 2'000'000;    // pairs of letters that may still be compared to suggest names
};

/// One table. Every read() leaves the variable, that is the struct's own default, alone where the key is absent, and
/// notes an error where the value has the wrong type or lies outside the range. A key that nobody asked for is an error
/// too.
class TableReader {
 public:
  using Body = std::function<void(TableReader&)>;
  using NamedBody = std::function<void(const std::string& name, TableReader&)>;

  /// The root table of a file: calls `body`, then notes the keys that it did not ask for.
  static void read_root(const toml::table& table, Findings& findings, const Body& body);

  void read(std::string_view key, double& value, const Range& range);
  void read(std::string_view key, int& value, const Range& range);
  void read(std::string_view key, std::int64_t& value, const Range& range);
  void read(std::string_view key, bool& value);
  /// Any text on one line.
  void read(std::string_view key, std::string& value);
  /// One of `choices`.
  void read(std::string_view key, std::string& value, std::span<const std::string> choices);
  /// One number or an array of numbers.
  void read(std::string_view key, std::vector<double>& values, const Range& range);
  /// An array of as many numbers as there are axes.
  template <int Size>
  void read(std::string_view key, Eigen::Matrix<double, Size, 1>& value, const Range& range);
  /// An array of such arrays.
  template <int Size>
  void read(std::string_view key, std::vector<Eigen::Matrix<double, Size, 1>>& values, const Range& range);
  /// One text or an array of texts, each one of `choices`.
  void read(std::string_view key, std::vector<std::string>& values, std::span<const std::string> choices);
  /// The name of another file, in or below the folder of the one that is read, or absolute: here with that folder.
  /// Remembered together with the name that `beside` makes of it, of a file that belongs to it.
  void read(std::string_view key, std::filesystem::path& value,
            const std::function<std::filesystem::path(const std::filesystem::path&)>& beside);
  /// An angle, in the file in degrees, here in radians; `range` in degrees.
  void read_degrees(std::string_view key, double& radians, const Range& range);

  /// The table `[key]`; one that is absent reads as empty.
  void table(std::string_view key, const Body& body);
  /// The tables `[[key]]`, in their order. Whether it is such tables, or absent.
  bool tables(std::string_view key, const Body& body);
  /// The tables `[key.NAME]`, ordered by name. Whether it is such tables, or absent.
  bool named_tables(std::string_view key, const NamedBody& body);

  /// `key` had the name `old_key` before, under which it can still be given in this version, with a warning. To be
  /// called before `key` is read.
  void renamed(std::string_view old_key, std::string_view key);

  bool has(std::string_view key);
  /// Notes an error if the key is absent.
  void require(std::string_view key);
  /// Notes an error if the key is there, for keys that many will try.
  void refuse(std::string_view key, std::string rule);
  /// Notes an error about a key's value, or about the whole table if the key is absent or empty.
  void reject(std::string_view key, std::string rule, std::string suggestion = {});
  /// Notes what a check of ours threw, "NAME.KEY = VALUE: RULE", at `key`; without, at KEY if the table has it, else at
  /// the table.
  void reject_as(const std::invalid_argument& refusal, std::string_view key = {});
  /// Adds a warning about the whole table, with its place in the file.
  void warn(std::string_view warning);
  /// Keys that nobody asked for are no errors, since nobody can tell which belong here.
  void allow_unknown_keys() { unknown_keys_allowed_ = true; }

  /// Whether no error was noted in this table so far.
  bool sound() const { return findings_.errors.size() == errors_before_; }
  const std::string& path() const { return path_; }

 private:
  struct Location {
    std::string file;
    int line = 0;
    int column = 0;
  };
  TableReader(const toml::table& table, std::string path, std::string generic_path, Location location,
              Findings& findings);

  const toml::node* find(std::string_view key);
  const toml::node* node_of(std::string_view key) const;
  template <typename Number>
  void read_whole(std::string_view key, Number& value, const Range& range);
  bool read_number(const toml::node& node, const std::string& name, double& value, const Range& range);
  bool read_choice(const toml::node& node, const std::string& name, std::string& value,
                   std::span<const std::string> choices);
  bool read_array(const toml::node& node, const std::string& name, std::span<double> values, const Range& range);
  void read_child(const toml::node& node, const std::string& name, const std::string& generic_name, const Body& body);
  void note_unknown_keys();
  void warn_at(const Location& at, const std::string& warning);
  void note(const toml::node& node, std::string name, std::string rule, std::string suggestion = {});
  /// The name of `known` that was most likely meant; empty if none is near or the budget is spent.
  std::string suggestion(std::string_view name, std::span<const std::string> known);
  /// Whether that many tables at `node` are beyond the limit, which is noted.
  bool is_too_many(std::string_view key, const toml::node& node, std::size_t count);
  Location locate(const toml::source_region& region) const;
  std::string field(std::string_view key) const;

  const toml::table& table_;
  std::string path_;
  std::string generic_path_;
  Location location_;
  Findings& findings_;
  std::size_t errors_before_;
  std::vector<std::string> known_;
  std::map<std::string, std::string, std::less<>> old_names_;  // of keys that are given under one
  bool unknown_keys_allowed_ = false;
};

}  // namespace talus
