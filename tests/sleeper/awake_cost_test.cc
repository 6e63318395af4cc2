// What a sleeper adds to a step of its engine while all bodies move: drums that turn, with and without it.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <numbers>
#include <vector>

#include "common/measure/ensemble.h"
#include "tests/sleeper/box2d_scene.h"
#include "tests/sleeper/bullet_scene.h"

namespace talus::test {
namespace {

constexpr double wall = 1.0;       // [m]
constexpr float drum_spin = 0.7F;  // [rad/s]
constexpr int drum_sides = 8;

/// Boxes fill a third of the drum.
double drum_radius(int boxes) { return 9.0 * std::sqrt(boxes / 300.0); }

/// Where box number `i` starts in the drum, in rows `per_row` wide.
Vec2 start(int i, int per_row, double radius) {
  return {1.2 * (i % per_row - 0.5 * (per_row - 1)), 1.0 * (i / per_row) - 0.5 * radius};
}

/// The middle of a side of the drum and its angle.
Pose<2> side(int number, double radius) {
  const double angle = 2.0 * std::numbers::pi * number / drum_sides;
  return {radius * Vec2(std::cos(angle), std::sin(angle)), Rotation<2>(angle)};
}
double side_length(double radius) { return 2.0 * (radius + wall) * std::tan(std::numbers::pi / drum_sides); }

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

/// Processor time of some steps [s].
template <typename Drum>
double time_of_steps(Drum& drum, int steps) {
  const std::clock_t start = std::clock();
  for (int i = 0; i < steps; ++i) drum.step();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Two drums of the same bits take turns.
template <typename Drum>
void expect_small_cost(int boxes) {
  constexpr int rounds = 10;
  Drum plain(boxes, false);
  Drum attached(boxes, true);
  std::vector<double> shares;
  double total = 0.0;
  for (int round = -1; round < rounds; ++round) {  // the first one warms up
    const double engine = time_of_steps(plain, 60);
    const double share = time_of_steps(attached, 60) / engine - 1.0;
    if (round < 0) continue;
    shares.push_back(share);
    total += engine;
  }
  const MeanWithError share = mean_with_error(shares);
  fmt::print("{}, {} boxes that all move: a sleeper adds {:.3f} +- {:.3f} to {:.3f} ms a step\n", Drum::name(), boxes,
             share.mean, share.error, 1e3 * total / (60 * rounds));
  EXPECT_EQ(attached.asleep(), 0);
  EXPECT_EQ(plain.state(), attached.state());
  EXPECT_LT(share.mean - 3.0 * share.error, 0.1);
}

class LongAwakeCost : public ::testing::TestWithParam<int> {};

// Measured: 0.02 to 0.05 on a quiet machine. Where others use the caches it is up to twice that.
TEST_P(LongAwakeCost, IsBelowATenthInADrumOnBox2d) { expect_small_cost<Box2dDrum>(GetParam()); }
TEST_P(LongAwakeCost, IsBelowATenthInADrumOnBullet) { expect_small_cost<BulletDrum>(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Boxes, LongAwakeCost, ::testing::Values(300, 1000));

}  // namespace
}  // namespace talus::test
