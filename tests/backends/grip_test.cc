// What the grip of bodies holds, against closed forms, on every engine.

#include <cmath>

#include "common/measure/wake_test.h"
#include "common/world/scaled_world.h"
#include "tests/backends/backend.h"

namespace talus::grip_test {
namespace {

/// Unit cubes and balls in a gravity of 10 m/s^2; obstacle 0 is a plate whose lower side is at 5 m.
template <typename Backend>
class Grip : public BackendTest<Backend> {
 protected:
  static constexpr int dimension = Backend::dim;
  using V = Vec<dimension>;

  static WorldDescription<dimension> with_plate() {
    WorldDescription<dimension> world = BackendTest<Backend>::description();
    V size = V::Constant(4.0);
    size[dimension - 1] = 0.5;
    world.obstacles.push_back({make_shape<dimension>("plate", box_pieces<dimension>(size), world.ground.material),
                               {.position = up<dimension>(5.25)}});
    return world;
  }
  /// A cube below the plate, which it overlaps by 1 mm: Bullet knows no contact of boxes that are apart.
  static BodyDef<dimension> hanging() { return BackendTest<Backend>::at(up<dimension>(4.501)); }

  /// In gravity tilted against the ground by so many degrees.
  static std::unique_ptr<World<dimension>> on_slope(double degrees, int shape, double grip) {
    WorldDescription<dimension> description = BackendTest<Backend>::description();
    const double angle = in_radians(degrees);
    description.set_gravity(10.0 * (std::sin(angle) * V::Unit(0) - std::cos(angle) * V::Unit(dimension - 1)));
    auto world = Backend::make(description);
    world->add(BackendTest<Backend>::at(up<dimension>(0.5), shape));
    if (grip > 0.0) world->set_grip(0, grip);
    return world;
  }
};
TYPED_TEST_SUITE(Grip, SmallStepsBackends, BackendName);

// A grip attracts with eight times the weight of the lighter body.
TYPED_TEST(Grip, HoldsABodyBelowAPlateFromAnEighthOn) {
  for (const double grip : {0.11, 0.14}) {
    const auto world = TypeParam::make(this->with_plate());
    world->add(this->hanging());
    world->set_grip(0, grip);
    this->run(*world, 2.0);
    if (grip > 0.125)
      EXPECT_NEAR(this->height_of(*world, 0), 4.5, 0.01) << grip;
    else
      EXPECT_LT(this->height_of(*world, 0), 4.0) << grip;
  }
}

// The body lies across the side: its centre is on it.
TYPED_TEST(Grip, HoldsABodyAtASideOfAPeriodicWorld) {
  WorldDescription<TypeParam::dim> description = this->with_plate();
  description.periodic_x = Vec<2>(-5.0, 5.0);
  description.obstacles[0].pose.position[0] = 5.0;
  const auto world = TypeParam::make(description);
  world->add(this->at(up<TypeParam::dim>(4.501) + 5.0 * Vec<TypeParam::dim>::Unit(0)));
  world->set_grip(0, 0.2);
  this->run(*world, 2.0);
  EXPECT_NEAR(this->height_of(*world, 0), 4.5, 0.01);
}

// In units of the engine, which are not metres.
TYPED_TEST(Grip, HoldsAPebble) {
  constexpr int dim = TypeParam::dim;
  constexpr double size = 0.02;
  WorldDescription<dim> description = this->description();
  Vec<dim> plate = Vec<dim>::Constant(4.0 * size);
  plate[dim - 1] = size;
  const Material& material = description.ground.material;
  description.shapes = {make_shape<dim>("cube", box_pieces<dim>(Vec<dim>(size * Vec<dim>::Ones())), material)};
  description.obstacles.push_back(
      {make_shape<dim>("plate", box_pieces<dim>(plate), material), {.position = up<dim>(5.5 * size)}});
  description.units = fitting_units(description);
  EXPECT_NE(description.units.lengths(), 1.0);
  description.dt /= description.units.steps();
  const auto world = TypeParam::make(description);
  world->add(this->at(up<dim>(4.501 * size)));
  world->set_grip(0, 0.2);
  this->run(*world, 2.0);
  EXPECT_NEAR(this->height_of(*world, 0), 4.5 * size, 0.01 * size);
}

TYPED_TEST(Grip, ReportsTheForceThatHolds) {
  const auto world = TypeParam::make(this->with_plate());
  world->add(this->hanging());
  world->set_grip(0, 0.5);
  world->record_contacts(true);
  this->run(*world, 2.0);
  double pull = 0.0;
  for (const Contact<TypeParam::dim>& contact : world->contacts())
    pull += height<TypeParam::dim>(contact.normal) * contact.normal_impulse / world->dt();
  const double weight = 10.0 * world->shape_of(0).mass;
  EXPECT_NEAR(pull, weight, 0.01 * weight);
}

// Friction of 0.5 holds up to 26.6 degrees. A grip of 0.3 makes it 0.8, and attracts with 2.4 weights.
TYPED_TEST(Grip, HoldsACubeOnASlopeSteeperThanItsFrictionDoes) {
  for (const double grip : {0.0, 0.3}) {
    const auto world = this->on_slope(40.0, 0, grip);
    this->run(*world, 2.0);
    const double way = this->pose(*world, 0).position[0];
    if (grip > 0.0)
      EXPECT_LT(way, 0.05);
    else
      EXPECT_GT(way, 1.0);
  }
}

// The torque of the weight about the point of contact is r m g sin, that which resists at most grip r m (g cos + 8 grip
// g): at 20 degrees 0.16 holds.
TYPED_TEST(Grip, HoldsABallOnASlope) {
  for (const double grip : {0.1, 0.25}) {
    const auto world = this->on_slope(20.0, 1, grip);
    this->run(*world, 2.0);
    const double way = this->pose(*world, 0).position[0];
    if (grip > 0.2)
      EXPECT_LT(way, 0.05);
    else
      EXPECT_GT(way, 0.5);
  }
}

TYPED_TEST(Grip, EndsWhenItIsTakenAway) {
  const auto world = TypeParam::make(this->with_plate());
  world->add(this->hanging());
  world->set_grip(0, 1.0);
  this->run(*world, 1.0);
  world->set_grip(0, 0.0);
  this->run(*world, 1.0);
  EXPECT_LT(this->height_of(*world, 0), 4.0);
}

TYPED_TEST(Grip, StaysWithABodyOverItsSleep) {
  const auto world = TypeParam::make(this->with_plate());
  world->set_ring(SleepRing{.extent = 1.0, .rings = 2, .still_speed = 0.01});
  world->add(this->hanging());
  world->set_grip(0, 1.0);
  this->run(*world, 1.0);
  this->freeze(*world, 0);
  this->run(*world, 1.0);
  EXPECT_TRUE(world->stirred().empty());
  this->thaw(*world, 0);
  this->run(*world, 1.0);
  EXPECT_NEAR(this->height_of(*world, 0), 4.5, 0.01);
}

TYPED_TEST(Grip, IsPartOfTheStateThatTheWakeTestStartsFrom) {
  const WorldDescription<TypeParam::dim> description = this->with_plate();
  const auto world = TypeParam::make(description);
  world->add(this->hanging());
  world->set_grip(0, 1.0);
  this->run(*world, 1.0);
  const auto make = [](const WorldDescription<TypeParam::dim>& of) -> std::unique_ptr<World<TypeParam::dim>> {
    return TypeParam::make(of);
  };
  EXPECT_LT(wake_test<TypeParam::dim>(make, description, world->states(), {}).mean, 0.01);
}

}  // namespace
}  // namespace talus::grip_test
