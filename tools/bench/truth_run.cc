#include "tools/bench/truth_run.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/measure/ensemble.h"
#include "common/measure/fork.h"
#include "common/measure/placed_body.h"
#include "common/measure/support.h"
#include "common/measure/wake_test.h"
#include "common/policy/adaptive/rest_criterion.h"
#include "common/scene/happened.h"
#include "common/scene/typical_body.h"
#include "common/simulation/make_policy.h"
#include "common/simulation/simulation.h"
#include "tools/run/backends.h"
#include "tools/run/measured_drift.h"
#include "tools/run/processor_watch.h"

namespace talus {
namespace {

constexpr double fastest_of_pile = 1.0;  // [m/s]; faster bodies are in flight

/// A position with its height above the slope, and the distance down the slope in the place of x.
template <int Dim>
Vec<Dim> along_slope(const Vec<Dim>& position, double slope) {
  Vec<Dim> turned = position;
  turned[0] = position[0] * std::cos(slope) - position[Dim - 1] * std::sin(slope);
  turned[Dim - 1] = position[0] * std::sin(slope) + position[Dim - 1] * std::cos(slope);
  return turned;
}

template <int Dim>
bool is_spilled(const Vec<Dim>& position, const TruthGeometry& geometry) {
  const double aside = position.template head<Dim - 1>().cwiseAbs().maxCoeff();
  return aside > geometry.inside_half_width || position[Dim - 1] < geometry.inside_above;
}

template <int Dim>
int spilled(const BodyStates<Dim>& states, const TruthGeometry& geometry) {
  int count = 0;
  for (std::size_t i = 0; i < states.shape.size(); ++i)
    count += !states.removed[i] && is_spilled<Dim>(states.pose[i].position, geometry);
  return count;
}

/// Bodies of the pile, in the axes of the ground; what has left a slope is left out.
template <int Dim>
std::vector<PlacedBody<Dim>> pile_of(const Scene<Dim>& scene, const BodyStates<Dim>& states,
                                     const TruthGeometry& geometry) {
  auto bodies = placed_bodies<Dim>(scene.world.shapes, states, fastest_of_pile);
  if (geometry.slope > 0.0)
    std::erase_if(bodies, [&](const auto& body) { return is_spilled<Dim>(body.centre, geometry); });
  for (PlacedBody<Dim>& body : bodies) {
    if (geometry.slope == 0.0) body.centre[Dim - 1] -= scene.world.ground.height;
    body.centre = along_slope<Dim>(body.centre, geometry.slope);
  }
  return bodies;
}

/// Height of the centre of mass [m]; NaN where no body lies still.
template <int Dim>
double centre_of(std::span<const PlacedBody<Dim>> bodies) {
  double mass = 0.0;
  double moment = 0.0;
  for (const PlacedBody<Dim>& body : bodies) {
    mass += body.mass;
    moment += body.mass * body.centre[Dim - 1];
  }
  return moment / mass;
}

template <int Dim>
void add_shape(const Scene<Dim>& scene, const BodyStates<Dim>& last, const TruthGeometry& geometry, Values& values) {
  const auto bodies = pile_of(scene, last, geometry);
  values["bodies"] = static_cast<double>(last.shape.size());
  if (geometry.has_spill()) values["spill"] = spilled(last, geometry);
  if (bodies.empty()) return;
  const std::vector<double> distances = radii<Dim>(bodies, Vec<Dim - 1>::Zero());
  values["centre"] = centre_of<Dim>(bodies);
  values["r50"] = quantile(distances, 0.5);
  values["r95"] = quantile(distances, 0.95);
}

/// Whether obstacles or gravity change.
template <int Dim>
bool has_plan(const Scene<Dim>& scene) {
  return !scene.movers.empty() || !scene.events.empty() || scene.gravity_motion.has_value();
}

template <int Dim>
void add_last_state(const Scene<Dim>& scene, const std::string& backend, const Simulation<Dim>& simulation,
                    Values& values) {
  constexpr double reach = 0.05;  // [m], see touching_pairs()
  BodyStates<Dim> last = simulation.world().states();
  const WorldDescription<Dim> world = world_at<Dim>(scene, simulation.done_events(), simulation.time());
  const auto touches = touching_pairs<Dim>(world, last, reach);
  values["floating"] = static_cast<double>(floating_sleepers<Dim>(last, touches).size());
  if (still_moves(scene, simulation.done_events(), simulation.time())) return;
  for (std::size_t i = 0; i < last.shape.size(); ++i)
    if (last.velocity[i].norm() > fastest_of_pile) last.removed[i] = 1;
  const WakeTest wake = wake_all<Dim>(world, backend, last, {.duration = wake_time(world.gravity)});
  const double extent = typical_body(scene).extent;
  if (wake.bodies > 0) values["drift_mean_D"] = wake.mean / extent;
  if (scene.policy.kind != "adaptive") return;
  if (const auto slept = of_sleepers<Dim>(wake, last); !slept.empty()) values["drift_slept_D"] = mean(slept) / extent;
  const double allowance = probe_allowance(values["mean_awake"] * values["steps"]);
  const auto probe = probe_end_drift<Dim>(simulation, scene, backend, allowance, {});
  if (!probe) return;
  values["estimate_D"] = probe->expected() / extent;
  values["estimate_most_D"] = probe->most / extent;
}

/// Bodies of the fork of which a point moves by more than 0.05 D within half a second with all bodies awake.
template <int Dim>
int moving_bodies(const Scene<Dim>& scene, const std::string& backend, const Fork<Dim>& fork,
                  const std::vector<Arrival<Dim>>& arrivals) {
  constexpr double far = 0.05;  // [D of the body]
  constexpr int frames = 10;    // of 0.05 s
  const Trajectory<Dim> run =
      full_continuation<Dim>(world_maker<Dim>(backend), scene.world, 0.05)(fork, arrivals, frames);
  int moving = 0;
  for (BodyIndex body = 0; body < run.bodies(0); ++body) {
    if (!run.present(0, body)) continue;
    const double extent = scene.world.shapes[static_cast<std::size_t>(run.shape(body))].extent;
    const Pose<Dim> start{run.position(0, body), run.rotation(0, body)};
    bool moves = false;
    for (int frame = 1; frame < run.frames() && run.present(frame, body) && !moves; ++frame) {
      const Pose<Dim> now{run.position(frame, body), run.rotation(frame, body)};
      moves = max_displacement<Dim>(start, now, 0.5 * extent) > far * extent;
    }
    moving += moves;
  }
  return moving;
}

/// When the last body is due [s].
template <int Dim>
double length_of_pour(const Scene<Dim>& scene) {
  double length = 0.0;
  for (const Source<Dim>& source : scene.sources) length = std::max(length, source.due_time(source.count - 1));
  return length;
}

/// How long a run takes if nothing of its pour has to wait [s].
template <int Dim>
double length_of_run(const Scene<Dim>& scene, const TruthRunParams& params) {
  if (params.to_end) return static_cast<double>(scene.steps()) * scene.world.dt;
  return length_of_pour(scene) + calm_time(scene.world.gravity);
}

/// A simulation that counts its time, its awake bodies and what it needs for forks.
template <int Dim>
class TruthStepper {
 public:
  TruthStepper(const Scene<Dim>& scene, const std::string& backend, const TruthRunParams& params)
      : scene_(scene),
        simulation_(scene, make_world<Dim>(backend, scene.world), make_policy(scene)),
        between_(length_of_run(scene, params) / std::max(1, params.moments)),
        moments_(has_plan(scene) ? 0 : params.moments) {}

  const Simulation<Dim>& simulation() const { return simulation_; }

  void step() {
    watch_.lap();
    simulation_.step();
    seconds_ += watch_.lap();
    ++steps_;
    awake_ += static_cast<double>(simulation_.world().awake().size());
    if (moments_ == 0) return;
    count_checked();
    const BodyStates<Dim>& states = simulation_.world().states();
    for (std::size_t i = arrivals_.size(); i < states.shape.size(); ++i)
      arrivals_.push_back({simulation_.time(), {states.shape[i], states.pose[i], states.velocity[i], states.spin[i]}});
    if (static_cast<int>(forks_.size()) == moments_) return;
    if (simulation_.time() < (static_cast<double>(forks_.size()) + 0.5) * between_) return;
    forks_.push_back({simulation_.time(), states});
    awake_at_forks_ += static_cast<double>(simulation_.world().awake().size());
  }

  void add_work(const std::string& backend, Values& values) const {
    values["seconds"] = seconds_;
    values["steps"] = static_cast<double>(steps_);
    values["mean_awake"] = awake_ / static_cast<double>(steps_);
    values["all_asleep"] = simulation_.world().awake().empty() ? 1.0 : 0.0;
    if (forks_.empty()) return;
    values["awake_checked"] = checked_ / static_cast<double>(steps_);
    values["awake_at_end"] = static_cast<double>(simulation_.world().awake().size());
    values["moving_at_end"] =
        moving_bodies<Dim>(scene_, backend, {simulation_.time(), simulation_.world().states()}, arrivals_);
    double moving = 0.0;
    for (const Fork<Dim>& fork : forks_) moving += moving_bodies(scene_, backend, fork, arrivals_);
    values["awake_sampled"] = awake_at_forks_ / static_cast<double>(forks_.size());
    values["moving_sampled"] = moving / static_cast<double>(forks_.size());
  }

 private:
  /// Counts the awake bodies that a check woke.
  void count_checked() {
    woken_by_.resize(simulation_.world().states().asleep.size(), SleepCause::rest);
    const Frame<Dim> frame = simulation_.frame();
    for (const SleepEvent& event : frame.events) woken_by_[event.body] = event.cause;
    for (const BodyIndex body : frame.world.awake()) checked_ += woken_by_[body] == SleepCause::check ? 1.0 : 0.0;
  }

  const Scene<Dim>& scene_;
  Simulation<Dim> simulation_;
  double between_;  // moments [s]
  int moments_;
  ProcessorWatch watch_;
  double seconds_ = 0.0;
  std::int64_t steps_ = 0;
  double awake_ = 0.0;    // body-steps
  double checked_ = 0.0;  // of these, by bodies that a check woke
  std::vector<SleepCause> woken_by_;
  std::vector<Fork<Dim>> forks_;
  std::vector<Arrival<Dim>> arrivals_;
  double awake_at_forks_ = 0.0;
};

}  // namespace

template <int Dim>
TruthRun<Dim> truth_run(const Scene<Dim>& scene, const std::string& backend, const TruthGeometry& geometry,
                        const TruthRunParams& params) {
  TruthStepper<Dim> stepper(scene, backend, params);
  const Simulation<Dim>& simulation = stepper.simulation();
  TruthRun<Dim> run;
  const double latest = params.to_end ? length_of_run(scene, params) : 3.0 * length_of_pour(scene) + 60.0;
  while (!simulation.emitter().finished() && simulation.time() < latest) stepper.step();
  run.values["poured_at"] = simulation.time();
  const auto poured = pile_of(scene, simulation.world().states(), geometry);
  if (!poured.empty() && !scene.sources.empty()) run.values["centre_poured"] = centre_of<Dim>(poured);
  const double calm = params.to_end ? latest - simulation.time() : calm_time(scene.world.gravity);
  const auto steps = std::llround(calm / scene.world.dt);
  for (std::int64_t step = 0; step < steps; ++step) stepper.step();
  stepper.add_work(backend, run.values);
  run.last = simulation.world().states();
  run.piles.assign(simulation.piles().piles().begin(), simulation.piles().piles().end());
  add_shape(scene, run.last, geometry, run.values);
  if (params.last_state) add_last_state(scene, backend, simulation, run.values);
  return run;
}

template TruthRun<2> truth_run(const Scene<2>&, const std::string&, const TruthGeometry&, const TruthRunParams&);
template TruthRun<3> truth_run(const Scene<3>&, const std::string&, const TruthGeometry&, const TruthRunParams&);

}  // namespace talus
