#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "common/text/printable.h"
#include "tools/commands/commands.h"
#include "tools/commands/validators.h"
#include "tools/output/output.h"
#include "tools/picture/contact_sheet.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

/// What a run's summary calls its scene.
std::string title_of(const fs::path& run) {
  std::ifstream stream(run / "summary.json");
  const auto summary = nlohmann::json::parse(stream, nullptr, false);
  if (!summary.is_object() || !summary.contains("title") || !summary["title"].is_string()) {
    throw std::invalid_argument(
        fmt::format("run = {}: must be a run folder, with summary.json and pile.png", run.string()));
  }
  return summary["title"];
}

void write_sheet(const std::string& out, const std::vector<std::string>& runs, const ContactSheetParams& params) {
  std::vector<Tile> tiles;
  tiles.reserve(runs.size());
  for (const fs::path run : runs) tiles.push_back({run / "pile.png", printable(title_of(run))});
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
  command->callback([=, &exit_code] {
    write_sheet(*out, *runs, *params);
    exit_code = exit_codes::success;
  });
}

}  // namespace talus
