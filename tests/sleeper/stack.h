#pragma once
// Tests of a stack of boxes that sleep in a program's own engine, the same for every engine.

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "common/math/require.h"
#include "tests/sleeper/drops.h"

namespace talus::test {

/// Four boxes on each other, asleep. `Scene` is SleepingBulletScene or the like.
template <typename Scene>
class SleepingStack : public ::testing::Test {
 protected:
  static constexpr int dimension = Scene::dimension;
  using Vector = Vec<dimension>;

  SleepingStack() {
    for (int i = 0; i < 4; ++i) stack.push_back(&scene.drop(standing({0.0, (0.5 + i) * height()})));
    // Until after the stability check of the settled stack, so that no box wakes without a cause.
    scene.run(480);
  }
  static double height() { return box_size<dimension>()[dimension - 1]; }
  /// Along x and up.
  static Vector vector(const Vec2& of) {
    Vector result = Vector::Zero();
    result[0] = of.x();
    result[dimension - 1] = of.y();
    return result;
  }
  static Pose<dimension> standing(const Vec2& at) { return {vector(at), Rotation<dimension>::Identity()}; }
  int asleep() const {
    return static_cast<int>(std::ranges::count_if(stack, [&](auto* body) { return scene.sleeper->asleep(*body); }));
  }
  double height_of(std::size_t number) const { return scene.place(*stack[number])[dimension - 1]; }

  Scene scene;
  std::vector<typename Scene::Body*> stack;
};
TYPED_TEST_SUITE_P(SleepingStack);

TYPED_TEST_P(SleepingStack, FallsWhenItsLowestBoxIsRemoved) {
  ASSERT_EQ(this->asleep(), 4);
  this->scene.take_away(*this->stack.front());
  this->stack.erase(this->stack.begin());
  this->scene.run(300);
  EXPECT_NEAR(this->height_of(0), 0.5 * this->height(), 0.02);
  EXPECT_NEAR(this->height_of(2), 2.5 * this->height(), 0.04);
}

TYPED_TEST_P(SleepingStack, FallsWhenTheGroundIsRemoved) {
  this->scene.take_away_ground();
  this->scene.run(120);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(this->height_of(i), 0.0);
}

TYPED_TEST_P(SleepingStack, FallsWhenItsLowestBoxIsTakenElsewhere) {
  this->scene.put(*this->stack.front(), this->vector({20.0, 0.5 * this->height()}));
  EXPECT_FALSE(this->scene.sleeper->asleep(*this->stack.front()));
  this->scene.run(300);
  EXPECT_NEAR(this->height_of(1), 0.5 * this->height(), 0.02);
  EXPECT_NEAR(this->height_of(3), 2.5 * this->height(), 0.04);
}

TYPED_TEST_P(SleepingStack, WakesAndSlidesWhenGravityTurns) {
  this->scene.set_gravity(this->vector({9.81, -1.0}));
  this->scene.step();
  EXPECT_EQ(this->asleep(), 0);
  this->scene.run(60);
  for (const auto* body : this->stack) EXPECT_GT(this->scene.place(*body)[0], 0.5);
}

TYPED_TEST_P(SleepingStack, LosesItsTopWhenThatIsPushed) {
  this->scene.push(*this->stack.back(), this->vector({3.0, 0.0}));
  this->scene.run(120);
  EXPECT_GT(this->scene.place(*this->stack.back())[0], 1.0);
  EXPECT_LT(this->height_of(3), 2.0 * this->height());
}

TYPED_TEST_P(SleepingStack, StaysAwakeWithAJoint) {
  auto& top = *this->stack.back();
  this->scene.sleeper->wake(top);
  const auto joint = this->scene.hold(top);
  this->scene.run(240);
  EXPECT_FALSE(this->scene.sleeper->asleep(top));
  this->scene.release(joint);
  this->scene.run(240);
  EXPECT_TRUE(this->scene.sleeper->asleep(top));
}

TYPED_TEST_P(SleepingStack, IsRefusedOnceItIsRemoved) {
  const Handle handle = this->scene.sleeper->handle(*this->stack.back());
  this->scene.take_away(*this->stack.back());
  EXPECT_THROW(this->scene.sleeper->body(handle), InvalidValue);
  const Handle next = this->scene.sleeper->handle(this->scene.drop(this->standing({0.0, 5.0})));
  EXPECT_EQ(next.slot, handle.slot);
  EXPECT_THROW(this->scene.sleeper->body(handle), InvalidValue);
}

TYPED_TEST_P(SleepingStack, SleepsAgainAfterSaveAndLoad) {
  ASSERT_EQ(this->asleep(), 4);
  const std::vector<SavedSleep> saved = this->scene.sleeper->snapshot();
  std::vector<typename TypeParam::Saved> states;
  std::vector<typename TestFixture::Vector> places;
  for (const auto* body : this->stack) {
    states.push_back(this->scene.save(*body));
    places.push_back(this->scene.place(*body));
  }
  this->scene.push(*this->stack.back(), this->vector({3.0, 0.0}));
  this->scene.run(60);
  for (std::size_t i = 0; i < 4; ++i) this->scene.load(*this->stack[i], states[i]);
  this->scene.sleeper->restore(saved);
  EXPECT_EQ(this->asleep(), 4);
  this->scene.run(120);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT((this->scene.place(*this->stack[i]) - places[i]).norm(), 1e-3);
}

REGISTER_TYPED_TEST_SUITE_P(SleepingStack, FallsWhenItsLowestBoxIsRemoved, FallsWhenTheGroundIsRemoved,
                            FallsWhenItsLowestBoxIsTakenElsewhere, WakesAndSlidesWhenGravityTurns,
                            LosesItsTopWhenThatIsPushed, StaysAwakeWithAJoint, IsRefusedOnceItIsRemoved,
                            SleepsAgainAfterSaveAndLoad);

}  // namespace talus::test
