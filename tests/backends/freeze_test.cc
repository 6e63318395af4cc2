// What freezing and thawing promise, alike on every engine.

#include "common/simulation/state_hash.h"
#include "tests/backends/backend.h"

namespace talus::freeze_test {
namespace {

template <typename Backend>
class FrozenBody : public BackendTest<Backend> {};
TYPED_TEST_SUITE(FrozenBody, Backends, BackendName);

TYPED_TEST(FrozenBody, HangsWhereItIsUntilThawedAndThenFalls) {
  constexpr int dim = TypeParam::dim;
  auto world = TypeParam::make(this->description());
  const BodyIndex body = world->add(this->at(up<dim>(20.0), 2, Vec<dim>::Unit(0)));
  this->run(*world, 0.5);
  const Pose<dim> before = this->pose(*world, body);
  this->freeze(*world, body);
  EXPECT_EQ(this->speed(*world, body), 0.0);
  EXPECT_TRUE(world->awake().empty());
  this->run(*world, 1.0);
  EXPECT_EQ(this->pose(*world, body).position, before.position);
  this->thaw(*world, body);
  EXPECT_EQ(this->pose(*world, body).position, before.position);
  this->run(*world, 1.0);
  constexpr int n = 60 * falls_in_a_step<TypeParam>;
  const double fallen = 10.0 * (n + 1) / n / 2.0;  // from rest: semi-implicit Euler over n sub-steps of a second
  EXPECT_NEAR(this->height_of(*world, body), height<dim>(before.position) - fallen, 1e-3);
}

TYPED_TEST(FrozenBody, IsSolidAndImmovableForWhatFallsOnIt) {
  constexpr int dim = TypeParam::dim;
  auto world = TypeParam::make(this->description());
  const BodyIndex support = world->add(this->at(up<dim>(3.0)));
  this->freeze(*world, support);
  const BodyIndex falling = world->add(this->at(up<dim>(8.0)));
  this->run(*world, 4.0);
  EXPECT_EQ(this->pose(*world, support).position, up<dim>(3.0));
  EXPECT_NEAR(this->height_of(*world, falling), 4.0, 0.03);
  EXPECT_TRUE(this->asleep(*world, support));
  EXPECT_FALSE(this->asleep(*world, falling));
}

TYPED_TEST(FrozenBody, StaysFrozenBesideAnAwakeOneThatTouchesIt) {
  constexpr int dim = TypeParam::dim;
  auto world = TypeParam::make(this->description());
  const BodyIndex lower = world->add(this->at(up<dim>(0.5)));
  const BodyIndex upper = world->add(this->at(up<dim>(1.5)));
  this->run(*world, 1.0);
  this->freeze(*world, lower);
  for (int i = 0; i < 60; ++i) {
    world->step();
    ASSERT_TRUE(this->asleep(*world, lower));
    ASSERT_EQ(world->awake().size(), 1U);
    ASSERT_EQ(world->awake().front(), upper);
  }
  EXPECT_LT(this->speed(*world, upper), 0.01);
}

TYPED_TEST(FrozenBody, DoesNotWakeOthersWhenItIsThawed) {
  constexpr int dim = TypeParam::dim;
  auto world = TypeParam::make(this->description());
  std::vector<BodyIndex> tower;
  for (int i = 0; i < 5; ++i) tower.push_back(world->add(this->at(up<dim>(0.5 + i))));
  this->run(*world, 2.0);
  world->freeze(tower);
  this->thaw(*world, tower[4]);
  this->run(*world, 1.0);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(this->asleep(*world, tower[i]));
  EXPECT_EQ(world->awake().size(), 1U);
}

TYPED_TEST(FrozenBody, BarelyMovesWhenThawedAtRest) {
  constexpr int dim = TypeParam::dim;
  auto world = TypeParam::make(this->description());
  std::vector<BodyIndex> tower;
  for (int i = 0; i < 5; ++i) tower.push_back(world->add(this->at(up<dim>(0.5 + i))));
  this->run(*world, 3.0);
  world->freeze(tower);
  this->run(*world, 1.0);
  std::vector<Vec<dim>> before;
  for (const BodyIndex body : tower) before.push_back(this->pose(*world, body).position);
  world->thaw(tower);
  double fastest = 0.0;
  for (int i = 0; i < 120; ++i) {
    world->step();
    for (const BodyIndex body : tower) fastest = std::max(fastest, this->speed(*world, body));
  }
  // One step of free fall would be 0.167 m/s: the contacts must bear weight from the first step on.
  EXPECT_LT(fastest, 0.15);
  for (std::size_t i = 0; i < tower.size(); ++i)
    EXPECT_LT((this->pose(*world, tower[i]).position - before[i]).norm(), 0.02) << "box " << i;
}

TYPED_TEST(FrozenBody, MayBeFrozenOrThawedTwice) {
  constexpr int dim = TypeParam::dim;
  auto world = TypeParam::make(this->description());
  const BodyIndex body = world->add(this->at(up<dim>(5.0)));
  this->thaw(*world, body);
  this->freeze(*world, body);
  this->freeze(*world, body);
  EXPECT_TRUE(world->awake().empty());
  this->thaw(*world, body);
  this->thaw(*world, body);
  EXPECT_EQ(world->awake().size(), 1U);
  this->run(*world, 0.5);
  EXPECT_LT(this->height_of(*world, body), 4.0);
}

TYPED_TEST(FrozenBody, CanBeRemoved) {
  constexpr int dim = TypeParam::dim;
  auto world = TypeParam::make(this->description());
  const BodyIndex support = world->add(this->at(up<dim>(3.0)));
  this->freeze(*world, support);
  world->remove(support);
  const BodyIndex falling = world->add(this->at(up<dim>(6.0)));
  this->run(*world, 3.0);
  EXPECT_NEAR(this->height_of(*world, falling), 0.5, 0.02) << "through where the removed body was";
  EXPECT_EQ(world->states().removed[support], 1);
}

TYPED_TEST(FrozenBody, IsRemovedTogetherWithAwakeOnesAsOneAfterTheOther) {
  constexpr int dim = TypeParam::dim;
  const std::vector<BodyIndex> removed = {5, 1, 4, 5};
  const auto hash_after = [&](bool at_once) {
    auto world = TypeParam::make(this->description());
    for (int i = 0; i < 8; ++i) world->add(this->at(up<dim>(0.6 + 1.1 * i)));
    this->run(*world, 1.0);
    for (const BodyIndex body : {0, 1, 5}) this->freeze(*world, body);
    this->run(*world, 0.1);
    if (at_once)
      world->remove(removed);
    else
      for (const BodyIndex body : {1, 4, 5}) world->remove(body);
    EXPECT_EQ(world->removals(), 3);
    EXPECT_EQ(std::vector<BodyIndex>(world->awake().begin(), world->awake().end()),
              (std::vector<BodyIndex>{2, 3, 6, 7}));
    this->run(*world, 1.0);
    return state_hash(world->states());
  };
  EXPECT_EQ(hash_after(true), hash_after(false));
}

TYPED_TEST(FrozenBody, SupportsAPileThatIsFrozenAndThawedAtRandomWithoutHarm) {
  constexpr int dim = TypeParam::dim;
  auto world = TypeParam::make(this->description());
  std::uint32_t random = 1;
  for (int i = 0; i < 600; ++i) {
    if (i % 10 == 0) world->add(this->at(up<dim>(9.0) + (i % 7 - 3) * 0.1 * Vec<dim>::Unit(0), 2));
    world->step();
    random = random * 1664525U + 1013904223U;  // Numerical Recipes' generator
    const auto body = static_cast<BodyIndex>((random >> 8) % static_cast<std::uint32_t>(world->states().size()));
    const Pose<dim> before = this->pose(*world, body);
    if (this->asleep(*world, body))
      this->thaw(*world, body);
    else if (this->speed(*world, body) < 1.0)
      this->freeze(*world, body);
    ASSERT_EQ(this->pose(*world, body).position, before.position);
  }
  std::vector<BodyIndex> all;
  for (BodyIndex body = 0; body < world->states().size(); ++body) all.push_back(body);
  world->thaw(all);
  this->run(*world, 4.0);
  for (const BodyIndex body : all) {
    EXPECT_GT(this->height_of(*world, body), 0.1) << "body " << body << " sank into the ground";
    EXPECT_LT(this->speed(*world, body), 12.0) << "body " << body << ": faster than a fall from the pile";
  }
}

TYPED_TEST(FrozenBody, IsNotAmongTheAwakeWhateverHits) {
  constexpr int dim = TypeParam::dim;
  auto world = TypeParam::make(this->description());
  const BodyIndex target = world->add(this->at(up<dim>(0.5)));
  this->run(*world, 0.5);
  this->freeze(*world, target);
  const BodyIndex shot = world->add(this->at(up<dim>(0.5) - 10.0 * Vec<dim>::Unit(0), 1, 25.0 * Vec<dim>::Unit(0)));
  this->run(*world, 2.0);
  EXPECT_EQ(world->awake().size(), 1U);
  EXPECT_EQ(world->awake().front(), shot);
  EXPECT_LT(this->pose(*world, shot).position[0], -0.9) << "it must not have gone through";
}

}  // namespace
}  // namespace talus::freeze_test
