#include "sim3d/engine_world.h"

#include <algorithm>
#include <cmath>

#include "common/world/stopwatch.h"
#include "sim3d/bodies.h"
#include "sim3d/body_template.h"
#include "sim3d/conversions.h"

namespace talus::bullet {
namespace {

// What moves less in a step is never swept [m]: for Bullet, 0 turns continuous collision off.
constexpr btScalar shortest_sweep = 1e-6F;

/// Collects the bodies that Bullet finds in a box.
struct Finder final : btBroadphaseAabbCallback {
  explicit Finder(std::vector<BodyIndex>& into) : found(into) {}
  bool process(const btBroadphaseProxy* proxy) override {
    const int index = static_cast<const btCollisionObject*>(proxy->m_clientObject)->getUserIndex();
    if (index >= 0) found.push_back(index);
    return true;
  }
  std::vector<BodyIndex>& found;
};

// Bullet stops simulating a body whose bounding box is not finite, without a message.
bool is_finite(const btRigidBody& body) {
  // A sum is finite only if all its parts are (or nearly overflow, which is no better).
  const btVector3 sum = body.getWorldTransform().getOrigin() + body.getWorldTransform().getBasis().getRow(0) +
                        body.getWorldTransform().getBasis().getRow(1) + body.getWorldTransform().getBasis().getRow(2) +
                        body.getLinearVelocity() + body.getAngularVelocity();
  return std::isfinite(sum.x() + sum.y() + sum.z()) && body.getActivationState() != DISABLE_SIMULATION;
}

template <int Dim>
btVector3 gravity_of(const WorldDescription<Dim>& description) {
  return to_bullet(description.gravity_vector());
}

/// Null: Bullet's own solver is to be used.
template <int Dim>
std::unique_ptr<SmallSteps<Dim>> make_small_steps(const WorldDescription<Dim>& description,
                                                  const BodyStates<Dim>& states, std::optional<Ring<Dim>>& ring) {
  if (!description.solver.small_steps()) return nullptr;
  return std::make_unique<SmallSteps<Dim>>(description, fastest_spin(description.dt), states, ring);
}

template <int Dim>
void give_velocity(btRigidBody& body, const Vec<Dim>& velocity, const Spin<Dim>& spin) {
  body.setLinearVelocity(to_bullet(velocity));
  body.setAngularVelocity(spin_to_bullet<Dim>(spin));
}

}  // namespace

// Planar as free: one engine, so the limits are those of 3D.
template <int Dim>
EngineWorld<Dim>::EngineWorld(const WorldDescription<Dim>& description)
    : RingWorld<Dim>(description, {fastest_speed<3>(description.dt), fastest_spin(description.dt)}),
      mass_scale_(mass_scale<Dim>(description.shapes)),
      engine_(gravity_of(description), description.solver, description.debug),
      small_steps_(make_small_steps(description, this->states(), ring_)) {
  for (const Shape<Dim>& shape : description.shapes) {
    templates_.push_back(make_body_template(shape, mass_scale_));
    if (description.debug.sweep_slow_bodies) templates_.back().sweep_from = shortest_sweep;
    if (small_steps_) templates_.back().sweep_from = 0;  // never: it finds the contacts ahead
  }
  if (description.ground.present) add_ground();
  add_obstacles();
  if (small_steps_) use_small_steps();
  engine_.world.set_after_collision([this] { swap_.restore_contacts(); });
}

template <int Dim>
void EngineWorld<Dim>::use_small_steps() {
  engine_.keep_points_of_spheres();
  if constexpr (Dim == 3) engine_.find_points_on_ground();
  engine_.world.set_contact_step({.drift = [this] { small_steps_->drift(rigid_, moving_obstacles_); },
                                  .solve = [this] { small_steps_->solve(engine_, rigid_, actions()); },
                                  .finish = [this] { small_steps_->finish(rigid_); }});
}

template <int Dim>
typename SmallSteps<Dim>::Actions EngineWorld<Dim>::actions() {
  typename SmallSteps<Dim>::Actions actions{
      .moving = moving_obstacles_, .belts = this->belts(), .pushes = {}, .gravity = engine_.world.getGravity()};
  for (const Push<Dim>& push : this->pushes())
    actions.pushes.emplace_back(rigid_body(push.body), push.force / this->shape_of(push.body).mass);
  return actions;
}

// Bullet holds the bodies by address: they leave it before they are destroyed.
template <int Dim>
EngineWorld<Dim>::~EngineWorld() {
  engine_.world.set_bodies({});
  for (const std::unique_ptr<btCollisionObject>& object : objects_)
    if (object != nullptr) engine_.broadphase.destroyProxy(object->getBroadphaseHandle(), &engine_.dispatcher);
}

template <int Dim>
void EngineWorld<Dim>::add_ground() {
  const Ground& ground = this->description().ground;
  ground_ = std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), static_cast<btScalar>(ground.height));
  const Surface surface{static_cast<btScalar>(pair_friction(ground.material.friction, 1.0)),
                        static_cast<btScalar>(std::sqrt(ground.material.restitution))};
  statics_.push_back(make_static_object(*ground_, surface, btTransform::getIdentity(), ground_index));
  engine_.world.add_static(*statics_.back());
}

template <int Dim>
void EngineWorld<Dim>::add_obstacles() {
  BodyIndex index = first_obstacle;
  for (const Obstacle<Dim>& obstacle : this->description().obstacles) {
    const BodyTemplate& from = obstacles_.emplace_back(make_body_template(obstacle.shape));
    const btTransform place = to_bullet(obstacle.pose, from.frame);
    statics_.push_back(obstacle.moves ? make_moving_obstacle(from, place, index)
                                      : make_static_object(*from.whole, from.surface, place, index));
    --index;
    engine_.world.add_static(*statics_.back());
  }
}

template <int Dim>
Pose<Dim> EngineWorld<Dim>::engine_add(BodyIndex body, const BodyDef<Dim>& def) {
  const BodyTemplate& from = template_of(def.shape);
  auto made = engine_.rigid_bodies.make(from, to_bullet(def.pose, from.frame), body, this->description().engine_sleep);
  give_velocity<Dim>(*made, def.velocity, def.spin);
  if (def.image) {
    set_image(*made, *def.image);
    engine_.pairs.setOverlapFilterCallback(&meeting_);
  }
  engine_.world.addRigidBody(made.get());
  listed_.push_back(body);
  rigid_.push_back(made.get());
  objects_.push_back(std::move(made));
  // Bullet has listed the body behind the frozen ones, but bodies stand together in its list.
  if (this->description().debug.keep_sleepers) update_lists();
  return def.pose;
}

template <int Dim>
void EngineWorld<Dim>::engine_remove(std::span<const BodyIndex> bodies) {
  std::vector<std::unique_ptr<btCollisionObject>> leaving;  // they outlive Bullet's lists of them
  for (const BodyIndex body : bodies) {
    swap_.forget(body);
    if (ring_) ring_->forget(body);
    engine_.broadphase.destroyProxy(at(body)->getBroadphaseHandle(), &engine_.dispatcher);
    leaving.push_back(std::move(at(body)));
  }
  const bool were_listed = std::erase_if(listed_, [this](BodyIndex body) { return at(body) == nullptr; }) > 0;
  if (were_listed || this->description().debug.keep_sleepers) update_lists();
}

template <int Dim>
Pose<Dim> EngineWorld<Dim>::engine_place(BodyIndex body, const Pose<Dim>& pose) {
  btRigidBody& placed = *rigid_body(body);
  placed.setWorldTransform(to_bullet(pose, template_of_body(body).frame));
  placed.setInterpolationWorldTransform(placed.getWorldTransform());
  strayed_known_ = false;
  return from_bullet<Dim>(placed.getWorldTransform(), template_of_body(body).frame_inverse);
}

template <int Dim>
void EngineWorld<Dim>::engine_contacts(std::vector<Contact<Dim>>& contacts) const {
  contacts_.gather(engine_, this->states().asleep, contacts);
  if (small_steps_) small_steps_->gather_ahead(impulse_unit(), contacts);
}

template <int Dim>
void EngineWorld<Dim>::engine_set_velocity(BodyIndex body, const Vec<Dim>& velocity, const Spin<Dim>& spin) {
  give_velocity<Dim>(*rigid_body(body), velocity, spin);
}

template <int Dim>
bool EngineWorld<Dim>::idle() const {
  if (!rigid_.empty() || !ring_) return rigid_.empty();
  std::vector<BodyIndex> moving;
  for (const btRigidBody* obstacle : moving_obstacles_) moving.push_back(obstacle->getUserIndex());
  return ring_->idle(moving);
}

template <int Dim>
EngineTimes EngineWorld<Dim>::engine_step() {
  if (this->records_contacts()) contacts_.note_motion(rigid_, moving_obstacles_);
  if (!this->description().debug.step_when_idle && idle()) {
    if (ring_) ring_->start();
    // Upkeep of the broadphase's trees: their form decides the order of pairs, and so how a run continues after a thaw.
    engine_.broadphase.calculateOverlappingPairs(&engine_.dispatcher);
    return {};
  }
  Stopwatch watch;
  engine_.world.stepSimulation(static_cast<btScalar>(this->description().dt), 0);
  detected_ = this->states().size();
  strayed_known_ = false;
  const double collide = engine_.world.collide_seconds();
  return {.collide = collide, .solve = watch.lap() - collide};
}

template <int Dim>
std::optional<BodyIndex> EngineWorld<Dim>::engine_read(BodyStates<Dim>& states) {
  const auto broken = std::ranges::find_if(rigid_, [](const btRigidBody* body) { return !is_finite(*body); });
  if (broken != rigid_.end()) return (*broken)->getUserIndex();
  for (const btRigidBody* body : rigid_) {
    const BodyIndex i = body->getUserIndex();
    states.pose[i] = from_bullet<Dim>(body->getWorldTransform(), template_of_body(body->getUserIndex()).frame_inverse);
    states.velocity[i] = from_bullet<Dim>(body->getLinearVelocity());
    states.spin[i] = spin_from_bullet<Dim>(body->getAngularVelocity());
  }
  return std::nullopt;
}

template <int Dim>
void EngineWorld<Dim>::engine_move_obstacle(int number, const Pose<Dim>& /*to*/, const Vec<Dim>& velocity,
                                            const Spin<Dim>& spin) {
  btRigidBody* body = btRigidBody::upcast(&obstacle(number));
  give_velocity<Dim>(*body, velocity, spin);
  moving_obstacles_.push_back(body);
}

template <int Dim>
void EngineWorld<Dim>::engine_place_obstacle(int number, const Pose<Dim>& at) {
  btRigidBody& body = *btRigidBody::upcast(&obstacle(number));
  body.setWorldTransform(to_bullet(at, obstacles_[number].frame));
  give_velocity<Dim>(body, Vec<Dim>::Zero(), Spin<Dim>::Zero());
  moving_obstacles_.clear();
}

/// It stays in Bullet's list of objects, without an entry in the broad phase: nothing meets it any more.
template <int Dim>
void EngineWorld<Dim>::engine_remove_obstacle(int number) {
  btCollisionObject& object = obstacle(number);
  std::erase(moving_obstacles_, btRigidBody::upcast(&object));
  swap_.forget(first_obstacle - number);
  if (ring_) ring_->forget(first_obstacle - number);
  engine_.pairs.remove_pairs_of_obstacle(object.getBroadphaseHandle(), &engine_.dispatcher);
  engine_.broadphase.destroyProxy(object.getBroadphaseHandle(), &engine_.dispatcher);
  object.setBroadphaseHandle(nullptr);
  object.setCollisionFlags(btCollisionObject::CF_STATIC_OBJECT);
  object.forceActivationState(ISLAND_SLEEPING);
}

template <int Dim>
void EngineWorld<Dim>::engine_restore_obstacle(int number) {
  btCollisionObject& object = obstacle(number);
  object.setWorldTransform(to_bullet(this->obstacle_pose(number), obstacles_[number].frame));
  object.setInterpolationWorldTransform(object.getWorldTransform());
  if (btRigidBody::upcast(&object) != nullptr) {
    object.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    object.forceActivationState(DISABLE_DEACTIVATION);
  }
  engine_.pairs.places().forget_obstacle(object.getUserIndex());
  engine_.world.restore_static(object);
}

template <int Dim>
void EngineWorld<Dim>::engine_set_gravity(const Vec<Dim>& gravity) {
  engine_.world.setGravity(to_bullet(gravity));
  for (btRigidBody* body : rigid_) body->setGravity(to_bullet(gravity));
}

/// Of awake bodies that fall asleep, some of them maybe before their first step.
template <int Dim>
void EngineWorld<Dim>::keep_contacts(std::span<const BodyIndex> bodies) {
  if (bodies.back() >= detected_) engine_.world.detect_contacts();
  detected_ = this->states().size();
  std::vector<btRigidBody*> falling_asleep;
  for (const BodyIndex body : bodies) falling_asleep.push_back(rigid_body(body));
  small_steps_->freeze(engine_, falling_asleep);
}

template <int Dim>
void EngineWorld<Dim>::engine_freeze(std::span<const BodyIndex> bodies) {
  if (ring_) keep_contacts(bodies);
  const btScalar stray = ring_ ? 0.5F * ring_->reach() : 0;
  for (const BodyIndex body : bodies) swap_.freeze(at(body), template_of_body(body), stray);
  std::erase_if(listed_, [this](BodyIndex body) { return rigid_body(body) == nullptr; });
  update_lists();
}

template <int Dim>
void EngineWorld<Dim>::engine_thaw(std::span<const BodyIndex> bodies) {
  const auto before = static_cast<std::ptrdiff_t>(listed_.size());
  for (const BodyIndex body : bodies) {
    if (rigid_body(body) == nullptr) {
      const bool moves = ring_ && ring_->has(body);
      btVector3 velocity;
      btVector3 spin;
      if (moves) {
        const btTransform place = small_steps_->thaw(*at(body), bodies, velocity, spin, renewed_);
        renew_kept_points();
        at(body)->setWorldTransform(place);
      }
      swap_.thaw(at(body), template_of_body(body), this->description().engine_sleep);
      listed_.push_back(body);
      if (moves) resume(body, velocity, spin);
    }
    at(body)->activate(true);
  }
  std::inplace_merge(listed_.begin(), listed_.begin() + before, listed_.end());
  update_lists();
}

/// Updates the kept contact points of bodies that wake to the last solve.
template <int Dim>
void EngineWorld<Dim>::renew_kept_points() {
  for (auto first = renewed_.begin(); first != renewed_.end();) {
    const auto of_other = [&](const WarmStart::Renewed& point) { return point.owner != first->owner; };
    const auto last = std::find_if(first, renewed_.end(), of_other);
    swap_.renew(*at(first->owner), {first, last});
    first = last;
  }
}

/// A body that felt forces in its sleep wakes where these have moved it.
template <int Dim>
void EngineWorld<Dim>::resume(BodyIndex body, const btVector3& velocity, const btVector3& spin) {
  btRigidBody& rigid = *rigid_body(body);
  rigid.setLinearVelocity(velocity);
  rigid.setAngularVelocity(spin);
  BodyStates<Dim>& all = this->writable_states();
  all.pose[body] = from_bullet<Dim>(rigid.getWorldTransform(), template_of_body(body).frame_inverse);
  all.velocity[body] = from_bullet<Dim>(velocity);
  all.spin[body] = spin_from_bullet<Dim>(spin);
}

// Bullet's lists in the order of indices, whatever the order of freezing and thawing was.
template <int Dim>
void EngineWorld<Dim>::update_lists() {
  rigid_.clear();
  for (const BodyIndex body : listed_) rigid_.push_back(rigid_body(body));
  engine_.world.set_bodies(rigid_);
  if (this->description().debug.keep_sleepers) list_frozen();
}

template <int Dim>
void EngineWorld<Dim>::list_frozen() {
  for (const std::unique_ptr<btCollisionObject>& object : objects_)
    if (object != nullptr && btRigidBody::upcast(object.get()) == nullptr) engine_.world.list(*object);
}

// The broadphase has the place of a body before the last step and the place that it would have reached undisturbed.
// Bodies elsewhere are searched for only on demand and kept in a list of their own, since an update of the broadphase
// would change the order of pairs and so the run.
template <int Dim>
void EngineWorld<Dim>::find_strayed() const {
  strayed_.clear();
  for (const btRigidBody* body : rigid_) {
    btVector3 low;
    btVector3 high;
    body->getAabb(low, high);
    const auto* proxy = static_cast<const btDbvtProxy*>(body->getBroadphaseProxy());
    if (!proxy->leaf->volume.Contain(btDbvtVolume::FromMM(low, high))) strayed_.push_back(body->getUserIndex());
  }
  strayed_known_ = true;
}

template <int Dim>
void EngineWorld<Dim>::engine_query_box(const Box<Dim>& box, std::vector<BodyIndex>& found) const {
  if (!strayed_known_) find_strayed();
  btVector3 low = to_bullet(Vec<Dim>(box.min()));
  btVector3 high = to_bullet(Vec<Dim>(box.max()));
  Finder finder(found);
  const_cast<Engine&>(engine_).broadphase.aabbTest(low, high, finder);
  for (const BodyIndex body : strayed_) {
    if (at(body) == nullptr) continue;  // removed since
    btVector3 body_low;
    btVector3 body_high;
    at(body)->getCollisionShape()->getAabb(at(body)->getWorldTransform(), body_low, body_high);
    if (TestAabbAgainstAabb2(low, high, body_low, body_high)) found.push_back(body);
  }
}

template class EngineWorld<2>;
template class EngineWorld<3>;

}  // namespace talus::bullet
