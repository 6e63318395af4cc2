#pragma once
// Reads the values of one TOML table into plain variables and collects the errors.

#include <toml++/toml.h>

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/math/require.h"
#include "common/params/field.h"
#include "common/scene/diagnostics.h"
#include "common/scene/toml_text.h"

namespace talus {

/// One table. Every read() leaves the variable, that is the struct's own default, unchanged where the key is absent,
/// and adds an error where the value has the wrong type or is outside of the range. A key that is not read is an error
/// too.
class TableReader {
 public:
  using Body = std::function<void(TableReader&)>;
  using NamedBody = std::function<void(const std::string& name, TableReader&)>;

  /// The root table of a file: calls `body`, then adds an error for each key that was not read. `dimension` of the
  /// scene.
  static void read_root(const toml::table& table, int dimension, Diagnostics& diagnostics, const Body& body);

  /// All fields of a struct, as they are declared.
  template <typename S>
  void read_fields(S& params, std::type_identity_t<Fields<S>> fields) {
    for (const Field<S>& field : fields)
      read_field(field.key, value_of(params, field), range_of(field.key, params, fields));
  }
  /// One key, as it is declared.
  template <typename T>
  void read(const Key& key, T& value) {
    read_field(key, &value, key.range);
  }
  /// One text or an array of texts, each one of `choices`.
  void read(std::string_view key, std::vector<std::string>& values, std::span<const std::string> choices);
  /// One of `choices`.
  void read(std::string_view key, std::string& value, std::span<const std::string> choices);
  /// The name of another file, in or below the folder of the one that is read, or absolute: here with that folder.
  /// Remembered together with the name that `beside` makes of it, of a file that belongs to it.
  void read(std::string_view key, std::filesystem::path& value,
            const std::function<std::filesystem::path(const std::filesystem::path&)>& beside);

  /// The table `[key]`; one that is absent reads as empty.
  void table(std::string_view key, const Body& body);
  /// The tables `[[key]]`, in their order. Whether it is such tables, or absent.
  bool tables(std::string_view key, const Body& body);
  /// The tables `[key.NAME]`, ordered by name. Whether it is such tables, or absent.
  bool named_tables(std::string_view key, const NamedBody& body);

  /// The table `[key.NAME]` alone, if there is one.
  void named_table(std::string_view key, const std::string& name, const Body& body);
  /// The names of the tables `[key.NAME]`.
  std::vector<std::string> names_of_tables(std::string_view key) const;
  /// The texts that the tables `[[tables]]` have at `key`, each a text or an array of texts.
  std::vector<std::string> texts_in_tables(std::string_view tables, std::string_view key) const;

  bool has(std::string_view key);
  /// Whether the key is given as an array.
  bool is_array(std::string_view key);
  /// Adds an error if the key is absent.
  void require(std::string_view key);
  /// Adds an error if the key is given, for keys that many will try.
  void forbid(std::string_view key, std::string rule);
  /// Adds an error about a key's value, or about the whole table if the key is absent or empty.
  void error(std::string_view key, std::string rule);
  /// Runs `body` and adds an error if it throws std::invalid_argument: at `key` if it is given, else at the key that
  /// the field of an InvalidValue ends with if the table has it, else at the table.
  void check(const std::function<void()>& body, std::string_view key = {});
  /// Runs `check` on this table once the whole scene is read: the units of the engine and the step follow from all of
  /// it.
  void check_later(const Body& check);
  void make_later_checks() const;
  /// Adds a warning about the whole table, with its place in the file.
  void warn(std::string_view warning);
  /// The value of a key in the text with all defaults, where read() has not the right one.
  void fill(std::string_view key, std::string_view toml);
  /// Keys that were not read are no errors, since it cannot be decided which belong here.
  void allow_unknown_keys() { unknown_keys_allowed_ = true; }

  /// Whether this table has no error so far.
  bool ok() const { return diagnostics_.errors.size() == errors_before_; }
  const std::string& path() const { return path_; }

 private:
  struct Location {
    std::string file;
    int line = 0;
    int column = 0;
  };
  TableReader(const toml::table& table, int dimension, Location location, Diagnostics& diagnostics);

  void read_field(const Key& key, const Value& value, const Range& range);

  // The value of a node, whose name is for messages; whether it has the right type and range.
  bool read_value(const toml::node& node, const std::string& name, const Key& key, const Range& range, double& value);
  bool read_value(const toml::node& node, const std::string& name, const Key& key, const Range& range, int& value);
  bool read_value(const toml::node& node, const std::string& name, const Key& key, const Range& range,
                  std::int64_t& value);
  bool read_value(const toml::node& node, const std::string& name, const Key& key, const Range& range,
                  std::uint64_t& value);
  bool read_value(const toml::node& node, const std::string& name, const Key& key, const Range& range, bool& value);
  bool read_value(const toml::node& node, const std::string& name, const Key& key, const Range& range,
                  std::string& value);
  bool read_value(const toml::node& node, const std::string& name, const Key& key, const Range& range,
                  std::vector<double>& values);
  template <int Size>
  bool read_value(const toml::node& node, const std::string& name, const Key& key, const Range& range,
                  Eigen::Vector<double, Size>& value);
  template <int Size>
  bool read_value(const toml::node& node, const std::string& name, const Key& key, const Range& range,
                  Eigen::Vector<int, Size>& value);
  template <int Size>
  bool read_value(const toml::node& node, const std::string& name, const Key& key, const Range& range,
                  std::vector<Eigen::Vector<double, Size>>& values);
  template <typename T>
  bool read_value(const toml::node& node, const std::string& name, const Key& key, const Range& range,
                  std::optional<T>& value);

  template <typename Number>
  bool read_whole(const toml::node& node, const std::string& name, const Range& range, Number& value);
  bool read_array(const toml::node& node, const std::string& name, const Key& key, const Range& range,
                  std::span<double> values);
  bool read_choice(const toml::node& node, const std::string& name, std::string& value,
                   std::span<const std::string> choices, bool or_number = false);
  bool all_whole(const toml::node& node, const std::string& name, std::span<const double> numbers);
  std::size_t count_of_points(const toml::node& node, const std::string& name);
  bool has_meaning(const Key& key);
  /// A default outside of its range stands for a value that follows from other keys.
  static bool in_range(const Key& key, std::span<const double> numbers);

  const toml::node* find(const Key& key);
  const toml::node* find(std::string_view key);
  /// A table below this one as messages, the manual and TOML name it: source[2], source[], [[source]].
  struct Child {
    std::string name;
    std::string generic_name;
    std::string head_name;
    bool in_array = false;
  };
  void read_child(const toml::node& node, const Child& child, const Body& body);
  /// Adds an error for each key of the node and of all below it that has a character 0.
  void check_keys(const toml::node& node);
  void add_unknown_keys();
  void error_at(const toml::node& node, std::string name, std::string rule, std::string suggestion = {});
  void error_at_table(std::string name, std::string rule);
  /// The name of `known` that was most likely meant; empty if none is near or the budget is spent.
  std::string suggestion(std::string_view name, std::span<const std::string> known);
  /// Whether that many tables at `node` are beyond the limit, which is an error.
  bool is_too_many(std::string_view key, const toml::node& node, std::size_t count);
  Location locate(const toml::source_region& region) const;
  std::string field(std::string_view key) const;

  const toml::table& table_;
  int dimension_;
  std::string path_ = {};
  std::string generic_path_ = {};
  std::string head_ = {};
  Location location_;
  Diagnostics& diagnostics_;
  std::size_t errors_before_;
  std::size_t filled_ = 0;  // index of this table in Diagnostics::filled
  std::vector<std::string> known_;
  bool unknown_keys_allowed_ = false;
};

}  // namespace talus
