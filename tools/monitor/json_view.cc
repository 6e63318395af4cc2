#include "tools/monitor/json_view.h"

#include <nlohmann/json.hpp>

#include "lcmtypes/run_info.h"
#include "lcmtypes/stats_message.h"
#include "tools/output/json_text.h"

namespace talus {

using talus_lcm::talus_run;
using talus_lcm::talus_stats;
using Json = nlohmann::ordered_json;

namespace {

Json of(const Pile<3>& pile) {
  Json counts = Json::array();
  Json sleeping = Json::array();
  Json densities = Json::array();
  Json capacities = Json::array();
  Json sleep_thresholds = Json::array();
  Json wake_thresholds = Json::array();
  const auto threshold = [](double density) { return density >= 0.0 ? Json(density) : Json(); };
  for (const Layer& layer : pile.layers) {
    counts.push_back(layer.count);
    sleeping.push_back(layer.sleeping);
    densities.push_back(layer.density());
    capacities.push_back(layer.capacity);
    sleep_thresholds.push_back(threshold(layer.thresholds.sleep));
    wake_thresholds.push_back(threshold(layer.thresholds.wake));
  }
  return {{"layers", pile.layers.size()},
          {"occupation_ratio", pile.occupation_ratio()},
          {"density", densities},
          {"sleep_density", sleep_thresholds},
          {"wake_density", wake_thresholds},
          {"capacity", capacities},
          {"count", counts},
          {"sleeping", sleeping}};
}

Json of(const talus_run& run) {
  constexpr const char* phases[] = {"begin", "alive", "end"};
  return {{"scene", run.scene},         {"backend", run.backend}, {"solver", run.solver},
          {"policy", run.policy},       {"version", run.version}, {"seed", static_cast<std::uint64_t>(run.seed)},
          {"phase", phases[run.phase]}, {"reason", run.reason}};
}

/// As in summary.json.
Json of(const Warning& warning) {
  return {{"kind", to_string(warning.kind)},
          {"step", warning.step},
          {"body", warning.body},
          {"bodies", warning.bodies},
          {"value", warning.value}};
}

Json of(const talus_stats& stats) {
  Json object = {{"awake", stats.awake},
                 {"asleep", stats.asleep},
                 {"kinetic_energy_J", stats.kinetic_energy},
                 {"bodies_planned", stats.planned},
                 {"bodies_appeared", stats.appeared}};
  if (stats.drift_estimate >= 0.0)
    object["estimate"] = {{"drift_D", stats.drift_estimate}, {"checked_share", stats.checked_share}};
  object["overlap"] = {{"deepest_D", stats.overlap}, {"share", stats.overlap_share}};
  object["warnings"] = Json::array();
  for (const Warning& warning : warnings_of(stats)) object["warnings"].push_back(of(warning));
  if (stats.timed == 0) return object;
  object["real_time_factor"] = stats.real_time_factor;
  object["ms"] = {{"emit", stats.ms_emit},     {"step", stats.ms_step},   {"collide", stats.ms_collide},
                  {"solve", stats.ms_solve},   {"read", stats.ms_read},   {"count", stats.ms_count},
                  {"decide", stats.ms_decide}, {"apply", stats.ms_apply}, {"observe", stats.ms_observe}};
  object["dropped"] = stats.dropped;
  return object;
}

}  // namespace

std::string json_line(std::int64_t run_id, const RunView& view, const Faults& faults) {
  Json object = {{"run", short_id(run_id)}, {"step", view.step()}, {"time_s", view.sim_time()}};
  if (view.run()) object.update(of(*view.run()));
  if (view.stats()) object.update(of(*view.stats()));
  object["piles"] = Json::array();
  for (const RunView::NumberedPile& each : view.piles()) {
    object["piles"].push_back({{"number", each.number}});
    object["piles"].back().update(of(*each.pile));
  }
  object["piles_left_out"] = view.reader().piles_left_out();
  object["slept"] = view.reader().slept();
  object["woken"] = view.reader().woken();
  object["received"] = view.received();
  for (const Channel channel : all_channels) object["lost"][name_of(channel)] = view.reader().lost(channel);
  object["undecodable"] = faults.undecodable;
  object["receiver_crashes"] = faults.receiver_crashes;
  object["dropped_runs"] = faults.dropped_runs;
  return json_text(object);
}

std::string json_line(const Faults& faults) {
  Json object = {{"undecodable", faults.undecodable},
                 {"last_undecodable", faults.last_undecodable},
                 {"receiver_crashes", faults.receiver_crashes},
                 {"last_crash", faults.last_crash},
                 {"restart_delay_ms", faults.restart_delay_ms},
                 {"dropped_runs", faults.dropped_runs},
                 {"last_dropped", faults.dropped_runs > 0 ? Json(short_id(faults.last_dropped)) : Json(nullptr)},
                 {"unplaced_messages", faults.unplaced_messages},
                 {"piles_left_out", faults.piles_left_out}};
  return json_text({{"faults", object}});
}

}  // namespace talus
