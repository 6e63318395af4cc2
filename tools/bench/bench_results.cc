#include "tools/bench/bench_results.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tools/bench/machine.h"

namespace talus {

namespace {

using Json = nlohmann::ordered_json;

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
}

std::vector<std::string> summary_names() {
  std::vector<std::string> names = {"speed_up",          "speed_up_min", "speed_up_max", "speed_up_pour",
                                    "speed_up_last_100", "seconds_min",  "seconds_max"};
  for (const char* name : measure_names()) names.emplace_back(name);
  return names;
}

Json json_of(const Values& values) {
  Json json = Json::object();
  for (const std::string& name : summary_names()) {
    const double value = value_of(values, name);
    if (std::isfinite(value)) json[name] = value;
  }
  return json;
}

Json results_json(const BenchRunner& runner, const std::vector<BenchGroup>& groups, const BenchResults& results) {
  Json machine = Json::object();
  for (const auto& [name, value] : machine_facts()) machine[name] = value;
  Json json = {{"title", results.title}, {"machine", machine}, {"cases", Json::array()}};
  for (const BenchGroup& group : groups) {
    for (const BenchCase& each : group.cases) {
      const RowKey key = key_of(each);
      Json row = {{"scene", key.scene},
                  {"backend", key.backend},
                  {"policy", key.policy},
                  {"settings", each.settings},
                  {"version", key.version},
                  {"end_hashes", runner.hashes(each)},
                  {"against_full", json_of(runner.summary(each, group.cases.front()))}};
      if (runner.options().reference) {
        row["against_reference"] = json_of(runner.summary(each, group.cases.front(), "reference"));
      }
      json["cases"].push_back(row);
    }
  }
  return json;
}

Table results_table(const BenchRunner& runner, const std::vector<BenchGroup>& groups) {
  Table table{"", {{"scene"}, {"backend"}, {"policy"}, {"settings"}, {"version"}, {"against"}, {"end_hashes"}}, {}};
  for (const std::string& name : summary_names()) table.columns.push_back({name, true});
  std::vector<std::string> baselines = {"errors"};
  if (runner.options().reference) baselines.emplace_back("reference");
  for (const BenchGroup& group : groups) {
    for (const BenchCase& each : group.cases) {
      for (const std::string& against : baselines) {
        const RowKey key = key_of(each);
        table.rows.push_back({key.scene, key.backend, key.policy, key.settings, key.version,
                              against == "errors" ? "full" : against,
                              fmt::format("{}", fmt::join(runner.hashes(each), " "))});
        const Values values = runner.summary(each, group.cases.front(), against);
        for (const std::string& name : summary_names()) {
          const double value = value_of(values, name);
          table.rows.back().push_back(std::isfinite(value) ? fmt::format("{}", value) : "");
        }
      }
    }
  }
  return table;
}

std::string markdown_of(const BenchResults& results) {
  std::string text = fmt::format("# {}\n\n", results.title);
  for (const std::string& note : results.notes) text += note + "\n\n";
  for (const auto& [name, value] : machine_facts()) text += fmt::format("- {}: {}\n", name, value);
  for (const Section& section : results.sections) {
    text += fmt::format("\n## {}\n", section.heading);
    for (const Block& block : section.blocks) {
      if (const auto* paragraph = std::get_if<Paragraph>(&block)) text += "\n" + paragraph->text + "\n";
      if (const auto* table = std::get_if<Table>(&block)) {
        text += (table->caption.empty() ? "\n" : fmt::format("\n{}\n\n", table->caption)) + talus::markdown_of(*table);
      }
    }
  }
  return text;
}

/// The figures as files too, for manuals.
void write_figures(const std::filesystem::path& folder, const BenchResults& results) {
  int number = 0;
  for (const Section& section : results.sections) {
    for (const Block& block : section.blocks) {
      const auto* figure = std::get_if<Figure>(&block);
      if (figure != nullptr) write(folder / fmt::format("figure-{}.svg", ++number), figure->svg);
    }
  }
}

Report report_of(const BenchResults& results) {
  Report report{results.title, "", {}};
  Section conditions{"How it was measured", {}};
  for (const std::string& note : results.notes) conditions.blocks.emplace_back(Paragraph{note});
  Table machine{"", {{"what"}, {"value"}}, {}};
  for (const auto& [name, value] : machine_facts()) {
    machine.rows.push_back({name, value});
    if (name == "talus" || name == "date") report.subtitle += (report.subtitle.empty() ? "" : ", talus ") + value;
  }
  conditions.blocks.emplace_back(machine);
  report.sections = results.sections;
  report.sections.push_back(conditions);
  return report;
}

}  // namespace

std::string shown(double value, int digits) {
  if (std::isinf(value)) return "∞";
  if (std::isnan(value)) return "-";
  const double size = std::abs(value);
  if (size >= 1e3 && size < 1e6) return fmt::format("{:.0f}", value);
  return fmt::format("{:.{}g}", value, digits);
}

std::string shown_with_range(const Values& values, const std::string& name, int digits) {
  const double value = value_of(values, name);
  const double low = value_of(values, name + "_min");
  if (std::isnan(value) || low == value_of(values, name + "_max")) return shown(value, digits);
  return fmt::format("{} ({}-{})", shown(value, digits), shown(low, digits),
                     shown(value_of(values, name + "_max"), digits));
}

std::string label_of(const BenchGroup& group, const BenchCase& bench_case) {
  std::string label = bench_case.policy;
  for (const std::string& setting : bench_case.settings) {
    const bool everywhere = std::all_of(group.cases.begin(), group.cases.end(), [&](const BenchCase& other) {
      return std::find(other.settings.begin(), other.settings.end(), setting) != other.settings.end();
    });
    if (!everywhere) label += " " + setting;
  }
  return label;
}

void write_results(const BenchRunner& runner, const std::vector<BenchGroup>& groups, const BenchResults& results) {
  const std::filesystem::path& folder = runner.options().out;
  write(folder / "results.csv", csv_of(results_table(runner, groups)));
  write(folder / "results.json", results_json(runner, groups, results).dump(2) + "\n");
  write(folder / "results.md", markdown_of(results));
  write_figures(folder, results);
  write(folder / "report.html", html_of(report_of(results)));
  fmt::print("{}/report.html, results.md, results.csv and results.json\n", folder.string());
}

}  // namespace talus
