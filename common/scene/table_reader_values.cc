// The values that a TableReader reads; its tables, keys and errors are in table_reader.cc.

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "common/scene/table_reader.h"

namespace talus {
namespace {

std::string rule_of(std::span<const std::string> choices) {
  constexpr std::size_t most_named = 50;
  return fmt::format("must be {}{}{}", choices.size() == 1 ? "" : "one of ",
                     fmt::join(choices.first(std::min(choices.size(), most_named)), ", "),
                     choices.size() > most_named ? ", ..." : "");
}

}  // namespace

bool TableReader::read_number(const toml::node& node, const std::string& name, double& value, const Range& range) {
  if (!node.is_number()) {
    note(node, name, "must be a number");
    return false;
  }
  // Not node.value<double>(), which has no answer for an integer that a double must round.
  const double number = node.is_integer() ? static_cast<double>(**node.as_integer()) : **node.as_floating_point();
  if (!range.holds(number)) {
    note(node, name, range.rule());
    return false;
  }
  value = number;
  return true;
}

void TableReader::read(std::string_view key, double& value, const Range& range) {
  if (const toml::node* node = find(key)) {
    read_number(*node, field(key), value, range);
  }
}

void TableReader::read_degrees(std::string_view key, double& radians, const Range& range) {
  double degrees = 0.0;
  const toml::node* node = find(key);
  if (node != nullptr && read_number(*node, field(key), degrees, range)) {
    radians = degrees * std::numbers::pi / 180.0;
  }
}

template <typename Number>
void TableReader::read_whole(std::string_view key, Number& value, const Range& range) {
  const toml::node* node = find(key);
  if (node == nullptr) {
    return;
  }
  if (!node->is_integer()) {
    note(*node, field(key), "must be a whole number");
    return;
  }
  const std::int64_t number = **node->as_integer();
  if (!range.holds(static_cast<double>(number)) || !std::in_range<Number>(number)) {
    note(*node, field(key), range.rule());
    return;
  }
  value = static_cast<Number>(number);
}

void TableReader::read(std::string_view key, int& value, const Range& range) { read_whole(key, value, range); }
void TableReader::read(std::string_view key, std::int64_t& value, const Range& range) { read_whole(key, value, range); }

void TableReader::read(std::string_view key, bool& value) {
  if (const toml::node* node = find(key)) {
    if (const auto* flag = node->as_boolean()) {
      value = **flag;
    } else {
      note(*node, field(key), "must be true or false");
    }
  }
}

void TableReader::read(std::string_view key, std::string& value) {
  const toml::node* node = find(key);
  if (node == nullptr) {
    return;
  }
  const auto* text = node->as_string();
  if (text == nullptr || (*text)->empty() || (*text)->find_first_of("\n\r") != std::string::npos) {
    note(*node, field(key), "must be a text on one line, in quotes, not empty");
    return;
  }
  value = **text;
}

void TableReader::read(std::string_view key, std::filesystem::path& value,
                       const std::function<std::filesystem::path(const std::filesystem::path&)>& beside) {
  std::string name;
  read(key, name);
  const std::filesystem::path file(name);
  if (name.empty()) {
    return;
  }
  if (std::find(file.begin(), file.end(), "..") != file.end()) {
    reject(key, "must be in or below the scene's folder, or absolute: a run keeps a copy of it");
    return;
  }
  value = std::filesystem::path(findings_.file).parent_path() / file;
  if (file.is_relative()) {
    findings_.referred.push_back(file);
    findings_.referred.push_back(beside(file));
  }
}

bool TableReader::read_choice(const toml::node& node, const std::string& name, std::string& value,
                              std::span<const std::string> choices) {
  const auto* text = node.as_string();
  if (text == nullptr || std::find(choices.begin(), choices.end(), **text) == choices.end()) {
    note(node, name, rule_of(choices), text == nullptr ? "" : suggestion(**text, choices));
    return false;
  }
  value = **text;
  return true;
}

void TableReader::read(std::string_view key, std::string& value, std::span<const std::string> choices) {
  if (const toml::node* node = find(key)) {
    read_choice(*node, field(key), value, choices);
  }
}

void TableReader::read(std::string_view key, std::vector<std::string>& values, std::span<const std::string> choices) {
  const toml::node* node = find(key);
  if (node == nullptr) {
    return;
  }
  const toml::array* array = node->as_array();
  if (array != nullptr && array->empty()) {
    note(*node, field(key), "must name at least one");
    return;
  }
  values.assign(array == nullptr ? 1 : array->size(), "");
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string name = array == nullptr ? field(key) : fmt::format("{}[{}]", field(key), i);
    read_choice(array == nullptr ? *node : (*array)[i], name, values[i], choices);
  }
}

void TableReader::read(std::string_view key, std::vector<double>& values, const Range& range) {
  const toml::node* node = find(key);
  if (node == nullptr) {
    return;
  }
  const toml::array* array = node->as_array();
  if (array == nullptr) {
    values.assign(1, 0.0);
    read_number(*node, field(key), values.front(), range);
    return;
  }
  if (array->empty()) {
    note(*node, field(key), "must hold at least one number");
    return;
  }
  values.assign(array->size(), 0.0);
  read_array(*node, field(key), values, range);
}

bool TableReader::read_array(const toml::node& node, const std::string& name, std::span<double> values,
                             const Range& range) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != values.size()) {
    note(node, name,
         fmt::format("must be {} in brackets", values.size() == 1   ? "one number"
                                               : values.size() == 2 ? "two numbers"
                                                                    : "three numbers"));
    return false;
  }
  bool good = true;
  for (std::size_t i = 0; i < values.size(); ++i) {
    good = read_number((*array)[i], fmt::format("{}[{}]", name, i), values[i], range) && good;
  }
  return good;
}

template <int Size>
void TableReader::read(std::string_view key, Eigen::Matrix<double, Size, 1>& value, const Range& range) {
  if (const toml::node* node = find(key)) {
    read_array(*node, field(key), {value.data(), static_cast<std::size_t>(Size)}, range);
  }
}

template <int Size>
void TableReader::read(std::string_view key, std::vector<Eigen::Matrix<double, Size, 1>>& values, const Range& range) {
  const toml::node* node = find(key);
  if (node == nullptr) {
    return;
  }
  const toml::array* array = node->as_array();
  if (array == nullptr) {
    note(*node, field(key), "must be an array of points");
    return;
  }
  values.assign(array->size(), Eigen::Matrix<double, Size, 1>::Zero());
  for (std::size_t i = 0; i < values.size(); ++i) {
    read_array((*array)[i], fmt::format("{}[{}]", field(key), i), {values[i].data(), static_cast<std::size_t>(Size)},
               range);
  }
}

using Vector1 = Eigen::Matrix<double, 1, 1>;
using Vector2 = Eigen::Matrix<double, 2, 1>;
using Vector3 = Eigen::Matrix<double, 3, 1>;
template void TableReader::read<1>(std::string_view, Vector1&, const Range&);
template void TableReader::read<2>(std::string_view, Vector2&, const Range&);
template void TableReader::read<3>(std::string_view, Vector3&, const Range&);
template void TableReader::read<2>(std::string_view, std::vector<Vector2>&, const Range&);
template void TableReader::read<3>(std::string_view, std::vector<Vector3>&, const Range&);

}  // namespace talus
