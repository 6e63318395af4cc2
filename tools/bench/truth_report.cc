#include "tools/bench/truth_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "common/measure/ensemble.h"
#include "common/text/base64.h"
#include "tools/output/output.h"
#include "tools/picture/contact_sheet.h"
#include "tools/report/json_text.h"

namespace talus {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// "+4.1 (2.3)": the bias, and standard errors in brackets. Twins of a scene where nothing is random hardly scatter.
std::string shown_bias(double value, double errors) {
  if (std::isnan(value)) return "-";
  if (std::abs(errors) > 100.0) return fmt::format("{:+.1f} (> 100)", value);
  return fmt::format("{:+.1f} ({:.1f})", value, std::abs(errors));
}

/// A number of a cell: key of the files, heading of the tables, how it is shown, and its value.
struct TruthColumn {
  std::string key;
  std::string heading;
  std::function<std::string(const TruthRow&)> cell;
  std::function<double(const TruthRow&)> number;
};

TruthColumn number_column(const std::string& key, const std::string& heading,
                          const std::function<double(const TruthResult&)>& number, int digits = 3) {
  return {key, heading, [=](const TruthRow& row) { return shown(number(row.result), digits); },
          [=](const TruthRow& row) { return number(row.result); }};
}

TruthColumn bias_column(const std::string& key, const std::string& heading, Bias TruthResult::*bias,
                        double Bias::*value = &Bias::percent) {
  return {key, heading + " (σ)",
          [=](const TruthRow& row) { return shown_bias(row.result.*bias.*value, (row.result.*bias).errors); },
          [=](const TruthRow& row) { return row.result.*bias.*value; }};
}

/// "3.3 (2.9-3.6)": median, smallest and largest of the seeds.
std::string shown_ratio(const TimeRatio& ratio) {
  return fmt::format("{} ({}-{})", shown(ratio.middle, 2), shown(ratio.least, 2), shown(ratio.most, 2));
}

TruthColumn speed_up_column(const std::string& key, const std::string& heading, TimeRatio TruthResult::*ratio) {
  return {key, heading, [=](const TruthRow& row) { return shown_ratio(row.result.*ratio); },
          [=](const TruthRow& row) { return (row.result.*ratio).middle; }};
}

std::vector<TruthColumn> truth_columns() {
  using R = TruthResult;
  return {bias_column("centre_percent", "centre %", &R::centre),
          bias_column("centre_from_full_percent", "from full %", &R::centre_from_full),
          bias_column("poured_percent", "poured %", &R::poured),
          bias_column("r50_percent", "r50 %", &R::r50),
          bias_column("r95_percent", "r95 %", &R::r95),
          bias_column("spill_difference", "spill", &R::spill, &Bias::difference),
          number_column(
              "drift_D", "drift/D", [](const R& r) { return r.drift; }, 2),
          number_column(
              "drift_95_D", "95 %", [](const R& r) { return r.drift_95; }, 2),
          number_column(
              "drift_full_D", "full's", [](const R& r) { return r.drift_full; }, 2),
          number_column(
              "drift_slept_D", "of the sleeping", [](const R& r) { return r.drift_slept; }, 2),
          number_column(
              "estimate_D", "estimate", [](const R& r) { return r.estimate; }, 2),
          number_column("floating", "floating", [](const R& r) { return r.floating; }),
          number_column("asleep_percent", "asleep %", [](const R& r) { return 100.0 * r.asleep; }),
          number_column("awake", "awake", [](const R& r) { return r.awake; }),
          number_column(
              "awake_over_moving", "/moving", [](const R& r) { return r.awake_ratio; }, 2),
          speed_up_column("speed_up", "speed-up", &R::speed_up),
          speed_up_column("speed_up_reference", "/ref", &R::speed_up_reference)};
}

std::string beyond_text(const TruthRow& row) { return fmt::format("{}", fmt::join(row.result.beyond, ", ")); }

/// The table as shown; red cells are marked by what is beyond its limit.
Table shown_table(const std::vector<TruthRow>& rows) {
  Table table{"", {{"cell"}, {"engine"}, {"n", true}}, {}};
  const std::vector<TruthColumn> columns = truth_columns();
  for (const TruthColumn& column : columns) table.columns.push_back({column.heading, true});
  table.columns.push_back({"red"});
  for (const TruthRow& row : rows) {
    std::vector<std::string> cells = {row.runs.cell, row.runs.backend, std::to_string(row.runs.adaptive.size())};
    for (const TruthColumn& column : columns) cells.push_back(column.cell(row));
    cells.push_back(beyond_text(row));
    table.rows.push_back(cells);
  }
  return table;
}

Json truth_json(const std::vector<TruthRow>& rows) {
  Json json = Json::array();
  for (const TruthRow& row : rows) {
    Json each = {{"cell", row.runs.cell}, {"backend", row.runs.backend}, {"seeds", row.runs.adaptive.size()}};
    for (const TruthColumn& column : truth_columns()) {
      const double number = column.number(row);
      each[column.key] = std::isfinite(number) ? Json(number) : Json();
    }
    const TruthResult& result = row.result;
    const std::pair<const char*, const Bias*> biases[] = {
        {"centre_errors", &result.centre}, {"centre_from_full_errors", &result.centre_from_full},
        {"poured_errors", &result.poured}, {"r50_errors", &result.r50},
        {"r95_errors", &result.r95},       {"spill_errors", &result.spill}};
    for (const auto& [key, bias] : biases) each[key] = std::isfinite(bias->errors) ? Json(bias->errors) : Json();
    each["speed_up_min"] = result.speed_up.least;
    each["speed_up_max"] = result.speed_up.most;
    each["severity"] = std::isfinite(result.severity) ? Json(result.severity) : Json();
    each["red"] = result.beyond;
    each["why"] = result.reasons;
    json.push_back(each);
  }
  return json;
}

Table truth_csv(const Json& json) {
  Table table;
  if (json.empty()) return table;
  for (const auto& [key, value] : json.front().items()) table.columns.push_back({key});
  for (const Json& each : json) {
    std::vector<std::string> cells;
    for (const auto& [key, value] : each.items())
      if (value.is_array())
        cells.push_back(fmt::format("{}", fmt::join(value.get<std::vector<std::string>>(), " + ")));
      else
        cells.push_back(value.is_null() ? "" : value.is_string() ? value.get<std::string>() : value.dump());
    table.rows.push_back(cells);
  }
  return table;
}

/// "12 of 60 cells are red: drift 7, centre 6".
std::string red_cells(const std::vector<TruthRow>& rows) {
  std::vector<std::pair<std::string, int>> reasons;
  int red = 0;
  for (const TruthRow& row : rows) {
    red += !row.result.beyond.empty();
    for (const std::string& name : row.result.beyond) {
      const auto found = std::ranges::find(reasons, name, &std::pair<std::string, int>::first);
      if (found != reasons.end())
        ++found->second;
      else
        reasons.emplace_back(name, 1);
    }
  }
  std::ranges::stable_sort(reasons, [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text = fmt::format("{} of {} cells are red", red, rows.size());
  for (const auto& [name, count] : reasons)
    text += fmt::format("{}{} {}", name == reasons.front().first ? ": " : ", ", name, count);
  return text + ".";
}

/// A number of the cells that have it.
std::vector<double> numbers_of(const std::vector<TruthRow>& rows,
                               const std::function<double(const TruthResult&)>& number) {
  std::vector<double> numbers;
  for (const TruthRow& row : rows)
    if (std::isfinite(number(row.result))) numbers.push_back(number(row.result));
  return numbers;
}

EnsembleSummary over_cells(const std::vector<TruthRow>& rows, const std::function<double(const TruthResult&)>& number) {
  const std::vector<double> numbers = numbers_of(rows, number);
  return numbers.empty() ? EnsembleSummary{} : summarize(numbers);
}

/// "+5.5 ± 1.4 %": mean over the cells and its standard error.
std::string mean_bias(const std::vector<TruthRow>& rows, Bias TruthResult::*bias) {
  const EnsembleSummary cells = over_cells(rows, [=](const TruthResult& result) { return (result.*bias).percent; });
  return fmt::format("{:+.1f} ± {:.1f} %", cells.mean, cells.deviation / std::sqrt(std::max(1, cells.runs)));
}

constexpr double small_drift = 0.1 * TruthLimits{}.drift;  // [D] too small to need an estimate that is near

/// How the mean estimate of a cell compares with the mean drift of its sleeping bodies.
struct EstimatedCells {
  int cells = 0;  // with an estimate
  int near = 0;   // of these, within a factor of 2
  int small = 0;  // of the others, with estimate and drift of at most small_drift
};
EstimatedCells estimated_cells(const std::vector<TruthRow>& rows) {
  EstimatedCells estimated;
  for (const TruthRow& row : rows) {
    if (std::isnan(row.result.estimate)) continue;
    ++estimated.cells;
    if (is_near(row.result.estimate, row.result.drift_slept))
      ++estimated.near;
    else if (std::max(row.result.estimate, row.result.drift_slept) <= small_drift)
      ++estimated.small;
  }
  return estimated;
}

/// How well the runs' estimates foresaw the drift.
std::string estimates_in_short(const std::vector<TruthRow>& rows) {
  const EstimatedCells cells = estimated_cells(rows);
  EstimateScore all;
  for (const TruthRow& row : rows) {
    const EstimateScore score = estimate_score(row.runs.adaptive, TruthLimits{}.drift);
    all.runs += score.runs;
    all.near += score.near;
    all.claims += score.claims;
    all.false_claims += score.false_claims;
    all.too_low += score.too_low;
  }
  return fmt::format(
      "The estimate at the end of a run is within a factor of 2 of the sleeping bodies' drift in {} of {} cells, and "
      "in {} of {} runs. In {} of the other cells both are at most {:.2g} D. {} runs say that the drift is "
      "within the tolerance: in {} of them it is not, in {} it is above twice the estimate.",
      cells.near, cells.cells, all.near, all.runs, cells.small, small_drift, all.claims, all.false_claims, all.too_low);
}

/// What each red cell is red for, and why as far as the measures tell.
Table reasons_table(const std::vector<TruthRow>& rows) {
  Table table{"", {{"cell"}, {"engine"}, {"why it is red"}}, {}};
  for (const TruthRow& row : rows) {
    if (row.result.beyond.empty()) continue;
    std::vector<std::string> sentences;
    for (std::size_t i = 0; i < row.result.beyond.size(); ++i)
      sentences.push_back(fmt::format("{}: {}", row.result.beyond[i], row.result.reasons[i]));
    table.rows.push_back({row.runs.cell, row.runs.backend, fmt::format("{}.", fmt::join(sentences, "; "))});
  }
  return table;
}

/// "All sleep at the end of 900 of 960 runs."
std::string runs_asleep(const std::vector<TruthRow>& rows) {
  double asleep = 0.0;
  std::size_t runs = 0;
  for (const TruthRow& row : rows) {
    const std::size_t own = row.runs.adaptive.size();
    asleep += row.result.asleep * static_cast<double>(own);
    runs += own;
  }
  return fmt::format("All sleep at the end of {} of {} runs.", std::lround(asleep), runs);
}

std::string in_short(const std::vector<TruthRow>& rows) {
  using R = TruthResult;
  return fmt::format(
      "{} {} Means over the cells with their standard errors: centre {} of the reference's and {} of full's, at the "
      "end of the pour {}. Means: drift beyond full's {:.2g} D, awake {:.3g}, speed-up {:.3g}. {}",
      red_cells(rows), runs_asleep(rows), mean_bias(rows, &R::centre), mean_bias(rows, &R::centre_from_full),
      mean_bias(rows, &R::poured), over_cells(rows, [](const R& r) { return r.drift; }).mean,
      over_cells(rows, [](const R& r) { return r.awake; }).mean,
      over_cells(rows, [](const R& r) { return r.speed_up.middle; }).mean, estimates_in_short(rows));
}

/// NaN where no cell has the number.
double median_over(const std::vector<TruthRow>& rows, const std::function<double(const TruthResult&)>& number) {
  const std::vector<double> numbers = numbers_of(rows, number);
  return numbers.empty() ? std::numeric_limits<double>::quiet_NaN() : median(numbers);
}

std::string mean_and_median(const std::vector<TruthRow>& rows, Bias TruthResult::*bias) {
  return fmt::format("{}, {:+.1f} %", mean_bias(rows, bias),
                     median_over(rows, [=](const TruthResult& result) { return (result.*bias).percent; }));
}

/// Cells that are red for a measure, and how many of these `condition` holds for: "6 (2)".
std::string red_count(const std::vector<TruthRow>& rows, const std::string& name,
                      const std::function<bool(const TruthResult&)>& condition) {
  int red = 0;
  int with_condition = 0;
  for (const TruthRow& row : rows) {
    if (std::ranges::count(row.result.beyond, name) == 0) continue;
    ++red;
    with_condition += condition(row.result) ? 1 : 0;
  }
  return fmt::format("{} ({})", red, with_condition);
}

std::vector<std::string> engine_cells(const std::string& engine, const std::vector<TruthRow>& rows) {
  using R = TruthResult;
  const TruthLimits limits;
  const auto policy_is_cause = [&](const R& r) {
    return is_beyond(r.centre_from_full, limits.centre_percent, limits.errors);
  };
  const auto still_moves = [&](const R& r) { return r.moving_at_end >= 1.0; };
  const EstimatedCells estimated = estimated_cells(rows);
  return {engine,
          std::to_string(rows.size()),
          mean_and_median(rows, &R::centre),
          mean_and_median(rows, &R::centre_from_full),
          mean_and_median(rows, &R::poured_from_full),
          red_count(rows, "centre", policy_is_cause),
          red_count(rows, "drift", still_moves),
          red_count(rows, "drift 95 %", still_moves),
          red_count(rows, "not asleep", still_moves),
          shown(median_over(rows, [](const R& r) { return r.awake_ratio; }), 2),
          shown(median_over(rows, [](const R& r) { return r.speed_up.middle; }), 2),
          fmt::format("{} of {}", estimated.near, estimated.cells)};
}

/// One row for each engine, and one for all where there are several.
Table engines_table(const std::vector<TruthRow>& rows) {
  Table table{"",
              {{"engine"},
               {"cells", true},
               {"centre: mean, median", true},
               {"from full: mean, median", true},
               {"poured, from full: mean, median", true},
               {"centre beyond", true},
               {"drift beyond", true},
               {"drift 95 % beyond", true},
               {"not asleep", true},
               {"awake over moving: median", true},
               {"speed-up: median", true},
               {"estimate within a factor of 2", true}},
              {}};
  std::map<std::string, std::vector<TruthRow>> by_engine;
  for (const TruthRow& row : rows) by_engine[row.runs.backend].push_back(row);
  for (const auto& [engine, own] : by_engine) table.rows.push_back(engine_cells(engine, own));
  if (by_engine.size() > 1) table.rows.push_back(engine_cells("all", rows));
  return table;
}

std::string file_bytes(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A PNG as a drawing; the size stands in the bytes 16 to 23 of the file.
Figure figure_of(const fs::path& png, const std::string& caption) {
  const std::string bytes = file_bytes(png);
  const auto number_at = [&](std::size_t place) {
    std::uint32_t number = 0;
    for (std::size_t k = 0; k < 4; ++k) number = number << 8U | static_cast<unsigned char>(bytes.at(place + k));
    return number;
  };
  return {fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\"><image width=\"{0}\" "
                      "height=\"{1}\" href=\"data:image/png;base64,{2}\"/></svg>\n",
                      number_at(16), number_at(20), base64(bytes)),
          caption};
}

/// Full beside adaptive, of each red cell.
Section red_pictures(const fs::path& folder, const std::vector<TruthRow>& rows) {
  Section section{"Red cells: full beside adaptive, first seed", {}};
  for (const TruthRow& row : rows) {
    if (row.result.beyond.empty()) continue;
    std::vector<Tile> tiles;
    for (const std::string policy : {"full", "adaptive"}) {
      const fs::path png = picture_file(folder, row.runs.cell, row.runs.backend, policy);
      if (fs::exists(png)) tiles.push_back({png, policy});
    }
    if (tiles.size() < 2) continue;
    const fs::path sheet = picture_file(folder, row.runs.cell, row.runs.backend, "both");
    write_contact_sheet(sheet, tiles, "", {.columns = 2});
    section.blocks.emplace_back(
        figure_of(sheet, fmt::format("{} on {}: {}", row.runs.cell, row.runs.backend, beyond_text(row))));
  }
  return section;
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
}

constexpr const char* how_to_read =
    "Centre, r50 and r95: adaptive less the converged reference in per cent of it, spill in bodies; in brackets the "
    "same in standard errors of both ensembles. From full: against full. Poured: centre when the last body appears. "
    "Drift: mean distance in D that bodies move when all are woken at the end, less full's; 95 %: the runs' quantile; "
    "of the sleeping: that of the bodies that slept, over the runs with an estimate, which the run makes itself. "
    "Asleep: runs in which all sleep at the end. Awake: mean over the run; /moving: over the bodies of which a point "
    "moves by more than 0.05 D within half a second with all awake, at the same moments. Speed-ups "
    "are ratios of processor time, seed by seed: median, in brackets the smallest and largest.";

constexpr const char* how_to_read_in_short =
    "The columns beyond and not asleep count the cells that exceed a limit. In brackets for the centre: those that "
    "exceed it against full too, where the policy is the cause and not the engine's default step. In brackets for the "
    "others: those in which a body or more still moves at the end, by 0.05 D within half a second with all awake.";

}  // namespace

std::filesystem::path picture_file(const std::filesystem::path& folder, const std::string& cell,
                                   const std::string& backend, const std::string& policy) {
  return folder / "pictures" / fmt::format("{}-{}-{}.png", cell, backend, policy);
}

void report_truth(const std::filesystem::path& folder, std::vector<TruthRow> rows, BenchResults results) {
  std::ranges::stable_sort(rows,
                           [](const TruthRow& a, const TruthRow& b) { return a.result.severity > b.result.severity; });
  const Table table = shown_table(rows);
  results.notes.emplace_back(how_to_read);
  results.sections.push_back({"In short", {engines_table(rows), Paragraph{how_to_read_in_short}}});
  results.sections.push_back({"Cells, worst first", {Paragraph{in_short(rows)}, table}});
  if (const Table reasons = reasons_table(rows); !reasons.rows.empty())
    results.sections.push_back({"Why they are red", {reasons}});
  Section pictures = red_pictures(folder, rows);
  if (!pictures.blocks.empty()) results.sections.push_back(std::move(pictures));
  write_pages(folder, results);
  const Json json = truth_json(rows);
  write_text(folder / "results.json", json_text(json, 2) + "\n");
  write_text(folder / "results.csv", csv_of(truth_csv(json)));
  print_text(text_of(table));
  print_result("\n{}\n{}/report.html, results.md, results.csv and results.json\n", in_short(rows), folder.string());
}

}  // namespace talus
