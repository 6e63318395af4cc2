// Bad input is refused on every engine, before the engine gets it, and does no harm.

#include <limits>

#include "tests/backends/backend.h"

namespace talus::input_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

template <typename Backend>
class BadInput : public BackendTest<Backend> {};
TYPED_TEST_SUITE(BadInput, BackendsAndToy, BackendName);

TYPED_TEST(BadInput, InABodyIsRefusedAndTheWorldGoesOn) {
  constexpr int dim = TypeParam::dim;
  auto world = TypeParam::make(this->description());
  const BodyIndex good = world->add(this->at(up<dim>(5.0)));
  for (const double bad : {nan, infinite, -infinite}) {
    EXPECT_THROW(world->add(this->at(up<dim>(bad))), std::invalid_argument);
    EXPECT_THROW(world->add(this->at(up<dim>(5.0), 0, up<dim>(bad))), std::invalid_argument);
    auto spinning = this->at(up<dim>(5.0));
    spinning.spin[0] = bad;
    EXPECT_THROW(world->add(spinning), std::invalid_argument);
    EXPECT_THROW(world->set_velocity(good, up<dim>(bad), Spin<dim>::Zero()), std::invalid_argument);
  }
  EXPECT_THROW(world->add(this->at(up<dim>(5.0), 17)), std::invalid_argument) << "no such shape";
  EXPECT_THROW(world->add(this->at(up<dim>(5.0), -1)), std::invalid_argument);
  EXPECT_EQ(world->states().size(), 1);
  this->run(*world, 2.0);
  EXPECT_NEAR(this->height_of(*world, good), 0.5, 0.02);
}

TYPED_TEST(BadInput, InAWorldIsRefused) {
  const auto refused = [&](auto change) {
    auto description = this->description();
    change(description);
    EXPECT_THROW(TypeParam::make(description), std::invalid_argument);
  };
  for (const double bad : {nan, infinite, 0.0, -1.0 / 60.0, 0.1}) refused([&](auto& world) { world.dt = bad; });
  for (const double bad : {nan, infinite, -1.0}) refused([&](auto& world) { world.gravity = bad; });
  for (const int bad : {0, -3, 100000}) refused([&](auto& world) { world.solver.velocity_iterations = bad; });
  for (const double bad : {nan, -0.5}) refused([&](auto& world) { world.ground.material.friction = bad; });
  for (const double bad : {nan, -0.5, 1.5}) refused([&](auto& world) { world.ground.material.restitution = bad; });
}

TYPED_TEST(BadInput, IsASpeedBeyondTheEnginesReachAndNoneWithinIt) {
  constexpr int dim = TypeParam::dim;
  auto world = TypeParam::make(this->description());
  const Vec<dim> beyond = 1.01 * fastest_speed<dim>(world->dt()) * Vec<dim>::Unit(0);
  EXPECT_THROW(world->add(this->at(up<dim>(50.0), 1, beyond)), std::invalid_argument);
  // 100 m/s is within what every engine can do at 60 steps a second: 1.7 m a step.
  const BodyIndex fast = world->add(this->at(up<dim>(50.0), 1, 100.0 * Vec<dim>::Unit(0)));
  EXPECT_THROW(world->set_velocity(fast, beyond, Spin<dim>::Zero()), std::invalid_argument);
  this->run(*world, 0.5);
  EXPECT_NEAR(this->pose(*world, fast).position[0], 50.0, 0.1);
}

TYPED_TEST(BadInput, IsNoVelocityOfABodyFarAway) {
  constexpr int dim = TypeParam::dim;
  auto world = TypeParam::make(this->description());
  const BodyIndex body = world->add(this->at(up<dim>(5.0) + 1e4 * Vec<dim>::Unit(0), 1, 50.0 * Vec<dim>::Unit(0)));
  this->run(*world, 0.5);
  EXPECT_GT(this->pose(*world, body).position[0], 1e4);
  EXPECT_NO_THROW(world->set_velocity(body, Vec<dim>::Zero(), Spin<dim>::Zero()));
}

}  // namespace
}  // namespace talus::input_test
