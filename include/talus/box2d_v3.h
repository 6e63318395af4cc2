#pragma once
/// @file
/// Sleep body by body in a Box2D world of one's own, version 3.1. Compiled with the program's own Box2D; link
/// talus::core.

#include <box2d/box2d.h>

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "common/math/require.h"
#include "common/sleeper/pile_sleeper.h"
#include "common/sleeper/step_buffer.h"

namespace talus {

/// Puts bodies of a world of Box2D 3 to sleep one by one where they are. A sleeping body is static to Box2D; waking
/// gives type and mass back. User data stay.
///
///     talus::Box2dV3Sleeper sleeper(world);
///     sleeper.add_all(bodies);
///     for (;;) { sleeper.before_step(); b2World_Step(world, dt, 4); sleeper.after_step(dt, 4); }
///
/// Box2D's own sleep is off for watched bodies, since it does not update their contacts. A force on a sleeping body and
/// a joint that it gets have no effect until the program calls wake(). Bodies with joints never sleep, but wake others.
/// Sensors are ignored. A change of type ends the contacts of a body and begins them again without impulses:
/// Box2D reports it as events, and a woken heap sinks by a thousandth of its height. The world must outlive this
/// object, which wakes all bodies when it ends.
class Box2dV3Sleeper {
 public:
  /// Throws InvalidValue on an option outside of its range.
  explicit Box2dV3Sleeper(b2WorldId world, const SleeperOptions& options = {})
      : world_(world), enabled_(options.enabled), core_(from_box2d(b2World_GetGravity(world)), options) {}
  Box2dV3Sleeper(const Box2dV3Sleeper&) = delete;
  Box2dV3Sleeper& operator=(const Box2dV3Sleeper&) = delete;
  ~Box2dV3Sleeper() {
    wake_all();
    for (const Entry& entry : entries_)
      if (enabled_ && B2_IS_NON_NULL(entry.body)) b2Body_EnableSleep(entry.body, entry.slept_alone);
  }

  /// Watches a body with its shapes. Throws InvalidValue on a static one, on one without a solid shape and on one that
  /// is watched.
  Handle add(b2BodyId body) {
    require(b2Body_GetType(body) != b2_staticBody, "body", "static", "must be dynamic or kinematic");
    require(!watches(body), "body", "watched", "must not be watched already");
    require(is_solid(body), "body", "without a solid shape", "must have a shape that is no sensor");
    const BodyRole role = is_kinematic(body) ? BodyRole::kinematic : free_role(body);
    BodyTraits<2> told = traits(body);
    if (observed_) told.pieces = pieces_of(body, from_box2d(b2Body_GetLocalCenterOfMass(body)));
    const Handle handle = core_.add(told, pose({.body = body}), role);
    if (entries_.size() <= handle.slot) entries_.resize(handle.slot + 1);
    entries_[handle.slot] = {.body = body, .slept_alone = b2Body_IsSleepEnabled(body)};
    const auto number = static_cast<std::size_t>(body.index1);
    if (handles_.size() <= number) handles_.resize(number + 1);
    handles_[number] = {body.generation, handle};
    if (enabled_ && role != BodyRole::kinematic) b2Body_EnableSleep(body, false);
    return handle;
  }
  /// Watches those of the bodies that are dynamic or kinematic and not watched yet, but none without a solid shape:
  /// Box2D has no list of all. Returns how many of them never sleep since they have joints.
  int add_all(std::span<const b2BodyId> bodies) {
    int kept_awake = 0;
    for (const b2BodyId body : bodies)
      if (b2Body_GetType(body) != b2_staticBody && !watches(body) && is_solid(body))
        kept_awake += core_.role(add(body)) == BodyRole::stays_awake ? 1 : 0;
    return kept_awake;
  }
  /// Before a body is destroyed, watched or not: what sleeps near it wakes.
  void about_to_remove(b2BodyId body) {
    if (!watches(body)) return wake_near(body);
    const Handle handle = find(body);
    carry_out(core_.wake(handle));
    b2Body_EnableSleep(body, entries_[handle.slot].slept_alone);
    handles_[body.index1] = {};
    carry_out(core_.remove(handle));
    entries_[handle.slot] = {};
  }

  /// Call it directly before each step of Box2D.
  void before_step() {
    if (enabled_) carry_out(core_.set_gravity(from_box2d(b2World_GetGravity(world_))));
  }
  /// Call it directly after each step of Box2D, of `dt` [s] in `substeps`. Returns the changes, which the world has
  /// already; valid until the next call.
  const SleepChanges<2>& after_step(double dt, int substeps = 4) {
    buffer_.clear();
    if (enabled_) read_bodies();
    for (const Handle handle : buffer_.bodies)
      if (entries_[handle.slot].gives_contacts) read_contacts(handle, substeps);
    const SleepChanges<2>& changes = core_.after_step(buffer_.step(dt));
    carry_out(changes);
    return changes;
  }

  /// Before a force, an impulse or a velocity is given to a body.
  void wake(b2BodyId body) { carry_out(core_.wake(handle(body))); }
  /// Wakes all watched bodies.
  void wake_all() { carry_out(core_.wake_all()); }
  /// Wakes what sleeps by a body, such as a static one that is about to move, has moved or is about to lose a shape.
  void wake_near(b2BodyId body) {
    const b2AABB box = b2Body_ComputeAABB(body);
    carry_out(core_.wake_near({from_box2d(box.lowerBound), from_box2d(box.upperBound)}));
  }
  /// After the program has put a body elsewhere.
  void moved(b2BodyId body) { carry_out(core_.moved(handle(body), pose(entry(handle(body))))); }

  /// Whether a body has been added.
  bool watches(b2BodyId body) const { return find(body) != Handle{}; }
  /// Whether a watched body sleeps. Throws InvalidValue on any other.
  bool asleep(b2BodyId body) const { return core_.asleep(handle(body)); }
  /// Throws InvalidValue on a body that is not watched.
  Handle handle(b2BodyId body) const {
    require(watches(body), "body", "not watched", "must have been added");
    return find(body);
  }
  /// The body of a handle. Throws InvalidValue on one that names none.
  b2BodyId body(Handle handle) const { return entry(handle).body; }
  /// Bodies that are watched; kinematic ones count.
  int size() const { return core_.size(); }
  /// Bodies that are watched and awake, without kinematic ones.
  int awake() const { return core_.awake(); }

  /// `observer`, such as a record, the live view or a watch, sees each step from now on (PileSleeper::observe()). It
  /// sees these static bodies, too: Box2D has no list of all.
  void observe(std::unique_ptr<Observer<2>> observer, std::span<const b2BodyId> statics = {}) {
    for (const b2BodyId body : statics) add_static(body);
    if (!std::exchange(observed_, true))
      for (const Entry& entry : entries_)
        if (B2_IS_NON_NULL(entry.body)) show_pieces(entry);
    core_.observe(std::move(observer));
  }
  /// Ends the observers; else the destructor does, after all bodies have woken.
  void end_observers() { core_.end_observers(); }
  /// What decides. Its handle_of() names the body of a warning or a record.
  const PileSleeper<2>& core() const { return core_; }

  /// What a saved program must keep beside its bodies. All bodies that are not kinematic are dynamic when awake.
  std::vector<SavedSleep> snapshot() const { return core_.snapshot(); }
  /// Once the bodies are in their saved places: those that slept sleep again, all others wake.
  void restore(const std::vector<SavedSleep>& saved) {
    std::vector<Pose<2>> poses;
    for (const SavedSleep& one : saved) poses.push_back(pose(entry(one.body)));
    carry_out(core_.restore(saved, poses));
  }

 private:
  /// A watched body, and what it gets back when it wakes.
  struct Entry {
    b2BodyId body = b2_nullBodyId;
    b2MassData mass = {};
    bool gives_contacts = false;  // in this step
    bool slept_alone = true;      // Box2D was allowed to put it to sleep
  };
  /// Box2D uses the numbers of its bodies again, with another generation.
  struct Known {
    std::uint16_t generation = 0;
    Handle handle;
  };

  static Vec2 from_box2d(const b2Vec2& v) { return {v.x, v.y}; }
  static b2Vec2 to_box2d(const Vec2& v) { return {static_cast<float>(v.x()), static_cast<float>(v.y())}; }
  /// Throws InvalidValue if no watched body has this handle.
  const Entry& entry(Handle handle) const {
    require(core_.has(handle), "body", handle.slot, "must be the handle of a body that is watched");
    return entries_[handle.slot];
  }
  /// Of the centre of mass. A sleeping body is static, and static bodies have that at their origin.
  static Pose<2> pose(const Entry& entry) {
    const bool sleeps = b2Body_GetType(entry.body) == b2_staticBody;
    const b2Vec2 centre =
        sleeps ? b2Body_GetWorldPoint(entry.body, entry.mass.center) : b2Body_GetWorldCenterOfMass(entry.body);
    return {from_box2d(centre), Rotation<2>(b2Rot_GetAngle(b2Body_GetRotation(entry.body)))};
  }
  static bool is_kinematic(b2BodyId body) { return b2Body_GetType(body) == b2_kinematicBody; }
  static BodyRole free_role(b2BodyId body) {
    return b2Body_GetJointCount(body) > 0 ? BodyRole::stays_awake : BodyRole::sleeps;
  }

  /// In the axes of its body.
  static Box<2> bounds(b2ShapeId shape) {
    const auto box = [](const b2AABB& aabb) {
      return Box<2>(from_box2d(aabb.lowerBound), from_box2d(aabb.upperBound));
    };
    switch (b2Shape_GetType(shape)) {
      case b2_circleShape: {
        const b2Circle circle = b2Shape_GetCircle(shape);
        return box(b2ComputeCircleAABB(&circle, b2Transform_identity));
      }
      case b2_capsuleShape: {
        const b2Capsule capsule = b2Shape_GetCapsule(shape);
        return box(b2ComputeCapsuleAABB(&capsule, b2Transform_identity));
      }
      case b2_polygonShape: {
        const b2Polygon polygon = b2Shape_GetPolygon(shape);
        return box(b2ComputePolygonAABB(&polygon, b2Transform_identity));
      }
      default: {
        const bool of_chain = b2Shape_GetType(shape) == b2_chainSegmentShape;
        const b2Segment segment = of_chain ? b2Shape_GetChainSegment(shape).segment : b2Shape_GetSegment(shape);
        return box(b2ComputeSegmentAABB(&segment, b2Transform_identity));
      }
    }
  }

  /// Appends the convex pieces of a shape, relative to `centre`. A line becomes a capsule with the radius of Box2D's
  /// slop.
  static void add_pieces(b2ShapeId shape, const Vec2& centre, std::vector<Piece<2>>& pieces) {
    constexpr double slop = 0.005;  // [m]
    const auto add = [&](std::span<const b2Vec2> corners, double radius) {
      HullPiece<2> hull = {.corners = {}, .radius = radius};
      for (const b2Vec2& corner : corners) hull.corners.push_back(from_box2d(corner) - centre);
      add_piece<2>(hull, pieces);
    };
    if (b2Shape_GetType(shape) == b2_circleShape) {
      const b2Circle circle = b2Shape_GetCircle(shape);
      add({&circle.center, 1}, circle.radius);
    } else if (b2Shape_GetType(shape) == b2_capsuleShape) {
      const b2Capsule capsule = b2Shape_GetCapsule(shape);
      add(std::array{capsule.center1, capsule.center2}, capsule.radius);
    } else if (b2Shape_GetType(shape) == b2_polygonShape) {
      const b2Polygon polygon = b2Shape_GetPolygon(shape);
      add({polygon.vertices, static_cast<std::size_t>(polygon.count)}, 0.0);
    } else {
      const bool of_chain = b2Shape_GetType(shape) == b2_chainSegmentShape;
      const b2Segment segment = of_chain ? b2Shape_GetChainSegment(shape).segment : b2Shape_GetSegment(shape);
      add(std::array{segment.point1, segment.point2}, slop);
    }
  }
  static std::vector<b2ShapeId> shapes_of(b2BodyId body) {
    std::vector<b2ShapeId> shapes(b2Body_GetShapeCount(body));
    b2Body_GetShapes(body, shapes.data(), static_cast<int>(shapes.size()));
    return shapes;
  }
  static std::vector<Piece<2>> pieces_of(b2BodyId body, const Vec2& centre) {
    std::vector<Piece<2>> pieces;
    for (const b2ShapeId shape : shapes_of(body))
      if (!b2Shape_IsSensor(shape)) add_pieces(shape, centre, pieces);
    return pieces;
  }
  void show_pieces(const Entry& entry) {
    const Handle shown = find(entry.body);
    core_.set_pieces(shown,
                     pieces_of(entry.body, from_box2d(core_.asleep(shown) ? entry.mass.center
                                                                          : b2Body_GetLocalCenterOfMass(entry.body))));
  }
  void add_static(b2BodyId body) {
    const std::vector<Piece<2>> pieces = pieces_of(body, Vec2::Zero());
    if (!pieces.empty())
      core_.add_static(pieces,
                       {from_box2d(b2Body_GetPosition(body)), Rotation<2>(b2Rot_GetAngle(b2Body_GetRotation(body)))});
  }

  static bool is_solid(b2BodyId body) {
    return !std::ranges::all_of(shapes_of(body), [](b2ShapeId shape) { return b2Shape_IsSensor(shape); });
  }
  /// A body that cannot turn has no inertia. The program may have put the centre of mass outside of the shapes.
  static BodyTraits<2> traits(b2BodyId body) {
    const Vec2 centre = from_box2d(b2Body_GetLocalCenterOfMass(body));
    BodyTraits<2> traits{.mass = b2Body_GetMass(body)};
    traits.bounds.setEmpty();
    for (const b2ShapeId shape : shapes_of(body)) {
      if (b2Shape_IsSensor(shape)) continue;
      traits.bounds.extend(bounds(shape));
      traits.friction = b2Shape_GetFriction(shape);
    }
    traits.bounds.translate(-centre);
    if (!is_kinematic(body)) traits.bounds.extend(Vec2(Vec2::Zero()));
    const double inertia = b2Body_IsFixedRotation(body) ? 0.0 : b2Body_GetRotationalInertia(body);
    traits.inertia(0, 0) = inertia > 0.0 ? inertia : traits.locked_inertia();
    return traits;
  }

  /// The default for a body that is not watched.
  Handle find(b2BodyId body) const {
    const auto number = static_cast<std::size_t>(body.index1);
    if (number >= handles_.size() || handles_[number].generation != body.generation) return {};
    return handles_[number].handle;
  }

  void read_bodies() {
    const bool all = core_.needs_all_contacts();
    for (const Handle handle : core_.followed()) {
      Entry& entry = entries_[handle.slot];
      const bool kinematic = is_kinematic(entry.body);
      if (!kinematic && core_.role(handle) != free_role(entry.body))  // it got its first joint, or lost its last one
        carry_out(core_.set_role(handle, free_role(entry.body)));
      entry.gives_contacts = !kinematic && (all || core_.needs_contacts(handle));
      read_state(handle);
    }
#ifndef NDEBUG
    for (const Known& known : handles_)  // finds sleeping bodies that were moved
      if (known.handle != Handle{} && core_.asleep(known.handle)) read_state(known.handle);
#endif
  }
  void read_state(Handle handle) {
    const b2BodyId body = entries_[handle.slot].body;
    buffer_.add(handle, pose(entries_[handle.slot]), from_box2d(b2Body_GetLinearVelocity(body)),
                Spin<2>(b2Body_GetAngularVelocity(body)));
  }

  void read_contacts(Handle handle, int substeps) {
    const b2BodyId body = entries_[handle.slot].body;
    contacts_.resize(b2Body_GetContactCapacity(body));
    contacts_.resize(b2Body_GetContactData(body, contacts_.data(), static_cast<int>(contacts_.size())));
    for (const b2ContactData& contact : contacts_) read_contact(contact, handle, substeps);
  }
  /// Of the body `a`. A contact of two bodies that both give their contacts is read with that of its first shape.
  void read_contact(const b2ContactData& contact, Handle a, int substeps) {
    const b2BodyId first = b2Shape_GetBody(contact.shapeIdA);
    const bool is_first = find(first) == a;
    const Handle b = is_first ? find(b2Shape_GetBody(contact.shapeIdB)) : find(first);
    if (!is_first && b != Handle{} && entries_[b.slot].gives_contacts) return;
    const b2Manifold& manifold = contact.manifold;
    const double sign = is_first ? -1.0 : 1.0;  // Box2D's normal points from its first shape to its second
    const b2Vec2 centre = b2Body_GetWorldCenterOfMass(first);
    for (int i = 0; i < manifold.pointCount; ++i) {
      const b2ManifoldPoint& point = manifold.points[i];  // impulses are those of the last substep
      buffer_.contacts.push_back(
          {.a = a,
           .b = b,
           .point = from_box2d(b2Add(centre, point.anchorA)),
           .normal = sign * from_box2d(manifold.normal),
           .normal_impulse = substeps * static_cast<double>(point.normalImpulse),
           .friction_impulse = sign * substeps * point.tangentImpulse * from_box2d(b2RightPerp(manifold.normal)),
           .approach_speed = std::max(0.0F, -point.normalVelocity),
           .depth = -point.separation});
    }
  }

  void carry_out(const SleepChanges<2>& changes) {
    for (const SleepChange& change : changes.thaw) thaw(entries_[change.body.slot]);
    for (const GivenVelocity<2>& change : changes.velocities) {
      b2Body_SetLinearVelocity(entries_[change.body.slot].body, to_box2d(change.velocity));
      b2Body_SetAngularVelocity(entries_[change.body.slot].body, static_cast<float>(change.spin[0]));
    }
    for (const SleepChange& change : changes.freeze) freeze(entries_[change.body.slot]);
  }
  static void freeze(Entry& entry) {
    entry.gives_contacts = false;
    entry.mass = b2Body_GetMassData(entry.body);
    b2Body_SetType(entry.body, b2_staticBody);
  }
  /// The mass follows from the shapes unless the program has set it.
  static void thaw(const Entry& entry) {
    b2Body_SetType(entry.body, b2_dynamicBody);
    const b2MassData& mass = entry.mass;
    const b2MassData now = b2Body_GetMassData(entry.body);
    if (now.mass != mass.mass || now.rotationalInertia != mass.rotationalInertia || now.center.x != mass.center.x ||
        now.center.y != mass.center.y)
      b2Body_SetMassData(entry.body, mass);
  }

  b2WorldId world_;
  bool enabled_;
  bool observed_ = false;
  PileSleeper<2> core_;
  std::vector<Known> handles_;           // [number of Box2D]
  std::vector<Entry> entries_;           // [slot]
  std::vector<b2ContactData> contacts_;  // of one body
  StepBuffer<2> buffer_;
};

}  // namespace talus
