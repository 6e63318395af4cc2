// Wrong calls, and right calls in an unusual order, have one answer on all engines, to the last letter of a message.

#include <functional>
#include <limits>

#include "common/world/world.h"
#include "tests/backends/backend.h"

namespace talus::wrong_calls_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

template <typename Backend>
class WrongCall : public BackendTest<Backend> {
 protected:
  static constexpr int dimension = Backend::dim;
  using Bodies = std::vector<BodyIndex>;

  /// Bodies 0 awake, 1 frozen, 2 removed, high above the ground.
  WrongCall() {
    for (int i = 0; i < 3; ++i) world->add(this->at(up<dimension>(5.0) + 3.0 * i * Vec<dimension>::Unit(0)));
    this->freeze(*world, 1);
    world->remove(2);
  }

  /// What the call throws; "no error" if it returns. A wrong call must leave the world as it is.
  std::string error_of(const std::function<void()>& call) {
    const Bodies awake(world->awake().begin(), world->awake().end());
    std::string error = "no error";
    try {
      call();
    } catch (const std::invalid_argument& refused) {
      error = refused.what();
    }
    EXPECT_EQ(Bodies(world->awake().begin(), world->awake().end()), awake) << error;
    EXPECT_EQ(world->states().size(), 3) << error;
    return error;
  }
  std::string velocity_error(BodyIndex body, const Vec<dimension>& velocity) {
    return error_of([&] { world->set_velocity(body, velocity, Spin<dimension>::Zero()); });
  }
  std::string query_error(const Box<dimension>& box) {
    Bodies found;
    return error_of([&] { world->query_box(box, found); });
  }

  std::unique_ptr<World<dimension>> world = Backend::make(this->description());
};
TYPED_TEST_SUITE(WrongCall, BackendsAndToy, BackendName);

TYPED_TEST(WrongCall, WithAnUnknownBodyIsRefused) {
  for (const BodyIndex body : {-1, 3, 700, -2'000'000'000}) {
    const std::string text =
        "body = " + std::to_string(body) + ": must be the number of a body added before, from 0 on";
    EXPECT_EQ(this->error_of([&] { this->world->remove(body); }), text);
    EXPECT_EQ(this->error_of([&] { this->freeze(*this->world, body); }), text);
    EXPECT_EQ(this->error_of([&] { this->thaw(*this->world, body); }), text);
    EXPECT_EQ(this->velocity_error(body, up<TypeParam::dim>(1.0)), text);
  }
}

TYPED_TEST(WrongCall, WithARemovedBodyIsRefused) {
  const std::string text = "body = 2: must not have been removed";
  EXPECT_EQ(this->error_of([&] { this->world->remove(2); }), text);
  EXPECT_EQ(this->error_of([&] { this->freeze(*this->world, 2); }), text);
  EXPECT_EQ(this->error_of([&] { this->thaw(*this->world, 2); }), text);
  EXPECT_EQ(this->velocity_error(2, up<TypeParam::dim>(1.0)), text);
}

TYPED_TEST(WrongCall, WithOneBadBodyAmongGoodOnesChangesNone) {
  const std::vector<BodyIndex> bodies = {0, 1, 2};
  EXPECT_EQ(this->error_of([&] { this->world->freeze(bodies); }), "body = 2: must not have been removed");
  EXPECT_EQ(this->error_of([&] { this->world->thaw(bodies); }), "body = 2: must not have been removed");
  EXPECT_EQ(this->error_of([&] { this->world->remove(bodies); }), "body = 2: must not have been removed");
  EXPECT_EQ(this->world->removals(), 1);
  EXPECT_FALSE(this->asleep(*this->world, 0));
  EXPECT_TRUE(this->asleep(*this->world, 1));
}

TYPED_TEST(WrongCall, ThatGivesAFrozenBodyAVelocityIsRefused) {
  EXPECT_EQ(this->velocity_error(1, up<TypeParam::dim>(1.0)), "body = 1: must be awake to get a velocity");
}

TYPED_TEST(WrongCall, WithAGripThatIsNoneIsRefused) {
  for (const double grip : {-0.5, nan, infinite}) {
    const std::string error = this->error_of([&] { this->world->set_grip(0, grip); });
    EXPECT_TRUE(error.ends_with("must be >= 0 and finite")) << error;
  }
  const std::string error = this->error_of([&] { this->world->set_grip(0, 0.5); });
  EXPECT_TRUE(error.starts_with(TypeParam::small_steps ? "no error" : "grip = 0.5: must be 0")) << error;
}

TYPED_TEST(WrongCall, WithAVelocityThatIsNoNumberIsRefused) {
  EXPECT_EQ(this->velocity_error(0, nan * Vec<TypeParam::dim>::Ones()), "body.velocity[0] = nan: must be finite");
  EXPECT_EQ(this->velocity_error(0, Vec<TypeParam::dim>::Constant(infinite)), "body.velocity[0] = inf: must be finite");
}

TYPED_TEST(WrongCall, WithABoxThatIsNoBoxIsRefused) {
  constexpr int dim = TypeParam::dim;
  const std::string text = "box = NaN: must have corners that are numbers";
  EXPECT_EQ(this->query_error({nan * Vec<dim>::Ones(), Vec<dim>::Ones()}), text);
  EXPECT_EQ(this->query_error({Vec<dim>::Zero(), nan * Vec<dim>::Ones()}), text);
}

template <typename Backend>
class CallOrder : public BackendTest<Backend> {
 protected:
  static constexpr int dimension = Backend::dim;

  static std::vector<BodyIndex> found_in(const World<dimension>& world, const Box<dimension>& box) {
    std::vector<BodyIndex> found;
    world.query_box(box, found);
    return found;
  }

  /// A box at rest on the ground, its contacts recorded.
  std::unique_ptr<World<dimension>> resting_box() {
    auto world = Backend::make(this->description());
    world->record_contacts(true);
    world->add(this->at(up<dimension>(0.5)));
    this->run(*world, 1.0);
    return world;
  }
};
TYPED_TEST_SUITE(CallOrder, BackendsAndToy, BackendName);

TYPED_TEST(CallOrder, AnEmptyBoxFindsNothingAndABoxWithoutEndFindsAll) {
  constexpr int dim = TypeParam::dim;
  const auto world = this->resting_box();
  EXPECT_TRUE(this->found_in(*world, {Vec<dim>::Constant(10.0), Vec<dim>::Constant(-10.0)}).empty());
  EXPECT_EQ(this->found_in(*world, {Vec<dim>::Constant(-infinite), Vec<dim>::Constant(infinite)}),
            std::vector<BodyIndex>{0});
}

TYPED_TEST(CallOrder, AQueryAppendsAndLeavesWhatWasInTheList) {
  constexpr int dim = TypeParam::dim;
  const auto world = this->resting_box();
  std::vector<BodyIndex> found = {7, 0};
  world->query_box({Vec<dim>::Constant(-1.0), Vec<dim>::Constant(1.0)}, found);
  EXPECT_EQ(found, (std::vector<BodyIndex>{7, 0, 0}));
}

// A fast body leaves the bounds that Bullet's broadphase has for it.
TYPED_TEST(CallOrder, AQueryFindsAThrownBodyAlsoOnceItIsFrozenAndNotOnceItIsRemoved) {
  constexpr int dim = TypeParam::dim;
  const auto world = TypeParam::make(this->description());
  const BodyIndex body = world->add(this->at(up<dim>(20.0)));
  world->step();
  world->set_velocity(body, 60.0 * Vec<dim>::Unit(0), Spin<dim>::Zero());
  world->step();
  const Box<dim> around = world->bounds_of(body);
  EXPECT_EQ(this->found_in(*world, around), std::vector<BodyIndex>{body});
  this->freeze(*world, body);
  EXPECT_EQ(this->found_in(*world, around), std::vector<BodyIndex>{body});
  world->remove(body);
  EXPECT_TRUE(this->found_in(*world, around).empty());
}

TYPED_TEST(CallOrder, ContactsAreThoseOfTheLastStepWhateverIsFrozenOrRemovedAfterIt) {
  const auto world = this->resting_box();
  const std::size_t points = world->contacts().size();
  EXPECT_GT(points, 0U);
  this->freeze(*world, 0);
  EXPECT_EQ(world->contacts().size(), points);
  this->thaw(*world, 0);
  EXPECT_EQ(world->contacts().size(), points);
  world->remove(0);
  EXPECT_EQ(world->contacts().size(), points);
  world->step();
  EXPECT_TRUE(world->contacts().empty());
}

TYPED_TEST(CallOrder, AStepThatDoesNotRecordContactsHasNone) {
  const auto world = this->resting_box();
  world->record_contacts(false);
  EXPECT_FALSE(world->contacts().empty()) << "of the last step";
  world->step();
  EXPECT_TRUE(world->contacts().empty());
  world->record_contacts(true);
  EXPECT_TRUE(world->contacts().empty()) << "of the last step";
  world->step();
  EXPECT_FALSE(world->contacts().empty());
}

TYPED_TEST(CallOrder, TheFirstStepThatRecordsContactsHasTheSpeedsOfApproach) {
  constexpr int dim = TypeParam::dim;
  const auto world = TypeParam::make(this->description());
  world->record_contacts(true);
  world->add(this->at(up<dim>(0.51), 1, up<dim>(-5.0)));
  double approach = 0.0;
  for (int step = 0; step < 2 && world->contacts().empty(); ++step) {
    world->step();
    for (const Contact<dim>& contact : world->contacts()) approach = std::max(approach, contact.approach_speed);
  }
  EXPECT_NEAR(approach, 5.0, 0.5);
}

TYPED_TEST(CallOrder, AFrozenBodyIsListedOnceHoweverOftenItIsFrozen) {
  constexpr int dim = TypeParam::dim;
  const auto world = TypeParam::make(this->description());
  for (int i = 0; i < 4; ++i) world->add(this->at(up<dim>(5.0) + 3.0 * i * Vec<dim>::Unit(0)));
  world->freeze(std::vector<BodyIndex>{3, 1, 3, 1, 0});
  EXPECT_EQ(std::vector<BodyIndex>(world->awake().begin(), world->awake().end()), std::vector<BodyIndex>{2});
  world->thaw(std::vector<BodyIndex>{3, 0, 3, 2});
  EXPECT_EQ(std::vector<BodyIndex>(world->awake().begin(), world->awake().end()), (std::vector<BodyIndex>{0, 2, 3}));
  world->step();
  EXPECT_TRUE(this->asleep(*world, 1));
}

}  // namespace
}  // namespace talus::wrong_calls_test
