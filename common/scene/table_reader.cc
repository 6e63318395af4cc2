#include "common/scene/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/scene/nearest_name.h"
#include "common/scene/toml_text.h"
#include "common/text/shortened.h"

namespace talus {
namespace {

// A value short enough for a message; a table says no more than that it is one.
std::string written(const toml::node& node) {
  if (node.is_table()) {
    return "{...}";
  }
  return shortened(value_text(node), 60);
}

std::string joined(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : (path + '.').append(key);
}

bool is_header_array(const toml::node& node) {
  return node.is_array() && std::all_of(node.as_array()->begin(), node.as_array()->end(),
                                        [](const toml::node& element) { return element.is_table(); });
}

}  // namespace

TableReader::TableReader(const toml::table& table, std::string path, std::string generic_path, Location location,
                         Findings& findings)
    : table_(table),
      path_(std::move(path)),
      generic_path_(std::move(generic_path)),
      location_(std::move(location)),
      findings_(findings),
      errors_before_(findings.errors.size()) {}

void TableReader::read_root(const toml::table& table, Findings& findings, const Body& body) {
  TableReader reader(table, "", "", {findings.file, 1, 1}, findings);
  body(reader);
  reader.note_unknown_keys();
}

std::string TableReader::field(std::string_view key) const { return joined(path_, key); }

const toml::node* TableReader::find(std::string_view key) {
  known_.emplace_back(key);
  if (findings_.keys_wanted) findings_.keys.insert(joined(generic_path_, key));
  return node_of(key);
}

const toml::node* TableReader::node_of(std::string_view key) const {
  const auto old = old_names_.find(key);
  return table_.get(old == old_names_.end() ? key : std::string_view(old->second));
}

void TableReader::renamed(std::string_view old_key, std::string_view key) {
  const toml::node* node = table_.get(old_key);
  if (node == nullptr) {
    return;
  }
  known_.emplace_back(old_key);
  if (table_.contains(key)) {
    note(*node, field(old_key), fmt::format("must not be given beside {}, its new name", key));
    return;
  }
  old_names_.emplace(key, old_key);
  warn_at(locate(node->source()),
          fmt::format("{} is now named {}; only this version still reads the old name", field(old_key), key));
}

void TableReader::warn(std::string_view warning) { warn_at(location_, fmt::format("{}: {}", path_, warning)); }

void TableReader::warn_at(const Location& at, const std::string& warning) {
  const std::string place = at.line > 0 ? fmt::format("{}:{}:{}", at.file, at.line, at.column) : at.file;
  findings_.warnings.push_back(fmt::format("{}: {}", place, warning));
}

TableReader::Location TableReader::locate(const toml::source_region& region) const {
  if (region.begin.line == 0) {
    return location_;
  }
  if (region.path && *region.path != findings_.file) {
    return {*region.path, 0, 0};  // a `--set`: line and column within its value would only confuse
  }
  return {findings_.file, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

void TableReader::note(const toml::node& node, std::string name, std::string rule, std::string suggestion) {
  Location at = locate(node.source());
  findings_.errors.push_back(
      {std::move(at.file), at.line, at.column, std::move(name), written(node), std::move(rule), std::move(suggestion)});
}

void TableReader::note_unknown_keys() {
  if (unknown_keys_allowed_) {
    return;
  }
  for (const auto& [key, node] : table_) {
    if (std::find(known_.begin(), known_.end(), key.str()) == known_.end()) {
      const bool key_has_place = key.source().begin.line > 0;
      Location at = locate(key_has_place ? key.source() : node.source());
      findings_.errors.push_back({std::move(at.file), at.line, at.column, field(key.str()), written(node),
                                  "no such key here", suggestion(key.str(), known_)});
    }
  }
}

std::string TableReader::suggestion(std::string_view name, std::span<const std::string> known) {
  std::size_t cost = 0;
  for (const std::string& candidate : known) cost += name.size() * candidate.size();
  if (cost > findings_.suggestion_budget) return "";
  findings_.suggestion_budget -= cost;
  return nearest_name(name, known);
}

bool TableReader::is_too_many(std::string_view key, const toml::node& node, std::size_t count) {
  constexpr std::size_t most_tables = 4096;  // bounds the time for shapes that each source chooses from
  if (count > most_tables) note(node, field(key), fmt::format("must be at most {} tables", most_tables));
  return count > most_tables;
}

bool TableReader::has(std::string_view key) { return find(key) != nullptr; }

void TableReader::require(std::string_view key) {
  if (!has(key)) {
    findings_.errors.push_back({location_.file, location_.line, location_.column, field(key), "", "must be given", ""});
  }
}

void TableReader::refuse(std::string_view key, std::string rule) {
  if (const toml::node* node = table_.get(key)) {
    known_.emplace_back(key);
    note(*node, field(key), std::move(rule));
  }
}

void TableReader::reject(std::string_view key, std::string rule, std::string suggestion) {
  const toml::node* node = key.empty() ? nullptr : node_of(key);
  if (node != nullptr) {
    note(*node, field(key), std::move(rule), std::move(suggestion));
  } else {
    findings_.errors.push_back({location_.file, location_.line, location_.column, key.empty() ? path_ : field(key), "",
                                std::move(rule), std::move(suggestion)});
  }
}

void TableReader::reject_as(const std::invalid_argument& refusal, std::string_view key) {
  const std::string_view text = refusal.what();
  const std::size_t equals = text.find(" = ");
  const std::size_t colon = text.find(": ", equals);
  if (colon == std::string_view::npos) {
    reject(key, std::string(text));
    return;
  }
  if (key.empty()) {
    const std::string_view name = text.substr(0, equals);
    key = name.substr(name.find_last_of('.') + 1);
  }
  if (node_of(key) != nullptr) {
    reject(key, std::string(text.substr(colon + 2)));
  } else {
    reject("", std::string(text));
  }
}

void TableReader::read_child(const toml::node& node, const std::string& name, const std::string& generic_name,
                             const Body& body) {
  const toml::table* table = node.as_table();
  if (table == nullptr) {
    note(node, field(name), "must be a table");
    return;
  }
  TableReader reader(*table, field(name), joined(generic_path_, generic_name), locate(node.source()), findings_);
  body(reader);
  reader.note_unknown_keys();
}

void TableReader::table(std::string_view key, const Body& body) {
  const toml::table absent;
  const toml::node* node = find(key);
  read_child(node == nullptr ? absent : *node, std::string(key), std::string(key), body);
}

bool TableReader::tables(std::string_view key, const Body& body) {
  const toml::node* node = find(key);
  if (node == nullptr) {
    return true;
  }
  if (!is_header_array(*node)) {
    note(*node, field(key), fmt::format("must be headed [[{}]], which may come many times", key));
    return false;
  }
  const toml::array& array = *node->as_array();
  if (is_too_many(key, *node, array.size())) return false;
  for (std::size_t i = 0; i < array.size(); ++i) {
    read_child(array[i], fmt::format("{}[{}]", key, i), fmt::format("{}[]", key), body);
  }
  return true;
}

bool TableReader::named_tables(std::string_view key, const NamedBody& body) {
  const toml::node* node = find(key);
  if (node == nullptr) {
    return true;
  }
  constexpr std::size_t max_name = 200;  // it is in each error of its table
  const std::string rule = fmt::format("must be headed [{}.NAME], once for each name", key);
  if (!node->is_table()) {
    note(*node, field(key), rule);
    return false;
  }
  if (is_too_many(key, *node, node->as_table()->size())) return false;
  bool well_formed = true;
  for (const auto& [key_below, child] : *node->as_table()) {
    const std::string name(key_below.str());
    if (name.size() > max_name) {
      note(child, shortened(fmt::format("{}.{}", field(key), name), max_name),
           fmt::format("NAME must be at most {} bytes", max_name));
      well_formed = false;
    } else if (child.is_table()) {
      read_child(child, fmt::format("{}.{}", key, name), fmt::format("{}.*", key),
                 [&](TableReader& reader) { body(name, reader); });
    } else {
      note(child, fmt::format("{}.{}", field(key), name), rule);
      well_formed = false;
    }
  }
  return well_formed;
}

}  // namespace talus
