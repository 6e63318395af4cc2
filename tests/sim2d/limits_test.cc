// What would make Box2D abort the process or go astray in silence.

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "common/world/world.h"
#include "sim2d/engine_world.h"
#include "tests/sim2d/heap.h"

namespace talus::limits_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Box2DWorld, RefusesWhatSinglePrecisionOrTheTwoMetresAStepCannotDo) {
  WorldDescription<2> description = l_world();
  description.dt = 1e-9;
  EXPECT_THROW(make_box2d_world(description), std::invalid_argument);
  description = l_world();
  description.gravity = 1e6;
  EXPECT_THROW(make_box2d_world(description), std::invalid_argument);
  description = l_world();
  description.shapes[0] = make_shape<2>("feather", l_pieces<2>({}), Material{.density = 1e-30});
  EXPECT_THROW(make_box2d_world(description), std::invalid_argument);
}

TEST(Box2DWorld, RefusesASpinThatIsNoneAndMoreThanTwoMetresAStep) {
  const auto world = make_box2d_world(l_world());
  world->add({0, {{0.0, 5.0}, Rotation<2>(0.0)}, Vec2::Zero(), Spin<2>::Zero()});
  EXPECT_THROW(world->set_velocity(0, {0.0, 0.0}, Spin<2>(nan)), std::invalid_argument);
  EXPECT_THROW(world->set_velocity(0, {0.0, -121.0}, Spin<2>::Zero()), std::invalid_argument);  // 2 m a step: 120 m/s
}

TEST(Box2DWorld, TakesEveryShapeThatAWorldAllows) {
  const auto polygon = [](const std::vector<Vec2>& corners) { return hull_pieces<2>(corners); };
  std::vector<Vec2> octagon;
  for (int i = 0; i < 8; ++i) {
    const double angle = i * std::numbers::pi / 4.0;
    octagon.emplace_back(0.004 * std::cos(angle), 0.004 * std::sin(angle));
  }
  WorldDescription<2> description;
  for (const auto& pieces : {polygon(octagon),  // corners 3 mm apart: b2PolygonShape::Set() would weld or abort
                             polygon({{0.0, 0.0}, {1.0, 0.0}, {0.5, 0.006}}), ball_pieces<2>(0.0025),
                             capsule_pieces<2>(0.1, 0.0025), box_pieces<2>({0.005, 0.005})}) {
    // Densities that bring all masses within the permitted ratio of 100.
    Shape<2> shape = make_shape<2>("small", pieces, Material{});
    description.shapes.push_back(make_shape<2>("small", pieces, Material{.density = 1e-3 / shape.volume}));
  }
  const auto world = make_box2d_world(description);
  for (int shape = 0; shape < 5; ++shape)
    world->add({shape, {{2.0 * shape, 0.3}, Rotation<2>(1e9 + shape)}, Vec2::Zero(), Spin<2>::Zero()});
  EXPECT_NO_THROW(run(*world, 300));
  for (const Pose<2>& pose : world->states().pose) {
    EXPECT_GT(pose.position.y(), 0.0);
    EXPECT_LT(pose.position.y(), 0.1);
  }
}

TEST(Capsule, LiesOnItsStraightSideAsHighAsOnItsRoundEnds) {
  WorldDescription<2> description;
  description.shapes = {make_shape<2>("capsule", capsule_pieces<2>(1.0, 0.2), Material{}),
                        make_shape<2>("ball", ball_pieces<2>(0.2), Material{})};
  const auto world = make_box2d_world(description);
  world->add({0, {{0.0, 0.25}, Rotation<2>(0.0)}, Vec2::Zero(), Spin<2>::Zero()});
  world->add({1, {{3.0, 0.25}, Rotation<2>(0.0)}, Vec2::Zero(), Spin<2>::Zero()});
  run(*world, 300);
  const double ball = world->states().pose[1].position.y();
  EXPECT_NEAR(ball, 0.2, 1e-3);
  EXPECT_NEAR(world->states().pose[0].position.y(), ball, 1e-3);
}

TEST(Ground, HoldsFarFromTheOrigin) {
  const auto world = make_box2d_world(l_world());
  for (const double x : {-1e4, -5e3, 0.0, 5e3, 1e4})
    world->add({0, {{x, 20.0}, Rotation<2>(0.3)}, {0.0, -100.0}, Spin<2>::Zero()});
  run(*world, 300);
  for (const Pose<2>& pose : world->states().pose) {
    EXPECT_GT(pose.position.y(), 0.2);
    EXPECT_LT(pose.position.y(), 1.0);
  }
}

// Nothing that comes through the interface is known to do it, so the engine is made to err by hand.
TEST(NonFiniteState, IsReportedAndTheStatesBeforeItAreKept) {
  const auto world = make_box2d_world(l_world());
  add_stack(*world, 3, 3);
  run(*world, 5);
  const BodyStates<2> before = world->states();
  auto& engine = const_cast<b2World&>(dynamic_cast<const box2d::EngineWorld&>(*world).engine());
  engine.GetBodyList()->SetLinearVelocity({static_cast<float>(nan), 0.0F});  // the body added last
  try {
    world->step();
    FAIL() << "step() returned";
  } catch (const NonFiniteState& error) {
    EXPECT_EQ(error.step, 6);
    EXPECT_EQ(error.body, 2);
  }
  EXPECT_THROW(world->step(), NonFiniteState);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(world->states().pose[i].position, before.pose[i].position);
    EXPECT_EQ(world->states().velocity[i], before.velocity[i]);
  }
}

}  // namespace
}  // namespace talus::limits_test
