#include "common/scene/read_parts.h"

#include <fmt/format.h>

#include <cmath>

#include "common/pile/angle_of_repose.h"
#include "common/scene/read_walls.h"

namespace talus {

void read_seed(TableReader& root, std::uint64_t& seed) {
  auto number = static_cast<std::int64_t>(seed);
  root.read("seed", number, at_least(0.0));
  seed = static_cast<std::uint64_t>(number);
}

namespace {

void read_adaptive(TableReader& table, AdaptiveParams& params) {
  const Range fraction = {.low = 0.0, .high = 10.0, .low_excluded = true};  // of D
  table.read("rest_distance", params.rest_distance, fraction);
  table.read("rest_time_deep", params.rest_time_deep, between(0, 1e3));
  table.read("rest_time_surface", params.rest_time_surface, {.low = params.rest_time_deep, .high = 1e3});
  table.read("rest_distance_woken", params.rest_distance_woken, fraction);
  table.read("rest_time_woken", params.rest_time_woken, between(0, 1e3));
  table.read("wake_height", params.wake_height, fraction);
  table.renamed("heavy_blow", "heavy_impact");
  table.read("heavy_impact", params.heavy_impact, {.low = 0.0, .high = 1e9, .low_excluded = true});
  table.read("support_slack", params.support_slack, fraction);
  table.read("awake_share", params.awake_share, {.low = 0.0, .high = 1.0, .high_excluded = true});
  table.read("avalanche_width", params.avalanche_width, {.low = 0.0, .high = 1e3, .low_excluded = true});
  table.read("avalanche_growth", params.avalanche_growth, {.low = 1.0, .high = 1e3, .low_excluded = true});
  table.read("avalanche_growth_quiet", params.avalanche_growth_quiet, {.low = 1.0, .high = 1e3});
  table.read_degrees("avalanche_angle_deg", params.avalanche_angle, between(0.0, 89.0));
  table.renamed("steering_gain", "slope_proportional_gain");
  table.renamed("steering_growth", "slope_integral_gain");
  table.renamed("steering_most", "slope_max_damping");
  table.read("slope_proportional_gain", params.slope_proportional_gain, between(0.0, 1e6));
  table.read("slope_integral_gain", params.slope_integral_gain, between(0.0, 1e6));
  table.read("slope_max_damping", params.slope_max_damping, between(0.0, 1e6));
}

}  // namespace

template <int Dim>
PileParams<Dim> read_pile(TableReader& table, std::vector<Obstacle<Dim>>& obstacles) {
  PileParams<Dim> pile;
  if (table.has("alpha_deg")) {
    // At 0 and 90 degrees a pile has no height or no base.
    table.read_degrees("alpha_deg", pile.alpha.emplace(), between(1.0, 89.0));
  }
  table.renamed("hold_slope", "control_slope");
  table.read("control_slope", pile.control_slope);
  if (pile.control_slope) {
    table.require("alpha_deg");
    if (pile.alpha.value_or(0.0) > max_angle_of_repose) {
      table.reject("alpha_deg", "must be at most 75 with control_slope: no steeper slope is measured");
    }
  }
  if (table.has("at")) {
    table.read("at", pile.at.emplace(), coordinate());
  }
  table.read("initial_size", pile.initial_size, between(1.0, 1e7));
  table.read("growth_ratio", pile.growth_ratio, between(0.01, 1.0));
  table.read("merge_distance", pile.merge_distance, between(0.0, 1e6));
  table.read("drift_rate", pile.drift_rate, between(0.0, 1e3));
  if (table.has("count_flying")) {
    table.read("count_flying", pile.count_flying.emplace());
  }
  if (table.has("boundary")) {
    table.table("boundary", [&](TableReader& within) {
      pile.boundary = read_boundary<Dim>(within, pile.at.value_or(Vec<Dim>::Zero()), obstacles);
    });
    if (!pile.at) {
      table.reject("boundary", "must be given together with at, the middle of its floor");
    }
    if (pile.control_slope) {
      table.reject("control_slope", "must be false within walls, which support their bodies at any slope");
    }
    table.require("alpha_deg");  // walls hide the slope that bodies take by themselves
  }
  return pile;
}

void read_policy(TableReader& table, PolicyParams& policy) {
  const std::vector<std::string> kinds = {"full", "engine", "paper", "adaptive"};
  table.read("kind", policy.kind, kinds);
  table.read("tau", policy.paper.tau, {.low = 0.0, .high = 1.0, .high_excluded = true});
  table.read("avalanche_density", policy.paper.avalanche_density, {.low = 0.0, .high = 1e3, .low_excluded = true});
  table.read("awake_steps", policy.paper.awake_steps, between(0, 1e9));
  table.read("wake_speed", policy.paper.wake_speed, {.low = 0.0, .high = 1e6, .low_excluded = true});
  table.table("adaptive", [&](TableReader& own) { read_adaptive(own, policy.adaptive); });
}

/// A run's steps: at 60 a second half a year, at a quarter of a microsecond for a world at rest four minutes.
constexpr double most_steps = 1e9;

void read_run(TableReader& table, double dt, RunParams& run) {
  table.read("frames", run.frames, between(1, 1e9));
  table.read("frame_rate", run.frame_rate, between(1e-3, 1e5));
  const double steps = 1.0 / (run.frame_rate * dt);
  if (table.sound() && (steps < 0.5 || std::abs(steps - std::round(steps)) > 1e-6)) {
    table.reject("frame_rate", fmt::format("must divide world.steps_per_second, here {:.6g}: a frame is one or more "
                                           "whole steps",
                                           1.0 / dt));
    return;
  }
  if (table.sound() && steps * static_cast<double>(run.frames) > most_steps) {
    table.reject("frames", fmt::format("must make at most {} steps, here {:.3g} steps a frame", most_steps, steps));
  }
}

template PileParams<2> read_pile(TableReader&, std::vector<Obstacle<2>>&);
template PileParams<3> read_pile(TableReader&, std::vector<Obstacle<3>>&);

}  // namespace talus
