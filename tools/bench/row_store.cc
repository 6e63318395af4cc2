#include "tools/bench/row_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array passes = {Pass::timing, Pass::against_full, Pass::against_reference};

std::vector<Row> read(const std::filesystem::path& file) {
  std::vector<Row> rows;
  std::ifstream in(file, std::ios::binary);
  int number = 0;
  for (std::string line; std::getline(in, line) && !in.eof();) {
    ++number;
    try {
      rows.push_back(row_of(line));
    } catch (const std::exception& error) {
      throw std::invalid_argument(
          fmt::format("{}:{}: must be a row that this version measured ({}); move the file away", file.string(), number,
                      error.what()));
    }
  }
  return rows;
}

}  // namespace

std::string line_of(const Row& row) {
  const RowKey& key = row.key;
  Json json = {{"scene", key.scene},       {"backend", key.backend},   {"policy", key.policy},
               {"settings", key.settings}, {"version", key.version},   {"pass", name_of(key.pass)},
               {"round", key.round},       {"end_hash", row.end_hash}, {"values", Json::object()}};
  for (const MeasureId id : row.values.measured()) json["values"][std::string(id.info().name)] = row.values[id];
  return json.dump() + "\n";
}

Row row_of(const std::string& line) {
  const Json json = Json::parse(line);
  Row row{{json.at("scene"), json.at("backend"), json.at("policy"), json.at("settings"), json.at("version"),
           Pass::timing, json.at("round")},
          json.at("end_hash"),
          {}};
  const std::string pass = json.at("pass");
  const auto found = std::ranges::find(passes, pass, name_of);
  if (found == passes.end()) throw std::invalid_argument(fmt::format("pass = \"{}\" is not known", pass));
  row.key.pass = *found;
  for (const auto& [name, value] : json.at("values").items()) row.values[MeasureId::named(name)] = value;
  return row;
}

std::string name_of(Pass pass) {
  switch (pass) {
    case Pass::timing:
      return "timing";
    case Pass::against_full:
      return "against_full";
    case Pass::against_reference:
      return "against_reference";
  }
  throw std::logic_error("not a pass");
}

RowStore::RowStore(const std::filesystem::path& file) : file_(file), rows_(read(file)) {
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  const std::filesystem::path fresh = file.string() + ".new";
  out_.open(fresh, std::ios::binary);
  for (const Row& row : rows_) out_ << line_of(row);
  out_.flush();
  if (!out_) throw std::runtime_error(fmt::format("{}: cannot be written", fresh.string()));
  std::filesystem::rename(fresh, file);
}

const Row* RowStore::find(const RowKey& key) const {
  const auto found = std::ranges::find(rows_, key, &Row::key);
  return found == rows_.end() ? nullptr : &*found;
}

void RowStore::add(const Row& row) {
  assert(find(row.key) == nullptr);
  rows_.push_back(row);
  out_ << line_of(row);
  out_.flush();
  if (!out_) throw std::runtime_error(fmt::format("{}: cannot be written", file_.string()));
}

std::vector<const Row*> RowStore::rounds(RowKey key) const {
  std::vector<const Row*> found;
  key.pass = Pass::timing;
  for (const Row& row : rows_) {
    key.round = row.key.round;
    if (row.key == key) found.push_back(&row);
  }
  return found;
}

}  // namespace talus
