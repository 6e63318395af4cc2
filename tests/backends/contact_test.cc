// Contacts, neighbourhood and the engine's own sleeping, alike on every engine.

#include <algorithm>

#include "tests/backends/backend.h"

namespace talus::contact_test {
namespace {

template <typename Backend>
class WorldInterface : public BackendTest<Backend> {};
TYPED_TEST_SUITE(WorldInterface, Backends, BackendName);

TYPED_TEST(WorldInterface, ContactImpulsesOfARestingBoxCarryItsWeight) {
  constexpr int dim = TypeParam::dim;
  auto world = TypeParam::make(this->description());
  world->record_contacts(true);
  const BodyIndex box = world->add(this->at(up<dim>(0.5)));
  this->run(*world, 1.0);
  double impulse = 0.0;
  for (const Contact<dim>& contact : world->contacts()) {
    EXPECT_EQ(contact.a, box);
    EXPECT_EQ(contact.b, ground_index);
    EXPECT_NEAR(contact.normal[dim - 1], 1.0, 1e-3) << "from ground to box";
    EXPECT_NEAR(height<dim>(contact.point), 0.0, 0.03);
    impulse += contact.normal_impulse;
  }
  const double weight = 1000.0 * 10.0 / 60.0;  // density 1000, unit volume, one step
  EXPECT_NEAR(impulse, weight, 0.02 * weight);
}

TYPED_TEST(WorldInterface, ContactHasTheSpeedOfApproach) {
  constexpr int dim = TypeParam::dim;
  auto world = TypeParam::make(this->description());
  world->record_contacts(true);
  world->add(this->at(up<dim>(3.0), 1, up<dim>(-9.0)));
  double approach = 0.0;
  for (int i = 0; i < 60 && approach == 0.0; ++i) {
    world->step();
    for (const Contact<dim>& contact : world->contacts())
      if (contact.normal_impulse > 0.0) approach = std::max(approach, contact.approach_speed);
  }
  // Falls at most 2.5 m: v^2 = 81 + 50; the contact may be solved up to a step early.
  EXPECT_NEAR(approach, std::sqrt(131.0), 0.4);
}

TYPED_TEST(WorldInterface, ContactNamesTheFrozenBodyThatABodyRestsOn) {
  constexpr int dim = TypeParam::dim;
  auto world = TypeParam::make(this->description());
  world->record_contacts(true);
  const BodyIndex lower = world->add(this->at(up<dim>(0.5)));
  const BodyIndex upper = world->add(this->at(up<dim>(1.5)));
  this->run(*world, 1.0);
  this->freeze(*world, lower);
  this->run(*world, 0.5);
  ASSERT_FALSE(world->contacts().empty());
  for (const Contact<dim>& contact : world->contacts()) {
    EXPECT_EQ(contact.a, upper);
    EXPECT_EQ(contact.b, lower);
  }
}

TYPED_TEST(WorldInterface, QueryBoxFindsAwakeAndSleepingBodiesInOrder) {
  constexpr int dim = TypeParam::dim;
  auto world = TypeParam::make(this->description());
  for (int i = 0; i < 5; ++i) world->add(this->at(up<dim>(2.0) + 3.0 * i * Vec<dim>::Unit(0)));
  world->step();
  this->freeze(*world, 1);
  world->remove(3);
  std::vector<BodyIndex> found;
  world->query_box(Box<dim>(up<dim>(1.9) + 2.0 * Vec<dim>::Unit(0), up<dim>(2.1) + 20.0 * Vec<dim>::Unit(0)), found);
  EXPECT_EQ(found, (std::vector<BodyIndex>{1, 2, 4}));
}

TYPED_TEST(WorldInterface, AwakeListsTheBodiesThatAreNeitherAsleepNorRemoved) {
  constexpr int dim = TypeParam::dim;
  auto world = TypeParam::make(this->description());
  for (int i = 0; i < 4; ++i) world->add(this->at(up<dim>(2.0) + 3.0 * i * Vec<dim>::Unit(0)));
  this->freeze(*world, 2);
  world->remove(0);
  const auto awake = world->awake();
  EXPECT_EQ(std::vector<BodyIndex>(awake.begin(), awake.end()), (std::vector<BodyIndex>{1, 3}));
}

TYPED_TEST(WorldInterface, SetVelocityThrowsABody) {
  constexpr int dim = TypeParam::dim;
  auto world = TypeParam::make(this->description());
  const BodyIndex body = world->add(this->at(up<dim>(20.0)));
  world->set_velocity(body, 3.0 * Vec<dim>::Unit(0), Spin<dim>::Zero());
  this->run(*world, 1.0);
  EXPECT_NEAR(this->pose(*world, body).position[0], 3.0, 1e-3);
}

TYPED_TEST(WorldInterface, EngineSleepPutsARestingBoxToSleepAndAnImpactWakesIt) {
  constexpr int dim = TypeParam::dim;
  auto description = this->description();
  description.engine_sleep = true;
  if (!has_policy<TypeParam>("engine")) {
    EXPECT_THROW(TypeParam::make(description), std::invalid_argument);
    return;
  }
  auto world = TypeParam::make(description);
  const BodyIndex box = world->add(this->at(up<dim>(0.5)));
  this->run(*world, 5.0);
  EXPECT_TRUE(this->asleep(*world, box));
  EXPECT_TRUE(world->awake().empty());
  world->add(this->at(up<dim>(3.0)));
  this->run(*world, 0.9);
  EXPECT_FALSE(this->asleep(*world, box));
}

TYPED_TEST(WorldInterface, WithoutEngineSleepNoBodySleeps) {
  constexpr int dim = TypeParam::dim;
  auto world = TypeParam::make(this->description());
  world->add(this->at(up<dim>(0.5)));
  this->run(*world, 10.0);
  EXPECT_EQ(world->awake().size(), 1U);
}

}  // namespace
}  // namespace talus::contact_test
