#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/measure/compare.h"
#include "common/measure/resting_shape.h"
#include "common/scene/setting_differences.h"
#include "common/scene/typical_body.h"
#include "common/text/printable.h"
#include "tools/commands/commands.h"
#include "tools/output/json_text.h"
#include "tools/output/output.h"
#include "tools/output/table.h"
#include "tools/record/recorded_run.h"
#include "tools/run/make_simulation.h"
#include "tools/run/shape_json.h"

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
          {"damaged_bytes", run.damage.bytes},
          {"lost_steps", run.damage.lost_steps},
          {"damage", text_of(run.damage)}};
}

Json motion_json(const MotionError& error) {
  return {{"relative", error.relative}, {"left_out", error.left_out}, {"absolute", error.absolute},
          {"floored", error.floored},   {"R", error.ratio},           {"S", error.symmetric},
          {"turning", error.turning}};
}

Json settings_json(const std::vector<SettingDifference>& differences) {
  Json list = Json::array();
  for (const SettingDifference& difference : differences) {
    list.push_back(
        {{"path", difference.path}, {"a", difference.a}, {"b", difference.b}, {"of_scene", is_of_scene(difference)}});
  }
  return list;
}

/// Refuses runs that no measure is defined for.
template <int Dim>
void check_comparable_runs(const RecordedRun<Dim>& a, const RecordedRun<Dim>& b) {
  if (a.scene.world.shapes.size() != b.scene.world.shapes.size()) {
    throw std::invalid_argument(
        fmt::format("{} and {} are runs of different scenes, with {} and {} shapes: must be of the same shapes", a.name,
                    b.name, a.scene.world.shapes.size(), b.scene.world.shapes.size()));
  }
  const int last = last_common_frame(a.frames, b.frames);
  if (last < 0)
    throw std::invalid_argument(fmt::format("{} and {}: must have a frame of output in common", a.name, b.name));
  if (a.frames.bodies(last) > 0 && b.frames.bodies(last) > 0) return;
  throw std::invalid_argument(
      fmt::format("{} and {}: must both have a body by step {}, the last that both tell: there "
                  "is nothing to compare",
                  a.name, b.name, a.frames.step(last)));
}

/// Two runs, with the shapes of their piles as JSON; null where no body rests.
template <int Dim>
struct Compared {
  RunComparison<Dim> result;
  Json shape_a;
  Json shape_b;
};

/// `scene_b` and `done_b` are those of the run of which `b` are the frames.
template <int Dim>
Compared<Dim> compare_frames(const RecordedRun<Dim>& a, const Trajectory<Dim>& b, const Scene<Dim>& scene_b,
                             std::span<const DoneEvent> done_b) {
  const std::vector<Shape<Dim>>& shapes = a.scene.world.shapes;
  const int last = last_common_frame(a.frames, b);
  const double extent = typical_body(a.scene).extent;
  const double fastest = fastest_at_rest(a.scene.world);
  const auto bodies = placed_bodies<Dim>(shapes, a.frames, last, fastest);
  const auto bodies_b = placed_bodies<Dim>(shapes, b, last, fastest);
  const ProfileGrid<Dim> grid = grid_around<Dim>(bodies, a.scene.world.ground.height, extent);
  const double time = static_cast<double>(a.frames.step(last)) * a.frames.step_time();
  Compared<Dim> both{compare_runs<Dim>(a.frames, b, shapes, a.scene.world.gravity, grid, fastest), {}, {}};
  if (!bodies.empty())
    both.shape_a = shape_json<Dim>(bodies, both.result.shape_a, grid, world_at<Dim>(a.scene, a.done, time), extent);
  if (!bodies_b.empty())
    both.shape_b = shape_json<Dim>(bodies_b, both.result.shape_b, grid, world_at<Dim>(scene_b, done_b, time), extent);
  return both;
}

/// B's numbers minus A's, by name; without the texts, and null where either has none.
Json difference_of(const Json& a, const Json& b) {
  Json difference = Json::object();
  if (a.is_null()) return difference;
  for (const auto& [name, value] : b.items()) {
    if (name.ends_with("_reason")) continue;
    const bool both = value.is_number() && a[name].is_number();
    difference[name] = both ? Json(value.get<double>() - a[name].get<double>()) : Json();
  }
  return difference;
}

/// All numbers that are 0 where the runs are equal; of the shape B's minus A's.
template <int Dim>
Json numbers_json(const Compared<Dim>& compared) {
  const RunComparison<Dim>& result = compared.result;
  Json json = {
      {"motion", motion_json(result.motion_mean)},
      {"distance_D",
       {{"mean_at_end", result.position_mean[result.last]},
        {"p95_at_end", result.position_p95},
        {"max_at_end", result.position_max}}},
      {"shape", difference_of(compared.shape_a, compared.shape_b)},
      {"profile_rms_D", result.profile_rms},
      {"z", {{"ks", result.z.kolmogorov_smirnov}, {"w1_m", result.z.wasserstein}, {"energy_m", result.z.energy}}},
      {"r", {{"ks", result.r.kolmogorov_smirnov}, {"w1_m", result.r.wasserstein}, {"energy_m", result.r.energy}}}};
  if (compared.shape_a.is_null() || compared.shape_b.is_null())
    for (const char* of_shapes : {"profile_rms_D", "z", "r"}) json[of_shapes] = nullptr;
  return json;
}

/// Run A again, moved by `shift` [m] along x at its source or at its first body.
template <int Dim>
Trajectory<Dim> twin_of(const RecordedRun<Dim>& a, double shift) {
  Scene<Dim> scene = a.scene;
  if (!scene.sources.empty())
    scene.sources.front().position[0] += shift;
  else if (!scene.bodies.empty())
    scene.bodies.front().def.pose.position[0] += shift;
  Simulation<Dim> simulation = make_simulation(scene, a.backend);
  TrajectoryRecorder<Dim> recorder(scene.world.dt, scene.steps_per_frame(), scene.world.periodic());
  simulation.add_observer(recorder);
  for (std::int64_t step = 0; step < a.last_step; ++step) simulation.step();
  return recorder.trajectory();
}

/// Raises each number of `floor` to the size of that in `numbers`.
void raise_floor(Json& floor, const Json& numbers) {
  for (const auto& [name, value] : numbers.items())
    if (value.is_object())
      raise_floor(floor[name], value);
    else if (value.is_number())
      floor[name] = std::max(floor[name].is_number() ? floor[name].get<double>() : 0.0, std::abs(value.get<double>()));
}

/// The largest number of each kind that twins of A give: what chaos does to the same pile. Null without twins.
template <int Dim>
Json floor_json(const RecordedRun<Dim>& a, int twins) {
  constexpr double shift = 1e-6;  // [m]
  Json floor = nullptr;
  for (int k = 1; k <= twins; ++k) {
    if (floor.is_null()) floor = Json::object();
    raise_floor(floor, numbers_json(compare_frames<Dim>(a, twin_of(a, k * shift), a.scene, a.done)));
  }
  return floor;
}

/// Why the shapes cannot be compared; empty where they can.
std::string shape_fault(const Json& json) {
  const bool a = json["shape_a"].is_null();
  const bool b = json["shape_b"].is_null();
  if (!a && !b) return {};
  return fmt::format("no shapes to compare: no body of {} rests at the last frame that both have",
                     a && b ? "either" : (a ? "A" : "B"));
}

/// What B's shape differs from A's by, in percent of A's.
std::string shape_words(const Json& json) {
  std::string words = shape_fault(json);
  if (!words.empty()) return words;
  const Json& floor = json["floor"];
  for (const auto& [key, name] : {std::pair("centre_height_m", "centre of mass"), {"r50_m", "r50"}, {"r95_m", "r95"}}) {
    const double of_a = json["shape_a"][key].get<double>();
    if (of_a == 0.0) continue;
    const double percent = 100.0 / std::abs(of_a);
    words += fmt::format("{}{} {:+.1f} %", words.empty() ? "" : ", ", name,
                         percent * (json["shape_b"][key].get<double>() - of_a));
    if (!floor.is_null()) words += fmt::format(" (floor {:.1f} %)", percent * floor["shape"][key].get<double>());
  }
  return words;
}

/// Whether the shapes are there, and their three lengths differ by no more than those of twins.
bool within_floor(const Json& json) {
  if (!shape_fault(json).empty()) return false;
  const auto within = [&](const char* key) {
    const double difference = json["shape_b"][key].get<double>() - json["shape_a"][key].get<double>();
    return std::abs(difference) <= json["floor"]["shape"][key].get<double>();
  };
  return within("centre_height_m") && within("r50_m") && within("r95_m");
}

std::string verdict_of(const Json& json) {
  const Json& settings = json["settings_that_differ"];
  const bool other_scene = std::ranges::any_of(settings, [](const Json& one) { return one["of_scene"].get<bool>(); });
  if (json["first_difference"].is_null()) {
    const auto damaged = [](const Json& run) { return !run["damage"].get<std::string>().empty(); };
    const bool same =
        !other_scene && json["first_other_sleep_decision"].is_null() && json["a"]["steps"] == json["b"]["steps"];
    if (!same) return "Different runs; the frames that both have are equal bit for bit.";
    return damaged(json["a"]) || damaged(json["b"])
               ? "No difference in what both records have; damage has taken the rest."
               : "The same run, bit for bit.";
  }
  const std::string words = shape_words(json);
  if (other_scene) return fmt::format("Piles of different scenes: {}.", words);
  if (json["floor"].is_null()) return fmt::format("{}; --twins 3 measures what is noise.", words);
  return fmt::format("{}: {}.", within_floor(json) ? "The same pile within noise" : "Different piles", words);
}

template <int Dim>
Json comparison_json(const RecordedRun<Dim>& a, const RecordedRun<Dim>& b,
                     const std::vector<SettingDifference>& settings, int twins) {
  check_comparable_runs(a, b);
  const Compared<Dim> compared = compare_frames<Dim>(a, b.frames, b.scene, b.done);
  const RunComparison<Dim>& result = compared.result;
  Json json = {{"a", head_json(a)},
               {"b", head_json(b)},
               {"settings_that_differ", settings_json(settings)},
               {"frames_compared", result.frames - result.left_out},
               {"frames_left_out", result.left_out}};
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
  json["shape_a"] = compared.shape_a;
  json["shape_b"] = compared.shape_b;
  const Json numbers = numbers_json(compared);
  for (const char* key : {"motion", "distance_D", "profile_rms_D", "z", "r"}) json[key] = numbers[key];
  json["floor"] = floor_json(a, twins);
  json["verdict"] = verdict_of(json);
  return json;
}

std::string number(const Json& value) {
  const bool known = value.is_number() && std::isfinite(value.get<double>());
  return known ? fmt::format("{:.4g}", value.get<double>()) : "-";
}

std::string printed(const Json& text) { return printable(text.get<std::string>()); }

void print_head(const Json& run, char letter) {
  print_result("{}: {}: {}, policy {}, {} steps, {} bodies, {} sleep events\n", letter, printed(run["run"]),
               printed(run["backend"]), printed(run["policy"]), run["steps"].get<std::int64_t>(),
               run["bodies"].get<int>(), run["sleep_events"].get<int>());
  if (const auto damage = run["damage"].get<std::string>(); !damage.empty())
    print_result("   the record is damaged: {}\n", damage);
}

void print_settings(const Json& settings) {
  const bool other_scene = std::any_of(settings.begin(), settings.end(),
                                       [](const Json& setting) { return setting["of_scene"].get<bool>(); });
  if (other_scene) print_result("These are runs of different scenes: a body of A is not the same body in B.\n");
  if (settings.empty()) return;
  Table table{"Settings that differ", {{"setting"}, {"A"}, {"B"}}, {}};
  for (const Json& setting : settings)
    table.rows.push_back({printed(setting["path"]), printed(setting["a"]), printed(setting["b"])});
  print_result("{}\n", text_of(table));
}

void print_first_differences(const Json& json) {
  const Json& first = json["first_difference"];
  const auto left_out = json["frames_left_out"].get<int>();
  if (left_out > 0) print_result("Frames left out, lost in A or B: {}.\n", left_out);
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

/// A table of numbers, beside each the floor where there is one.
Table numbers_table(std::string title, std::vector<Column> columns, const Json& json) {
  if (!json["floor"].is_null()) columns.push_back({"floor", true});
  return {std::move(title), std::move(columns), {}};
}

void add_row(Table& table, const Json& json, std::vector<std::string> cells, const Json::json_pointer& in_floor) {
  if (!json["floor"].is_null()) cells.push_back(number(json["floor"].value(in_floor, Json())));
  table.rows.push_back(std::move(cells));
}

void print_motion(const Json& json) {
  Table table =
      numbers_table("\nMotion, mean over frames, A in the role of the full run", {{"measure"}, {"value", true}}, json);
  for (const char* group : {"motion", "distance_D"})
    for (const auto& [name, value] : json[group].items())
      add_row(table, json, {(group == std::string("motion") ? "" : "distance_D ") + name, number(value)},
              Json::json_pointer(fmt::format("/{}/{}", group, name)));
  print_text(text_of(table));
}

void print_shapes(const Json& json) {
  if (!shape_fault(json).empty()) return;
  Table shape =
      numbers_table("\nShape at the last frame that both have", {{"measure"}, {"A", true}, {"B", true}}, json);
  for (const auto& [name, value] : json["shape_a"].items())
    if (!name.ends_with("_reason"))
      add_row(shape, json, {name, number(value), number(json["shape_b"][name])}, Json::json_pointer("/shape/" + name));
  print_text(text_of(shape));
  for (const auto& [letter, side] : {std::pair("A", "shape_a"), {"B", "shape_b"}})
    for (const auto& [reason, name] :
         {std::pair("angle_of_repose_reason", "angle of repose"), {"packing_reason", "packing"}})
      if (const Json& text = json[side][reason]; text.is_string())
        print_result("{}: no {}: {}\n", letter, name, printed(text));
  Table between = numbers_table("\nBetween the shapes", {{"measure"}, {"value", true}}, json);
  add_row(between, json, {"profile_rms_D", number(json["profile_rms_D"])}, Json::json_pointer("/profile_rms_D"));
  for (const char* axis : {"z", "r"})
    for (const auto& [name, value] : json[axis].items())
      add_row(between, json, {fmt::format("{} {}", axis, name), number(value)},
              Json::json_pointer(fmt::format("/{}/{}", axis, name)));
  print_text(text_of(between));
}

void print_comparison(const Json& json) {
  print_head(json["a"], 'A');
  print_head(json["b"], 'B');
  print_settings(json["settings_that_differ"]);
  print_first_differences(json);
  print_motion(json);
  print_shapes(json);
  print_result("\n{}\n", json["verdict"].get<std::string>());
}

int compare(const std::string& folder_a, const std::string& folder_b, int twins, bool as_json) {
  const AnyRecordedRun a = read_run(folder_a);
  const AnyRecordedRun b = read_run(folder_b);
  if (a.index() != b.index()) throw std::invalid_argument("a run in 2D and one in 3D: must be of one dimension");
  const auto settings = setting_differences(scene_texts_of_run(folder_a), scene_texts_of_run(folder_b));
  const Json json = std::visit(
      [&]<int Dim>(const RecordedRun<Dim>& one) {
        return comparison_json(one, std::get<RecordedRun<Dim>>(b), settings, twins);
      },
      a);
  if (as_json)
    print_result("{}\n", json_text(json, 2));
  else
    print_comparison(json);
  return exit_codes::success;
}

}  // namespace

void add_compare_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("compare", "How far two recorded runs differ, and from which step on");
  command->footer(
      "Example: talus compare runs/drop_in_a_pile_2d-box2d-full runs/drop_in_a_pile_2d-box2d-paper\n"
      "docs/accuracy.md explains each measure and gives its floor and ceiling.");
  struct Options {
    std::string a;
    std::string b;
    int twins = 0;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  command->add_option("run_a", options->a, "Run folder or its record, in the role of the full run")
      ->required()
      ->check(not_empty());
  command->add_option("run_b", options->b, "Run folder or its record")->required()->check(not_empty());
  command
      ->add_option("--twins", options->twins,
                   "Run A's scene so many times more, its source moved by 1e-6 m and multiples: what differs between "
                   "these is noise, the floor of each number")
      ->check(whole_number(0, 100))
      ->capture_default_str();
  command->add_flag("--json", options->json, "As JSON");
  command->callback(
      [options, &exit_code] { exit_code = compare(options->a, options->b, options->twins, options->json); });
}

}  // namespace talus
