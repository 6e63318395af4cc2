#include <gtest/gtest.h>

#include <cmath>

#include "common/measure/rebuild.h"
#include "common/measure/wake_test.h"
#include "common/shape/catalogue.h"
#include "tests/common/cubes.h"
#include "tests/common/falling_world.h"
#include "tests/common/made_up_run.h"

namespace talus::measure_wake_test {
namespace {

template <int Dim>
WorldDescription<Dim> cube_world() {
  WorldDescription<Dim> description;
  description.gravity = 10.0;
  description.dt = 1.0 / 128;
  description.shapes = {make_shape<Dim>("cube", box_pieces<Dim>(Vec<Dim>::Ones()), Material{})};
  return description;
}

/// One body on the ground, one asleep 0.2 m above it.
template <int Dim>
BodyStates<Dim> one_hangs() {
  Vec<Dim> resting = 0.5 * Vec<Dim>::Unit(Dim - 1);
  Vec<Dim> hanging = 3.0 * Vec<Dim>::Unit(0) + 0.7 * Vec<Dim>::Unit(Dim - 1);
  BodyStates<Dim> states = states_at<Dim>({resting, hanging});
  states.asleep = {1, 1};
  return states;
}

TEST(WakeTest, FindsTheBodyThatHungInTheAir) {
  const WakeTest test = wake_test<3>(make_falling_world<3>, cube_world<3>(), one_hangs<3>());
  EXPECT_EQ(test.bodies, 2);
  EXPECT_NEAR(test.max, 0.2, 1e-12);
  EXPECT_NEAR(test.mean, 0.1, 1e-12);
  EXPECT_NEAR(test.displacements[0], 0.0, 1e-12);
  // The centre of mass sinks from 0.6 to 0.5 m in 5 s.
  EXPECT_NEAR(test.creep, 0.1 / 0.6 * 12.0, 1e-9);
}

TEST(WakeTest, LastsAsLongAsTheSameMotionTakesInOtherGravity) {
  EXPECT_DOUBLE_EQ(wake_time(9.81), 5.0);
  EXPECT_DOUBLE_EQ(wake_time(9.81 / 4.0), 10.0);
}

TEST(WakeTest, EndsWhenToldTo) {
  int calls = 0;
  const WakeTestParams params{.stop = [&] { return ++calls > 2; }};
  const WakeTest test = wake_test<3>(make_falling_world<3>, cube_world<3>(), one_hangs<3>(), params);
  EXPECT_EQ(calls, 3);
  EXPECT_LT(test.max, 0.01) << "two steps of 1/128 s";
}

TEST(WakeTest, WakeEnergyIsThatOfTheFall) {
  const WakeTest test = wake_test<3>(make_falling_world<3>, cube_world<3>(), one_hangs<3>());
  // Energy of the fall by 0.2 m over that of a fall by D = sqrt 3; before the last step it is up to g v dt = 8 % less.
  EXPECT_NEAR(test.energy, 0.2 / std::sqrt(3.0), 0.08 * 0.2);
  EXPECT_NEAR(test.energy_all, test.energy / 2, 1e-12);
}

TEST(WakeTest, CountsTurningAsEnergy) {
  WorldDescription<2> description = cube_world<2>();
  BodyStates<2> states = one_hangs<2>();
  states.asleep = {0, 0};
  states.spin[0][0] = 3.0;
  const double expected = 0.5 * description.shapes[0].inertia(0, 0) * 9.0 / (1000.0 * 10.0 * std::sqrt(2.0));
  WakeTestParams params;
  params.energy_window = 1.0 / 128;  // one step, in which the hanging body falls by g dt^2 only
  EXPECT_NEAR(wake_test<2>(make_falling_world<2>, description, states, params).energy, expected, 1e-9);
}

TEST(WakeTest, IgnoresRemovedBodies) {
  BodyStates<2> states = one_hangs<2>();
  states.removed[1] = 1;
  const WakeTest test = wake_test<2>(make_falling_world<2>, cube_world<2>(), states);
  EXPECT_EQ(test.bodies, 1);
  EXPECT_NEAR(test.max, 0.0, 1e-12);
}

TEST(WakeTest, RefusesSettingsThatMeanNothing) {
  WakeTestParams params;
  params.duration = 0.0;
  EXPECT_THROW(wake_test<2>(make_falling_world<2>, cube_world<2>(), one_hangs<2>(), params), std::invalid_argument);
}

TEST(Rebuild, KeepsIndicesSleepersAndRemovals) {
  BodyStates<2> states = states_at<2>({{0, 2}, {1, 2}, {2, 2}});
  states.asleep = {0, 1, 0};
  states.removed = {1, 0, 0};
  const auto frozen = rebuild<2>(make_falling_world<2>, cube_world<2>(), states, Sleepers::frozen);
  EXPECT_EQ(frozen->states().asleep, states.asleep);
  EXPECT_EQ(frozen->states().removed, states.removed);
  EXPECT_EQ(frozen->states().pose[2].position, Vec2(2, 2));
  EXPECT_EQ(rebuild<2>(make_falling_world<2>, cube_world<2>(), states, Sleepers::awake)->awake().size(), 2U);
}

TEST(Rebuild, SlowsABodyThatIsFasterThanAWorldTakes) {
  StillWorld<3> world = cubes_at({Vec3::Zero()});
  world.push(0, Vec3(1e6, 0.0, 0.0), Spin<3>(0.0, 1e6, 0.0));
  const auto make = [](const WorldDescription<3>& description) { return std::make_unique<StillWorld<3>>(description); };
  const auto copy = rebuild<3>(make, cubes(), world.states(), Sleepers::awake);
  EXPECT_NEAR(copy->states().velocity[0].x(), fastest_speed<3>(cubes().dt), 1e-6);
  EXPECT_NEAR(copy->states().spin[0].y(), fastest_spin(cubes().dt), 1e-6);
}

TEST(ReferenceSettings, AreNeverCoarserThanTheRunsOwn) {
  WorldDescription<2> fine = cube_world<2>();
  fine.dt = 1.0 / 240;
  fine.engine_sleep = true;
  fine.solver.velocity_iterations = 80;
  fine.solver.friction_directions = 1;
  const WorldDescription<2> reference = reference_settings(fine);
  EXPECT_EQ(reference.dt, 1.0 / 240);
  EXPECT_FALSE(reference.engine_sleep);
  EXPECT_EQ(reference.solver.velocity_iterations, 80);
  EXPECT_EQ(reference.solver.friction_directions, 2);
}

}  // namespace
}  // namespace talus::measure_wake_test
