// What a sleeper adds to a step of its engine while all bodies move: drums that turn, with and without it.

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <vector>

#include "tests/sleeper/box2d_scene.h"
#include "tests/sleeper/bullet_scene.h"
#include "tests/sleeper/drum.h"

namespace talus::test {
namespace {

/// A drum that turns, in the plane.
class Box2dDrum {
 public:
  static std::string name() { return "Box2D"; }

  Box2dDrum(int boxes, bool attached) {
    const double radius = drum_radius(boxes);
    b2BodyDef def;
    def.type = b2_kinematicBody;
    def.angularVelocity = drum_spin;
    drum_ = world_.CreateBody(&def);
    for (int i = 0; i < drum_sides; ++i) {
      b2PolygonShape shape;
      shape.SetAsBox(static_cast<float>(0.5 * wall), static_cast<float>(0.5 * side_length(radius)),
                     Box2dScene::to_box2d(side(i, radius).position),
                     static_cast<float>(side(i, radius).rotation.angle()));
      drum_->CreateFixture(&shape, 0.0F);
    }
    for (int i = 0; i < boxes; ++i) add_box(start(i, 15, radius));
    if (attached) sleeper_.emplace(world_).add_all();
  }
  void step() {
    if (sleeper_) sleeper_->before_step();
    world_.Step(static_cast<float>(drop_dt), 10, 4);
    if (sleeper_) sleeper_->after_step(drop_dt);
  }
  std::vector<double> state() const {
    std::vector<double> numbers;
    for (const b2Body* body = world_.GetBodyList(); body != nullptr; body = body->GetNext())
      numbers.insert(numbers.end(), {body->GetPosition().x, body->GetPosition().y, body->GetAngle()});
    return numbers;
  }
  int asleep() const { return sleeper_->size() - 1 - sleeper_->awake(); }

 private:
  void add_box(const Vec2& at) {
    b2BodyDef def;
    def.type = b2_dynamicBody;
    def.position = Box2dScene::to_box2d(at);
    def.allowSleep = false;
    b2PolygonShape shape;
    shape.SetAsBox(0.35F, 0.21F);
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.density = 1000.0F;
    fixture.friction = 0.5F;
    world_.CreateBody(&def)->CreateFixture(&fixture);
  }

  b2World world_{b2Vec2(0.0F, -9.81F)};
  b2Body* drum_ = nullptr;
  std::optional<Box2dSleeper> sleeper_;
};

/// A drum that turns about the y axis, closed by two static planes.
class BulletDrum {
 public:
  static std::string name() { return "Bullet"; }

  BulletDrum(int boxes, bool attached) {
    scene_.remove(*scene_.ground);
    constexpr double depth = 8.0;
    const double radius = drum_radius(boxes);
    for (int i = 0; i < drum_sides; ++i) {
      pieces_.push_back(std::make_unique<btBoxShape>(to_bullet({0.5 * wall, 0.5 * depth, 0.5 * side_length(radius)})));
      const Pose<2> at = side(i, radius);
      const btQuaternion turn(btVector3(0, 1, 0), static_cast<btScalar>(-at.rotation.angle()));
      shape_.addChildShape(btTransform(turn, to_bullet({at.position.x(), 0.0, at.position.y()})), pieces_.back().get());
    }
    for (const double y : {-0.5 * depth - 1.0, 0.5 * depth + 1.0})
      scene_.add_box({4.0 * radius, 2.0, 4.0 * radius}, {0, y, 0}, 0);
    scene_.bodies.push_back(std::make_unique<btRigidBody>(0, &motion_, &shape_));
    drum_ = scene_.bodies.back().get();
    drum_->setCollisionFlags(drum_->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    drum_->setActivationState(DISABLE_DEACTIVATION);
    scene_.world.addRigidBody(drum_);
    for (int i = 0; i < boxes; ++i) {
      const Vec2 at = start(i / 5, 9, radius);
      scene_.add_box({1.0, 0.7, 0.5}, {at.x(), 1.2 * (i % 5 - 2), at.y()}, 350.0)
          .setActivationState(DISABLE_DEACTIVATION);
    }
    if (attached) sleeper_.emplace(scene_.world).add_all();
  }
  void step() {
    angle_ += drum_spin * static_cast<float>(drop_dt);
    motion_.setWorldTransform(btTransform(btQuaternion(btVector3(0, 1, 0), angle_)));
    if (sleeper_) sleeper_->before_step();
    scene_.step();
    if (sleeper_) sleeper_->after_step(drop_dt);
  }
  std::vector<double> state() const {
    std::vector<double> numbers;
    for (const auto& body : scene_.bodies) {
      const btVector3& at = body->getWorldTransform().getOrigin();
      numbers.insert(numbers.end(), {at.x(), at.y(), at.z()});
    }
    return numbers;
  }
  int asleep() const { return sleeper_->size() - 1 - sleeper_->awake(); }

 private:
  std::vector<std::unique_ptr<btBoxShape>> pieces_;
  btCompoundShape shape_;
  btDefaultMotionState motion_;
  BulletScene scene_;
  btRigidBody* drum_ = nullptr;
  btScalar angle_ = 0;
  std::optional<BulletSleeper> sleeper_;
};

class LongAwakeCost : public ::testing::TestWithParam<int> {};

// Measured: 0.02 to 0.05 on a quiet machine. Where others use the caches it is up to twice that.
TEST_P(LongAwakeCost, IsBelowATenthInADrumOnBox2d) { expect_small_cost<Box2dDrum>(GetParam()); }
TEST_P(LongAwakeCost, IsBelowATenthInADrumOnBullet) { expect_small_cost<BulletDrum>(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Boxes, LongAwakeCost, ::testing::Values(300, 1000));

}  // namespace
}  // namespace talus::test
