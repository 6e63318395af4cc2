#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "common/measure/support.h"
#include "common/text/printable.h"
#include "tools/commands/commands.h"
#include "tools/commands/validators.h"
#include "tools/output/output.h"
#include "tools/record/recorded_run.h"
#include "tools/record/wake_run.h"
#include "tools/report/json_text.h"
#include "tools/report/table.h"

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

struct WakeOptions {
  std::string run;
  std::string full;               // empty: none
  std::optional<double> seconds;  // not given: wake_time()
  bool json = false;
};

constexpr double longest_wake = 3600.0;  // [s]
constexpr double contact_reach = 0.05;   // [m], see touching_pairs()

/// What the last state lacks of a finished pile. The bodies that move are those faster than what counts as at rest in a
/// run's summary.
template <int Dim>
Json unfinished_json(const RecordedRun<Dim>& run) {
  constexpr double still = 1.0;  // [m/s]
  int moving = 0;
  for (const Vec<Dim>& velocity : run.last.velocity) moving += velocity.norm() > still ? 1 : 0;
  return {{"bodies_to_come", run.scene.bodies_planned() - run.last.size()},
          {"moving", moving},
          {"reason", run.reason.empty() ? "killed, or its record is cut" : run.reason}};
}

/// Events of the scene that happened, in their order.
template <int Dim>
Json events_json(const RecordedRun<Dim>& run) {
  Json events = Json::array();
  for (const DoneEvent& event : run.done)
    events.push_back({{"number", event.number}, {"time_s", event.time}, {"text", event_text(run.scene, event.number)}});
  return events;
}

template <int Dim>
Json result_of(const RecordedRun<Dim>& run, const WakeOptions& options) {
  const WorldDescription<Dim> world = world_at_end(run);
  const double seconds = options.seconds.value_or(wake_time(world.gravity));
  const WakeTest test = wake(run, seconds, options.run);
  const double extent = mean_extent(run);
  const std::vector<Touch> touches = touching_pairs<Dim>(world, run.last, contact_reach);
  const Penetration depth = penetration(touches);
  int asleep = 0;
  for (const std::uint8_t sleeps : run.last.asleep) asleep += sleeps;
  Json json = {
      {"run", run.name},
      {"backend", run.backend},
      {"policy", run.policy},
      {"step", run.last_step},
      {"bodies", test.bodies},
      {"asleep", asleep},
      {"floating_sleepers", floating_sleepers<Dim>(run.last, touches).size()},
      {"sunken_sleepers", sunken_sleepers<Dim>(world, run.last).size()},
      {"penetration_D", {{"mean", depth.mean / extent}, {"p99", depth.p99 / extent}, {"max", depth.max / extent}}},
      {"unfinished", unfinished_json(run)},
      {"events", events_json(run)},
      {"damage", text_of(run.damage)},
      {"simulated_s", seconds},
      {"after_waking", wake_json(test, extent)}};
  if (options.full.empty()) return json;
  const AnyRecordedRun other = read_run(options.full);
  const auto* full = std::get_if<RecordedRun<Dim>>(&other);
  if (full == nullptr)
    throw std::invalid_argument(
        fmt::format("--full = {}: must be a run of the same dimension, {}D", options.full, Dim));
  const WakeTest of_full = wake(*full, seconds, options.full);
  json["full_run"] = wake_json(of_full, extent);
  json["beyond_full_run"] = wake_json(excess(test, of_full), extent);
  return json;
}

std::string in_short(const Json& value) { return fmt::format("{:.4g}", value.get<double>()); }

void print_unfinished(const Json& unfinished) {
  const auto to_come = unfinished["bodies_to_come"].get<std::int64_t>();
  const auto moving = unfinished["moving"].get<int>();
  const auto reason = unfinished["reason"].get<std::string>();
  if (to_come <= 0 && moving == 0 && reason == "finished") return;
  print_result(
      "not a finished pile: {} bodies have yet to appear, {} move faster than 1 m/s, the run ended: {};\n"
      "  what falls counts as displaced below\n",
      to_come, moving, printable(reason));
}

void print_wake(const Json& json) {
  const auto text = [&](const char* key) { return printable(json[key].get<std::string>()); };
  print_result("{} ({}, policy {}) after step {}: {} bodies, {} of them asleep\n", text("run"), text("backend"),
               text("policy"), json["step"].get<std::int64_t>(), json["bodies"].get<int>(), json["asleep"].get<int>());
  if (const auto damage = json["damage"].get<std::string>(); !damage.empty())
    print_result("the record is damaged: {}\n", damage);
  print_unfinished(json["unfinished"]);
  if (!json["events"].empty())
    print_result(
        "{} events of the scene have happened: obstacles and gravity are as they left them; no other happens\n",
        json["events"].size());
  print_result("floating sleepers: {} (must be 0)\n", json["floating_sleepers"].get<int>());
  print_result("sleepers below ground: {} (must be 0)\n", json["sunken_sleepers"].get<int>());
  const Json& depth = json["penetration_D"];
  print_result("penetration over D: mean {}, 99 % {}, max {}\n", in_short(depth["mean"]), in_short(depth["p99"]),
               in_short(depth["max"]));
  const bool with_full = json.contains("full_run");
  Table table{
      fmt::format("\nAll woken and simulated for {:g} s at the reference settings", json["simulated_s"].get<double>()),
      {{"measure"}, {"run", true}},
      {}};
  if (with_full) table.columns.insert(table.columns.end(), {{"full run", true}, {"beyond it", true}});
  for (const auto& [name, value] : json["after_waking"].items()) {
    table.rows.push_back({name, in_short(value)});
    if (!with_full) continue;
    table.rows.back().push_back(in_short(json["full_run"][name]));
    table.rows.back().push_back(in_short(json["beyond_full_run"][name]));
  }
  print_text(text_of(table));
}

int wake_command(const WakeOptions& options) {
  const Json json = std::visit([&](const auto& run) { return result_of(run, options); }, read_run(options.run));
  if (options.json)
    print_result("{}\n", json_text(json, 2));
  else
    print_wake(json);
  return exit_codes::success;
}

}  // namespace

void add_wake_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("wake", "Wake all bodies of a recorded run and measure how far they drift");
  command->footer(
      "Rebuilds the last recorded state with all bodies awake and simulates on at the reference settings.\n"
      "Take a finished pile: what still falls counts as displaced.\n"
      "Example: talus wake runs/pile-paper --full runs/pile-full");
  auto options = std::make_shared<WakeOptions>();
  command->add_option("run", options->run, "Run folder")->required()->check(not_empty());
  command->add_option("--full", options->full, "Run folder of the full run, whose own drift is taken off")
      ->check(not_empty());
  command
      ->add_option(
          "--seconds", options->seconds,
          "Simulated after waking; default: 5 at 9.81 m/s^2, in other gravity as long as takes the same motion")
      ->check(number_between(0.0, longest_wake, Bound::left_out));
  command->add_flag("--json", options->json, "As JSON");
  command->callback([options, &exit_code] { exit_code = wake_command(*options); });
}

}  // namespace talus
