#pragma once
// A simulation without physics: bodies stay where they are put, and a policy lets all of them sleep and wake in turn.

#include <memory>
#include <optional>

#include "common/shape/catalogue.h"
#include "common/simulation/simulation.h"
#include "tests/common/still_world.h"

namespace talus {

/// Steps 4, 12, 20...: all fall asleep; steps 8, 16, 24...: all wake.
template <int Dim>
class InTurnPolicy final : public SleepPolicy<Dim> {
 public:
  std::optional<DriftEstimate> drift_estimate(const World<Dim>& /*world*/) const override {
    return DriftEstimate{.drift = 0.0, .checked_share = 1.0};  // no body moves
  }
  void decide(const Frame<Dim>& frame, Decision<Dim>& decision) override {
    if (frame.step % 4 != 0) return;
    const bool wake = frame.step % 8 == 0;
    const BodyStates<Dim>& states = frame.world.states();
    for (BodyIndex body = 0; body < states.size(); ++body) {
      if (states.removed[body] != 0 || (states.asleep[body] != 0) != wake) continue;
      const auto cause = wake ? SleepCause::avalanche : SleepCause::score;
      (wake ? decision.thaw : decision.freeze).push_back({.body = body, .pile = 0, .cause = cause, .score = 0.625});
    }
  }
};

template <int Dim>
Scene<Dim> still_scene() {
  Scene<Dim> scene;
  scene.title = "bodies that stand still";
  scene.world.shapes = {make_shape<Dim>("l", l_pieces<Dim>({}), {}),
                        make_shape<Dim>("ball", ball_pieces<Dim>(0.5), {})};
  scene.world.obstacles = {
      {make_shape<Dim>("wall", box_pieces<Dim>(Vec<Dim>::Constant(2.0)), {}), {.position = Vec<Dim>::Constant(7.0)}}};
  scene.sources.resize(1);
  scene.sources[0].shapes = {0, 1};
  scene.sources[0].start = 1e6;
  scene.piles.emplace_back().at = Vec<Dim>::Zero();
  scene.run.frames = 60;
  return scene;
}

template <int Dim>
std::unique_ptr<Simulation<Dim>> still_run(const Scene<Dim>& scene, int bodies) {
  auto run = std::make_unique<Simulation<Dim>>(scene, std::make_unique<StillWorld<Dim>>(scene.world),
                                               std::make_unique<InTurnPolicy<Dim>>());
  for (int body = 0; body < bodies; ++body) {
    Vec<Dim> position = Vec<Dim>::Zero();
    position[0] = 0.25 * (body % 9) - 1.0;
    position[Dim - 1] = 0.001 * body;
    run->add({.shape = body % 2, .pose = {.position = position}});
  }
  return run;
}

}  // namespace talus
