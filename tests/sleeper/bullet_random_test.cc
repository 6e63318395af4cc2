#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "tests/sleeper/bullet_scene.h"

namespace talus::test {
namespace {

/// A game: boxes come, go, are teleported, pushed and carried; now and then the state is saved or loaded.
class Game {
 public:
  explicit Game(unsigned seed) : random_(seed) {
    lift_ = &scene_.add_box({3, 3, 4}, {6, 0, -1}, 0);
    lift_->setCollisionFlags(lift_->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    lift_->setActivationState(DISABLE_DEACTIVATION);
    lift_->setMotionState(&motion_);
    scene_.sleeper->add(*lift_);
    save();
  }

  void play(int turns) {
    for (int turn = 0; turn < turns; ++turn) {
      act(static_cast<int>(random_() % 16));
      for (int i = 0; i < 10; ++i) step();
    }
  }
  void rest() {
    lift_speed_ = 0.0;
    for (int i = 0; i < 900; ++i) step();
  }
  /// Boxes that hang in the air: woken, they fall as nothing held them, but for a fifth.
  int floating() {
    std::vector<btScalar> heights;
    for (const btRigidBody* box : boxes_) heights.push_back(box->getWorldTransform().getOrigin().z());
    scene_.sleeper->wake_all();
    constexpr int steps = 6;
    for (int i = 0; i < steps; ++i) scene_.BulletScene::step();
    const double free_fall = 9.81 * drop_dt * drop_dt * steps * (steps + 1) / 2;
    int count = 0;
    for (std::size_t i = 0; i < boxes_.size(); ++i)
      count += heights[i] - boxes_[i]->getWorldTransform().getOrigin().z() > 0.8 * free_fall ? 1 : 0;
    return count;
  }
  bool all_there() const {
    return scene_.sleeper->size() == static_cast<int>(boxes_.size()) + 1 &&
           std::ranges::all_of(boxes_, [&](const btRigidBody* box) {
             const btVector3& at = box->getWorldTransform().getOrigin();
             return scene_.sleeper->watches(*box) && at.z() > 0.1 && at.length() < 100;
           });
  }
  int awake() const { return scene_.sleeper->awake(); }
  std::size_t boxes() const { return boxes_.size(); }
  std::uint32_t highest_slot() const {
    std::uint32_t highest = 0;
    for (const btRigidBody* box : boxes_) highest = std::max(highest, scene_.sleeper->handle(*box).slot);
    return highest;
  }
  bool refuses_removed() const {
    return std::ranges::all_of(gone_, [&](Handle handle) {
      try {
        scene_.sleeper->body(handle);
        return false;
      } catch (const InvalidValue&) {
        return true;
      }
    });
  }

 private:
  double number(double low, double high) { return low + (high - low) * fraction(random_); }
  Pose<3> anywhere() {
    Pose<3> pose = drops<3>(1, static_cast<unsigned>(random_())).front();
    pose.position += Vec3(number(-1, 7), number(-1, 1), 0);
    return pose;
  }
  btRigidBody& any_box() { return *boxes_[random_() % boxes_.size()]; }

  void act(int what) {
    if (what < 7 && boxes_.size() < 60) boxes_.push_back(&scene_.drop(anywhere()));
    if (boxes_.empty()) return;
    switch (what) {
      case 8:
      case 9:
        return take_away(any_box());
      case 10: {
        btRigidBody& box = any_box();
        const Pose<3> to = anywhere();
        box.setWorldTransform(btTransform(btQuaternion::getIdentity(), to_bullet(to.position)));
        return scene_.sleeper->moved(box);
      }
      case 11: {
        btRigidBody& box = any_box();
        scene_.sleeper->wake(box);
        return box.setLinearVelocity({btScalar(number(-3, 3)), btScalar(number(-3, 3)), 2});
      }
      case 12:
        lift_speed_ = number(-0.3, 0.3);
        return;
      case 13:
        scene_.world.setGravity({btScalar(number(-1, 1)), 0, btScalar(-9.81)});
        return;
      case 14:
        return save();
      case 15:
        return load();
      default:
        return;
    }
  }
  void take_away(btRigidBody& box) {
    gone_.push_back(scene_.sleeper->handle(box));
    std::erase(boxes_, &box);
    scene_.sleeper->about_to_remove(box);
    scene_.remove(box);
  }
  void save() {
    saved_ = scene_.sleeper->snapshot();
    places_.clear();
    for (const SavedSleep& one : saved_) places_.push_back(scene_.sleeper->body(one.body).getWorldTransform());
    lift_saved_ = lift_->getWorldTransform();
    gravity_saved_ = scene_.world.getGravity();
  }
  /// Boxes of the saved state that have left since do not come back; those that have come since leave.
  void load() {
    std::set<Handle> kept;
    for (const SavedSleep& one : saved_) kept.insert(one.body);
    for (btRigidBody* box : std::vector(boxes_))
      if (!kept.contains(scene_.sleeper->handle(*box))) take_away(*box);
    std::vector<SavedSleep> there;
    for (std::size_t i = 0; i < saved_.size(); ++i) {
      if (std::ranges::find(gone_, saved_[i].body) != gone_.end()) continue;
      scene_.sleeper->body(saved_[i].body).setWorldTransform(places_[i]);
      there.push_back(saved_[i]);
    }
    motion_.setWorldTransform(lift_saved_);
    scene_.world.setGravity(gravity_saved_);
    // What lay on a box that is gone must not hang.
    const bool complete = there.size() == saved_.size();
    scene_.sleeper->restore(there);
    if (!complete) scene_.sleeper->wake_all();
  }
  void step() {
    btTransform at;
    motion_.getWorldTransform(at);
    at.getOrigin().setZ(std::clamp(at.getOrigin().z() + btScalar(lift_speed_ * drop_dt), btScalar(-1.5), btScalar(0)));
    motion_.setWorldTransform(at);
    scene_.step(number(0.8, 1.2) * drop_dt);
  }

  std::mt19937 random_;
  SleepingBulletScene scene_;
  btDefaultMotionState motion_{btTransform(btQuaternion::getIdentity(), {6, 0, -1})};
  btRigidBody* lift_ = nullptr;
  double lift_speed_ = 0.0;
  std::vector<btRigidBody*> boxes_;
  std::vector<Handle> gone_;
  std::vector<SavedSleep> saved_;
  std::vector<btTransform> places_;
  btTransform lift_saved_;
  btVector3 gravity_saved_;
};

class BulletGame : public ::testing::TestWithParam<unsigned> {};

TEST_P(BulletGame, LeavesNoBodyFloatingHangingOrLost) {
  Game game(GetParam());
  for (int round = 0; round < 4; ++round) {
    game.play(100);
    EXPECT_TRUE(game.all_there());
    EXPECT_TRUE(game.refuses_removed());
  }
  game.rest();
  EXPECT_LE(game.awake(), 3) << game.boxes() << " boxes";
  EXPECT_EQ(game.floating(), 0);
  EXPECT_LE(game.highest_slot(), 60U);  // the most there ever were at once, and the lift
}

class LongBulletGame : public BulletGame {};
TEST_P(LongBulletGame, LeavesNoBodyFloatingAfterHours) {
  Game game(GetParam());
  game.play(5000);
  game.rest();
  EXPECT_TRUE(game.all_there());
  EXPECT_TRUE(game.refuses_removed());
  EXPECT_EQ(game.floating(), 0);
  EXPECT_LE(game.highest_slot(), 60U);
}

INSTANTIATE_TEST_SUITE_P(Seeds, LongBulletGame, ::testing::Range(101U, 105U));
INSTANTIATE_TEST_SUITE_P(Seeds, BulletGame, ::testing::Range(1U, 9U));

}  // namespace
}  // namespace talus::test
