#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "common/scene/setting_differences.h"
#include "common/text/printable.h"
#include "tools/commands/commands.h"
#include "tools/commands/validators.h"
#include "tools/output/output.h"
#include "tools/picture/contact_sheet.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

/// A run folder, as far as its tile needs it.
struct SheetRun {
  fs::path folder;
  std::string title;
  std::map<std::string, std::string> values;  // engine, policy, seed and all that its scene file sets
  double pixels_per_metre = 0.0;
};

SheetRun read_sheet_run(const fs::path& folder) {
  std::ifstream stream(folder / "summary.json");
  const auto summary = nlohmann::json::parse(stream, nullptr, false);
  if (!summary.is_object() || !summary.contains("title") || !summary["title"].is_string()) {
    throw std::invalid_argument(
        fmt::format("run = {}: must be a run folder, with summary.json and pile.png", folder.string()));
  }
  SheetRun run{.folder = folder, .title = summary["title"], .values = {}};
  run.pixels_per_metre = summary.value("picture_pixels_per_m", 0.0);
  std::ifstream scene(folder / "scene.toml", std::ios::binary);
  try {
    const std::string text(std::istreambuf_iterator<char>(scene), {});
    for (const SettingDifference& setting : setting_differences(text, "")) run.values[setting.path] = setting.a;
  } catch (const std::exception&) {
    run.values.clear();  // a folder without a scene that can be read still has a picture
  }
  run.values.erase("title");
  run.values["backend"] = summary.value("backend", "");
  run.values["policy.kind"] = summary.value("policy", "");
  run.values["seed"] = fmt::format("{}", summary.value("seed", std::uint64_t{0}));
  return run;
}

/// Values that are not the same in all runs. Those of different scenes are told apart by their titles alone.
std::vector<std::string> paths_that_differ(const std::vector<SheetRun>& runs) {
  std::set<std::string> paths;
  for (const SheetRun& run : runs)
    for (const auto& [path, value] : run.values) paths.insert(path);
  const bool one_scene = std::ranges::all_of(runs, [&](const SheetRun& run) { return run.title == runs[0].title; });
  if (!one_scene) paths = {"backend", "policy.kind", "seed"};
  std::vector<std::string> differing;
  const auto value_of = [](const SheetRun& run, const std::string& path) {
    const auto found = run.values.find(path);
    return found == run.values.end() ? std::string("default") : found->second;
  };
  for (const std::string& path : paths)
    if (std::ranges::any_of(runs, [&](const auto& run) { return value_of(run, path) != value_of(runs[0], path); }))
      differing.push_back(path);
  return differing;
}

/// What sets the run apart from the others, else its title.
std::string caption_of(const SheetRun& run, const std::vector<SheetRun>& runs) {
  const bool one_scene = std::ranges::all_of(runs, [&](const SheetRun& other) { return other.title == run.title; });
  std::string caption = one_scene && runs.size() > 1 ? "" : run.title;
  for (const std::string& path : paths_that_differ(runs)) {
    const auto found = run.values.find(path);
    const std::string name = path == "policy.kind" ? "policy" : path;
    caption += fmt::format("{}{} {}", caption.empty() ? "" : ", ", name,
                           found == run.values.end() ? "default" : found->second);
  }
  return printable(caption.empty() ? run.title : caption);
}

void write_sheet(const std::string& out, const std::vector<std::string>& folders, const ContactSheetParams& params) {
  std::vector<SheetRun> runs;
  for (const std::string& folder : folders) runs.push_back(read_sheet_run(folder));
  std::vector<Tile> tiles;
  for (const SheetRun& run : runs)
    tiles.push_back({run.folder / "pile.png", caption_of(run, runs), run.pixels_per_metre});
  write_contact_sheet(out, tiles, "", params);
  print_result("{}\n", printable(out));
}

}  // namespace

void add_sheet_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("sheet", "Put the pictures of runs side by side into one PNG");
  auto runs = std::make_shared<std::vector<std::string>>();
  auto out = std::make_shared<std::string>();
  auto params = std::make_shared<ContactSheetParams>();
  command->add_option("runs", *runs, "Run folders, as `talus run` leaves them")->required()->check(not_empty());
  command->add_option("-o,--out", *out, "PNG to write; overwritten if there")->required()->check(in_a_folder());
  command->add_option("--columns", params->columns, "Pictures in a row")
      ->check(number_between(1, 20))
      ->capture_default_str();
  command->add_option("--width", params->tile_width, "Width of each [pixels]")
      ->check(number_between(100, 4000))
      ->capture_default_str();
  command->add_option("--font", params->font_size, "Size of the captions [pixels]")
      ->check(number_between(0, 500, Bound::left_out))
      ->capture_default_str();
  command->add_flag("--one-scale", params->one_scale, "A metre has the same length in all pictures");
  command->callback([=, &exit_code] {
    write_sheet(*out, *runs, *params);
    exit_code = exit_codes::success;
  });
}

}  // namespace talus
