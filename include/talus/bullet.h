#pragma once
/// @file
/// Sleep body by body in a Bullet world of one's own. Compiled with the program's own Bullet, 3.24 or similar, in
/// single or double precision; link talus::core.

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "common/math/require.h"
#include "common/sleeper/pile_sleeper.h"
#include "common/sleeper/step_buffer.h"

namespace talus {

/// Puts bodies of a btDiscreteDynamicsWorld to sleep one by one where they are. A sleeping body is static to Bullet:
/// its mass is 0, its manifolds and their impulses stay, pointers and user data too. Waking restores mass and
/// activation.
///
///     talus::BulletSleeper sleeper(world);
///     sleeper.add_all();
///     for (;;) { sleeper.before_step(); world.stepSimulation(dt, 0); sleeper.after_step(dt); }
///
/// With substeps of Bullet, call both functions from the two internal tick callbacks. Forces on a sleeping body do
/// nothing: call wake() first. Bodies with constraints that are enabled never sleep, but wake others. Contacts of
/// objects without contact response are ignored. The world and its bodies must outlive this object, which wakes
/// all when it ends.
class BulletSleeper {
 public:
  /// Throws InvalidValue on an option outside of its range.
  explicit BulletSleeper(btDiscreteDynamicsWorld& world, const SleeperOptions& options = {})
      : world_(world), enabled_(options.enabled), core_(from_bullet(world.getGravity()), options) {}
  BulletSleeper(const BulletSleeper&) = delete;
  BulletSleeper& operator=(const BulletSleeper&) = delete;
  ~BulletSleeper() { wake_all(); }

  /// Watches a body of the world, dynamic or kinematic. Throws InvalidValue on a static one, on one that is in no
  /// world, on one whose shape is empty and on one that is watched.
  Handle add(btRigidBody& body) {
    require(body.getWorldArrayIndex() >= 0, "body", "in no world", "must be in the world before it is watched");
    require(!never_moves(body), "body", "static", "must be dynamic or kinematic");
    require(!handles_.contains(&body), "body", "watched", "must not be watched already");
    require(is_solid(body), "body", "without a solid shape", "must have a shape that is not empty");
    const BodyRole role = body.isKinematicObject() ? BodyRole::kinematic : BodyRole::sleeps;
    BodyTraits<3> told = traits(body);
    if (observed_) told.pieces = pieces_of(body);
    const Handle handle = core_.add(told, pose(body), role);
    if (entries_.size() <= handle.slot) entries_.resize(handle.slot + 1);
    entries_[handle.slot] = {.body = &body};
    handles_[&body] = handle;
    remember(body, handle);
    return handle;
  }
  /// Watches all dynamic and kinematic bodies that are not watched yet, but none whose shape is empty. Returns how many
  /// of them never sleep since they have constraints.
  int add_all() {
    std::vector<Handle> added;
    for (int i = 0; i < world_.getNumCollisionObjects(); ++i) {
      btRigidBody* body = btRigidBody::upcast(world_.getCollisionObjectArray()[i]);
      if (body != nullptr && !never_moves(*body) && !handles_.contains(body) && is_solid(*body))
        added.push_back(add(*body));
    }
    follow_constraints();
    const auto stays_awake = [&](Handle one) { return core_.role(one) == BodyRole::stays_awake; };
    return static_cast<int>(std::ranges::count_if(added, stays_awake));
  }
  /// Before an object is taken out of the world, watched or not: what sleeps near it wakes.
  void about_to_remove(btCollisionObject& object) {
    const auto found = handles_.find(&object);
    if (found == handles_.end()) return wake_near(object);
    const Handle handle = found->second;
    carry_out(core_.wake(handle));
    forget(object);
    handles_.erase(found);
    carry_out(core_.remove(handle));
    entries_[handle.slot] = {};
  }

  /// Call it directly before each step of Bullet. Throws InvalidValue if a body that is watched and awake is in no
  /// world any more.
  void before_step() {
    if (!enabled_) return;
    carry_out(core_.set_gravity(from_bullet(world_.getGravity())));
    follow_constraints();
    all_contacts_ = core_.needs_all_contacts();
    for (const Handle handle : core_.followed()) {
      Entry& entry = entries_[handle.slot];
      require(entry.body->getWorldArrayIndex() >= 0, "body", handle.slot,
              "must be in the world: call about_to_remove() before it is taken out");
      if (!all_contacts_) continue;  // the speeds are those at which bodies meet sleeping ones
      entry.velocity = entry.body->getLinearVelocity();
      entry.spin = entry.body->getAngularVelocity();
    }
  }
  /// Call it directly after each step of Bullet, of `dt` [s]. Returns the changes, which the world has already; valid
  /// until the next call.
  const SleepChanges<3>& after_step(double dt) {
    buffer_.clear();
    if (enabled_ && read_bodies()) read_contacts();
    const SleepChanges<3>& changes = core_.after_step(buffer_.step(dt));
    carry_out(changes);
    return changes;
  }

  /// Before a force, an impulse or a velocity is given to a body.
  void wake(btRigidBody& body) { carry_out(core_.wake(handle(body))); }
  /// Wakes all watched bodies.
  void wake_all() { carry_out(core_.wake_all()); }
  /// Wakes what sleeps by an object that is not watched, such as a static one that is about to move or has moved.
  void wake_near(btCollisionObject& object) {
    btVector3 low;
    btVector3 high;
    object.getCollisionShape()->getAabb(object.getWorldTransform(), low, high);
    carry_out(core_.wake_near({from_bullet(low), from_bullet(high)}));
  }
  /// After the program has put a body elsewhere.
  void moved(btRigidBody& body) { carry_out(core_.moved(handle(body), pose(body))); }

  /// Whether a body has been added.
  bool watches(const btRigidBody& body) const { return handles_.contains(&body); }
  /// Throws InvalidValue on a body that is not watched.
  bool asleep(const btRigidBody& body) const { return core_.asleep(handle(body)); }
  /// Throws InvalidValue on a body that is not watched.
  Handle handle(const btRigidBody& body) const {
    const auto found = handles_.find(&body);
    require(found != handles_.end(), "body", "not watched", "must have been added");
    return found->second;
  }
  /// Throws InvalidValue if no watched body has this handle.
  btRigidBody& body(Handle handle) const {
    require(core_.has(handle), "body", handle.slot, "must be the handle of a body that is watched");
    return *entries_[handle.slot].body;
  }
  /// Bodies that are watched; kinematic ones count.
  int size() const { return core_.size(); }
  /// Bodies that are watched and awake, without kinematic ones.
  int awake() const { return core_.awake(); }

  /// `observer`, such as a record, the live view or a watch, sees each step from now on (PileSleeper::observe()). It
  /// sees the static planes, convex shapes and compounds that there are at the first call, too.
  void observe(std::unique_ptr<Observer<3>> observer) {
    if (!std::exchange(observed_, true)) show_all();
    core_.observe(std::move(observer));
  }
  /// Ends the observers; else the destructor does, after all bodies have woken.
  void end_observers() { core_.end_observers(); }
  /// What decides. Its handle_of() names the body of a warning or a record.
  const PileSleeper<3>& core() const { return core_; }

  /// What a saved program must keep beside its bodies and their masses.
  std::vector<SavedSleep> snapshot() const { return core_.snapshot(); }
  /// Mass [kg] of a watched body, also of a sleeping one, which has none in Bullet. Throws InvalidValue on any other
  /// body.
  btScalar mass(const btRigidBody& body) const {
    return asleep(body) ? entries_[handle(body).slot].mass : body.getMass();
  }
  /// Once the bodies are in their saved places: those that slept sleep again, all others wake.
  void restore(const std::vector<SavedSleep>& saved) {
    std::vector<Pose<3>> poses;
    for (const SavedSleep& one : saved) poses.push_back(pose(body(one.body)));
    carry_out(core_.restore(saved, poses));
  }

 private:
  /// A watched body: its motion before the step, and what it gets back when it wakes.
  struct Entry {
    btRigidBody* body = nullptr;
    bool needs_contacts = false;  // in this step, even if not all contacts are needed
    btVector3 velocity = btVector3(0, 0, 0);
    btVector3 spin = btVector3(0, 0, 0);
    btScalar mass = 0;
    btVector3 inertia = btVector3(0, 0, 0);
    btVector3 gravity = btVector3(0, 0, 0);  // of the world when it fell asleep
    int activation = ACTIVE_TAG;
  };
  /// The object at a place of Bullet's list when it was last looked up.
  struct Known {
    const btCollisionObject* object = nullptr;
    Handle handle;
  };

  static Vec3 from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
  static btVector3 to_bullet(const Vec3& v) {
    return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
  }
  static Pose<3> pose(const btRigidBody& body) { return pose(body.getWorldTransform()); }
  /// Kinematic bodies often count as static too.
  static bool never_moves(const btCollisionObject& object) {
    return object.isStaticObject() && !object.isKinematicObject();
  }

  static Pose<3> pose(const btTransform& at) {
    const btQuaternion q = at.getRotation();
    return {from_bullet(at.getOrigin()), Rotation<3>(q.w(), q.x(), q.y(), q.z())};
  }
  /// The convex pieces of a shape that is placed in other axes. Nothing of a mesh.
  static void add_pieces(const btCollisionShape& shape, const btTransform& at, std::vector<Piece<3>>& pieces) {
    const auto corner = [&](const btVector3& v) { return from_bullet(at * v); };
    if (shape.isCompound()) {
      const auto& compound = static_cast<const btCompoundShape&>(shape);
      for (int i = 0; i < compound.getNumChildShapes(); ++i)
        add_pieces(*compound.getChildShape(i), at * compound.getChildTransform(i), pieces);
    } else if (shape.getShapeType() == STATIC_PLANE_PROXYTYPE) {
      add_piece<3>(plane_piece(static_cast<const btStaticPlaneShape&>(shape), at), pieces);
    } else if (shape.getShapeType() == BOX_SHAPE_PROXYTYPE) {
      const auto& box = static_cast<const btBoxShape&>(shape);
      add_piece<3>(BoxPiece<3>{.pose = pose(at), .half = from_bullet(box.getHalfExtentsWithMargin())}, pieces);
    } else if (shape.getShapeType() == SPHERE_SHAPE_PROXYTYPE) {
      const auto& ball = static_cast<const btSphereShape&>(shape);
      add_piece<3>(HullPiece<3>{.corners = {corner({0, 0, 0})}, .radius = ball.getRadius()}, pieces);
    } else if (shape.getShapeType() == CAPSULE_SHAPE_PROXYTYPE) {
      const auto& capsule = static_cast<const btCapsuleShape&>(shape);
      btVector3 end(0, 0, 0);
      end[capsule.getUpAxis()] = capsule.getHalfHeight();
      add_piece<3>(HullPiece<3>{.corners = {corner(-end), corner(end)}, .radius = capsule.getRadius()}, pieces);
    } else if (shape.isConvex()) {
      HullPiece<3> hull;
      for (const btVector3& v : outline(static_cast<const btConvexShape&>(shape))) hull.corners.push_back(corner(v));
      add_piece<3>(hull, pieces);
    }
  }
  /// A thin plate below the plane about the point nearest to the origin.
  static BoxPiece<3> plane_piece(const btStaticPlaneShape& plane, const btTransform& at) {
    constexpr double size = 100.0;      // [m]
    constexpr double thickness = 0.01;  // [m]
    const Vec3 normal = from_bullet(plane.getPlaneNormal());
    const Pose<3> placed = pose(at);
    return {.pose = {placed * ((plane.getPlaneConstant() - 0.5 * thickness) * normal),
                     placed.rotation * Rotation<3>::FromTwoVectors(Vec3::UnitZ(), normal)},
            .half = 0.5 * Vec3(size, size, thickness)};
  }
  /// Points of a convex shape that lie farthest in directions all around.
  static std::vector<btVector3> outline(const btConvexShape& shape) {
    constexpr int directions = 100;
    constexpr double golden_angle = 2.399963;  // [rad]
    std::vector<btVector3> points;
    for (int i = 0; i < directions; ++i) {
      const double z = (2.0 * i + 1.0) / directions - 1.0;
      const double r = std::sqrt(1.0 - z * z);
      const btVector3 point = shape.localGetSupportingVertex(
          to_bullet({r * std::cos(golden_angle * i), r * std::sin(golden_angle * i), z}));
      if (std::ranges::find(points, point) == points.end()) points.push_back(point);
    }
    return points;
  }
  static std::vector<Piece<3>> pieces_of(const btCollisionObject& object) {
    std::vector<Piece<3>> pieces;
    add_pieces(*object.getCollisionShape(), btTransform::getIdentity(), pieces);
    return pieces;
  }
  void show_all() {
    for (const Entry& entry : entries_)
      if (entry.body != nullptr) core_.set_pieces(handle(*entry.body), pieces_of(*entry.body));
    for (int i = 0; i < world_.getNumCollisionObjects(); ++i) {
      const btCollisionObject& object = *world_.getCollisionObjectArray()[i];
      if (!never_moves(object) || handles_.contains(&object)) continue;
      const std::vector<Piece<3>> pieces = pieces_of(object);
      if (!pieces.empty()) core_.add_static(pieces, pose(object.getWorldTransform()));
    }
  }

  /// In the axes of the body.
  static Box<3> bounds(const btRigidBody& body) {
    btVector3 low;
    btVector3 high;
    body.getCollisionShape()->getAabb(btTransform::getIdentity(), low, high);
    return {from_bullet(low), from_bullet(high)};
  }
  /// A compound without children is a point.
  static bool is_solid(const btRigidBody& body) {
    return body.getCollisionShape()->getShapeType() != EMPTY_SHAPE_PROXYTYPE && bounds(body).sizes().minCoeff() > 0.0;
  }
  /// An axis about which a body cannot turn has no inverse inertia. The program may have put the centre of mass outside
  /// of the shape.
  static BodyTraits<3> traits(const btRigidBody& body) {
    BodyTraits<3> traits{.mass = body.getMass(), .bounds = bounds(body)};
    if (!body.isKinematicObject()) traits.bounds.extend(Vec3(Vec3::Zero()));
    for (int axis = 0; axis < 3; ++axis) {
      const btScalar inverse = body.getInvInertiaDiagLocal()[axis];
      traits.inertia(axis, axis) = inverse > 0 ? 1.0 / inverse : traits.locked_inertia();
    }
    traits.friction = body.getFriction() * body.getFriction();  // Bullet multiplies those of two bodies
    return traits;
  }

  void remember(const btCollisionObject& object, Handle handle) {
    const auto place = static_cast<std::size_t>(object.getWorldArrayIndex());
    if (known_.size() <= place) known_.resize(place + 1);
    known_[place] = {&object, handle};
  }
  void forget(const btCollisionObject& object) {
    for (Known& known : known_)
      if (known.object == &object) known = {};
  }
  /// The default for an object that is not watched. Places in Bullet's list change when objects are removed.
  Handle find(const btCollisionObject& object) {
    const bool in_world = object.getWorldArrayIndex() >= 0;  // a constraint may name one that is not
    const auto place = static_cast<std::size_t>(object.getWorldArrayIndex());
    if (place < known_.size() && known_[place].object == &object) return known_[place].handle;
    const auto found = handles_.find(&object);
    const Handle handle = found == handles_.end() ? Handle{} : found->second;
    if (found != handles_.end() && in_world) remember(object, handle);
    return handle;
  }

  /// Returns whether any contacts are needed.
  bool read_bodies() {
    bool contacts = all_contacts_;
    for (const Handle handle : core_.followed()) {
      read_state(handle);
      if (!all_contacts_) contacts |= entries_[handle.slot].needs_contacts = core_.needs_contacts(handle);
    }
#ifndef NDEBUG
    for (const auto& [object, handle] :
         handles_)  // finds sleeping bodies that were moved; nothing depends on the order
      if (core_.asleep(handle)) read_state(handle);
#endif
    return contacts;
  }
  /// Keeps bodies awake as long as they have an enabled constraint. Reads the constraints of the world:
  /// Bullet's list of a body has only those that switch off the collision between the two bodies that they join.
  void follow_constraints() {
    std::vector<Handle> held;
    for (int i = 0; i < world_.getNumConstraints(); ++i) {
      const btTypedConstraint& constraint = *world_.getConstraint(i);
      if (!constraint.isEnabled()) continue;
      for (const btRigidBody* body : {&constraint.getRigidBodyA(), &constraint.getRigidBodyB()}) {
        const Handle handle = find(*body);
        if (handle != Handle{} && core_.role(handle) != BodyRole::kinematic) held.push_back(handle);
      }
    }
    std::ranges::sort(held);
    held.erase(std::unique(held.begin(), held.end()), held.end());
    for (const Handle handle : held_)
      if (core_.has(handle) && !std::ranges::binary_search(held, handle))
        carry_out(core_.set_role(handle, BodyRole::sleeps));
    for (const Handle handle : held)
      if (core_.role(handle) == BodyRole::sleeps) carry_out(core_.set_role(handle, BodyRole::stays_awake));
    held_ = std::move(held);
  }
  void read_state(Handle handle) {
    const btRigidBody& body = *entries_[handle.slot].body;
    buffer_.add(handle, pose(body), from_bullet(body.getLinearVelocity()), from_bullet(body.getAngularVelocity()));
  }

  bool needs_contacts(Handle handle) const {
    return handle != Handle{} && (all_contacts_ || entries_[handle.slot].needs_contacts);
  }
  /// Those that Bullet itself has put to sleep too: their impulses are those that hold them.
  static bool moves(const btCollisionObject& object) { return !object.isStaticOrKinematicObject(); }
  void read_contacts() {
    btDispatcher& dispatcher = *world_.getDispatcher();
    for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
      const btCollisionObject& a = *manifold.getBody0();
      const btCollisionObject& b = *manifold.getBody1();
      if (manifold.getNumContacts() == 0 || (!moves(a) && !moves(b))) continue;
      if (a.hasContactResponse() && b.hasContactResponse()) read_manifold(manifold, a, b);
    }
  }
  bool sleeps(Handle handle) const { return handle != Handle{} && core_.asleep(handle); }
  /// A support that has just woken may carry nothing in its first step, and be gone in the next: it counts too.
  void read_manifold(const btPersistentManifold& manifold, const btCollisionObject& a, const btCollisionObject& b) {
    const Handle first = find(a);
    const Handle second = find(b);
    if (!needs_contacts(first) && !needs_contacts(second)) return;
    const bool swap = first == Handle{};
    const double sign = swap ? -1.0 : 1.0;
    for (int i = 0; i < manifold.getNumContacts(); ++i) {
      const btManifoldPoint& point = manifold.getContactPoint(i);
      if (point.getDistance() > 0 && point.m_appliedImpulse <= 0 && !sleeps(first) && !sleeps(second)) continue;
      const btVector3& where = point.getPositionWorldOnB();
      const btVector3 friction = point.m_lateralFrictionDir1 * point.m_appliedImpulseLateral1 +
                                 point.m_lateralFrictionDir2 * point.m_appliedImpulseLateral2;
      const btVector3 approach =
          all_contacts_ ? velocity_before(b, second, where) - velocity_before(a, first, where) : btVector3(0, 0, 0);
      buffer_.contacts.push_back(
          {.a = swap ? second : first,
           .b = swap ? first : second,
           .point = from_bullet(where),
           .normal = sign * from_bullet(point.m_normalWorldOnB),
           .normal_impulse = std::max(0.0, static_cast<double>(point.m_appliedImpulse)),
           .friction_impulse = sign * from_bullet(friction),
           .approach_speed = std::max(0.0, static_cast<double>(point.m_normalWorldOnB.dot(approach))),
           .depth = -point.getDistance()});
    }
  }
  /// Of a point of an object before the step. One that is not watched is taken as it is.
  btVector3 velocity_before(const btCollisionObject& object, Handle handle, const btVector3& where) const {
    const btVector3 arm = where - object.getWorldTransform().getOrigin();
    if (never_moves(object)) return {0, 0, 0};
    if (handle != Handle{} && !object.isKinematicObject()) {
      const Entry& entry = entries_[handle.slot];
      return entry.velocity + entry.spin.cross(arm);
    }
    const btRigidBody* body = btRigidBody::upcast(&object);
    return body == nullptr ? btVector3(0, 0, 0) : body->getLinearVelocity() + body->getAngularVelocity().cross(arm);
  }

  void carry_out(const SleepChanges<3>& changes) {
    for (const SleepChange& change : changes.thaw) thaw(entries_[change.body.slot]);
    for (const GivenVelocity<3>& change : changes.velocities) {
      entries_[change.body.slot].body->setLinearVelocity(to_bullet(change.velocity));
      entries_[change.body.slot].body->setAngularVelocity(to_bullet(change.spin));
    }
    for (const SleepChange& change : changes.freeze) freeze(entries_[change.body.slot]);
  }
  void freeze(Entry& entry) const {
    btRigidBody& body = *entry.body;
    entry.mass = body.getMass();
    entry.inertia = body.getLocalInertia();
    entry.gravity = world_.getGravity();
    entry.activation = body.getActivationState();
    stop(body);
    // While it still counts as movable: the program sees it where it sleeps, not where Bullet extrapolated it to.
    body.setInterpolationWorldTransform(body.getWorldTransform());
    world_.synchronizeSingleMotionState(&body);
    body.setMassProps(0, btVector3(0, 0, 0));
    body.updateInertiaTensor();
    body.forceActivationState(ISLAND_SLEEPING);
  }
  /// Bullet gives a new gravity to active bodies only.
  void thaw(const Entry& entry) const {
    btRigidBody& body = *entry.body;
    body.setMassProps(entry.mass, entry.inertia);
    body.updateInertiaTensor();
    if (entry.gravity != world_.getGravity() && (body.getFlags() & BT_DISABLE_WORLD_GRAVITY) == 0)
      body.setGravity(world_.getGravity());
    stop(body);
    body.forceActivationState(entry.activation == DISABLE_DEACTIVATION ? DISABLE_DEACTIVATION : ACTIVE_TAG);
    body.setDeactivationTime(0);
  }
  static void stop(btRigidBody& body) {
    body.setLinearVelocity(btVector3(0, 0, 0));
    body.setAngularVelocity(btVector3(0, 0, 0));
    body.setInterpolationLinearVelocity(btVector3(0, 0, 0));
    body.setInterpolationAngularVelocity(btVector3(0, 0, 0));
  }

  btDiscreteDynamicsWorld& world_;
  bool enabled_;
  bool all_contacts_ = true;  // are needed in this step
  bool observed_ = false;
  PileSleeper<3> core_;
  std::vector<Handle> held_;  // by constraints, in order
  std::unordered_map<const btCollisionObject*, Handle> handles_;
  std::vector<Known> known_;    // [place in Bullet's list]
  std::vector<Entry> entries_;  // [slot]
  StepBuffer<3> buffer_;
};

}  // namespace talus
