#pragma once
// A program of one's own with Box2D 3: a ground, and what falls on it.

#include <list>
#include <optional>

#include "talus/box2d_v3.h"
#include "tests/sleeper/drops.h"

namespace talus::test {

class Box2dV3Scene {
 public:
  static constexpr int substeps = 4;

  Box2dV3Scene() {
    b2WorldDef def = b2DefaultWorldDef();
    def.gravity = {0.0F, -9.81F};
    world = b2CreateWorld(&def);
    ground = add_box({200, 2}, {0, -1}, b2_staticBody);
  }
  Box2dV3Scene(const Box2dV3Scene&) = delete;
  Box2dV3Scene& operator=(const Box2dV3Scene&) = delete;
  ~Box2dV3Scene() { b2DestroyWorld(world); }

  b2BodyId add_box(const Vec2& size, const Vec2& at, b2BodyType type, double angle = 0.0) {
    b2BodyDef def = b2DefaultBodyDef();
    def.type = type;
    def.position = to_box2d(at);
    def.rotation = b2MakeRot(static_cast<float>(angle));
    const b2BodyId body = b2CreateBody(world, &def);
    b2ShapeDef shape = b2DefaultShapeDef();
    shape.density = 1000.0F;
    shape.material.friction = 0.5F;
    const b2Polygon box = b2MakeBox(static_cast<float>(0.5 * size.x()), static_cast<float>(0.5 * size.y()));
    b2CreatePolygonShape(body, &shape, &box);
    return body;
  }
  b2BodyId add_drop(const Pose<2>& pose) {
    return add_box(box_size<2>(), pose.position, b2_dynamicBody, pose.rotation.angle());
  }
  void step(double dt = drop_dt) { b2World_Step(world, static_cast<float>(dt), substeps); }

  static b2Vec2 to_box2d(const Vec2& v) { return {static_cast<float>(v.x()), static_cast<float>(v.y())}; }

  b2WorldId world = b2_nullWorldId;
  b2BodyId ground = b2_nullBodyId;
};

/// With a sleeper: what the three lines in a loop of a program are.
class SleepingBox2dV3Scene : public Box2dV3Scene {
 public:
  /// A body of the program, which keeps its id.
  struct Body {
    b2BodyId id = b2_nullBodyId;
    operator b2BodyId() const { return id; }  // NOLINT: a body is its id
  };
  static constexpr int dimension = 2;

  explicit SleepingBox2dV3Scene(const SleeperOptions& options = {}) : sleeper(std::in_place, world, options) {}
  ~SleepingBox2dV3Scene() { sleeper.reset(); }

  Vec2 place(const Body& body) const {
    const b2Vec2 at = b2Body_GetPosition(body.id);
    return {at.x, at.y};
  }
  Pose<2> pose(const Body& body) const {
    return {place(body), Rotation<2>(b2Rot_GetAngle(b2Body_GetRotation(body.id)))};
  }
  void take_away(Body& body) {
    sleeper->about_to_remove(body.id);
    b2DestroyBody(body.id);
    bodies.remove_if([&](const Body& one) { return &one == &body; });
  }
  void take_away_ground() {
    sleeper->about_to_remove(ground);
    b2DestroyBody(ground);
  }
  void put(Body& body, const Vec2& at) {
    b2Body_SetTransform(body.id, to_box2d(at), b2Body_GetRotation(body.id));
    sleeper->moved(body.id);
  }
  void push(Body& body, const Vec2& velocity) {
    sleeper->wake(body.id);
    b2Body_SetLinearVelocity(body.id, to_box2d(velocity));
  }
  /// Holds a body where it is, until released.
  b2JointId hold(const Body& body) {
    b2MouseJointDef def = b2DefaultMouseJointDef();
    def.bodyIdA = ground;
    def.bodyIdB = body.id;
    def.target = b2Body_GetPosition(body.id);
    def.maxForce = 100.0F;
    return b2CreateMouseJoint(world, &def);
  }
  void release(b2JointId joint) { b2DestroyJoint(joint); }
  void set_gravity(const Vec2& gravity) { b2World_SetGravity(world, to_box2d(gravity)); }
  /// A kinematic block.
  Body& add_lift(const Vec2& size, const Vec2& at) {
    bodies.push_back({add_box(size, at, b2_kinematicBody)});
    sleeper->add(bodies.back().id);
    return bodies.back();
  }
  /// Where it is after the next step of `dt` [s].
  void move_lift(Body& lift, const Vec2& to, double dt) {
    b2Body_SetLinearVelocity(lift.id, to_box2d((to - place(lift)) / dt));
  }
  /// Puts it elsewhere at once, not by a motion that throws what lies on it.
  void place_lift(Body& lift, const Vec2& to) { put(lift, to); }
  /// Place and turn of a body, to be loaded again.
  using Saved = b2Transform;
  Saved save(b2BodyId body) const { return b2Body_GetTransform(body); }
  void load(b2BodyId body, const Saved& saved) { b2Body_SetTransform(body, saved.p, saved.q); }

  Body& drop(const Pose<2>& pose) { return watch(add_drop(pose)); }
  Body& watch(b2BodyId id) {
    bodies.push_back({id});
    sleeper->add(id);
    return bodies.back();
  }
  void keep_awake(Body& body) { b2Body_EnableSleep(body.id, false); }
  SleepChanges<2> step(double dt = drop_dt) {
    sleeper->before_step();
    Box2dV3Scene::step(dt);
    return sleeper->after_step(dt, substeps);
  }
  /// A step of the engine alone.
  void step_engine() { Box2dV3Scene::step(); }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) step();
  }

  std::list<Body> bodies;  // without the ground
  std::optional<Box2dV3Sleeper> sleeper;
};

}  // namespace talus::test
