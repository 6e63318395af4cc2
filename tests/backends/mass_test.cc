// The unit of mass means nothing to the motion.

#include <cmath>
#include <cstring>
#include <numeric>

#include "tests/backends/backend.h"

namespace talus::mass_test {
namespace {

template <typename Backend>
class Mass : public BackendTest<Backend> {
 protected:
  using Base = BackendTest<Backend>;

  /// The fixture's shapes with `factor` times their masses.
  static WorldDescription<Backend::dim> description(double factor) {
    auto world = Base::description();
    for (Shape<Backend::dim>& shape : world.shapes) {
      shape.mass *= factor;
      shape.inertia *= factor;
    }
    return world;
  }

  /// A heap that falls, is frozen in part, thawed and falls on.
  static std::unique_ptr<World<Backend::dim>> heap(double factor) {
    auto world = Backend::make(description(factor));
    for (int i = 0; i < 12; ++i)
      world->add(Base::at(up<Backend::dim>(0.8 + 1.3 * i) + 0.1 * (i % 3) * Vec<Backend::dim>::Unit(0), i % 3));
    std::vector<BodyIndex> lower(6);
    std::iota(lower.begin(), lower.end(), 0);
    Base::run(*world, 1.0);
    world->record_contacts(true);
    world->freeze(lower);
    Base::run(*world, 0.5);
    world->thaw(lower);
    Base::run(*world, 0.5);
    return world;
  }
};
TYPED_TEST_SUITE(Mass, Backends, BackendName);

constexpr double largest_density = 1e6;  // that a scene file may give

TYPED_TEST(Mass, OfTheLargestBodiesRestsOnTheGround) {
  constexpr int dim = TypeParam::dim;
  const Material material{.density = largest_density, .friction = 0.5, .restitution = 0.0};
  for (const double size : {2.0, 3.0, 4.0, 30.0, 1000.0}) {
    WorldDescription<dim> description;
    description.shapes = {make_shape<dim>("cube", box_pieces<dim>(Vec<dim>::Constant(size)), material),
                          make_shape<dim>("ball", ball_pieces<dim>(size / 2.0), material)};
    auto world = TypeParam::make(description);
    const BodyIndex cube = world->add(this->at(up<dim>(0.5 * size + 0.1)));
    const BodyIndex ball = world->add(this->at(up<dim>(0.5 * size + 0.1) + 2.0 * size * Vec<dim>::Unit(0), 1));
    this->run(*world, 2.0);
    EXPECT_NEAR(this->height_of(*world, cube), 0.5 * size, 0.05) << size;
    EXPECT_NEAR(this->height_of(*world, ball), 0.5 * size, 0.05) << size;
  }
}

TYPED_TEST(Mass, OfHeavyBodiesRestsOnHeavyBodies) {
  constexpr int dim = TypeParam::dim;
  auto world = TypeParam::make(this->description(1e6));
  world->add(this->at(up<dim>(0.5)));
  const BodyIndex upper = world->add(this->at(up<dim>(1.55)));
  this->run(*world, 2.0);
  EXPECT_NEAR(this->height_of(*world, upper), 1.5, 0.05);
}

TYPED_TEST(Mass, InAnotherUnitGivesTheSameBits) {
  const auto plain = this->heap(1.0);
  for (const int exponent : {-60, -30, 10, 14, 30}) {
    const auto scaled = this->heap(std::ldexp(1.0, exponent));
    for (std::size_t i = 0; i < plain->states().pose.size(); ++i) {
      EXPECT_EQ(scaled->states().pose[i].position, plain->states().pose[i].position) << exponent << " " << i;
      EXPECT_EQ(scaled->states().velocity[i], plain->states().velocity[i]) << exponent << " " << i;
      EXPECT_EQ(scaled->states().spin[i], plain->states().spin[i]) << exponent << " " << i;
    }
  }
}

TYPED_TEST(Mass, InAnotherUnitScalesTheImpulsesOfContacts) {
  const auto plain = this->heap(1.0);
  const auto expected = plain->contacts();
  ASSERT_FALSE(expected.empty());
  for (const int exponent : {-30, 14}) {
    const auto scaled = this->heap(std::ldexp(1.0, exponent));
    const auto contacts = scaled->contacts();
    ASSERT_EQ(contacts.size(), expected.size()) << exponent;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(contacts[i].normal_impulse, std::ldexp(expected[i].normal_impulse, exponent));
      EXPECT_EQ(contacts[i].friction_impulse, std::ldexp(1.0, exponent) * expected[i].friction_impulse);
    }
  }
}

}  // namespace
}  // namespace talus::mass_test
