#pragma once
/// @file
/// Sleep body by body in a Box2D world of one's own. Compiled with the program's own Box2D 2.4; link talus::core.

#include <box2d/box2d.h>

#include <algorithm>
#include <array>
#include <compare>
#include <initializer_list>
#include <map>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "common/math/require.h"
#include "common/sleeper/pile_sleeper.h"
#include "common/sleeper/step_buffer.h"

namespace talus {

/// Impulses of contacts that Box2D destroys when a body changes its type. Without them a woken heap slumps.
class Box2dImpulses {
 public:
  /// Keeps the impulses of a body's contacts. Call it before its type changes.
  void save(b2Body& body) {
    for (b2ContactEdge* edge = body.GetContactList(); edge != nullptr; edge = edge->next) save(*edge->contact);
  }
  /// A body is about to wake: the contacts that it had while it slept will begin again.
  void expect(const b2Body& body) {
    if (const auto found = of_body_.find(&body); found != of_body_.end())
      waiting_.insert(waiting_.end(), found->second.begin(), found->second.end());
  }
  /// A body is about to leave the world.
  void forget(const b2Body& body) {
    if (const auto found = of_body_.find(&body); found != of_body_.end())
      for (const Key& key : std::vector(found->second)) erase(key);
  }
  /// From PreSolve of a contact that has just begun.
  void apply(b2Contact& contact) {
    const auto found = saved_.find(key_of(contact));
    if (found == saved_.end() || found->second.bodies != bodies_of(contact)) return;
    b2Manifold& manifold = *contact.GetManifold();
    for (int i = 0; i < manifold.pointCount; ++i) {
      b2ManifoldPoint& point = manifold.points[i];
      for (const Point& saved : found->second.points) {
        if (saved.feature != point.id.key) continue;
        point.normalImpulse = saved.normal;
        point.tangentImpulse = saved.tangent;
      }
    }
  }
  /// After a step: what has not begun again by now will not, except between sleeping bodies, which have no contacts.
  void end_step() {
    for (const Key& key : waiting_)
      if (const auto found = saved_.find(key); found != saved_.end() && !sleeps(found->second)) erase(key);
    waiting_.clear();
  }

 private:
  /// Addresses alone: the program may have destroyed a fixture.
  struct Key {
    const b2Fixture* a = nullptr;
    const b2Fixture* b = nullptr;
    int child_a = 0;
    int child_b = 0;
    auto operator<=>(const Key&) const = default;
  };
  /// Its feature names the corner and the side that it comes from.
  struct Point {
    static constexpr std::uint32_t no_feature = 0xffffffff;
    std::uint32_t feature = no_feature;
    float normal = 0.0F;   // [N s]
    float tangent = 0.0F;  // [N s]
  };
  using Bodies = std::array<const b2Body*, 2>;
  struct Contact {
    Bodies bodies;
    std::array<Point, b2_maxManifoldPoints> points;
  };

  /// Fixtures keep their order in contacts as long as they exist.
  static Key key_of(b2Contact& contact) {
    return {contact.GetFixtureA(), contact.GetFixtureB(), contact.GetChildIndexA(), contact.GetChildIndexB()};
  }
  static Bodies bodies_of(b2Contact& contact) {
    return {contact.GetFixtureA()->GetBody(), contact.GetFixtureB()->GetBody()};
  }
  static bool sleeps(const Contact& saved) {
    return std::ranges::all_of(saved.bodies, [](const b2Body* body) { return body->GetType() == b2_staticBody; });
  }

  void save(b2Contact& contact) {
    if (!contact.IsTouching()) return;
    const Key key = key_of(contact);
    Contact kept{.bodies = bodies_of(contact), .points = {}};
    const b2Manifold& manifold = *contact.GetManifold();
    for (int i = 0; i < manifold.pointCount; ++i)
      kept.points[i] = {manifold.points[i].id.key, manifold.points[i].normalImpulse, manifold.points[i].tangentImpulse};
    waiting_.push_back(key);
    if (saved_.contains(key)) erase(key);
    saved_[key] = kept;
    for (const b2Body* body : kept.bodies) of_body_[body].push_back(key);
  }
  void erase(const Key& key) {
    for (const b2Body* body : saved_.at(key).bodies) {
      const auto found = of_body_.find(body);
      std::erase(found->second, key);
      if (found->second.empty()) of_body_.erase(found);
    }
    saved_.erase(key);
  }

  std::map<Key, Contact> saved_;  // looked up only, so no address reaches a result
  std::unordered_map<const b2Body*, std::vector<Key>> of_body_;
  std::vector<Key> waiting_;  // to begin again in the next step
};

/// Puts bodies of a b2World to sleep one by one where they are. A sleeping body is static to Box2D; waking gives type
/// and mass back, and the impulses of its contacts. User data stay, and the program's own contact listener is called as
/// ever.
///
///     talus::Box2dSleeper sleeper(world);
///     sleeper.add_all();
///     for (;;) { sleeper.before_step(); world.Step(dt, 8, 3); sleeper.after_step(dt); }
///
/// Box2D's own sleep is off for watched bodies, since it does not update their contacts. A force on a sleeping body and
/// a joint that it gets have no effect until the program calls wake(). Bodies with joints never sleep, but wake others.
/// Sensors are ignored. A world has one sleeper that is on: a second one throws InvalidValue in before_step(). The
/// world must outlive this object, which wakes all bodies when it ends.
class Box2dSleeper {
 public:
  /// Throws InvalidValue on an option outside of its range.
  explicit Box2dSleeper(b2World& world, const SleeperOptions& options = {})
      : world_(world), enabled_(options.enabled), core_(from_box2d(world.GetGravity()), options) {}
  Box2dSleeper(const Box2dSleeper&) = delete;
  Box2dSleeper& operator=(const Box2dSleeper&) = delete;
  ~Box2dSleeper() {
    wake_all();
    for (const auto& [body, handle] : handles_)
      if (enabled_) entries_[handle.slot].body->SetSleepingAllowed(entries_[handle.slot].slept_alone);
    if (world_.GetContactManager().m_contactListener == &listener_) world_.SetContactListener(listener_.next);
  }

  /// Watches a body with its fixtures. Throws InvalidValue on a static one, on one without a solid fixture and on one
  /// that is watched.
  Handle add(b2Body& body) {
    require(body.GetType() != b2_staticBody, "body", "static", "must be dynamic or kinematic");
    require(!handles_.contains(&body), "body", "watched", "must not be watched already");
    require(is_solid(body), "body", "without a solid fixture", "must have a fixture that is no sensor");
    const BodyRole role = body.GetType() == b2_kinematicBody ? BodyRole::kinematic : free_role(body);
    BodyTraits<2> told = traits(body);
    if (observed_) told.pieces = pieces_of(body, from_box2d(body.GetLocalCenter()));
    const Handle handle = core_.add(told, pose({.body = &body}), role);
    if (entries_.size() <= handle.slot) entries_.resize(handle.slot + 1);
    entries_[handle.slot] = {.body = &body, .slept_alone = body.IsSleepingAllowed()};
    handles_[&body] = handle;
    if (enabled_ && role != BodyRole::kinematic) body.SetSleepingAllowed(false);
    return handle;
  }
  /// Watches all dynamic and kinematic bodies that are not watched yet, but none without a solid fixture. Returns how
  /// many of them never sleep since they have joints.
  int add_all() {
    int kept_awake = 0;
    for (b2Body* body = world_.GetBodyList(); body != nullptr; body = body->GetNext())
      if (body->GetType() != b2_staticBody && !handles_.contains(body) && is_solid(*body))
        kept_awake += core_.role(add(*body)) == BodyRole::stays_awake ? 1 : 0;
    return kept_awake;
  }
  /// Before a body is destroyed, watched or not: what sleeps near it wakes.
  void about_to_remove(b2Body& body) {
    const auto found = handles_.find(&body);
    if (found == handles_.end()) {
      wake_near(body);
      return impulses_.forget(body);
    }
    const Handle handle = found->second;
    carry_out(core_.wake(handle));
    body.SetSleepingAllowed(entries_[handle.slot].slept_alone);
    handles_.erase(found);
    carry_out(core_.remove(handle));
    impulses_.forget(body);  // after its neighbours have woken, which keeps the impulses of their contacts with it
    entries_[handle.slot] = {};
  }

  /// Call it directly before each step of Box2D.
  void before_step() {
    if (!enabled_) return;
    listen();
    carry_out(core_.set_gravity(from_box2d(world_.GetGravity())));
    all_contacts_ = core_.needs_all_contacts();
    listener_.start_step(all_contacts_);
    if (!all_contacts_) return;  // the speeds are those at which bodies meet sleeping ones
    for (const Handle handle : core_.followed()) {
      Entry& entry = entries_[handle.slot];
      entry.velocity = entry.body->GetLinearVelocity();
      entry.spin = entry.body->GetAngularVelocity();
    }
  }
  /// Call it directly after each step of Box2D, of `dt` [s]. Returns the changes, which the world has already; valid
  /// until the next call.
  const SleepChanges<2>& after_step(double dt) {
    impulses_.end_step();
    buffer_.clear();
    if (enabled_) read_bodies();
    if (enabled_) read_contacts();
    const SleepChanges<2>& changes = core_.after_step(buffer_.step(dt));
    carry_out(changes);
    return changes;
  }

  /// Before a force, an impulse or a velocity is given to a body.
  void wake(b2Body& body) { carry_out(core_.wake(handle(body))); }
  /// Wakes all watched bodies.
  void wake_all() { carry_out(core_.wake_all()); }
  /// Wakes what sleeps by a body, such as a static one that is about to move, has moved or is about to lose a fixture.
  void wake_near(b2Body& body) {
    for (b2Fixture* fixture = body.GetFixtureList(); fixture != nullptr; fixture = fixture->GetNext())
      carry_out(core_.wake_near(bounds(*fixture, body.GetTransform())));
  }
  /// After the program has put a body elsewhere.
  void moved(b2Body& body) { carry_out(core_.moved(handle(body), pose(entry(handle(body))))); }

  /// Whether a body has been added.
  bool watches(const b2Body& body) const { return handles_.contains(&body); }
  /// Throws InvalidValue on a body that is not watched.
  bool asleep(const b2Body& body) const { return core_.asleep(handle(body)); }
  /// Throws InvalidValue on a body that is not watched.
  Handle handle(const b2Body& body) const {
    const auto found = handles_.find(&body);
    require(found != handles_.end(), "body", "not watched", "must have been added");
    return found->second;
  }
  /// Throws InvalidValue if no watched body has this handle.
  b2Body& body(Handle handle) const { return *entry(handle).body; }
  /// Bodies that are watched; kinematic ones count.
  int size() const { return core_.size(); }
  /// Bodies that are watched and awake, without kinematic ones.
  int awake() const { return core_.awake(); }

  /// `observer`, such as a record, the live view or a watch, sees each step from now on (PileSleeper::observe()). It
  /// sees the static bodies that there are at the first call, too.
  void observe(std::unique_ptr<Observer<2>> observer) {
    if (!std::exchange(observed_, true)) show_all();
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
  /// A watched body: its motion before the step, and what it gets back when it wakes.
  struct Entry {
    b2Body* body = nullptr;
    b2Vec2 velocity = b2Vec2_zero;
    float spin = 0.0F;
    b2MassData mass = {0.0F, b2Vec2_zero, 0.0F};
    bool slept_alone = true;  // Box2D was allowed to put it to sleep
  };

  /// Calls the program's listener each time that Box2D calls it.
  class Listener final : public b2ContactListener {
   public:
    explicit Listener(Box2dImpulses& impulses) : impulses_(impulses) {}
    void BeginContact(b2Contact* contact) override {
      if (next != nullptr) next->BeginContact(contact);
    }
    void EndContact(b2Contact* contact) override {
      if (next != nullptr) next->EndContact(contact);
    }
    void PreSolve(b2Contact* contact, const b2Manifold* before) override {
      if (before->pointCount == 0) impulses_.apply(*contact);
      if (next != nullptr) next->PreSolve(contact, before);
    }
    void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override {
      if (recording_ && is_searched(*contact)) add(*contact, *impulse);
      if (next != nullptr) next->PostSolve(contact, impulse);
    }
    void start_step(bool records) {
      recording_ = records;
      given_.clear();
    }
    /// Of point `i` of a contact in this step: normal and tangent.
    b2Vec2 impulse(b2Contact& contact, int i) const {
      if (const auto found = given_.find(&contact); found != given_.end()) return found->second[i];
      const b2ManifoldPoint& point = contact.GetManifold()->points[i];
      return {point.normalImpulse, point.tangentImpulse};
    }
    b2ContactListener* next = nullptr;

   private:
    using Impulses = std::array<b2Vec2, b2_maxManifoldPoints>;

    /// Whether Box2D searches for the time of impact of the two. The impulses of that impact are in no manifold.
    static bool is_searched(b2Contact& contact) {
      const b2Body& a = *contact.GetFixtureA()->GetBody();
      const b2Body& b = *contact.GetFixtureB()->GetBody();
      return a.GetType() != b2_dynamicBody || b.GetType() != b2_dynamicBody || a.IsBullet() || b.IsBullet();
    }
    void add(b2Contact& contact, const b2ContactImpulse& impulse) {
      Impulses& sum = given_.try_emplace(&contact, Impulses{b2Vec2_zero, b2Vec2_zero}).first->second;
      for (int i = 0; i < impulse.count; ++i) sum[i] += {impulse.normalImpulses[i], impulse.tangentImpulses[i]};
    }

    Box2dImpulses& impulses_;
    bool recording_ = false;
    std::unordered_map<const b2Contact*, Impulses> given_;  // in this step
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
    const b2Body& body = *entry.body;
    const bool sleeps = body.GetType() == b2_staticBody;
    const b2Vec2 centre = sleeps ? body.GetWorldPoint(entry.mass.center) : body.GetWorldCenter();
    return {from_box2d(centre), Rotation<2>(body.GetAngle())};
  }
  static BodyRole free_role(const b2Body& body) {
    return body.GetJointList() != nullptr ? BodyRole::stays_awake : BodyRole::sleeps;
  }
  static Box<2> bounds(const b2Fixture& fixture, const b2Transform& at) {
    Box<2> box;
    for (int child = 0; child < fixture.GetShape()->GetChildCount(); ++child) {
      b2AABB aabb;
      fixture.GetShape()->ComputeAABB(&aabb, at, child);
      box.extend(Box<2>(from_box2d(aabb.lowerBound), from_box2d(aabb.upperBound)));
    }
    return box;
  }

  /// Appends the convex pieces of a shape, relative to `centre`. A line becomes a capsule with the radius of Box2D's
  /// slop.
  static void add_pieces(const b2Fixture& fixture, const Vec2& centre, std::vector<Piece<2>>& pieces) {
    const b2Shape& shape = *fixture.GetShape();
    const auto add = [&](std::initializer_list<b2Vec2> corners, double radius) {
      HullPiece<2> hull = {.corners = {}, .radius = radius};
      for (const b2Vec2& corner : corners) hull.corners.push_back(from_box2d(corner) - centre);
      add_piece<2>(hull, pieces);
    };
    if (shape.GetType() == b2Shape::e_circle) {
      add({static_cast<const b2CircleShape&>(shape).m_p}, shape.m_radius);
    } else if (shape.GetType() == b2Shape::e_polygon) {
      const auto& polygon = static_cast<const b2PolygonShape&>(shape);
      HullPiece<2> hull;
      for (int i = 0; i < polygon.m_count; ++i) hull.corners.push_back(from_box2d(polygon.m_vertices[i]) - centre);
      add_piece<2>(hull, pieces);
    } else if (shape.GetType() == b2Shape::e_edge) {
      const auto& edge = static_cast<const b2EdgeShape&>(shape);
      add({edge.m_vertex1, edge.m_vertex2}, b2_linearSlop);
    } else {
      const auto& chain = static_cast<const b2ChainShape&>(shape);
      for (int i = 0; i + 1 < chain.m_count; ++i) add({chain.m_vertices[i], chain.m_vertices[i + 1]}, b2_linearSlop);
    }
  }
  static std::vector<Piece<2>> pieces_of(const b2Body& body, const Vec2& centre) {
    std::vector<Piece<2>> pieces;
    for (const b2Fixture* fixture = body.GetFixtureList(); fixture != nullptr; fixture = fixture->GetNext())
      if (!fixture->IsSensor()) add_pieces(*fixture, centre, pieces);
    return pieces;
  }
  void show_pieces(const Entry& entry) {
    const Handle shown = handle(*entry.body);
    core_.set_pieces(shown, pieces_of(*entry.body, from_box2d(core_.asleep(shown) ? entry.mass.center
                                                                                  : entry.body->GetLocalCenter())));
  }
  void show_all() {
    for (const Entry& entry : entries_)
      if (entry.body != nullptr) show_pieces(entry);
    for (b2Body* body = world_.GetBodyList(); body != nullptr; body = body->GetNext()) {
      if (body->GetType() != b2_staticBody || handles_.contains(body)) continue;
      const std::vector<Piece<2>> pieces = pieces_of(*body, Vec2::Zero());
      if (!pieces.empty()) core_.add_static(pieces, {from_box2d(body->GetPosition()), Rotation<2>(body->GetAngle())});
    }
  }

  static bool is_solid(const b2Body& body) {
    const b2Fixture* fixture = body.GetFixtureList();
    while (fixture != nullptr && fixture->IsSensor()) fixture = fixture->GetNext();
    return fixture != nullptr;
  }
  /// A body that cannot turn has no inertia. The program may have put the centre of mass outside of the fixtures.
  static BodyTraits<2> traits(const b2Body& body) {
    b2Transform own;
    own.SetIdentity();
    const Vec2 centre = from_box2d(body.GetLocalCenter());
    BodyTraits<2> traits{.mass = body.GetMass()};
    traits.bounds.setEmpty();
    for (const b2Fixture* fixture = body.GetFixtureList(); fixture != nullptr; fixture = fixture->GetNext()) {
      if (fixture->IsSensor()) continue;
      traits.bounds.extend(bounds(*fixture, own));
      traits.friction = fixture->GetFriction();
    }
    traits.bounds.translate(-centre);
    if (body.GetType() == b2_dynamicBody) traits.bounds.extend(Vec2(Vec2::Zero()));
    const double inertia = body.GetInertia() - traits.mass * centre.squaredNorm();
    traits.inertia(0, 0) = inertia > 0.0 ? inertia : traits.locked_inertia();
    return traits;
  }

  /// Box2D has one listener; the program may have set another one since the last step.
  void listen() {
    b2ContactListener* now = world_.GetContactManager().m_contactListener;
    if (now == &listener_) return;
    require(dynamic_cast<Listener*>(now) == nullptr, "world", "watched",
            "must have no other sleeper: each calls the other");
    listener_.next = now;
    world_.SetContactListener(&listener_);
  }

  /// The default for a body that is not watched.
  Handle find(const b2Body& body) const {
    const auto found = handles_.find(&body);
    return found == handles_.end() ? Handle{} : found->second;
  }

  void read_bodies() {
    contacts_of_.clear();
    for (const Handle handle : core_.followed()) {
      follow_role(handle);
      read_state(handle);
      if (!all_contacts_ && core_.needs_contacts(handle)) contacts_of_.push_back(handle);
    }
#ifndef NDEBUG
    for (const auto& [body, handle] : handles_)  // finds sleeping bodies that were moved; nothing depends on the order
      if (core_.asleep(handle)) read_state(handle);
#endif
  }
  /// A body may have got its first joint, or have lost its last one.
  void follow_role(Handle handle) {
    const b2Body& body = *entries_[handle.slot].body;
    if (body.GetType() == b2_dynamicBody && core_.role(handle) != free_role(body))
      carry_out(core_.set_role(handle, free_role(body)));
  }
  void read_state(Handle handle) {
    const b2Body& body = *entries_[handle.slot].body;
    buffer_.add(handle, pose(entries_[handle.slot]), from_box2d(body.GetLinearVelocity()),
                Spin<2>(body.GetAngularVelocity()));
  }

  void read_contacts() {
    if (all_contacts_)
      for (b2Contact* contact = world_.GetContactList(); contact != nullptr; contact = contact->GetNext())
        read_contact(*contact);
    std::ranges::sort(contacts_of_);
    for (const Handle handle : contacts_of_)
      for (b2ContactEdge* edge = entries_[handle.slot].body->GetContactList(); edge != nullptr; edge = edge->next)
        if (const Handle other = find(*edge->other); !was_read(other, handle)) read_contact(*edge->contact);
  }
  /// Whether the contact of two bodies was read with those of the other one.
  bool was_read(Handle other, Handle handle) const {
    return other < handle && std::ranges::binary_search(contacts_of_, other);
  }
  void read_contact(b2Contact& contact) {
    const bool solved = contact.IsTouching() && contact.IsEnabled();  // the program's listener may disable it
    if (!solved || contact.GetFixtureA()->IsSensor() || contact.GetFixtureB()->IsSensor()) return;
    const b2Body& a = *contact.GetFixtureA()->GetBody();
    const b2Body& b = *contact.GetFixtureB()->GetBody();
    const Handle first = find(a);
    const Handle second = find(b);
    if (first == Handle{} && second == Handle{}) return;
    const bool swap = first == Handle{};
    const double sign = swap ? 1.0 : -1.0;  // Box2D's normal points from its first body to its second
    b2WorldManifold world;
    contact.GetWorldManifold(&world);
    const b2Vec2 tangent = b2Cross(world.normal, 1.0F);
    for (int i = 0; i < contact.GetManifold()->pointCount; ++i) {
      const b2Vec2 impulse = listener_.impulse(contact, i);
      const b2Vec2& where = world.points[i];
      const b2Vec2 approach =
          all_contacts_ ? velocity_before(a, first, where) - velocity_before(b, second, where) : b2Vec2_zero;
      buffer_.contacts.push_back({.a = swap ? second : first,
                                  .b = swap ? first : second,
                                  .point = from_box2d(where),
                                  .normal = sign * from_box2d(world.normal),
                                  .normal_impulse = impulse.x,
                                  .friction_impulse = sign * impulse.y * from_box2d(tangent),
                                  .approach_speed = std::max(0.0F, b2Dot(approach, world.normal)),
                                  .depth = -world.separations[i]});
    }
  }
  /// Of a point of a body before the step. One that is not watched is taken as it is.
  b2Vec2 velocity_before(const b2Body& body, Handle handle, const b2Vec2& where) const {
    if (handle == Handle{} || body.GetType() != b2_dynamicBody) return body.GetLinearVelocityFromWorldPoint(where);
    const Entry& entry = entries_[handle.slot];
    return entry.velocity + b2Cross(entry.spin, where - body.GetWorldCenter());
  }

  void carry_out(const SleepChanges<2>& changes) {
    for (const SleepChange& change : changes.thaw) thaw(entries_[change.body.slot]);
    for (const GivenVelocity<2>& change : changes.velocities) {
      entries_[change.body.slot].body->SetLinearVelocity(to_box2d(change.velocity));
      entries_[change.body.slot].body->SetAngularVelocity(static_cast<float>(change.spin[0]));
    }
    for (const SleepChange& change : changes.freeze) freeze(entries_[change.body.slot]);
  }
  void freeze(Entry& entry) {
    impulses_.save(*entry.body);
    entry.body->GetMassData(&entry.mass);
    set_type(*entry.body, b2_staticBody);
  }
  /// A change of type ends the contacts of a body. Box2D would look for new ones only after the next step, within which
  /// bodies would fall through each other; after a transform it looks before.
  static void set_type(b2Body& body, b2BodyType type) {
    body.SetType(type);
    body.SetTransform(body.GetPosition(), body.GetAngle());
  }
  /// The mass follows from the fixtures unless the program has set it.
  void thaw(const Entry& entry) {
    b2Body& body = *entry.body;
    impulses_.save(body);
    impulses_.expect(body);
    set_type(body, b2_dynamicBody);
    const b2MassData mass = entry.mass;
    b2MassData now;
    body.GetMassData(&now);
    if (now.mass != mass.mass || now.I != mass.I || now.center != mass.center) body.SetMassData(&mass);
  }

  b2World& world_;
  bool enabled_;
  bool all_contacts_ = true;  // are needed in this step
  bool observed_ = false;
  PileSleeper<2> core_;
  Box2dImpulses impulses_;
  Listener listener_{impulses_};
  std::unordered_map<const b2Body*, Handle> handles_;
  std::vector<Entry> entries_;       // [slot]
  std::vector<Handle> contacts_of_;  // these bodies are needed, where not all are
  StepBuffer<2> buffer_;
};

}  // namespace talus
