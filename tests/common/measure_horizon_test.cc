#include <gtest/gtest.h>

#include "common/measure/short_horizon.h"
#include "common/shape/catalogue.h"
#include "tests/common/falling_world.h"
#include "tests/common/made_up_run.h"

namespace talus::measure_horizon_test {
namespace {

const std::vector<double> two_metres = {2.0};

WorldDescription<2> falling() {
  WorldDescription<2> description;
  description.gravity = 8.0;
  description.dt = 1.0 / 64;
  description.shapes = {make_shape<2>("disc", ball_pieces<2>(0.25), Material{})};
  return description;
}

struct Recorded {
  Trajectory<2> run{1.0 / 64, 2};
  std::vector<Fork<2>> forks;
  std::vector<Arrival<2>> arrivals;
};

/// Two frames of steps of a pour by hand: a disc every 16 steps from 40 m, recorded every 2 steps, forked every 20
/// frames.
Recorded record(int steps) {
  Recorded recorded;
  FallingWorld<2> world(falling());
  PileSet<2> piles(std::vector<PileParams<2>>{}, TypicalBody{});
  TrajectoryRecorder<2> recorder(falling().dt, 2);
  ForkRecorder<2> forks(2, 20);
  for (int step = 1; step <= steps; ++step) {
    if (step % 16 == 1) world.add({0, {Vec2(0.0, 40.0)}, Vec2(0.0, -4.0), Spin<2>::Zero()});
    world.step();
    const Frame<2> frame{step, step * falling().dt, world, piles, {}, {}};
    recorder.on_frame(frame);
    forks.on_frame(frame);
  }
  recorded.run = recorder.trajectory();
  recorded.forks.assign(forks.forks().begin(), forks.forks().end());
  recorded.arrivals.assign(forks.arrivals().begin(), forks.arrivals().end());
  return recorded;
}

TEST(HorizonErrors, AreZeroWhereTheRunIsTheFullSimulationArrivalsIncluded) {
  const Recorded recorded = record(160);
  ASSERT_EQ(recorded.forks.size(), 4U);
  EXPECT_EQ(recorded.arrivals.size(), 10U);
  const auto full = full_continuation<2>(make_falling_world<2>, falling(), 2.0 / 64);
  const auto errors =
      horizon_errors<2>(recorded.forks, recorded.arrivals, full, recorded_continuation(recorded.run), two_metres, 8.0);
  ASSERT_EQ(errors.size(), 3U);
  // Forks at steps 40, 80, 120, 160: frames left 60, 40, 20, 0.
  EXPECT_EQ(errors[0].forks, 3);
  EXPECT_EQ(errors[1].forks, 3);
  EXPECT_EQ(errors[2].forks, 2);
  for (const HorizonError& error : errors) {
    EXPECT_EQ(error.max, 0.0) << error.frames;
    EXPECT_EQ(error.ratio, 0.0) << error.frames;
  }
}

TEST(HorizonErrors, SeeABodyThatWasFrozenInFlight) {
  const Recorded recorded = record(160);
  const auto full = full_continuation<2>(make_falling_world<2>, falling(), 2.0 / 64);
  const Continuation<2> frozen = [](const Fork<2>& fork, std::span<const Arrival<2>>, int frames) {
    Trajectory<2> run(1.0 / 64, 2);
    const auto step = std::llround(fork.time * 64);
    for (int frame = 0; frame <= frames; ++frame) run.append(fork.states, step + 2 * frame);
    return run;
  };
  // The first fork alone: all three bodies in flight, none lands within 10 frames.
  const auto forks = std::span(recorded.forks).first(1);
  const auto errors = horizon_errors<2>(forks, recorded.arrivals, full, frozen, two_metres, 8.0, {10});
  // m against 0: R = sum m / (sum m + N m0) is below 1; S the same, since sum m~ is 0.
  EXPECT_GT(errors[0].ratio, 0.9);
  EXPECT_NEAR(errors[0].ratio, errors[0].symmetric, 1e-12);
  // The first body falls fastest: v = 4 + 8 t at t = 40 / 64, then 20 steps on by semi-implicit Euler, over D = 2.
  const double t = 20.0 / 64;
  EXPECT_NEAR(errors[0].max, ((4.0 + 8.0 * 40 / 64) * t + 4.0 * t * (t + 1.0 / 64)) / 2.0, 1e-6);
}

TEST(HorizonErrors, OfANudgeThatDoesNotGrowStaysTheNudge) {
  const Recorded recorded = record(160);
  const auto full = full_continuation<2>(make_falling_world<2>, falling(), 2.0 / 64);
  const auto nudged = full_continuation<2>(make_falling_world<2>, falling(), 2.0 / 64, 0.5);
  const auto errors = horizon_errors<2>(recorded.forks, recorded.arrivals, full, nudged, two_metres, 8.0, {10});
  EXPECT_DOUBLE_EQ(errors[0].max, 0.25);
}

TEST(HorizonErrors, CompareRunsOfDifferentTimeSteps) {
  const Recorded recorded = record(160);
  WorldDescription<2> fine = falling();
  fine.dt = 1.0 / 256;
  const auto full = full_continuation<2>(make_falling_world<2>, fine, 2.0 / 64);
  const auto errors = horizon_errors<2>(recorded.forks, recorded.arrivals, full, recorded_continuation(recorded.run),
                                        two_metres, 8.0, {10});
  // Semi-implicit Euler falls g t dt / 2 too far: 8 x 20/64 / 2 x (1/64 - 1/256) = 0.0146 m, over D = 2 m.
  EXPECT_NEAR(errors[0].max, 0.01465 / 2, 2e-5);
}

TEST(FullContinuation, RefusesStepsThatDoNotFitTheFrame) {
  EXPECT_THROW(full_continuation<2>(make_falling_world<2>, falling(), 0.025), std::invalid_argument);
}

TEST(RecordedContinuation, RefusesForksBetweenFrames) {
  Recorded recorded = record(40);
  recorded.forks[0].time += 1.0 / 64;
  EXPECT_THROW(recorded_continuation(recorded.run)(recorded.forks[0], {}, 5), std::invalid_argument);
}

}  // namespace
}  // namespace talus::measure_horizon_test
