#pragma once
// A program of one's own with Box2D: a ground, and what falls on it.

#include <optional>
#include <vector>

#include "talus/box2d.h"
#include "tests/sleeper/drops.h"

namespace talus::test {

class Box2dScene {
 public:
  Box2dScene() { ground = &add_box({200, 2}, {0, -1}, b2_staticBody); }

  b2Body& add_box(const Vec2& size, const Vec2& at, b2BodyType type, double angle = 0.0) {
    b2BodyDef def;
    def.type = type;
    def.position = to_box2d(at);
    def.angle = static_cast<float>(angle);
    b2Body& body = *world.CreateBody(&def);
    b2PolygonShape shape;
    shape.SetAsBox(static_cast<float>(0.5 * size.x()), static_cast<float>(0.5 * size.y()));
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.density = 1000.0F;
    fixture.friction = 0.5F;
    body.CreateFixture(&fixture);
    return body;
  }
  b2Body& add_drop(const Pose<2>& pose) {
    return add_box(box_size<2>(), pose.position, b2_dynamicBody, pose.rotation.angle());
  }
  std::vector<b2Body*> dynamic_bodies() {
    std::vector<b2Body*> found;
    for (b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext())
      if (body != ground && body->GetType() != b2_kinematicBody) found.push_back(body);
    return found;
  }
  void step(double dt = drop_dt) { world.Step(static_cast<float>(dt), 10, 4); }

  static b2Vec2 to_box2d(const Vec2& v) { return {static_cast<float>(v.x()), static_cast<float>(v.y())}; }

  b2World world{b2Vec2(0.0F, -9.81F)};
  b2Body* ground = nullptr;
};

/// With a sleeper: what the three lines in a loop of a program are.
class SleepingBox2dScene : public Box2dScene {
 public:
  using Body = b2Body;
  static constexpr int dimension = 2;

  Vec2 place(const Body& body) const { return {body.GetPosition().x, body.GetPosition().y}; }
  Pose<2> pose(const Body& body) const { return {place(body), Rotation<2>(body.GetAngle())}; }
  void take_away(Body& body) {
    sleeper->about_to_remove(body);
    world.DestroyBody(&body);
  }
  void take_away_ground() { take_away(*ground); }
  void put(Body& body, const Vec2& at) {
    body.SetTransform(to_box2d(at), body.GetAngle());
    sleeper->moved(body);
  }
  void push(Body& body, const Vec2& velocity) {
    sleeper->wake(body);
    body.SetLinearVelocity(to_box2d(velocity));
  }
  /// Holds a body where it is, until released.
  b2Joint* hold(Body& body) {
    b2MouseJointDef def;
    def.bodyA = ground;
    def.bodyB = &body;
    def.target = body.GetPosition();
    def.maxForce = 100.0F;
    return world.CreateJoint(&def);
  }
  void release(b2Joint* joint) { world.DestroyJoint(joint); }
  void set_gravity(const Vec2& gravity) { world.SetGravity(to_box2d(gravity)); }
  /// A kinematic block.
  Body& add_lift(const Vec2& size, const Vec2& at) {
    Body& lift = add_box(size, at, b2_kinematicBody);
    sleeper->add(lift);
    return lift;
  }
  /// Where it is after the next step of `dt` [s].
  void move_lift(Body& lift, const Vec2& to, double dt) { lift.SetLinearVelocity(to_box2d((to - place(lift)) / dt)); }
  /// Puts it elsewhere at once, not by a motion that throws what lies on it.
  void place_lift(Body& lift, const Vec2& to) { put(lift, to); }
  /// Place and turn of a body, to be loaded again.
  using Saved = b2Transform;
  Saved save(const Body& body) const { return body.GetTransform(); }
  void load(Body& body, const Saved& saved) { body.SetTransform(saved.p, saved.q.GetAngle()); }

  explicit SleepingBox2dScene(const SleeperOptions& options = {}) : sleeper(std::in_place, world, options) {}

  b2Body& drop(const Pose<2>& pose) {
    b2Body& body = add_drop(pose);
    sleeper->add(body);
    return body;
  }
  void keep_awake(Body& body) { body.SetSleepingAllowed(false); }
  SleepChanges<2> step(double dt = drop_dt) {
    sleeper->before_step();
    Box2dScene::step(dt);
    return sleeper->after_step(dt);
  }
  /// A step of the engine alone.
  void step_engine() { Box2dScene::step(); }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) step();
  }

  std::optional<Box2dSleeper> sleeper;
};

}  // namespace talus::test
