// What the policy `adaptive` promises, on every engine: sleep that is earned, and waking that is enough.

#include <algorithm>

#include "common/measure/support.h"
#include "common/measure/wake_test.h"
#include "common/simulation/simulation.h"
#include "tests/backends/backend.h"

namespace talus::adaptive_test {
namespace {

template <typename Backend>
class AdaptiveTest : public BackendTest<Backend> {
 protected:
  static constexpr int dimension = Backend::dim;

  static Scene<dimension> scene(const Material& material = {.friction = 0.5}) {
    Scene<dimension> scene;
    scene.world = BackendTest<Backend>::description(material);
    scene.policy.kind = "adaptive";
    scene.policy.adaptive.tolerance = 0.0;  // no stability check where not said
    return scene;
  }
  static Simulation<dimension> simulate(const Scene<dimension>& scene) { return simulation_on<Backend>(scene); }
  static int steps(Simulation<dimension>& simulation, int count) {
    int woken = 0;
    for (int i = 0; i < count; ++i) {
      simulation.step();
      for (const SleepEvent& event : simulation.frame().events) woken += event.woke ? 1 : 0;
    }
    return woken;
  }
  /// Three cubes on top of each other, long at rest.
  static Simulation<dimension> stack() {
    Simulation<dimension> simulation = simulate(scene());
    for (const double level : {0.5, 1.5, 2.5}) simulation.add(BackendTest<Backend>::at(up<dimension>(level)));
    steps(simulation, 120);
    return simulation;
  }
  /// L's poured onto one spot, six a second.
  static Scene<dimension> pour(int count) {
    Scene<dimension> poured = scene();
    Source<dimension> source;
    source.shapes = {2};
    source.count = count;
    source.rate = 6.0;
    source.position = up<dimension>(6.0);
    source.velocity = -up<dimension>(10.0);
    source.ride_above = 4.0;
    poured.sources = {source};
    poured.piles.resize(1);
    return poured;
  }
};
TYPED_TEST_SUITE(AdaptiveTest, Backends, BackendName);

TYPED_TEST(AdaptiveTest, AStackAtRestFallsAsleepAndNothingWakesIt) {
  Simulation<TypeParam::dim> simulation = this->stack();
  EXPECT_TRUE(simulation.world().awake().empty());
  EXPECT_EQ(this->steps(simulation, 300), 0);
}

TYPED_TEST(AdaptiveTest, ALoadLaidDownGentlyWakesNoBody) {
  Simulation<TypeParam::dim> simulation = this->stack();
  const double top = this->height_of(simulation.world(), 2) + 1.02;  // clear of the skins
  simulation.add(this->at(up<TypeParam::dim>(top)));
  EXPECT_EQ(this->steps(simulation, 120), 0);
  EXPECT_TRUE(simulation.world().awake().empty());
}

TYPED_TEST(AdaptiveTest, ASleeperThatIsHitTakesItsShareOfTheMomentum) {
  constexpr int dim = TypeParam::dim;
  Simulation<dim> simulation = this->simulate(this->scene({.friction = 0.0}));
  simulation.add(this->at(up<dim>(0.5)));
  this->steps(simulation, 60);
  ASSERT_TRUE(this->asleep(simulation.world(), 0));
  const Vec<dim> start = this->pose(simulation.world(), 0).position - 1.6 * Vec<dim>::Unit(0);
  simulation.add(this->at(start, 0, 4.0 * Vec<dim>::Unit(0)));
  EXPECT_GT(this->steps(simulation, 20), 0);
  // Without friction two equal cubes that do not bounce go on at half the speed. The engines push overlapping bodies
  // apart, which the two share evenly.
  const auto& velocity = simulation.world().states().velocity;
  EXPECT_NEAR(velocity[0][0] + velocity[1][0], 4.0, 0.05);
  EXPECT_NEAR(velocity[0][0], 2.0, 0.3);
}

TYPED_TEST(AdaptiveTest, AHeavyFastBodyDrivesARowOfSleepersBeforeIt) {
  constexpr int dim = TypeParam::dim;
  Scene<dim> row = this->scene();
  row.world.solver.velocity_iterations = 50;  // for so unequal masses
  const double volume = make_shape<dim>("ball", ball_pieces<dim>(1.0), {}).volume;
  row.world.shapes.push_back(make_shape<dim>("heavy", ball_pieces<dim>(1.0), {.density = 20000.0 / volume}));
  Simulation<dim> simulation = this->simulate(row);
  for (int i = 0; i < 5; ++i) simulation.add(this->at(up<dim>(0.5) + 1.02 * i * Vec<dim>::Unit(0)));
  this->steps(simulation, 60);
  ASSERT_TRUE(simulation.world().awake().empty());
  simulation.add(this->at(up<dim>(1.1) - 4.0 * Vec<dim>::Unit(0), 3, 30.0 * Vec<dim>::Unit(0)));
  this->steps(simulation, 30);
  // Twenty times a cube's mass, it keeps 20 / 25 of its speed when it drives all five before it without bouncing.
  EXPECT_GT(simulation.world().states().velocity[5][0], 20.0);
  EXPECT_GT(this->pose(simulation.world(), 4).position[0], 4.08 + 3.0);
}

/// In a row that falls each domino is pushed on by those that lean on it; a sleeping one that it hit would stop them
/// all.
TYPED_TEST(AdaptiveTest, SleepingDominoesFallAsFlatAsAwakeOnes) {
  constexpr int dim = TypeParam::dim;
  const auto mean_height = [&](const std::string& policy) {
    Scene<dim> row = this->scene();
    row.policy.kind = policy;
    Vec<dim> size = Vec<dim>::Ones();
    size[0] = 0.3;
    size[dim - 1] = 2.0;
    row.world.shapes.push_back(make_shape<dim>("domino", box_pieces<dim>(size), {.friction = 0.5}));
    Simulation<dim> simulation = this->simulate(row);
    for (int i = 0; i < 20; ++i) simulation.add(this->at(up<dim>(1.0) + i * Vec<dim>::Unit(0), 3));
    this->steps(simulation, 60);
    simulation.add(this->at(up<dim>(1.01) - 1.0 * Vec<dim>::Unit(0), 3, 3.0 * Vec<dim>::Unit(0)));
    this->steps(simulation, 600);
    double sum = 0.0;
    for (BodyIndex body = 0; body < 20; ++body) sum += this->height_of(simulation.world(), body);
    return sum / 20.0;
  };
  // 5 % apart where impacts wake one domino after the other. The last few, which have nothing to lean on, end by
  // chance.
  EXPECT_NEAR(mean_height("adaptive") / mean_height("full"), 1.0, 0.03);
}

TYPED_TEST(AdaptiveTest, WhatLiesOnABodyThatIsKnockedAwayComesDown) {
  constexpr int dim = TypeParam::dim;
  Simulation<dim> simulation = this->stack();
  const double top = this->height_of(simulation.world(), 2);
  simulation.add(this->at(up<dim>(0.6) - 4.0 * Vec<dim>::Unit(0), 0, 25.0 * Vec<dim>::Unit(0)));
  EXPECT_GT(this->steps(simulation, 300), 0);
  EXPECT_LT(this->height_of(simulation.world(), 2), top - 0.5);
}

TYPED_TEST(AdaptiveTest, ABodyTakenAwayByHandLetsTheUpperOnesFall) {
  Simulation<TypeParam::dim> simulation = this->stack();
  const double top = this->height_of(simulation.world(), 2);
  simulation.remove(0);
  this->steps(simulation, 180);
  EXPECT_NEAR(this->height_of(simulation.world(), 2), top - 1.0, 0.05);
}

/// A rule that lets it sleep too soon would find it where it was, and put it to sleep again and again.
TYPED_TEST(AdaptiveTest, ABodyOnASteepSlopeSlidesOnceWhatHeldItIsTakenAway) {
  constexpr int dim = TypeParam::dim;
  const Material material{.friction = 0.2};
  Scene<dim> slope = this->scene(material);
  slope.world.ground.present = false;
  const Rotation<dim> tilt = tilted<dim>(in_radians(35.0));  // atan(0.2) is 11 degrees
  const Vec<dim> plank = Vec<dim>::Constant(40.0);
  slope.world.obstacles.push_back({make_shape<dim>("plank", box_pieces<dim>(plank), material),
                                   {.position = tilt * up<dim>(-20.0), .rotation = tilt}});
  const Vec<dim> step = tilt * (up<dim>(0.5) - 1.01 * Vec<dim>::Unit(0));
  slope.world.obstacles.push_back(
      {make_shape<dim>("step", box_pieces<dim>(Vec<dim>::Ones()), material), {.position = step, .rotation = tilt}});
  Simulation<dim> simulation = this->simulate(slope);
  for (const double uphill : {0.0, 1.01}) {
    const Vec<dim> place = tilt * (up<dim>(0.51) + uphill * Vec<dim>::Unit(0));
    simulation.add({.shape = 0, .pose = {.position = place, .rotation = tilt}});
  }
  this->steps(simulation, 60);
  ASSERT_TRUE(simulation.world().awake().empty());
  const Vec<dim> held = this->pose(simulation.world(), 1).position;
  simulation.remove(0);
  this->steps(simulation, 30);
  // It slides 1.01 m to the step with 9.81 (sin 35 - 0.2 cos 35) = 4 m/s^2, which takes 0.7 s; after half a second it
  // has gone half a metre.
  EXPECT_NEAR((this->pose(simulation.world(), 1).position - held).norm(), 0.5, 0.1);
}

TYPED_TEST(AdaptiveTest, APouredPileIsAllAsleepSoonAfterTheLastBodyStopsAndNoBodyHangs) {
  constexpr int dim = TypeParam::dim;
  const Scene<dim> poured = this->pour(40);
  Simulation<dim> simulation = this->simulate(poured);
  int last_moving = 0;
  int last_awake = 0;
  for (int step = 1; step <= 1200; ++step) {
    simulation.step();
    const auto awake = simulation.world().awake();
    const double extent = poured.world.shapes[2].extent;
    const bool moving = std::any_of(awake.begin(), awake.end(), [&](BodyIndex body) {
      return this->speed(simulation.world(), body) > 0.1 * extent;  // a tenth of an extent in a second
    });
    if (moving) last_moving = step;
    if (!awake.empty()) last_awake = step;
  }
  EXPECT_TRUE(simulation.world().awake().empty());
  EXPECT_LT(last_awake - last_moving, 90);  // a second and a half
  const auto touches = touching_pairs(poured.world, simulation.world().states(), 0.05);
  EXPECT_TRUE(floating_sleepers(simulation.world().states(), touches).empty());
  EXPECT_LT(penetration(touches).p99, 0.02 * poured.world.shapes[2].extent);
}

TYPED_TEST(AdaptiveTest, SimulatesAFractionOfTheBodySteps) {
  Simulation<TypeParam::dim> simulation = this->simulate(this->pour(60));
  double awake = 0.0;
  double all = 0.0;
  for (int step = 1; step <= 780; ++step) {
    simulation.step();
    awake += static_cast<double>(simulation.world().awake().size());
    all += static_cast<double>(simulation.world().states().size());
  }
  // A third of the time the bodies of so small a pile are in flight or rolling; full would be 1.
  EXPECT_LT(awake, 0.75 * all);
}

/// Without checks these heaps move by 0.62 extents on Box2D and by 0.14 on planar Bullet when they wake. The tolerance
/// holds in the mean over heaps: a slope may fail late.
TYPED_TEST(AdaptiveTest, WithAToleranceAHeapOfLittleFrictionStaysWhereItIsWhenAllOfItWakes) {
  constexpr int dim = TypeParam::dim;
  Scene<dim> poured = this->pour(60);
  for (Shape<dim>& shape : poured.world.shapes) shape.material.friction = 0.15;
  poured.policy.adaptive.tolerance = 0.05;
  constexpr int heaps = 4;
  double drift = 0.0;
  for (int heap = 1; heap <= heaps; ++heap) {
    poured.seed = static_cast<std::uint64_t>(heap);
    Simulation<dim> simulation = this->simulate(poured);
    bool checked = false;
    for (int step = 0; step < 1800; ++step) {
      simulation.step();
      const auto events = simulation.frame().events;
      checked = checked || std::ranges::any_of(events, [](const auto& e) { return e.cause == SleepCause::check; });
    }
    EXPECT_TRUE(checked);
    EXPECT_TRUE(simulation.world().awake().empty());
    drift += wake_test<dim>(TypeParam::make, poured.world, simulation.world().states()).mean / heaps;
  }
  EXPECT_LT(drift, 0.05 * poured.world.shapes[2].extent);
}

TYPED_TEST(AdaptiveTest, EachDecisionHasItsCause) {
  Scene<TypeParam::dim> poured = this->pour(30);
  poured.policy.adaptive.tolerance = 0.05;
  Simulation<TypeParam::dim> simulation = this->simulate(poured);
  int slept = 0;
  for (int step = 1; step <= 600; ++step) {
    simulation.step();
    for (const SleepEvent& event : simulation.frame().events) {
      if (event.woke) {
        ASSERT_TRUE(event.cause == SleepCause::momentum || event.cause == SleepCause::lost_support ||
                    event.cause == SleepCause::avalanche || event.cause == SleepCause::check);
      } else {
        ASSERT_EQ(event.cause, SleepCause::rest);
        ++slept;
      }
    }
  }
  EXPECT_GT(slept, 0);
}

}  // namespace
}  // namespace talus::adaptive_test
