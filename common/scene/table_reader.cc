#include "common/scene/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/text/nearest_name.h"
#include "common/text/printable.h"

namespace talus {
namespace {

/// A value short enough for a message; a table is shown as {...}.
std::string written(const toml::node& node) {
  if (node.is_table()) return "{...}";
  return shortened(value_text(node), 60);
}

bool is_header_array(const toml::node& node) {
  return node.is_array() && std::all_of(node.as_array()->begin(), node.as_array()->end(),
                                        [](const toml::node& element) { return element.is_table(); });
}

std::string rule_of(std::span<const std::string> choices, bool or_number) {
  constexpr std::size_t most_named = 50;
  return fmt::format("must be {}{}{}{}", choices.size() == 1 ? "" : "one of ",
                     fmt::join(choices.first(std::min(choices.size(), most_named)), ", "),
                     choices.size() > most_named ? ", ..." : "", or_number ? ", or a number" : "");
}

std::string below(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : (path + '.').append(key);
}

}  // namespace

TableReader::TableReader(const toml::table& table, int dimension, Location location, Diagnostics& diagnostics)
    : table_(table),
      dimension_(dimension),
      location_(std::move(location)),
      diagnostics_(diagnostics),
      errors_before_(diagnostics.errors.size()) {}

void TableReader::read_root(const toml::table& table, int dimension, Diagnostics& diagnostics, const Body& body) {
  TableReader reader(table, dimension, {diagnostics.file, 1, 1}, diagnostics);
  diagnostics.filled = {{}};
  reader.check_keys(table);
  if (!reader.ok()) return;  // what takes C strings would cut such a key
  body(reader);
  reader.add_unknown_keys();
}

void TableReader::check_keys(const toml::node& node) {
  if (const toml::array* array = node.as_array())
    for (const toml::node& element : *array) check_keys(element);
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, child] : *table) {
      if (key.str().find('\0') != std::string_view::npos)
        error_at(child, key_text(key.str()), "must be a name without the character 0");
      check_keys(child);
    }
  }
}

std::string TableReader::field(std::string_view key) const { return below(path_, key); }

const toml::node* TableReader::find(std::string_view key) {
  known_.emplace_back(key);
  if (diagnostics_.fills) diagnostics_.keys.insert(below(generic_path_, key));
  return table_.get(key);
}

const toml::node* TableReader::find(const Key& key) {
  if (key.required) require(key.name);
  return find(key.name);
}

bool TableReader::has_meaning(const Key& key) {
  if (key.dimension == 0 || key.dimension == dimension_) return true;
  forbid(key.name, fmt::format("means nothing where dimension = {}{}{}", dimension_, key.elsewhere.empty() ? "" : ": ",
                               key.elsewhere));
  return false;
}

bool TableReader::in_range(const Key& key, std::span<const double> numbers) {
  return std::ranges::all_of(numbers, [&](double kept) { return key.range.holds(as_written(key, kept)); });
}

void TableReader::warn(std::string_view warning) {
  const std::string place =
      location_.line > 0 ? fmt::format("{}:{}:{}", location_.file, location_.line, location_.column) : location_.file;
  diagnostics_.warnings.push_back(fmt::format("{}: {}: {}", place, path_, warning));
}

void TableReader::fill(std::string_view key, std::string_view toml) {
  if (!diagnostics_.fills || toml.empty()) return;
  auto& values = diagnostics_.filled[filled_].values;
  const auto before = std::ranges::find(values, key, [](const auto& value) { return value.first; });
  if (before == values.end())
    values.emplace_back(key, toml);
  else
    before->second = toml;
}

TableReader::Location TableReader::locate(const toml::source_region& region) const {
  if (region.begin.line == 0) return location_;
  const bool of_scene = !region.path || *region.path == diagnostics_.file;
  if (!of_scene && diagnostics_.included.contains(*region.path))
    return {*region.path, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
  if (!of_scene) return {*region.path, 0, 0};  // a `--set`: line and column within its value would only confuse
  return {diagnostics_.file, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

void TableReader::error_at(const toml::node& node, std::string name, std::string rule, std::string suggestion) {
  Location at = locate(node.source());
  diagnostics_.errors.push_back(
      {std::move(at.file), at.line, at.column, std::move(name), written(node), std::move(rule), std::move(suggestion)});
}

void TableReader::error_at_table(std::string name, std::string rule) {
  diagnostics_.errors.push_back(
      {location_.file, location_.line, location_.column, std::move(name), "", std::move(rule), ""});
}

void TableReader::add_unknown_keys() {
  if (unknown_keys_allowed_) return;
  for (const auto& [key, node] : table_) {
    if (std::find(known_.begin(), known_.end(), key.str()) == known_.end()) {
      const bool key_has_place = key.source().begin.line > 0;
      Location at = locate(key_has_place ? key.source() : node.source());
      diagnostics_.errors.push_back({std::move(at.file), at.line, at.column, field(key.str()), written(node),
                                     "no such key here", suggestion(key.str(), known_)});
    }
  }
}

std::string TableReader::suggestion(std::string_view name, std::span<const std::string> known) {
  std::size_t cost = 0;
  for (const std::string& candidate : known) cost += name.size() * candidate.size();
  if (cost > diagnostics_.suggestion_budget) return "";
  diagnostics_.suggestion_budget -= cost;
  return nearest_name(name, known);
}

bool TableReader::is_too_many(std::string_view key, const toml::node& node, std::size_t count) {
  constexpr std::size_t most_tables = 4096;  // bounds the time for shapes that each source chooses from
  if (count > most_tables) error_at(node, field(key), fmt::format("must be at most {} tables", most_tables));
  return count > most_tables;
}

bool TableReader::has(std::string_view key) { return find(key) != nullptr; }

bool TableReader::is_array(std::string_view key) {
  const toml::node* node = find(key);
  return node != nullptr && node->is_array();
}

void TableReader::require(std::string_view key) {
  if (!has(key)) error_at_table(field(key), "must be given");
}

void TableReader::forbid(std::string_view key, std::string rule) {
  if (const toml::node* node = table_.get(key)) {
    known_.emplace_back(key);
    error_at(*node, field(key), std::move(rule));
  }
}

void TableReader::error(std::string_view key, std::string rule) {
  const toml::node* node = key.empty() ? nullptr : table_.get(key);
  if (node != nullptr)
    error_at(*node, field(key), std::move(rule));
  else
    error_at_table(key.empty() ? path_ : field(key), std::move(rule));
}

void TableReader::check(const std::function<void()>& body, std::string_view key) {
  try {
    body();
  } catch (const InvalidValue& invalid) {
    const std::string_view name = invalid.field();
    if (key.empty()) key = name.substr(name.find_last_of('.') + 1);
    const bool given = table_.get(key) != nullptr;
    error(given ? key : "", given ? invalid.rule() : invalid.what());
  } catch (const std::invalid_argument& refusal) {
    error(key, refusal.what());
  }
}

void TableReader::check_later(const Body& check) {
  diagnostics_.later.push_back([&table = table_, &diagnostics = diagnostics_, dimension = dimension_,
                                location = location_, path = path_, check] {
    TableReader reader(table, dimension, location, diagnostics);
    reader.path_ = path;
    check(reader);
  });
}

void TableReader::make_later_checks() const {
  for (const auto& check : std::exchange(diagnostics_.later, {})) check();
}

void TableReader::read_child(const toml::node& node, const Child& child, const Body& body) {
  const toml::table* table = node.as_table();
  if (table == nullptr) {
    error_at(node, field(child.name), "must be a table");
    return;
  }
  TableReader reader(*table, dimension_, locate(node.source()), diagnostics_);
  reader.path_ = field(child.name);
  reader.generic_path_ = below(generic_path_, child.generic_name);
  reader.head_ = below(head_, child.head_name);
  if (diagnostics_.fills) {
    reader.filled_ = diagnostics_.filled.size();
    diagnostics_.filled.push_back({fmt::format(fmt::runtime(child.in_array ? "[[{}]]" : "[{}]"), reader.head_), {}});
  }
  body(reader);
  reader.add_unknown_keys();
}

void TableReader::table(std::string_view key, const Body& body) {
  static const toml::table absent;
  const toml::node* node = find(key);
  const std::string name(key);
  read_child(node == nullptr ? absent : *node, {name, name, name}, body);
}

bool TableReader::tables(std::string_view key, const Body& body) {
  const toml::node* node = find(key);
  if (node == nullptr) return true;
  if (!is_header_array(*node)) {
    error_at(*node, field(key), fmt::format("must be headed [[{}]], which may come many times", key));
    return false;
  }
  const toml::array& array = *node->as_array();
  if (is_too_many(key, *node, array.size())) return false;
  for (std::size_t i = 0; i < array.size(); ++i)
    read_child(array[i], {fmt::format("{}[{}]", key, i), fmt::format("{}[]", key), std::string(key), true}, body);
  return true;
}

bool TableReader::named_tables(std::string_view key, const NamedBody& body) {
  const toml::node* node = find(key);
  if (node == nullptr) return true;
  constexpr std::size_t max_name = 200;  // it is in each error of its table
  const std::string rule = fmt::format("must be headed [{}.NAME], once for each name", key);
  if (!node->is_table()) {
    error_at(*node, field(key), rule);
    return false;
  }
  if (is_too_many(key, *node, node->as_table()->size())) return false;
  bool well_formed = true;
  for (const auto& [key_below, child] : *node->as_table()) {
    const std::string name(key_below.str());
    if (name.size() > max_name) {
      error_at(child, shortened(fmt::format("{}.{}", field(key), name), max_name),
               fmt::format("NAME must be at most {} bytes", max_name));
      well_formed = false;
    } else if (child.is_table()) {
      named_table(key, name, [&](TableReader& reader) { body(name, reader); });
    } else {
      error_at(child, fmt::format("{}.{}", field(key), name), rule);
      well_formed = false;
    }
  }
  return well_formed;
}

void TableReader::named_table(std::string_view key, const std::string& name, const Body& body) {
  const toml::node* node = table_.get(key);
  const toml::node* child = node == nullptr || !node->is_table() ? nullptr : node->as_table()->get(name);
  const std::string quoted = fmt::format("{}.{}", key, key_text(name));
  if (child != nullptr) read_child(*child, {fmt::format("{}.{}", key, name), fmt::format("{}.*", key), quoted}, body);
}

std::vector<std::string> TableReader::names_of_tables(std::string_view key) const {
  std::vector<std::string> names;
  const toml::node* node = table_.get(key);
  if (node == nullptr || !node->is_table()) return names;
  for (const auto& [name, child] : *node->as_table())
    if (child.is_table()) names.emplace_back(name.str());
  return names;
}

std::vector<std::string> TableReader::texts_in_tables(std::string_view tables, std::string_view key) const {
  std::vector<std::string> texts;
  const auto add = [&](const toml::node& node) {
    if (const auto* text = node.as_string()) texts.push_back(**text);
  };
  const toml::node* array = table_.get(tables);
  if (array == nullptr || !array->is_array()) return texts;
  for (const toml::node& table : *array->as_array()) {
    const toml::node* value = table.is_table() ? table.as_table()->get(key) : nullptr;
    if (value == nullptr) continue;
    add(*value);
    if (value->is_array())
      for (const toml::node& element : *value->as_array()) add(element);
  }
  return texts;
}

bool TableReader::read_value(const toml::node& node, const std::string& name, const Key& key, const Range& range,
                             double& value) {
  if (!node.is_number()) {
    error_at(node, name, "must be a number");
    return false;
  }
  // Not node.value<double>(), which is empty for an integer that a double must round.
  const double number = node.is_integer() ? static_cast<double>(**node.as_integer()) : **node.as_floating_point();
  if (!range.holds(number)) {
    error_at(node, name, range.rule());
    return false;
  }
  value = as_kept(key, number);
  return true;
}

template <typename Number>
bool TableReader::read_whole(const toml::node& node, const std::string& name, const Range& range, Number& value) {
  if (!node.is_integer()) {
    error_at(node, name, "must be a whole number");
    return false;
  }
  const std::int64_t number = **node.as_integer();
  if (!range.holds(static_cast<double>(number)) || !std::in_range<Number>(number)) {
    error_at(node, name, range.rule());
    return false;
  }
  value = static_cast<Number>(number);
  return true;
}

bool TableReader::read_value(const toml::node& node, const std::string& name, const Key& /*key*/, const Range& range,
                             int& value) {
  return read_whole(node, name, range, value);
}

bool TableReader::read_value(const toml::node& node, const std::string& name, const Key& /*key*/, const Range& range,
                             std::int64_t& value) {
  return read_whole(node, name, range, value);
}

bool TableReader::read_value(const toml::node& node, const std::string& name, const Key& /*key*/, const Range& range,
                             std::uint64_t& value) {
  return read_whole(node, name, range, value);
}

bool TableReader::read_value(const toml::node& node, const std::string& name, const Key& /*key*/,
                             const Range& /*range*/, bool& value) {
  const auto* flag = node.as_boolean();
  if (flag == nullptr) {
    error_at(node, name, "must be true or false");
    return false;
  }
  value = **flag;
  return true;
}

bool TableReader::read_value(const toml::node& node, const std::string& name, const Key& key, const Range& range,
                             std::string& value) {
  if (key.choice_of != nullptr && node.is_number()) {
    double number = 0.0;
    if (!read_value(node, name, key, range, number)) return false;
    value = key.choice_of(number);
    return true;
  }
  if (!key.choices.empty())
    return read_choice(node, name, value, std::vector<std::string>(key.choices.begin(), key.choices.end()),
                       key.choice_of != nullptr);
  const auto* text = node.as_string();
  if (text == nullptr || (*text)->empty() ||
      (*text)->find_first_of(std::string_view("\n\r\0", 3)) != std::string::npos) {
    error_at(node, name, "must be a text on one line, in quotes, not empty");
    return false;
  }
  value = **text;
  return true;
}

bool TableReader::read_value(const toml::node& node, const std::string& name, const Key& key, const Range& range,
                             std::vector<double>& values) {
  const toml::array* array = node.as_array();
  if (array == nullptr) {
    values.assign(1, 0.0);
    return read_value(node, name, key, range, values.front());
  }
  if (array->empty()) {
    error_at(node, name, "must be at least one number");
    return false;
  }
  values.assign(array->size(), 0.0);
  return read_array(node, name, key, range, values);
}

template <int Size>
bool TableReader::read_value(const toml::node& node, const std::string& name, const Key& key, const Range& range,
                             Eigen::Vector<double, Size>& value) {
  return read_array(node, name, key, range, {value.data(), Size});
}

template <int Size>
bool TableReader::read_value(const toml::node& node, const std::string& name, const Key& key, const Range& range,
                             Eigen::Vector<int, Size>& value) {
  Eigen::Vector<double, Size> numbers = value.template cast<double>();
  if (!read_value(node, name, key, range, numbers) || !all_whole(node, name, {numbers.data(), Size})) return false;
  value = numbers.template cast<int>();
  return true;
}

template <int Size>
bool TableReader::read_value(const toml::node& node, const std::string& name, const Key& key, const Range& range,
                             std::vector<Eigen::Vector<double, Size>>& values) {
  values.assign(count_of_points(node, name), Eigen::Vector<double, Size>::Zero());
  for (std::size_t i = 0; i < values.size(); ++i)
    read_value((*node.as_array())[i], fmt::format("{}[{}]", name, i), key, range, values[i]);
  return !values.empty();
}

template <typename T>
bool TableReader::read_value(const toml::node& node, const std::string& name, const Key& key, const Range& range,
                             std::optional<T>& value) {
  return read_value(node, name, key, range, value.emplace());
}

void TableReader::read_field(const Key& key, const Value& value, const Range& range) {
  const auto read_it = [&](auto where) {
    if constexpr (!std::is_same_v<decltype(where), std::monostate>) {
      if (!has_meaning(key)) return;
      const toml::node* node = find(key);
      if (node != nullptr) read_value(*node, field(key.name), key, range, *where);
      if (!diagnostics_.fills) return;
      if (node != nullptr)
        fill(key.name, value_text(*node));
      else if (in_range(key, numbers_of(where)))
        fill(key.name, field_text(key, *where));
    }
  };
  std::visit(read_it, value);
}

bool TableReader::read_array(const toml::node& node, const std::string& name, const Key& key, const Range& range,
                             std::span<double> values) {
  if (values.size() == 1 && node.is_number()) return read_value(node, name, key, range, values.front());
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != values.size()) {
    error_at(node, name,
             fmt::format("must be {}", values.size() == 1   ? "one number"
                                       : values.size() == 2 ? "two numbers in brackets"
                                                            : "three numbers in brackets"));
    return false;
  }
  bool good = true;
  for (std::size_t i = 0; i < values.size(); ++i)
    good = read_value((*array)[i], fmt::format("{}[{}]", name, i), key, range, values[i]) && good;
  return good;
}

bool TableReader::all_whole(const toml::node& node, const std::string& name, std::span<const double> numbers) {
  const bool whole = std::ranges::all_of(numbers, [](double number) { return number == std::round(number); });
  if (!whole) error_at(node, name, "must be whole numbers");
  return whole;
}

std::size_t TableReader::count_of_points(const toml::node& node, const std::string& name) {
  const std::size_t count = node.is_array() ? node.as_array()->size() : 0;
  if (count == 0) error_at(node, name, "must be an array of one point or more");
  return count;
}

bool TableReader::read_choice(const toml::node& node, const std::string& name, std::string& value,
                              std::span<const std::string> choices, bool or_number) {
  const auto* text = node.as_string();
  if (text == nullptr || std::find(choices.begin(), choices.end(), **text) == choices.end()) {
    error_at(node, name, rule_of(choices, or_number), text == nullptr ? "" : suggestion(**text, choices));
    return false;
  }
  value = **text;
  return true;
}

void TableReader::read(std::string_view key, std::string& value, std::span<const std::string> choices) {
  if (const toml::node* node = find(key)) {
    read_choice(*node, field(key), value, choices);
    fill(key, value_text(*node));
  }
}

void TableReader::read(std::string_view key, std::vector<std::string>& values, std::span<const std::string> choices) {
  const toml::node* node = find(key);
  if (node == nullptr) return;
  const toml::array* array = node->as_array();
  if (array != nullptr && array->empty()) {
    error_at(*node, field(key), "must name at least one");
    return;
  }
  values.assign(array == nullptr ? 1 : array->size(), "");
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string name = array == nullptr ? field(key) : fmt::format("{}[{}]", field(key), i);
    read_choice(array == nullptr ? *node : (*array)[i], name, values[i], choices);
  }
  fill(key, value_text(*node));
}

void TableReader::read(std::string_view key, std::filesystem::path& value,
                       const std::function<std::filesystem::path(const std::filesystem::path&)>& beside) {
  std::string name;
  read({.name = key, .required = true}, name);
  const std::filesystem::path file(name);
  if (name.empty()) return;
  if (std::find(file.begin(), file.end(), "..") != file.end()) {
    error(key, "must be in or below the scene's folder, or absolute: a run keeps a copy of it");
    return;
  }
  value = std::filesystem::path(diagnostics_.file).parent_path() / file;
  if (file.is_relative()) {
    diagnostics_.referred.push_back(file);
    diagnostics_.referred.push_back(beside(file));
  }
}

}  // namespace talus
