#include "tools/bench/error_meter.h"

#include <algorithm>
#include <array>
#include <utility>

#include "common/measure/compare.h"
#include "common/measure/divergence.h"
#include "common/measure/ensemble.h"
#include "common/measure/short_horizon.h"
#include "common/measure/support.h"
#include "common/measure/wake_test.h"
#include "common/measure/work.h"
#include "common/scene/typical_body.h"
#include "tools/run/backends.h"

namespace talus {
namespace {

constexpr double still = 1.0;  // [m/s]; faster bodies are in flight

/// Without the bodies in flight: they would count as displaced when they land.
template <int Dim>
BodyStates<Dim> settled(BodyStates<Dim> states) {
  for (std::size_t i = 0; i < states.shape.size(); ++i)
    if (states.velocity[i].norm() > still) states.removed[i] = 1;
  return states;
}

/// First frame at which all bodies are there.
template <int Dim>
int end_of_pour(const Trajectory<Dim>& run) {
  int frame = run.frames() - 1;
  while (frame > 0 && run.bodies(frame - 1) == run.bodies()) --frame;
  return frame;
}

/// End of the last frame after which a body still moves by more than 0.01 D within half a second; nothing where one
/// does to the end.
template <int Dim>
std::optional<double> stops_at(const Trajectory<Dim>& run, std::span<const double> extents) {
  constexpr double far = 0.01;
  constexpr double window = 0.5;
  const int last = run.frames() - 1 - static_cast<int>(window / run.frame_time());
  for (int frame = last; frame >= 0; --frame) {
    if (hindsight(run, extents, far, window, frame, frame + 1).share == 0.0) continue;
    if (frame == last) return std::nullopt;
    return static_cast<double>(run.step(frame + 1)) * run.step_time();
  }
  return 0.0;
}

/// Share of its height that the pile's middle loses per minute in the run itself, from five seconds after the last body
/// came in to the end; nothing where that is less than five seconds.
template <int Dim>
std::optional<double> settling(const Trajectory<Dim>& run, double ground) {
  const int calm = static_cast<int>(5.0 / run.frame_time());
  const int first = end_of_pour(run) + calm;
  const int last = run.frames() - 1;
  if (last - first < calm) return std::nullopt;
  const auto middle_at = [&](int frame) {
    double sum = 0.0;
    int bodies = 0;
    for (BodyIndex body = 0; body < run.bodies(frame); ++body) {
      if (!run.present(first, body) || !run.present(last, body)) continue;
      sum += height<Dim>(run.position(frame, body)) - ground;
      ++bodies;
    }
    return bodies > 0 ? sum / bodies : 0.0;
  };
  const double before = middle_at(first);
  const double minutes = (last - first) * run.frame_time() / 60.0;
  return before > 0.0 ? std::optional((before - middle_at(last)) / before / minutes) : std::nullopt;
}

/// Last states of the independent runs first_run .. runs - 1.
template <int Dim>
std::vector<BodyStates<Dim>> ends_of(const Scene<Dim>& scene, const std::string& backend, int first_run, int runs) {
  std::vector<BodyStates<Dim>> ends;
  for (int k = first_run; k < runs; ++k) ends.push_back(end_state(reseeded(scene, k), backend));
  return ends;
}

/// Hindsight of a full run over all of it, during the pour and after.
template <int Dim>
void add_hindsight(const Trajectory<Dim>& full, std::span<const double> extents, Values& values) {
  constexpr double window = 0.5;  // [s]
  const int poured = end_of_pour(full);
  values["hindsight_001"] = hindsight(full, extents, 0.01).ratio;
  values["hindsight_005"] = hindsight(full, extents, 0.05).ratio;
  values["hindsight_02"] = hindsight(full, extents, 0.2).ratio;
  values["hindsight_005_pour"] = hindsight(full, extents, 0.05, window, 0, poured).ratio;
  values["hindsight_005_after_pour"] = hindsight(full, extents, 0.05, window, poured).ratio;
}

}  // namespace

template <int Dim>
ErrorMeter<Dim>::ErrorMeter(const Scene<Dim>& baseline, std::string backend, int seeds)
    : scene_(baseline),
      backend_(std::move(backend)),
      seeds_(std::max(seeds, 2)),
      extent_(typical_body(baseline).extent),
      full_(record(baseline, backend_)) {
  const auto bodies = placed_bodies<Dim>(scene_.world.shapes, full_.last, still);
  grid_ = grid_around<Dim>(bodies, scene_.world.ground.height, extent_);
  std::vector<BodyStates<Dim>> ends = {full_.last};
  for (BodyStates<Dim>& end : ends_of(baseline, backend_, 1, seeds_)) ends.push_back(std::move(end));
  shapes_ = shape_ensemble<Dim>(ends, scene_.world.shapes, grid_);
  add_floors(ends);
}

template <int Dim>
void ErrorMeter<Dim>::add_floors(std::span<const BodyStates<Dim>> ends) {
  const std::vector<double> extents = extents_of<Dim>(scene_.world.shapes);
  const auto errors_of = [&](const Recording<Dim>& other) {
    return average(motion_errors<Dim>(full_.frames, other.frames, extents, scene_.world.gravity));
  };
  const Recording<Dim> near = record(perturbed(scene_), backend_);
  const MotionError floor = errors_of(near);
  const MotionError other_seed = errors_of(record(reseeded(scene_, 1), backend_));
  Values& values = of_baseline_;
  values["relative_floor"] = floor.relative;
  values["R_floor"] = floor.ratio;
  values["S_floor"] = floor.symmetric;
  values["R_ceiling"] = other_seed.ratio;
  values["S_ceiling"] = other_seed.symmetric;
  values["diverges_at"] = divergence_frame(position_differences(full_.frames, near.frames)) * full_.frames.frame_time();
  add_shape_errors(shapes_, shapes_, extent_, values);
  add_horizon(full_, values);
  values["horizon_R_30_floor"] = values["horizon_R_30"];
  values["horizon_mean_30_D_floor"] = values["horizon_mean_30_D"];
  add_last_state(full_, values);
  add_drift(ends, values);
  add_work(full_, values);
  add_hindsight<Dim>(full_.frames, extents, values);
}

template <int Dim>
Values ErrorMeter<Dim>::measure(const Scene<Dim>& scene) const {
  Values values;
  const Recording<Dim> run = record(scene, backend_);
  add_motion(run.frames, values);
  add_horizon(run, values);
  add_last_state(run, values);
  add_work(run, values);
  std::vector<BodyStates<Dim>> ends = {run.last};
  for (BodyStates<Dim>& end : ends_of(scene, backend_, 1, seeds_)) ends.push_back(std::move(end));
  add_drift(ends, values);
  add_shape_errors(shapes_, shape_ensemble<Dim>(ends, scene_.world.shapes, grid_), extent_, values);
  const Values& baseline = of_baseline_;
  constexpr std::array<MeasureId, 9> of_the_baseline = {
      "relative_floor",          "R_floor",     "S_floor",      "R_ceiling", "S_ceiling", "horizon_R_30_floor",
      "horizon_mean_30_D_floor", "diverges_at", "hindsight_005"};
  for (const MeasureId id : of_the_baseline) values[id] = baseline[id];
  values["drift_mean_excess_D"] = values["drift_mean_D"] - baseline["drift_mean_D"];
  values["drift_far_excess"] = values["drift_far"] - baseline["drift_far"];
  return values;
}

template <int Dim>
void ErrorMeter<Dim>::add_motion(const Trajectory<Dim>& frames, Values& values) const {
  const std::vector<double> extents = extents_of<Dim>(scene_.world.shapes);
  const MotionError error = average(motion_errors<Dim>(full_.frames, frames, extents, scene_.world.gravity));
  values["relative"] = error.relative;
  values["left_out"] = error.left_out;
  values["absolute"] = error.absolute;
  values["floored"] = error.floored;
  values["R"] = error.ratio;
  values["S"] = error.symmetric;
  values["turning"] = error.turning;
  const Values& baseline = of_baseline_;
  for (const MeasureId id : std::initializer_list<MeasureId>{"R", "S"}) {
    const double floor = baseline[id.with("_floor")];
    const double ceiling = baseline[id.with("_ceiling")];
    if (ceiling > floor) values[id.with("_skill")] = skill(values[id], floor, ceiling);
  }
}

template <int Dim>
void ErrorMeter<Dim>::add_horizon(const Recording<Dim>& run, Values& values) const {
  if (run.forks.empty()) return;
  const auto full = full_continuation<Dim>(world_maker<Dim>(backend_), scene_.world, full_.frames.frame_time());
  const std::vector<double> extents = extents_of<Dim>(scene_.world.shapes);
  const auto errors = horizon_errors<Dim>(run.forks, run.arrivals, full, recorded_continuation<Dim>(run.frames),
                                          extents, scene_.world.gravity, {10, 30});
  values["horizon_R_10"] = errors[0].ratio;
  values["horizon_R_30"] = errors[1].ratio;
  values["horizon_mean_30_D"] = errors[1].mean;
}

template <int Dim>
void ErrorMeter<Dim>::add_last_state(const Recording<Dim>& run, Values& values) const {
  constexpr double reach = 0.05;  // [m], see touching_pairs()
  const auto touches = touching_pairs<Dim>(scene_.world, run.last, reach);
  const Penetration depth = penetration(touches);
  values["floating"] = static_cast<double>(floating_sleepers<Dim>(run.last, touches).size());
  values["penetration_p99_D"] = depth.p99 / extent_;
  values["penetration_max_D"] = depth.max / extent_;
}

/// Means over the ensemble, since one heap slides as a whole when woken and the next does not.
template <int Dim>
void ErrorMeter<Dim>::add_drift(std::span<const BodyStates<Dim>> ends, Values& values) const {
  std::vector<double> drift, far, energy, creep;
  for (const BodyStates<Dim>& end : ends) {
    const WakeTest wake = wake_test<Dim>(world_maker<Dim>(backend_), reference_settings(scene_.world), settled(end));
    if (wake.bodies == 0) continue;
    drift.push_back(wake.mean / extent_);
    far.push_back(wake.share_far);
    energy.push_back(wake.energy);
    creep.push_back(wake.creep);
  }
  if (drift.empty()) return;
  const EnsembleSummary summary = summarize(drift);
  values["drift_mean_D"] = summary.mean;
  values["drift_mean_D_sd"] = summary.deviation;
  values["drift_far"] = mean(far);
  values["wake_energy_mgD"] = mean(energy);
  values["creep_per_minute"] = mean(creep);
}

template <int Dim>
void ErrorMeter<Dim>::add_work(const Recording<Dim>& run, Values& values) const {
  values["work_skipped"] = run.work_skipped;
  if (run.asleep_at) values["asleep_at"] = *run.asleep_at;
  const auto lost = settling(run.frames, scene_.world.ground.height);
  if (lost) values["settling_per_minute"] = *lost;
  const auto stops = stops_at<Dim>(run.frames, extents_of<Dim>(scene_.world.shapes));
  if (stops) values["stops_at"] = *stops;
}

template class ErrorMeter<2>;
template class ErrorMeter<3>;

}  // namespace talus
