#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>

#include "common/math/require.h"
#include "common/text/printable.h"
#include "tools/commands/commands.h"
#include "tools/commands/validators.h"
#include "tools/output/output.h"
#include "tools/plot/plot.h"
#include "tools/record/record_stream.h"
#include "tools/record/recorded_run.h"
#include "tools/record/run_history.h"
#include "tools/record/wake_run.h"
#include "tools/report/html_report.h"
#include "tools/report/json_text.h"
#include "tools/run/measured_drift.h"
#include "tools/view/page.h"

namespace talus {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;
using Columns = std::map<std::string, std::vector<double>>;

struct ReportOptions {
  std::string run;
  std::string html;  // empty: report.html in the run folder
  bool wake = false;
};

constexpr std::size_t most_points = 600;  // of a curve; more are not seen

std::string contents_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Null where the file is missing or damaged.
Json summary_of(const fs::path& folder) {
  const Json summary = Json::parse(contents_of(folder / "summary.json"), nullptr, false);
  return summary.is_object() ? summary : Json();
}

/// A curve of at most most_points: of so many neighbours in time each, what `fold` makes of their values.
Series curve(const std::string& name, const std::vector<double>& x, const std::vector<double>& y,
             const std::function<double(std::span<const double>)>& fold) {
  Series series{name, {}, {}};
  const std::size_t size = std::min(x.size(), y.size());
  const std::size_t each = std::max<std::size_t>(1, (size + most_points - 1) / most_points);
  for (std::size_t begin = 0; begin < size; begin += each) {
    const std::size_t count = std::min(each, size - begin);
    const double value = fold(std::span(y).subspan(begin, count));
    if (!std::isfinite(value)) continue;
    series.x.push_back(x[begin + count - 1]);
    series.y.push_back(value);
  }
  return series;
}

double sum_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum;
}
double mean_of(std::span<const double> values) { return sum_of(values) / static_cast<double>(values.size()); }
double largest_of(std::span<const double> values) { return *std::ranges::max_element(values); }

/// Nothing where no series has a value.
void add_plot(Section& section, Plot plot, const std::string& caption) {
  std::erase_if(plot.series, [](const Series& series) { return series.x.empty(); });
  if (!plot.series.empty()) section.blocks.emplace_back(Figure{svg_of(plot), caption});
}

Plot plot_over_time(const std::string& y_label, std::vector<Series> series) {
  Plot plot;
  plot.x_label = "simulated time [s]";
  plot.y_label = y_label;
  plot.series = std::move(series);
  plot.height = 320;
  return plot;
}

/// At most seven layers, evenly from the lowest to the highest that ever held a body.
Plot plot_of_densities(const RunHistory& history) {
  std::size_t layers = 0;
  for (const PileMoment& moment : history.pile)
    for (std::size_t i = 0; i < moment.densities.size(); ++i)
      if (moment.densities[i] > 0.0) layers = std::max(layers, i + 1);
  constexpr std::size_t most_curves = 7;
  const std::size_t curves = std::min(layers, most_curves);
  std::vector<Series> series;
  for (std::size_t i = 0; i < curves; ++i) {
    const std::size_t layer = curves == 1 ? 0 : i * (layers - 1) / (curves - 1);
    std::vector<double> density;
    for (const PileMoment& moment : history.pile)
      density.push_back(layer < moment.densities.size() ? moment.densities[layer] : 0.0);
    series.push_back(curve(fmt::format("layer {}", layer), history.time, density, mean_of));
  }
  return plot_over_time("density", series);
}

Series points(const std::string& name) {
  Series series{name, {}, {}};
  series.style = SeriesStyle::points;
  return series;
}

Plot plot_of_events(const RunHistory& history, const Json& summary, double dt) {
  std::vector<Series> series = {curve("fell asleep", history.time, history.slept, sum_of),
                                curve("woke", history.time, history.woken, sum_of)};
  for (Series& each : series) each.style = SeriesStyle::steps;
  Series warnings = points("warning, first time");
  Series events = points("event of the scene");
  for (const Warning& warning : history.warnings) {
    warnings.x.push_back(dt * static_cast<double>(warning.step));
    warnings.y.push_back(0.0);
  }
  for (const Json& event : summary.is_null() ? Json::array() : summary.value("events", Json::array())) {
    events.x.push_back(event.value("time_s", 0.0));
    events.y.push_back(0.0);
  }
  series.push_back(warnings);
  series.push_back(events);
  return plot_over_time("bodies", series);
}

Plot plot_of_slope(const RunHistory& history) {
  Series measured = points("measured");
  for (const MeasuredSlope& slope : history.slopes) {
    measured.x.push_back(slope.time);
    measured.y.push_back(slope.angle);
    measured.low.push_back(slope.angle - slope.standard_error);
    measured.high.push_back(slope.angle + slope.standard_error);
  }
  std::vector<double> time;
  std::vector<double> alpha;
  for (std::size_t i = 0; i < history.time.size(); ++i) {
    if (history.pile[i].densities.empty()) continue;
    time.push_back(history.time[i]);
    alpha.push_back(history.pile[i].alpha);
  }
  return plot_over_time("slope [degrees]", {curve("alpha of the pile", time, alpha, mean_of), measured});
}

Section plots_of(const RunHistory& history, const Columns& steps, const Json& summary, double dt) {
  Section section{"Over time", {}};
  add_plot(section,
           plot_over_time("bodies", {curve("awake", history.time, history.awake, mean_of),
                                     curve("asleep", history.time, history.asleep, mean_of)}),
           "Awake and sleeping bodies.");
  add_plot(section, plot_of_densities(history),
           "Density of layers of the largest pile: bodies over capacity, layer 0 at the bottom. The page above shows "
           "all layers.");
  if (steps.contains("step_ms")) {
    std::vector<double> all(steps.at("time_s").size(), 0.0);
    for (const char* phase : {"emit_ms", "step_ms", "count_ms", "decide_ms", "apply_ms"})
      for (std::size_t i = 0; i < all.size(); ++i) all[i] += steps.at(phase)[i];
    add_plot(section,
             plot_over_time("ms per step", {curve("slowest step", steps.at("time_s"), all, largest_of),
                                            curve("mean", steps.at("time_s"), all, mean_of)}),
             "Wall time of a step without observers.");
  } else {
    section.blocks.emplace_back(Paragraph{"Time per step: the run folder has no readable frames.csv."});
  }
  add_plot(section, plot_of_events(history, summary, dt),
           "Bodies that fell asleep and that woke, warnings and events of the scene on one time line.");
  add_plot(section, plot_of_slope(history),
           "Slope fitted to the surface of the bodies at rest that belong to the largest pile, with the standard error "
           "of the fit, and the slope alpha that the pile's layers have.");
  if (std::ranges::any_of(history.drift_estimate, [](double drift) { return drift > 0.0; }))
    add_plot(section, plot_over_time("drift [D]", {curve("estimate", history.time, history.drift_estimate, mean_of)}),
             "Mean distance that the sleeping bodies are expected to move once all are woken, where the policy has an "
             "estimate.");
  return section;
}

std::string text_of_value(const Json& value) {
  if (value.is_string()) return printable(value.get<std::string>());
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  return value.dump();
}

/// The numbers of an object, one a row.
Table table_of(const std::string& caption, const Json& json) {
  Table table{caption, {{"name"}, {"value", true}}, {}};
  for (const auto& [name, value] : json.items()) table.rows.push_back({name, text_of_value(value)});
  return table;
}

Section result_of(const Json& summary) {
  constexpr auto shown = std::to_array<std::array<const char*, 2>>({
      {"/reason", "end of the run"},
      {"/bodies", "bodies"},
      {"/asleep_at_end", "asleep at the end"},
      {"/mean_awake", "awake, mean over the steps"},
      {"/work_skipped", "share of body-steps skipped"},
      {"/steps", "steps"},
      {"/wall_s", "wall time of the steps [s]"},
      {"/ms_per_step", "mean time of a step [ms]"},
      {"/shape/height_m", "highest point of what rests [m]"},
      {"/shape/centre_height_m", "height of its centre of mass [m]"},
      {"/shape/r50_m", "radius that holds half of the bodies [m]"},
      {"/shape/angle_of_repose_deg", "slope of the surface [degrees]"},
      {"/shape/angle_of_repose_standard_error_deg", "standard error of the slope [degrees]"},
      {"/shape/angle_of_repose_reason", "no slope"},
      {"/shape/packing", "share of the volume that is solid"},
      {"/shape/packing_reason", "no such share"},
      {"/end_hash", "hash of all states at the end"},
  });
  Section section{"Result", {}};
  Table table{"", {{"quantity"}, {"value", true}}, {}};
  for (const auto& [key, name] : shown)
    if (const Json::json_pointer at(key); summary.contains(at) && !summary[at].is_null())
      table.rows.push_back({name, text_of_value(summary[at])});
  if (table.rows.empty())
    section.blocks.emplace_back(
        Paragraph{"The run folder has no readable summary.json: times, shape and hash are not known."});
  else
    section.blocks.emplace_back(table);
  return section;
}

/// "estimated 0.004 D (0.002 to 0.006)": by the probe at the end of the run, else by the policy, `by_policy` [D].
std::string estimate_text(double by_policy, const Json& summary) {
  const Json probed = summary.is_null() ? Json() : summary.value("estimate", Json());
  if (probed.is_object() && probed.value("least_D", Json()).is_number())
    return fmt::format("estimated {:.2g} D ({:.2g} to {:.2g})", probed.value("drift_D", 0.0),
                       probed.value("least_D", 0.0), probed.value("most_D", 0.0));
  return std::isnan(by_policy) ? "no estimate at the end" : fmt::format("estimated {:.2g} D", by_policy);
}

/// Mean drift as it was estimated and measured, beside the tolerance; the latter two where there are any.
std::string drift_text(double estimate, const Json& summary, double tolerance) {
  std::string text = "Mean distance that the sleeping bodies move once all are woken: ";
  text += estimate_text(estimate, summary);
  const Json measured = summary.is_null() ? Json() : summary.value("measured", Json());
  if (measured.is_object() && measured.value("drift_mean_D", Json()).is_number())
    text += fmt::format(", measured {:.2g} D", measured["drift_mean_D"].get<double>());
  else if (measured.is_object())
    text += fmt::format(", not measured ({})", printable(measured.value("missing", "")));
  if (tolerance > 0.0) text += fmt::format(", tolerance {:g} D", tolerance);
  return text + ".";
}

Section error_of(const RunHistory& history, const Json& summary, double tolerance, const ReportOptions& options) {
  Section section{"Error", {}};
  section.blocks.emplace_back(Paragraph{drift_text(history.drift_estimate.back(), summary, tolerance)});
  if (!options.wake) {
    section.blocks.emplace_back(
        Paragraph{"The report was made without --wake, which wakes all bodies and measures how far they move."});
    return section;
  }
  const auto measure = [&](const auto& run) {
    const double seconds = wake_time(world_at_end(run).gravity);
    section.blocks.emplace_back(table_of(
        fmt::format("Measured: all woken at the end and simulated for {:.3g} s at the reference settings", seconds),
        wake_json(wake(run, seconds, options.run), mean_extent(run))));
  };
  std::visit(measure, read_run(options.run));
  return section;
}

/// The warning that only the summary has, since it was measured after the record's end.
void add_drift_warning(const Json& summary, std::vector<Warning>& warnings) {
  if (summary.is_null()) return;
  for (const Json& warning : summary.value("warnings", Json::array()))
    if (warning.value("kind", "") == to_string(WarningKind::drift))
      warnings.push_back({.kind = WarningKind::drift,
                          .step = warning.value("step", std::int64_t{0}),
                          .bodies = warning.value("bodies", std::int64_t{0}),
                          .value = warning.value("value", 0.0)});
}

Section warnings_of(const RunHistory& history, double dt) {
  Section section{"Warnings", {}};
  const WalkDamage& damage = history.walk.damage;
  if (!damage.none())
    section.blocks.emplace_back(Paragraph{
        fmt::format("The record is damaged: {} bytes and {} messages left out.", damage.bytes, damage.undecodable)});
  if (history.warnings.empty()) {
    section.blocks.emplace_back(Paragraph{"None."});
    return section;
  }
  Table table{"", {{"kind"}, {"first [s]", true}, {"what and where"}, {"advice"}}, {}};
  for (const Warning& warning : history.warnings)
    table.rows.push_back({std::string(to_string(warning.kind)),
                          fmt::format("{:.2f}", dt * static_cast<double>(warning.step)), account(warning),
                          advice(warning)});
  section.blocks.emplace_back(table);
  return section;
}

Section settings_of(const Json& summary, const fs::path& folder) {
  Section section{"Settings", {}};
  if (summary.contains("settings")) section.blocks.emplace_back(table_of("", summary["settings"]));
  section.blocks.emplace_back(
      Listing{printable_lines(contents_of(folder / "scene.toml")), "scene.toml: the scene as it was run"});
  if (!summary.is_null())
    section.blocks.emplace_back(Listing{json_text(summary, 2), "summary.json: all numbers of the run"});
  return section;
}

template <int Dim>
Report report_of(const Scene<Dim>& scene, const ReportOptions& options) {
  const fs::path folder = options.run;
  const double dt = scene.world.dt;
  RunHistory history = history_of(scene, folder);
  const Json summary = summary_of(folder);
  add_drift_warning(summary, history.warnings);
  const RecordedIdentity& run = history.walk.run;
  const std::string end = run.reason.empty() ? "killed, or its record is cut" : run.reason;
  Section player{"Replay", {}};
  player.blocks.emplace_back(
      EmbeddedPage{page_with(record_stream(folder)), "The record. Click a body to see why it sleeps."});
  return {printable(scene.title),
          fmt::format("{}: {}, policy {}, seed {}, {:.2f} s; {}; talus {}", name_of_run(folder), run.backend,
                      run.policy, scene.seed, history.time.back(), end, run.version),
          {player, result_of(summary), warnings_of(history, dt),
           error_of(history, summary, tolerance_of(scene.policy), options),
           plots_of(history, columns_of(folder / "frames.csv"), summary, dt), settings_of(summary, folder)}};
}

void write_report(ReportOptions options) {
  const AnyScene scene = scene_of_run(options.run);
  if (options.html.empty()) options.html = (fs::path(options.run) / "report.html").string();
  require(options.html.ends_with(".html"), "--html", options.html, "must end in .html");
  const std::string page =
      std::visit([&](const auto& of_dimension) { return html_of(report_of(of_dimension, options)); }, scene);
  std::ofstream out(options.html, std::ios::binary);
  out << page << std::flush;
  if (!out) throw std::system_error(errno, std::generic_category(), options.html);
  print_result("{}: {:.0f} kB\n", printable(options.html), static_cast<double>(page.size()) / 1e3);
}

}  // namespace

void add_report_command(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("report", "Make a page of a recorded run with player, plots, error, settings and hash");
  auto options = std::make_shared<ReportOptions>();
  command->add_option("run", options->run, "Run folder, as `talus run` leaves it")->required()->check(not_empty());
  command
      ->add_option("--html", options->html, "Page to write, overwritten if there; default: report.html in the folder")
      ->check(in_a_folder());
  command->add_flag("--wake", options->wake, "Measure the error as `talus wake` does");
  command->footer("Example:\n  talus run drop_in_a_pile_2d --out runs/pour\n  talus report runs/pour --html pour.html");
  command->callback([options, &exit_code] {
    write_report(*options);
    exit_code = exit_codes::success;
  });
}

}  // namespace talus
