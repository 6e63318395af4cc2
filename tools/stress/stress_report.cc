#include "tools/stress/stress_report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>

#include "common/scene/scene.h"
#include "common/scene/window.h"
#include "tools/plot/plot.h"
#include "tools/run/backends.h"
#include "tools/run/version.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

bool is_bad(StressOutcome outcome) { return outcome == StressOutcome::known || outcome == StressOutcome::red; }

std::string measured_text(const StressRow& row) {
  if (row.outcome == StressOutcome::refused) return "refused";
  const std::string value = std::isfinite(row.measured) ? fmt::format("{:.3g}", row.measured) : "none";
  return is_bad(row.outcome) ? "**" + value + "**" : value;
}

std::string gate_text(const StressRow& row) {
  const std::string unit = row.unit.empty() ? "" : " " + row.unit;
  if (row.tolerance == 0.0) return fmt::format("{:.3g}{}", row.reference, unit);
  return fmt::format("{:.3g} ± {:.2g}{}", row.reference, row.tolerance, unit);
}

}  // namespace

Table stress_table(const std::vector<StressRow>& rows) {
  Table table{"", {{"case"}, {"quantity"}, {"must be"}, {"engine"}}, {}};
  for (const std::string_view policy : policy_kinds) table.columns.push_back({std::string(policy), true});
  std::map<std::string, std::size_t> lines;  // of a case, quantity and engine
  for (const StressRow& row : rows) {
    const auto [line, is_new] =
        lines.try_emplace(row.name + '\n' + row.quantity + '\n' + row.backend, table.rows.size());
    if (is_new) table.rows.push_back({row.name, row.quantity, gate_text(row), row.backend, "", "", "", ""});
    const auto column = std::ranges::find(policy_kinds, row.policy) - policy_kinds.begin();
    table.rows[line->second][4 + column] = measured_text(row);
  }
  return table;
}

Table red_table(const std::vector<StressRow>& rows) {
  Table table{"", {{"case"}, {"engine"}, {"quantity"}, {"must be"}, {"measured, by policy"}, {"why"}}, {}};
  std::map<std::string, std::size_t> lines;  // of a case, engine, quantity and reason
  for (const StressRow& row : rows) {
    if (!is_bad(row.outcome)) continue;
    const std::string why = row.outcome == StressOutcome::red ? "not known yet: " + row.note : row.note;
    const std::string value = std::isfinite(row.measured) ? fmt::format("{:.3g}", row.measured) : "none";
    const auto [line, is_new] =
        lines.try_emplace(fmt::format("{}\n{}\n{}\n{}", row.name, row.backend, row.quantity, why), table.rows.size());
    if (is_new) table.rows.push_back({row.name, row.backend, row.quantity, gate_text(row), "", why});
    std::string& measured = table.rows[line->second][4];
    measured += fmt::format("{}{} {}", measured.empty() ? "" : ", ", row.policy, value);
  }
  return table;
}

namespace {

/// "stack-10" as ("stack", 10); no number: an empty family.
std::pair<std::string, double> family_of(const std::string& name) {
  const std::size_t dash = name.rfind('-');
  if (dash == std::string::npos) return {};
  char* end = nullptr;
  const std::string number = name.substr(dash + 1);
  const double value = std::strtod(number.c_str(), &end);
  if (end == number.c_str() || *end != '\0') return {};
  return {name.substr(0, dash), value};
}

/// The numbers of a family that pass, as "5 to 20"; where some between fail, each is listed.
std::string passing_text(const std::map<double, bool>& passes) {
  std::vector<std::pair<double, double>> runs;  // the first and the last of numbers that follow each other
  bool passed = false;
  for (const auto& [value, pass] : passes) {
    if (pass && passed) runs.back().second = value;
    if (pass && !passed) runs.emplace_back(value, value);
    passed = pass;
  }
  std::string text;
  for (const auto& [first, last] : runs)
    text += fmt::format("{}{:g}{}", text.empty() ? "" : ", ", first,
                        last == first ? std::string() : fmt::format(" to {:g}", last));
  return text.empty() ? "none" : text;
}

}  // namespace

Table window_table(const std::vector<StressRow>& rows) {
  struct Cells {
    std::string family;
    std::string backend;
    std::map<std::string, std::map<double, bool>> passes;  // by policy
  };
  std::vector<Cells> all;
  for (const StressRow& row : rows) {
    const auto [family, value] = family_of(row.name);
    if (family.empty()) continue;
    auto found = std::ranges::find_if(
        all, [&, &name = family](const Cells& cells) { return cells.family == name && cells.backend == row.backend; });
    if (found == all.end()) found = all.insert(all.end(), {family, row.backend, {}});
    const bool pass = row.outcome == StressOutcome::pass;
    const auto [entry, is_new] = found->passes[row.policy].try_emplace(value, pass);
    entry->second = entry->second && pass;
  }
  Table table{"", {{"cases"}, {"engine"}}, {}};
  for (const std::string_view policy : policy_kinds) table.columns.push_back({std::string(policy)});
  for (const Cells& cells : all) {
    if (std::ranges::all_of(cells.passes, [](const auto& each) { return each.second.size() < 2; })) continue;
    std::vector<std::string> line = {cells.family, cells.backend};
    for (const std::string_view policy : policy_kinds) {
      const auto found = cells.passes.find(std::string(policy));
      line.push_back(found == cells.passes.end() ? "" : passing_text(found->second));
    }
    table.rows.push_back(std::move(line));
  }
  return table;
}

std::string in_short(const std::vector<StressRow>& rows) {
  std::array<int, 4> counts{};
  for (const StressRow& row : rows) ++counts.at(static_cast<std::size_t>(row.outcome));
  return fmt::format("{} gates: {} pass, {} are known to be red, {} are red for no known reason, {} are refused",
                     rows.size(), counts[0], counts[1], counts[2], counts[3]);
}

namespace {

constexpr std::array<std::string_view, 14> history_columns = {
    "version", "date",     "group",     "case",      "quantity", "unit",    "engine",
    "policy",  "measured", "reference", "tolerance", "outcome",  "seconds", "note"};

/// Cells of comma-separated values (RFC 4180).
std::vector<std::vector<std::string>> cells_of(const std::string& text) {
  std::vector<std::vector<std::string>> lines;
  std::vector<std::string> line(1);
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      const bool doubled = c == '"' && i + 1 < text.size() && text[i + 1] == '"';
      if (doubled) ++i;
      if (c != '"' || doubled)
        line.back() += c;
      else
        quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      line.emplace_back();
    } else if (c == '\n') {
      lines.push_back(std::exchange(line, std::vector<std::string>(1)));
    } else if (c != '\r') {
      line.back() += c;
    }
  }
  return lines;
}

StressRecord record_of(const std::vector<std::string>& cells) {
  StressRecord record{cells[0], cells[1], {}};
  StressRow& row = record.row;
  row.group = cells[2];
  row.name = cells[3];
  row.quantity = cells[4];
  row.unit = cells[5];
  row.backend = cells[6];
  row.policy = cells[7];
  row.measured = cells[8].empty() ? std::nan("") : std::stod(cells[8]);
  row.reference = std::stod(cells[9]);
  row.tolerance = std::stod(cells[10]);
  for (const StressOutcome outcome :
       {StressOutcome::pass, StressOutcome::known, StressOutcome::red, StressOutcome::refused})
    if (cells[11] == to_string(outcome)) row.outcome = outcome;
  row.seconds = std::stod(cells[12]);
  row.note = cells[13];
  return record;
}

std::vector<std::string> cells_of(const StressRecord& record) {
  const StressRow& row = record.row;
  return {record.version,
          record.date,
          row.group,
          row.name,
          row.quantity,
          row.unit,
          row.backend,
          row.policy,
          std::isfinite(row.measured) ? fmt::format("{:.6g}", row.measured) : "",
          fmt::format("{:g}", row.reference),
          fmt::format("{:g}", row.tolerance),
          std::string(to_string(row.outcome)),
          fmt::format("{:.3f}", row.seconds),
          row.note};
}

}  // namespace

std::vector<StressRecord> read_history(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return {};
  const auto lines = cells_of(std::string(std::istreambuf_iterator<char>(in), {}));
  if (lines.empty() || !std::ranges::equal(lines.front(), history_columns))
    throw std::invalid_argument(fmt::format("{}: must be a stress.csv of talus stress", file.string()));
  std::vector<StressRecord> records;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    try {
      if (lines[i].size() != history_columns.size()) throw std::invalid_argument("");
      records.push_back(record_of(lines[i]));
    } catch (const std::logic_error&) {
      throw std::invalid_argument(fmt::format("{}:{}: must be a row of talus stress", file.string(), i + 1));
    }
  }
  return records;
}

std::vector<StressRecord> append_history(const fs::path& file, const std::vector<StressRow>& rows) {
  std::vector<StressRecord> history = read_history(file);
  const std::string version = version_text();
  const std::string date = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
  std::erase_if(history, [&](const StressRecord& old) {
    return old.version == version && std::ranges::any_of(rows, [&](const StressRow& row) {
             return row.name == old.row.name && row.backend == old.row.backend && row.policy == old.row.policy;
           });
  });
  for (const StressRow& row : rows) history.push_back({version, date, row});
  Table table;
  for (const std::string_view column : history_columns) table.columns.push_back({std::string(column)});
  for (const StressRecord& record : history) table.rows.push_back(cells_of(record));
  if (!file.parent_path().empty()) fs::create_directories(file.parent_path());
  std::ofstream out(file, std::ios::binary);
  out << csv_of(table);
  if (!out.flush()) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
  return read_history(file);  // all with the digits of the file, or a value that did not change would seem to
}

namespace {

/// The commit alone, of "0.1.0 (0123abcd)"; the whole text where there is none.
std::string name_of_version(const std::string& version) {
  const std::size_t from = version.find('(');
  const std::size_t to = version.find(')');
  return from < to && to != std::string::npos ? version.substr(from + 1, to - from - 1) : version;
}

/// The newest versions of the history, in its order.
std::vector<std::string> newest_versions(const std::vector<StressRecord>& history) {
  constexpr std::size_t most_versions = 50;
  std::vector<std::string> versions;
  for (const StressRecord& record : history)
    if (std::ranges::find(versions, record.version) == versions.end()) versions.push_back(record.version);
  if (versions.size() > most_versions) versions.erase(versions.begin(), versions.end() - most_versions);
  return versions;
}

/// By engine: at each version, as its number, the value farthest from the reference.
using Curves = std::map<std::string, std::map<double, double>>;

/// By case and quantity.
std::map<std::pair<std::string, std::string>, Curves> curves_of(const std::vector<StressRecord>& history,
                                                                const std::vector<std::string>& versions) {
  std::map<std::pair<std::string, std::string>, Curves> curves;
  for (const StressRecord& record : history) {
    const auto version = std::ranges::find(versions, record.version);
    if (version == versions.end() || !std::isfinite(record.row.measured)) continue;
    auto& curve = curves[{record.row.name, record.row.quantity}][record.row.backend];
    const auto [point, is_new] =
        curve.try_emplace(static_cast<double>(version - versions.begin()), record.row.measured);
    if (std::abs(record.row.measured - record.row.reference) > std::abs(point->second - record.row.reference))
      point->second = record.row.measured;
  }
  return curves;
}

}  // namespace

std::vector<Figure> history_figures(const std::vector<StressRecord>& history) {
  const std::vector<std::string> versions = newest_versions(history);
  if (versions.size() < 2) return {};
  std::vector<std::string> names;
  std::ranges::transform(versions, std::back_inserter(names), name_of_version);
  std::vector<Figure> figures;
  for (const auto& [key, engines] : curves_of(history, versions)) {
    Plot plot{.title = key.first,
              .x_label = "version",
              .y_label = key.second,
              .x_names = names,
              .from_zero = false,
              .series = {}};
    for (const auto& [engine, points] : engines) {
      Series series{engine, {}, {}};
      series.style = SeriesStyle::line_and_points;
      for (const auto& [x, y] : points) {
        series.x.push_back(x);
        series.y.push_back(y);
      }
      if (points.size() > 1) plot.series.push_back(std::move(series));
    }
    if (plot.series.empty()) continue;
    figures.push_back(
        {svg_of(plot), fmt::format("{}: {}, of all policies the value farthest from its reference, from {} to {}.",
                                   key.first, key.second, versions.front(), versions.back())});
  }
  return figures;
}

namespace {

/// Setup and reason of each gate of the cases in the rows.
Table cases_table(std::string_view group, const std::vector<StressRow>& rows) {
  Table table{"", {{"case"}, {"what is built"}, {"why these references"}}, {}};
  for (const StressCase& each : stress_cases()) {
    if (each.group != group || std::ranges::find(rows, each.name, &StressRow::name) == rows.end()) continue;
    std::string why;
    for (const StressGate& gate : each.gates)
      why += fmt::format("{}{}: {}", why.empty() ? "" : "; ", gate.quantity, gate.why);
    table.rows.push_back({each.name, each.setup, why});
  }
  return table;
}

/// The limits of each engine in this build.
Table rules_table() {
  Table table{"", {{"engine"}, {"field"}, {"rule"}}, {}};
  const auto add = [&](const EngineTraits& engine) {
    for (const WindowRule& rule : window_rules(engine))
      table.rows.push_back({std::string(engine.name), fmt::format("`{}`", rule.field), rule.rule});
  };
  for (const std::string& backend : backends(2)) add(engine_traits<2>(backend));
  for (const std::string& backend : backends(3)) add(engine_traits<3>(backend));
  return table;
}

}  // namespace

std::vector<Section> stress_sections(const std::vector<StressRow>& rows) {
  std::vector<Section> sections;
  sections.push_back({"In short", {Paragraph{in_short(rows) + "."}}});
  sections.push_back(
      {"The window",
       {Paragraph{
            "What `talus run`, `check`, `view` and `sweep` demand of a scene, from the cases below. Outside of the "
            "window structures that stand by statics fall apart, or bodies pass through each other: the scene is "
            "refused with exit code 2, and with `--force` it runs with warnings, which also stand in "
            "[summary.json](files.md#summaryjson). Inside of it the [red cells](#red-cells) remain: they are "
            "smaller, or depend on more than a scene's numbers."},
        rules_table()}});
  sections.push_back(
      {"Where results hold",
       {Paragraph{"Of cases that differ in one number: the numbers at which all of their gates hold. What is left out "
                  "failed, or was refused before it ran."},
        window_table(rows)}});
  Section red{"Red cells", {}};
  const Table table = red_table(rows);
  if (table.rows.empty())
    red.blocks.emplace_back(Paragraph{"None."});
  else
    red.blocks.emplace_back(table);
  sections.push_back(std::move(red));
  for (const StressGroup& group : stress_groups()) {
    std::vector<StressRow> some;
    std::ranges::copy_if(rows, std::back_inserter(some), [&](const StressRow& row) { return row.group == group.name; });
    if (some.empty()) continue;
    sections.push_back({fmt::format("Group {}", group.name),
                        {Paragraph{std::string(group.about)}, stress_table(some), cases_table(group.name, some)}});
  }
  return sections;
}

}  // namespace talus
