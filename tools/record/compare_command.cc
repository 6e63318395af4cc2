#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "common/measure/compare.h"
#include "common/scene/typical_body.h"
#include "tools/commands/commands.h"
#include "tools/output/output.h"
#include "tools/record/record_commands.h"
#include "tools/record/recorded_run.h"
#include "tools/report/table.h"

namespace talus {

namespace {

using Json = nlohmann::ordered_json;

bool same(const SleepEvent& a, const SleepEvent& b) {
  return a.step == b.step && a.body == b.body && a.woke == b.woke && a.cause == b.cause;
}

/// The first step at which one run put to sleep or woke a body and the other did not.
template <int Dim>
std::optional<SleepEvent> first_other_decision(const RecordedRun<Dim>& a, const RecordedRun<Dim>& b) {
  const auto [of_a, of_b] = std::mismatch(a.events.begin(), a.events.end(), b.events.begin(), b.events.end(), same);
  const bool in_a = of_a != a.events.end();
  const bool in_b = of_b != b.events.end();
  if (!in_a && !in_b) return std::nullopt;
  return in_a && (!in_b || of_a->step <= of_b->step) ? *of_a : *of_b;
}

template <int Dim>
Json head_json(const RecordedRun<Dim>& run) {
  return {{"run", run.name},
          {"title", run.scene.title},
          {"backend", run.backend},
          {"policy", run.policy},
          {"reason", run.reason},
          {"dt_s", run.scene.world.dt},
          {"steps", run.last_step},
          {"bodies", run.last.size()},
          {"sleep_events", run.events.size()},
          {"damaged_bytes", run.damaged_bytes}};
}

template <int Dim>
Json shape_json(const ShapeStatistics<Dim>& shape) {
  constexpr double degrees = 180.0 / std::numbers::pi;
  return {{"centre_height_m", shape.centre_height},
          {"r50_m", shape.r50},
          {"r95_m", shape.r95},
          {"peak_m", shape.peak},
          {"angle_of_repose_deg", shape.repose.angle * degrees},
          {"packing", shape.packing.all}};
}

Json motion_json(const MotionError& error) {
  return {{"relative", error.relative}, {"left_out", error.left_out}, {"absolute_m0", error.absolute},
          {"floored", error.floored},   {"ratio_R", error.ratio},     {"symmetric_S", error.symmetric},
          {"turning", error.turning}};
}

template <int Dim>
Json comparison_json(const RecordedRun<Dim>& a, const RecordedRun<Dim>& b) {
  const auto bodies =
      placed_bodies<Dim>(a.scene.world.shapes, a.frames, std::min(a.frames.frames(), b.frames.frames()) - 1);
  const ProfileGrid<Dim> grid = grid_around<Dim>(bodies, a.scene.world.ground.height, typical_body(a.scene).extent);
  const RunComparison<Dim> result =
      compare_runs<Dim>(a.frames, b.frames, a.scene.world.shapes, a.scene.world.gravity, grid);
  Json json = {{"a", head_json(a)}, {"b", head_json(b)}, {"frames_compared", result.frames}};
  json["first_difference"] = nullptr;
  if (result.first_difference) {
    const FirstDifference& first = *result.first_difference;
    json["first_difference"] = {
        {"after_step", first.step - a.frames.steps_per_frame()}, {"by_step", first.step}, {"body", first.body}};
  }
  json["first_other_sleep_decision"] = nullptr;
  if (const auto event = first_other_decision(a, b)) {
    json["first_other_sleep_decision"] = {{"step", event->step},
                                          {"body", event->body},
                                          {"woke", event->woke},
                                          {"cause", std::string(to_string(event->cause))}};
  }
  json["motion"] = motion_json(result.motion_mean);
  json["distance_D"] = {{"mean_at_end", result.position_mean.back()},
                        {"p95_at_end", result.position_p95},
                        {"max_at_end", result.position_max}};
  json["shape_a"] = shape_json(result.shape_a);
  json["shape_b"] = shape_json(result.shape_b);
  json["profile_rms_D"] = result.profile_rms;
  json["z"] = {{"ks", result.z.kolmogorov_smirnov}, {"w1_m", result.z.wasserstein}, {"energy_m", result.z.energy}};
  json["r"] = {{"ks", result.r.kolmogorov_smirnov}, {"w1_m", result.r.wasserstein}, {"energy_m", result.r.energy}};
  return json;
}

std::string number(const Json& value) {
  const double known = value.get<double>();
  return std::isfinite(known) ? fmt::format("{:.4g}", known) : "-";
}

void print_head(const Json& run, char letter) {
  print_result(
      "{}: {}: {}, policy {}, {} steps, {} bodies, {} sleep events{}\n", letter, run["run"].get<std::string>(),
      run["backend"].get<std::string>(), run["policy"].get<std::string>(), run["steps"].get<int>(),
      run["bodies"].get<int>(), run["sleep_events"].get<int>(),
      run["damaged_bytes"] == 0 ? "" : fmt::format(", {} damaged bytes left out", run["damaged_bytes"].get<int>()));
}

void print_first_differences(const Json& json) {
  const Json& first = json["first_difference"];
  if (first.is_null()) {
    print_result("All {} frames that both have are equal bit for bit.\n", json["frames_compared"].get<int>());
  } else {
    print_result("Equal bit for bit up to step {}; by step {} body {} (and perhaps others) differs.\n",
                 first["after_step"].get<int>(), first["by_step"].get<int>(), first["body"].get<int>());
  }
  const Json& event = json["first_other_sleep_decision"];
  if (event.is_null()) return;
  print_result("First sleep decision of one alone: step {}, body {} {} ({}).\n", event["step"].get<int>(),
               event["body"].get<int>(), event["woke"].get<bool>() ? "wakes" : "falls asleep",
               event["cause"].get<std::string>());
}

void print_comparison(const Json& json) {
  print_head(json["a"], 'A');
  print_head(json["b"], 'B');
  print_first_differences(json);
  Table motion{"\nMotion, mean over frames, A in the role of the full run", {{"measure"}, {"value", true}}, {}};
  for (const auto& [name, value] : json["motion"].items()) motion.rows.push_back({name, number(value)});
  for (const auto& [name, value] : json["distance_D"].items())
    motion.rows.push_back({"distance_D " + name, number(value)});
  print_text(text_of(motion));
  Table shape{"\nShape at the last frame that both have", {{"measure"}, {"A", true}, {"B", true}}, {}};
  for (const auto& [name, value] : json["shape_a"].items()) {
    shape.rows.push_back({name, number(value), number(json["shape_b"][name])});
  }
  print_text(text_of(shape));
  Table between{
      "\nBetween the shapes", {{"measure"}, {"value", true}}, {{"profile_rms_D", number(json["profile_rms_D"])}}};
  for (const char* axis : {"z", "r"}) {
    for (const auto& [name, value] : json[axis].items())
      between.rows.push_back({fmt::format("{} {}", axis, name), number(value)});
  }
  print_text(text_of(between));
}

int compare(const std::string& folder_a, const std::string& folder_b, bool as_json) {
  const AnyRecordedRun a = read_run(folder_a);
  const AnyRecordedRun b = read_run(folder_b);
  if (a.index() != b.index()) throw std::invalid_argument("a run in 2D and one in 3D: must be of one dimension");
  const Json json = std::visit(
      [&]<int Dim>(const RecordedRun<Dim>& one) { return comparison_json(one, std::get<RecordedRun<Dim>>(b)); }, a);
  if (as_json) {
    print_result("{}\n", json.dump(2));
  } else {
    print_comparison(json);
  }
  return exit_codes::success;
}

}  // namespace

void add_compare_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("compare", "How far two recorded runs differ, and from which step on");
  command->footer(
      "Example: talus compare runs/drop_in_a_pile_2d-box2d-full runs/drop_in_a_pile_2d-box2d-paper\n"
      "docs/measures.md tells what each measure says and between which floor and ceiling it lies.");
  struct Options {
    std::string a;
    std::string b;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  command->add_option("run_a", options->a, "Run folder, in the role of the full run")->required();
  command->add_option("run_b", options->b, "Run folder")->required();
  command->add_flag("--json", options->json, "As JSON");
  command->callback([options, &exit_code] { exit_code = compare(options->a, options->b, options->json); });
}

}  // namespace talus
