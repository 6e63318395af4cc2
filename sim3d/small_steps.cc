#include "sim3d/small_steps.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "common/solver/solved_contact.h"
#include "sim3d/body_template.h"
#include "sim3d/bullet/fetch.h"
#include "sim3d/bullet/idle_pairs.h"
#include "sim3d/conversions.h"
#include "sim3d/friction_impulse.h"

namespace talus::bullet {
namespace {

template <int Dim>
InertiaF<Dim> inertia_to_solver(const btMatrix3x3& inverse) {
  if constexpr (Dim == 2) {
    return InertiaF<2>(inverse[1][1]);
  } else {
    InertiaF<3> made;
    for (int i = 0; i < 3; ++i) made.row(i) = to_solver<3>(inverse[i]).transpose();
    return made;
  }
}

template <int Dim>
SolverBody<Dim> awake_body(const btRigidBody& rigid) {
  SolverBody<Dim> body;
  body.velocity = to_solver<Dim>(rigid.getLinearVelocity());
  body.spin = spin_to_solver<Dim>(rigid.getAngularVelocity());
  body.inverse_mass = rigid.getInvMass();
  body.position = to_solver<Dim>(rigid.getWorldTransform().getOrigin());
  body.inverse_inertia = inertia_to_solver<Dim>(rigid.getInvInertiaTensorWorld());
  body.moves = true;
  return body;
}

/// A frozen body has its mass only in its template.
template <int Dim>
SolverBody<Dim> sleeper(const btCollisionObject& object) {
  const auto& shape = *static_cast<const BodyTemplate*>(object.getUserPointer());
  const btMatrix3x3& axes = object.getWorldTransform().getBasis();
  const btVector3 inverse(1 / shape.inertia.x(), 1 / shape.inertia.y(), 1 / shape.inertia.z());
  SolverBody<Dim> body;
  body.inverse_mass = 1 / shape.mass;
  body.inverse_inertia = inertia_to_solver<Dim>(axes.scaled(inverse) * axes.transpose());
  return body;
}

template <int Dim>
SolverBody<Dim> moving_obstacle(const btRigidBody& obstacle) {
  SolverBody<Dim> body;
  body.velocity = to_solver<Dim>(obstacle.getLinearVelocity());
  body.spin = spin_to_solver<Dim>(obstacle.getAngularVelocity());
  return body;
}

// Two points of a planar pair that are nearer are one, at the front and the back of the bodies [extents of the
// smallest].
constexpr double one_point = 0.005;
// In the plane, a normal that points out of it by more (60 degrees) is of the bodies' flat faces, which must not
// matter.
constexpr float least_in_plane = 0.5F;

/// Collects what the broad phase finds.
struct ObjectFinder final : btBroadphaseAabbCallback {
  explicit ObjectFinder(std::vector<const btCollisionObject*>& into) : found(into) {}
  bool process(const btBroadphaseProxy* proxy) override {
    found.push_back(static_cast<const btCollisionObject*>(proxy->m_clientObject));
    return true;
  }
  std::vector<const btCollisionObject*>& found;
};

/// Those of a pair that may have points.
void append_manifolds(const btBroadphasePair& pair, btManifoldArray& manifolds) {
  if (pair.m_algorithm == nullptr || IdleMark::is_set(pair)) return;
  if (IdleMark::is_compound(pair))
    static_cast<const CompoundPair*>(pair.m_algorithm)->append_touching(manifolds);
  else
    pair.m_algorithm->getAllContactManifolds(manifolds);
}

PointKey key_of(const btCollisionObject& a, const btCollisionObject& b) {
  return {.a = static_cast<std::uint64_t>(a.getUserIndex()), .b = static_cast<std::uint64_t>(b.getUserIndex())};
}

}  // namespace

template <int Dim>
SmallSteps<Dim>::SmallSteps(const WorldDescription<Dim>& description, double fastest_spin,
                            const BodyStates<Dim>& states, std::optional<Ring<Dim>>& ring)
    : states_(states),
      ring_(ring),
      params_(description.solver),
      dt_(static_cast<float>(description.dt)),
      fastest_spin_(static_cast<float>(fastest_spin)),
      fast_(description),
      resistance_(description.shapes),
      drift_(description) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Shape<Dim>& shape : description.shapes) smallest = std::min(smallest, shape.extent);
  one_point_ = static_cast<float>(one_point * smallest);
  obstacle_slots_.assign(description.obstacles.size(), 0);
}

template <int Dim>
void SmallSteps<Dim>::drift(std::span<btRigidBody* const> bodies, std::span<btRigidBody* const> moving) {
  const auto motion = [&](const btRigidBody& body) {
    return StepMotion<Dim>{dt_ * to_solver<Dim>(body.getLinearVelocity()),
                           dt_ * spin_to_solver<Dim>(body.getAngularVelocity())};
  };
  const auto move = [&](btRigidBody& body, const StepMotion<Dim>& by) {
    if (by.is_none()) return;
    const btTransform start = body.getWorldTransform();
    starts_.emplace_back(&body, start);
    btTransformUtil::integrateTransform(start, from_solver<Dim>(by.way), spin_from_solver<Dim>(by.turn), 1,
                                        body.getWorldTransform());
  };
  for (btRigidBody* body : bodies) {
    if (image_of(*body).sides == 0) drift_.add(fast_.drift(motion(*body)));
    move(*body, drift_.last());
  }
  for (btRigidBody* obstacle : moving) {
    const int number = first_obstacle - obstacle->getUserIndex();
    const StepMotion<Dim> by = fast_.drift_of_obstacle(number, motion(*obstacle));
    drift_.set(number, by);
    move(*obstacle, by);
  }
}

template <int Dim>
void SmallSteps<Dim>::solve(Engine& engine, std::span<btRigidBody* const> bodies, const Actions& actions) {
  ++step_;
  for (const auto& [body, start] : starts_) body->setWorldTransform(start);
  ahead_.clear();
  if (ring_) ring_->start();
  for (int round = 1;; ++round) {
    solver_.start();
    sources_.clear();
    manifolds_.clear();
    parts_.clear();
    add_bodies(bodies, actions);
    if (round == 1) expect_motion(engine, bodies);
    add_points_ahead(actions.belts);
    add_points(engine.dispatcher, actions.belts);
    if (ring_) ring_->extend(solver_, obstacle_slots_);
    solver_.solve(params_, to_solver<Dim>(actions.gravity), dt_);
    const std::size_t solved = ahead_.size();
    const bool last = round == most_solves;
    const bool struck = !last && ring_ && ring_->widen(solver_, actions.gravity.length());
    const bool again = (!last && passes_unseen(engine, bodies)) || struck;
    for (btCollisionObject* other : others_) other->setCompanionId(-1);
    others_.clear();
    if (!again) {
      ahead_.resize(solved);
      break;
    }
    if (ring_) ring_->start_again();
  }
  if (ring_) ring_->read(solver_, actions.gravity.length(), dt_);
  write_points();
  starts_.clear();
  drift_.end();
  set_mean_velocities(bodies);
}

/// From the velocities; finds the contacts ahead of what is fast.
template <int Dim>
void SmallSteps<Dim>::expect_motion(Engine& engine, std::span<btRigidBody* const> bodies) {
  fast_.expect(solver_, static_cast<int>(first_of_.size()), dt_);
  for (const int slot : fast_.found())
    for (btRigidBody* body : bodies_at<btRigidBody>(slot, first_of_, bodies)) find_ahead(engine, *body, true);
}

/// After a step is solved: whether a body that was struck, and so moves fast, gets past something. Finds what is ahead
/// of it.
template <int Dim>
bool SmallSteps<Dim>::passes_unseen(Engine& engine, std::span<btRigidBody* const> bodies) {
  const auto known = static_cast<std::ptrdiff_t>(ahead_.size());
  fast_.follow(solver_);
  for (const int slot : fast_.found())
    for (btRigidBody* body : bodies_at<btRigidBody>(slot, first_of_, bodies)) find_ahead(engine, *body, false);
  return std::any_of(ahead_.begin() + known, ahead_.end(),
                     [&](const Ahead& each) { return fast_.passes(solver_, each.point); });
}

/// Sleepers and what has no slot stay.
template <int Dim>
Mover SmallSteps<Dim>::mover_of(const btCollisionObject& object) const {
  const int slot = object.getCompanionId();
  if (btRigidBody::upcast(&object) == nullptr || slot <= 0) return {&object, {}, 0.0F};
  const auto in_space = [](const StepMotion<Dim>& motion) {
    const btVector3 way = from_solver<Dim>(motion.way);
    const btVector3 turn = spin_from_solver<Dim>(motion.turn);
    return StepMotion<3>{{way.x(), way.y(), way.z()}, {turn.x(), turn.y(), turn.z()}};
  };
  if (object.getUserIndex() >= 0) return {&object, in_space(fast_.motion(slot)), fast_.turn(fast_.motion(slot))};
  const StepMotion<Dim> motion{dt_ * solver_.body(slot).velocity, dt_ * solver_.body(slot).spin};
  return {&object, in_space(motion), fast_.turn_of_obstacle(first_obstacle - object.getUserIndex(), motion)};
}

/// Contacts of a fast body that begin within the step. `first`: the first time in the step.
template <int Dim>
void SmallSteps<Dim>::find_ahead(Engine& engine, btRigidBody& fast, bool first) {
  const Mover mover = mover_of(fast);
  find_near(engine, mover, first);
  for (const btCollisionObject* other : near_) {
    if (first ? is_fast(*other) && other->getUserIndex() < fast.getUserIndex() : is_found(fast, *other)) continue;
    if (other->getUserIndex() == ground_index) {
      met_ground_.clear();
      const BodyIndex body = fast.getUserIndex();
      fast_.meet_ground(fast.getCompanionId(), states_.shape[body], states_.pose[body], false, met_ground_);
      for (ContactPoint<Dim>& point : met_ground_) {
        resistance_.add_to(point, states_, ground_index, body);
        add_new(engine, *other, fast, point);
      }
    } else {
      const Mover second = mover_of(*other);
      if ((second.motion.way - mover.motion.way).norm() + second.turn + mover.turn <= fast_.limit()) continue;
      met_.clear();
      meet(second, mover, fast_.near(), met_);
      for (const ContactPoint<3>& point : met_) add_ahead(engine, *other, fast, point);
    }
  }
}

/// The objects that the mover may meet in the step. As long as it moves as expected and turns little, and no obstacle
/// moves, those are the partners that Bullet has found for its way.
template <int Dim>
void SmallSteps<Dim>::find_near(Engine& engine, const Mover& mover, bool first) {
  if (first && mover.turn <= fast_.limit() && obstacles_stand_) {
    near_.clear();
    for (const btBroadphaseProxy* partner : engine.pairs.partners(mover.object->getBroadphaseHandle()))
      near_.push_back(static_cast<const btCollisionObject*>(partner->m_clientObject));
    std::ranges::sort(near_, {}, &btCollisionObject::getUserIndex);
  } else {
    find_around(engine, mover, fast_.longest());
  }
}

/// The objects in the mover's box and `margin` [m] around it, sorted by their numbers.
template <int Dim>
void SmallSteps<Dim>::find_around(Engine& engine, const Mover& mover, float margin) {
  const SweptBox box = swept(mover);
  const btVector3 around(margin, margin, margin);
  near_.clear();
  ObjectFinder finder(near_);
  engine.broadphase.aabbTest(box.low - around, box.high + around, finder);
  std::erase_if(near_, [&](const btCollisionObject* other) {
    return other == mover.object || !images_meet(*mover.object, *other);
  });
  std::ranges::sort(near_, {}, &btCollisionObject::getUserIndex);
}

/// Of an awake body.
template <int Dim>
bool SmallSteps<Dim>::is_fast(const btCollisionObject& object) const {
  return object.getUserIndex() >= 0 && btRigidBody::upcast(&object) != nullptr &&
         fast_.is_fast(object.getCompanionId());
}

template <int Dim>
bool SmallSteps<Dim>::is_found(const btCollisionObject& a, const btCollisionObject& b) const {
  return std::ranges::any_of(
      ahead_, [&](const Ahead& each) { return (each.a == &a && each.b == &b) || (each.a == &b && each.b == &a); });
}

/// A point of `a` and `b` that is in no manifold. None in the plane where it is of flat faces, which must not matter.
template <int Dim>
std::optional<ContactPoint<Dim>> SmallSteps<Dim>::in_world(const btCollisionObject& a, const btCollisionObject& b,
                                                           const ContactPoint<3>& found) const {
  const auto in_world = [](const VecF<3>& v) { return to_solver<Dim>(from_solver<3>(v)); };
  ContactPoint<Dim> point;
  point.normal = in_world(found.normal);
  if (point.normal.norm() < least_in_plane) return std::nullopt;
  point.normal.normalize();
  point.arm_a = in_world(found.arm_a);
  point.arm_b = in_world(found.arm_b);
  point.gap = found.gap;
  if (ring_) point.gap += point.opening(ring_->shift(image_of(a).of), ring_->shift(image_of(b).of));
  point.friction = btManifoldResult::calculateCombinedFriction(&a, &b);
  point.restitution = btManifoldResult::calculateCombinedRestitution(&a, &b);
  resistance_.add_to(point, states_, a.getUserIndex(), b.getUserIndex());
  return point;
}

/// In the plane not if it lies behind one that is known.
template <int Dim>
void SmallSteps<Dim>::add_ahead(Engine& engine, const btCollisionObject& a, const btCollisionObject& b,
                                const ContactPoint<3>& found) {
  const std::optional<ContactPoint<Dim>> point = in_world(a, b, found);
  if (!point) return;
  if constexpr (Dim == 2)
    for (const Ahead& each : ahead_)
      if (each.a == &a && each.b == &b && (each.point.arm_b - point->arm_b).cwiseAbs().maxCoeff() < one_point_) return;
  add_new(engine, a, b, *point);
}

/// Adds nothing where Bullet already has that point.
template <int Dim>
void SmallSteps<Dim>::add_new(Engine& engine, const btCollisionObject& a, const btCollisionObject& b,
                              ContactPoint<Dim> point) {
  const btVector3 place = b.getWorldTransform().getOrigin() + from_solver<Dim>(point.arm_b);
  const auto proxy = [](const btCollisionObject& object) {  // Bullet looks it up without changing it
    return const_cast<btBroadphaseProxy*>(object.getBroadphaseHandle());
  };
  known_.resize(0);
  if (const btBroadphasePair* pair = engine.pairs.findPair(proxy(a), proxy(b))) append_manifolds(*pair, known_);
  for (int i = 0; i < known_.size(); ++i)
    for (int k = 0; k < known_[i]->getNumContacts(); ++k) {
      const VecF<Dim> apart = to_solver<Dim>(known_[i]->getContactPoint(k).getPositionWorldOnB() - place);
      if (apart.norm() < fast_.corner()) return;
    }
  const auto moving = [](const btCollisionObject& object) {
    return btRigidBody::upcast(&object) != nullptr ? std::max(0, object.getCompanionId()) : 0;
  };
  point.a = moving(a);
  point.b = moving(b);
  ahead_.push_back({&a, &b, point});
}

template <int Dim>
void SmallSteps<Dim>::add_points_ahead(std::span<const Vec<Dim>> belts) {
  for (Ahead& each : ahead_) {
    each.point.a = slot_at(*each.a, each.point.normal, belts);
    each.point.b = slot_at(*each.b, each.point.normal, belts);
    solver_.add(each.point);
    parts_.push_back(1);
  }
}

template <int Dim>
void SmallSteps<Dim>::gather_ahead(double impulse_unit, std::vector<Contact<Dim>>& contacts) const {
  if (ahead_.empty()) return;
  for (std::size_t i = 0; i < ahead_.size(); ++i) {
    const ContactPoint<Dim>& point = solver_.points()[i];
    if (point.normal_sum == 0.0F) continue;  // did not touch
    const BodyIndex a = ahead_[i].a->getUserIndex();
    const BodyIndex b = ahead_[i].b->getUserIndex();
    Contact<Dim> contact = solved_contact(solver_, point, a, b, listed_under_second(a, b, states_.asleep), states_);
    contact.normal_impulse *= impulse_unit;
    contact.friction_impulse *= impulse_unit;
    contacts.push_back(contact);
  }
  std::ranges::stable_sort(contacts, {}, [](const Contact<Dim>& each) { return std::pair(each.a, each.b); });
}

/// Images come after what they are images of, and have its slot.
template <int Dim>
void SmallSteps<Dim>::add_bodies(std::span<btRigidBody* const> bodies, const Actions& actions) {
  first_of_.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (image_of(*bodies[i]).sides != 0) {
      bodies[i]->setCompanionId(bodies[first_of_.back()]->getCompanionId());
      continue;
    }
    first_of_.push_back(i);
    SolverBody<Dim> body = awake_body<Dim>(*bodies[i]);
    // At once, as Bullet has it: spread over the sub-steps a tumbling body loses a fifth of its angular momentum.
    if constexpr (Dim == 3) body.spin += to_solver<3>(bodies[i]->computeGyroscopicImpulseImplicit_Body(dt_));
    bodies[i]->setCompanionId(solver_.add(body));
  }
  for (const auto& [body, acceleration] : actions.pushes)
    solver_.push(body->getCompanionId(), acceleration.template cast<float>());
  obstacles_stand_ = actions.moving.empty();
  std::ranges::fill(obstacle_slots_, 0);
  for (const btRigidBody* obstacle : actions.moving)
    obstacle_slots_[first_obstacle - obstacle->getUserIndex()] = slot_of(*obstacle);
}

template <int Dim>
int SmallSteps<Dim>::slot_of(const btCollisionObject& object) {
  if (object.getCompanionId() >= 0) return object.getCompanionId();
  const btRigidBody* rigid = btRigidBody::upcast(&object);
  if (rigid == nullptr && object.getUserIndex() < 0) return 0;
  if (rigid == nullptr && ring_ && ring_->has(image_of(object).of)) return ring_->join(image_of(object).of, solver_);
  auto& other = const_cast<btCollisionObject&>(object);  // manifolds give const access only
  other.setCompanionId(solver_.add(rigid != nullptr ? moving_obstacle<Dim>(*rigid) : sleeper<Dim>(object)));
  others_.push_back(&other);
  return other.getCompanionId();
}

/// For a contact with this normal.
template <int Dim>
int SmallSteps<Dim>::slot_at(const btCollisionObject& object, const VecF<Dim>& normal,
                             std::span<const Vec<Dim>> belts) {
  const int number = first_obstacle - object.getUserIndex();
  if (belts.empty() || number < 0 || belts[number].isZero(0.0)) return slot_of(object);
  return solver_.add_belt(belts[number].template cast<float>(), normal);
}

template <int Dim>
void SmallSteps<Dim>::add_points(btDispatcher& dispatcher, std::span<const Vec<Dim>> belts) {
  btPersistentManifold** manifolds = dispatcher.getInternalManifoldPointer();
  const int count = dispatcher.getNumManifolds();
  for (int i = 0; i < count; ++i) {
    if (i + 12 < count) fetch_head(*manifolds[i + 12]);
    if (i + 4 < count)
      for (int k = 0; k < manifolds[i + 4]->getNumContacts(); ++k) fetch(manifolds[i + 4]->getContactPoint(k));
    btPersistentManifold& manifold = *manifolds[i];
    if (manifold.getNumContacts() == 0) continue;
    // Bullet's normals point from the second body to the first.
    const int a = slot_of(*manifold.getBody1());
    const int b = slot_of(*manifold.getBody0());
    if (solver_.body(a).moves || solver_.body(b).moves) add_points(manifold, belts);
  }
}

template <int Dim>
void SmallSteps<Dim>::add_points(btPersistentManifold& manifold, std::span<const Vec<Dim>> belts) {
  const auto first = static_cast<int>(parts_.size());
  collect(manifold, step_ - 1);
  if (contacts_.empty()) return;
  hand_over(manifold);
  manifolds_.push_back({&manifold, first, static_cast<int>(contacts_.size())});
  const int a = slot_at(*manifold.getBody1(), contacts_[0].normal, belts);
  const int b = slot_at(*manifold.getBody0(), contacts_[0].normal, belts);
  for (ContactPoint<Dim>& contact : contacts_) {
    contact.a = a;
    contact.b = b;
    solver_.add(contact);
  }
}

/// Bullet keeps at most four contact points of two pieces and may replace a loaded one by a new one. The impulses of
/// the removed points go to the points that touch and carry none.
template <int Dim>
void SmallSteps<Dim>::hand_over(const btPersistentManifold& manifold) {
  if (static_cast<std::uint32_t>(manifold.m_companionIdB) != step_ - 1) return;
  Load lost = loads_[manifold.m_companionIdA];
  const auto takes = [](const ContactPoint<Dim>& point) { return point.normal_impulse == 0.0F && point.gap <= 0.0F; };
  for (const ContactPoint<Dim>& point : contacts_) {
    lost.normal -= point.normal_impulse;
    lost.friction -= point.friction_impulse;
  }
  const auto takers = std::ranges::count_if(contacts_, takes);
  if (lost.normal <= 0.0F || takers == 0) return;
  const float share = 1.0F / static_cast<float>(takers);
  for (ContactPoint<Dim>& point : contacts_) {
    if (!takes(point)) continue;
    point.normal_impulse = share * lost.normal;
    point.friction_impulse = along_plane<VecF<Dim>>(share * lost.friction, point.normal);
  }
}

/// The points of a manifold, without their slots.
template <int Dim>
void SmallSteps<Dim>::collect(btPersistentManifold& manifold, std::uint32_t last_step) {
  const btCollisionObject& object_a = *manifold.getBody1();
  const btCollisionObject& object_b = *manifold.getBody0();
  const StepMotion<Dim> drift_a = drift_of(object_a);
  const StepMotion<Dim> drift_b = drift_of(object_b);
  const btVector3 centre_a = object_a.getWorldTransform().getOrigin() + from_solver<Dim>(drift_a.way);
  const btVector3 centre_b = object_b.getWorldTransform().getOrigin() + from_solver<Dim>(drift_b.way);
  StepMotion<Dim> asleep_a;  // which the poses in Bullet do not contain
  StepMotion<Dim> asleep_b;
  if (ring_) {
    asleep_a = ring_->shift(image_of(object_a).of);
    asleep_b = ring_->shift(image_of(object_b).of);
  }
  const auto first = static_cast<int>(parts_.size());
  const SpinF<Dim>* rolling = nullptr;
  contacts_.clear();
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    btManifoldPoint& point = manifold.getContactPoint(i);
    ContactPoint<Dim> contact;
    contact.normal = to_solver<Dim>(point.m_normalWorldOnB);
    if constexpr (Dim == 2) {
      const float length = contact.normal.norm();
      if (length < least_in_plane) continue;
      contact.normal /= length;
    }
    contact.arm_a = to_solver<Dim>(point.getPositionWorldOnB() - centre_a);
    contact.arm_b = to_solver<Dim>(point.getPositionWorldOnA() - centre_b);
    contact.gap = point.getDistance();
    contact.gap += contact.opening(asleep_a, asleep_b) - contact.opening(drift_a, drift_b);
    contact.friction = point.m_combinedFriction;
    resistance_.add_to(contact, states_, object_a.getUserIndex(), object_b.getUserIndex());
    contact.restitution = point.m_combinedRestitution;
    contact.normal_impulse = point.m_appliedImpulse;
    contact.friction_impulse = to_solver<Dim>(friction_impulse(point));
    if (rolling == nullptr && contact.rolling_arm > 0.0F) rolling = rolling_of(point, last_step);
    sources_.push_back({&point, collect(contact, first), first});
  }
  if (rolling != nullptr) contacts_[0].rolling_impulse = *rolling;
}

template <int Dim>
StepMotion<Dim> SmallSteps<Dim>::drift_of(const btCollisionObject& object) const {
  return drift_.of(object.getUserIndex(), object.getCompanionId());
}

/// Joins the point with one of the same manifold, of which `first` is the first, where both are one in the plane.
template <int Dim>
int SmallSteps<Dim>::collect(const ContactPoint<Dim>& contact, int first) {
  if constexpr (Dim == 2) {
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      ContactPoint<2>& known = contacts_[i];
      if ((known.arm_a - contact.arm_a).cwiseAbs().maxCoeff() > one_point_) continue;
      known.normal_impulse += contact.normal_impulse;
      known.friction_impulse += contact.friction_impulse;
      known.gap = std::min(known.gap, contact.gap);
      ++parts_[first + i];
      return first + static_cast<int>(i);
    }
  }
  contacts_.push_back(contact);
  parts_.push_back(1);
  return first + static_cast<int>(contacts_.size()) - 1;
}

/// That of the point's manifold; null for a point that was not part of that step.
template <int Dim>
const SpinF<Dim>* SmallSteps<Dim>::rolling_of(const btManifoldPoint& point, std::uint32_t step) const {
  const PointMark mark = mark_of(point);
  return mark.step == step ? &rolling_[mark.entry] : nullptr;
}

/// Keeps the rolling impulse on the owner of a point that is put back before the next step. Returns its mark; the entry
/// behind it is the opposite impulse, for a manifold that has the owner second.
template <int Dim>
PointMark SmallSteps<Dim>::marked(const SpinF<Dim>& on_owner) {
  if (on_owner.isZero(0.0F)) return {};
  rolling_.push_back(on_owner);
  rolling_.emplace_back(-on_owner);
  return {step_, static_cast<std::uint32_t>(rolling_.size() - 2)};
}

template <int Dim>
void SmallSteps<Dim>::write_points() {
  const std::span<const ContactPoint<Dim>> points = solver_.points();
  for (const Source& source : sources_) {
    const ContactPoint<Dim>& contact = points[source.contact];
    btManifoldPoint& point = *source.point;
    const float share = 1.0F / static_cast<float>(parts_[source.contact]);
    point.m_appliedImpulse = share * contact.normal_impulse;
    point.setDistance(solver_.gap_after(contact));
    set_friction_impulse(point, from_solver<Dim>(share * contact.friction_impulse));
    set_impulse_of_step(point, share * contact.normal_sum, from_solver<Dim>(share * contact.friction_sum));
  }
  loads_.clear();
  for (const Solved& solved : manifolds_) {
    Load load;
    for (const ContactPoint<Dim>& contact : points.subspan(solved.first, solved.contacts)) {
      load.normal += contact.normal_impulse;
      load.friction += contact.friction_impulse;
    }
    solved.manifold->m_companionIdA = static_cast<int>(loads_.size());
    solved.manifold->m_companionIdB = static_cast<int>(step_);
    loads_.push_back(load);
  }
  if (!resistance_.active(states_)) return;
  rolling_.assign(parts_.size(), SpinF<Dim>::Zero());
  int added = -1;
  for (const Source& source : sources_) {
    if (source.contact > added) rolling_[source.first] += points[source.contact].rolling_impulse;
    added = std::max(added, source.contact);
    set_mark(*source.point, {step_, static_cast<std::uint32_t>(source.first)});
  }
}

template <int Dim>
void SmallSteps<Dim>::set_mean_velocities(std::span<btRigidBody* const> bodies) const {
  for (btRigidBody* body : bodies) {
    const SolverBody<Dim>& solved = solver_.body(body->getCompanionId());
    body->setLinearVelocity(from_solver<Dim>(solved.way / dt_));
    body->setAngularVelocity(spin_from_solver<Dim>(solved.turn / dt_));
  }
}

template <int Dim>
void SmallSteps<Dim>::finish(std::span<btRigidBody* const> bodies) const {
  for (btRigidBody* body : bodies) {
    const SolverBody<Dim>& solved = solver_.body(body->getCompanionId());
    body->setLinearVelocity(from_solver<Dim>(solved.velocity));
    const float share = fastest_spin_ / std::max(solved.spin.norm(), fastest_spin_);
    body->setAngularVelocity(spin_from_solver<Dim>(share * solved.spin));
  }
}

template <int Dim>
void SmallSteps<Dim>::freeze(Engine& engine, std::span<btRigidBody* const> bodies) {
  for (btRigidBody* body : bodies)
    if (image_of(*body).sides == 0)
      ring_->put_to_sleep(body->getUserIndex(), awake_body<Dim>(*body),
                          resistance_.reach(states_.shape[body->getUserIndex()]));
  btPersistentManifold** manifolds = engine.dispatcher.getInternalManifoldPointer();
  for (int i = 0; i < engine.dispatcher.getNumManifolds(); ++i)
    if (manifolds[i]->getNumContacts() > 0) keep(*manifolds[i], bodies);
  for (const btRigidBody* body : bodies) keep_near(engine, *body);
}

/// Of a pair of which one side falls asleep and the other is not awake. Bullet has the points of before it moved the
/// bodies.
template <int Dim>
void SmallSteps<Dim>::keep(btPersistentManifold& manifold, std::span<btRigidBody* const> falling_asleep) {
  const btCollisionObject& object_a = *manifold.getBody1();
  const btCollisionObject& object_b = *manifold.getBody0();
  const BodyIndex a = image_of(object_a).of;
  const BodyIndex b = image_of(object_b).of;
  const auto falls_asleep = [&](BodyIndex body) {
    return std::ranges::binary_search(falling_asleep, body, {}, &btRigidBody::getUserIndex);
  };
  const auto is_awake = [&](BodyIndex body) { return body >= 0 && !ring_->has(body); };
  if (!(falls_asleep(a) || falls_asleep(b)) || is_awake(a) || is_awake(b)) return;
  manifold.refreshContactPoints(object_b.getWorldTransform(), object_a.getWorldTransform());
  collect(manifold, step_);
  for (const ContactPoint<Dim>& contact : contacts_)
    ring_->keep({.a = a, .b = b, .contact = contact, .key = key_of(object_a, object_b)});
}

/// Points of a body that falls asleep with what it does not touch yet, but may by the displacements of sleeping bodies.
/// Bullet finds no points between bodies that sleep, and those of boxes and balls only once they overlap.
template <int Dim>
void SmallSteps<Dim>::keep_near(Engine& engine, const btRigidBody& body) {
  const Mover own{&body, {}, 0.5F * ring_->reach()};
  find_around(engine, own, own.turn);
  const BodyIndex b = image_of(body).of;
  for (const btCollisionObject* other : near_) {
    const BodyIndex a = image_of(*other).of;
    const bool awake = a >= 0 && !ring_->has(a);
    if (a == ground_index || awake || ring_->touch(b, a)) continue;
    met_.clear();
    meet({other, {}, own.turn}, own, ring_->reach(), met_);
    contacts_.clear();
    const auto first = static_cast<int>(parts_.size());
    for (const ContactPoint<3>& found : met_)
      if (const std::optional<ContactPoint<Dim>> point = in_world(*other, body, found)) collect(*point, first);
    for (const ContactPoint<Dim>& point : contacts_)
      ring_->keep({.a = a, .b = b, .contact = point, .key = key_of(*other, body)});
  }
}

template <int Dim>
btTransform SmallSteps<Dim>::thaw(const btCollisionObject& object, std::span<const BodyIndex> waking,
                                  btVector3& velocity, btVector3& spin, std::vector<WarmStart::Renewed>& renewed) {
  released_.clear();
  const SolverBody<Dim> state = ring_->wake(object.getUserIndex(), released_);
  renewed.clear();
  const auto shift_asleep = [&](BodyIndex side) {
    return std::ranges::binary_search(waking, side) ? StepMotion<Dim>{} : ring_->shift(side);
  };
  for (const SleepingPoint<Dim>& point : released_) {
    const float moved = point.contact.opening(shift_asleep(point.a), shift_asleep(point.b));
    const auto a = static_cast<BodyIndex>(point.key.a);
    const auto b = static_cast<BodyIndex>(point.key.b);
    const bool of_b = WarmStart::owns(b, a);
    const btVector3 friction = from_solver<Dim>(point.contact.friction_impulse);
    const SpinF<Dim>& rolling = point.contact.rolling_impulse;
    renewed.push_back({.owner = of_b ? b : a,
                       .partner = of_b ? a : b,
                       .arm = from_solver<Dim>(of_b ? point.contact.arm_b : point.contact.arm_a),
                       .distance = point.contact.gap - moved,
                       .impulse = point.contact.normal_impulse,
                       .friction = of_b ? friction : -friction,
                       .mark = marked(of_b ? rolling : SpinF<Dim>(-rolling))});
  }
  std::ranges::stable_sort(renewed, {}, &WarmStart::Renewed::owner);
  velocity = from_solver<Dim>(state.velocity);
  spin = spin_from_solver<Dim>(state.spin);
  btTransform place;
  btTransformUtil::integrateTransform(object.getWorldTransform(), from_solver<Dim>(state.way),
                                      spin_from_solver<Dim>(state.turn), 1, place);
  return place;
}

template class SmallSteps<2>;
template class SmallSteps<3>;

}  // namespace talus::bullet
