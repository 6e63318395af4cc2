#include "tools/bench/bench_results.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tools/bench/machine.h"
#include "tools/output/output.h"

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
}

Json json_of(const Values& values) {
  Json json = Json::object();
  for (const MeasureId id : values.measured()) json[std::string(id.info().name)] = values[id];
  return json;
}

std::vector<Pass> passes_of(const BenchOptions& options) {
  if (options.reference) return {Pass::against_full, Pass::against_reference};
  return {Pass::against_full};
}

Json results_json(const BenchRunner& runner, const std::vector<BenchGroup>& groups, const BenchResults& results) {
  Json machine = Json::object();
  for (const auto& [name, value] : machine_facts()) machine[name] = value;
  Json json = {{"title", results.title}, {"machine", machine}, {"cases", Json::array()}};
  for (const BenchGroup& group : groups) {
    for (const BenchCase& each : group.cases) {
      const RowKey key = key_of(each);
      Json row = {{"scene", key.scene},        {"backend", key.backend}, {"policy", key.policy},
                  {"settings", each.settings}, {"version", key.version}, {"end_hashes", runner.hashes(each)}};
      for (const Pass pass : passes_of(runner.options()))
        row[name_of(pass)] = json_of(runner.summary(each, group.full(), pass));
      json["cases"].push_back(row);
    }
  }
  return json;
}

Table results_table(const BenchRunner& runner, const std::vector<BenchGroup>& groups) {
  Table table{"", {{"scene"}, {"backend"}, {"policy"}, {"settings"}, {"version"}, {"pass"}, {"end_hashes"}}, {}};
  for (const Measure& measure : measures) table.columns.push_back({std::string(measure.name), true});
  for (const BenchGroup& group : groups) {
    for (const BenchCase& each : group.cases) {
      for (const Pass pass : passes_of(runner.options())) {
        const RowKey key = key_of(each);
        table.rows.push_back({key.scene, key.backend, key.policy, key.settings, key.version, name_of(pass),
                              fmt::format("{}", fmt::join(runner.hashes(each), " "))});
        const Values values = runner.summary(each, group.full(), pass);
        for (const MeasureId id : MeasureId::all())
          table.rows.back().push_back(std::isfinite(values[id]) ? fmt::format("{}", values[id]) : "");
      }
    }
  }
  return table;
}

/// What was run, when and on what: the head of a page of results.
std::string head_of(const BenchResults& results) {
  std::string text = fmt::format("# {}\n\n", results.title);
  if (!results.command.empty()) text += fmt::format("- command: `{}`\n", results.command);
  for (const auto& [fact, value] : machine_facts()) text += fmt::format("- {}: {}\n", fact, value);
  for (const std::string& note : results.notes) text += "\n" + note + "\n";
  return text;
}

/// The results as Markdown; figures are linked as NAME-1.svg, NAME-2.svg, ...
std::string markdown_of(const BenchResults& results, const std::string& name) {
  std::string text = head_of(results);
  int number = 0;
  for (const Section& section : results.sections) {
    text += fmt::format("\n## {}\n", section.heading);
    for (const Block& block : section.blocks) {
      if (const auto* paragraph = std::get_if<Paragraph>(&block)) text += "\n" + paragraph->text + "\n";
      if (const auto* table = std::get_if<Table>(&block))
        text += (table->caption.empty() ? "\n" : fmt::format("\n{}\n\n", table->caption)) + talus::markdown_of(*table);
      if (const auto* figure = std::get_if<Figure>(&block)) {
        ++number;
        text += fmt::format("\n![{}]({}-{}.svg)\n", figure->caption, name, number);
      }
    }
  }
  return text;
}

/// The figures as NAME-1.svg, NAME-2.svg, ...
void write_figures(const std::filesystem::path& folder, const std::string& name, const BenchResults& results) {
  int number = 0;
  for (const Section& section : results.sections) {
    for (const Block& block : section.blocks) {
      const auto* figure = std::get_if<Figure>(&block);
      if (figure != nullptr) write(folder / fmt::format("{}-{}.svg", name, ++number), figure->svg);
    }
  }
}

/// NAME.md and its figures.
void write_markdown(const std::filesystem::path& folder, const std::string& name, const std::string& figures,
                    const BenchResults& results) {
  std::filesystem::create_directories(folder);
  write(folder / (name + ".md"), markdown_of(results, figures));
  write_figures(folder, figures, results);
}

Report report_of(const BenchResults& results) {
  Report report{results.title, "", {}};
  Section conditions{"How it was measured", {}};
  if (!results.command.empty()) conditions.blocks.emplace_back(Paragraph{"Command: " + results.command});
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

void write_results(const BenchRunner& runner, const std::vector<BenchGroup>& groups, const BenchResults& results) {
  BenchResults with_command = results;
  with_command.command = command_of(runner.options());
  const std::filesystem::path& folder = runner.options().out;
  write(folder / "results.csv", csv_of(results_table(runner, groups)));
  write(folder / "results.json", results_json(runner, groups, results).dump(2) + "\n");
  write_pages(folder, with_command);
  const std::string name = folder.filename().string();
  if (!runner.options().docs.empty()) write_page(runner.options().docs, name, with_command);
  print_result("{}/report.html, results.md, results.csv and results.json\n", folder.string());
}

void write_page(const std::filesystem::path& folder, const std::string& name, const BenchResults& results) {
  write_markdown(folder, name, name, results);
}

void write_pages(const std::filesystem::path& folder, const BenchResults& results) {
  write_markdown(folder, "results", "figure", results);
  write(folder / "report.html", html_of(report_of(results)));
}

}  // namespace talus
