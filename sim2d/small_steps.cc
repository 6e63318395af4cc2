#include "sim2d/small_steps.h"

#include <algorithm>
#include <cmath>

#include "common/solver/solved_contact.h"
#include "common/world/stopwatch.h"
#include "sim2d/body_template.h"
#include "sim2d/conversions.h"

namespace talus::box2d {
namespace {

/// As Box2D has it.
VecF<2> tangent_of(const ContactPoint<2>& point) { return {point.normal.y(), -point.normal.x()}; }

SolverBody<2> solver_body(const b2Body& from, const b2MassData& mass) {
  SolverBody<2> body;
  body.velocity = to_solver(from.GetLinearVelocity());
  body.spin[0] = from.GetAngularVelocity();
  body.position = to_solver(from.GetWorldCenter());
  body.inverse_mass = 1.0F / mass.mass;
  body.inverse_inertia(0, 0) = 1.0F / mass.I;
  body.moves = true;
  return body;
}

/// Collects the fixtures in a box.
class FixtureFinder final : public b2QueryCallback {
 public:
  explicit FixtureFinder(std::vector<b2Fixture*>& found) : found_(&found) {}
  bool ReportFixture(b2Fixture* fixture) override {
    found_->push_back(fixture);
    return true;
  }

 private:
  std::vector<b2Fixture*>* found_;
};

}  // namespace

SmallSteps::SmallSteps(const WorldDescription<2>& description, std::optional<Ring<2>>& ring)
    : ring_(ring),
      params_(description.solver),
      dt_(static_cast<float>(description.dt)),
      fast_(description),
      resistance_(description.shapes),
      drift_(description) {}

void SmallSteps::drift(std::span<b2Body* const> bodies, const StepInput& input) {
  const auto motion = [&](const b2Body& body) {
    return StepMotion<2>{dt_ * to_solver(body.GetLinearVelocity()), SpinF<2>(dt_ * body.GetAngularVelocity())};
  };
  const auto move = [](b2Body& body, const StepMotion<2>& by) {
    if (!by.is_none()) body.SetTransform(body.GetPosition() + from_solver(by.way), body.GetAngle() + by.turn[0]);
  };
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (input.images[input.awake[i]].sides == 0) drift_.add(fast_.drift(motion(*bodies[i])));
    move(*bodies[i], drift_.last());
  }
  for (std::size_t i = 0; i < input.obstacles.size(); ++i) {
    b2Body* obstacle = input.obstacles[i];
    if (obstacle == nullptr || obstacle->GetType() != b2_kinematicBody) continue;
    const StepMotion<2> by = fast_.drift_of_obstacle(static_cast<int>(i), motion(*obstacle));
    drift_.set(static_cast<int>(i), by);
    move(*obstacle, by);
  }
}

EngineTimes SmallSteps::step(b2World& world, const StepInput& input, std::span<b2Body* const> bodies) {
  Stopwatch watch;
  collision_.collide(world, std::ssize(bodies), *team_);
  detected_ = input.states.size();
  slots_.resize(input.states.shape.size(), 0);
  ahead_.clear();
  if (ring_) ring_->start();
  double solving = 0.0;
  for (int round = 1;; ++round) {
    add_bodies(input, bodies);
    if (round == 1) expect_motion(world, input, bodies);
    add_points_ahead(input);
    add_contacts(input);
    if (ring_) ring_->extend(solver_, obstacle_slots_);
    Stopwatch solve;
    solver_.solve(params_, to_solver(world.GetGravity()), dt_);
    solving += solve.lap();
    if (round == most_solves) break;
    const bool struck = ring_ && ring_->widen(solver_, world.GetGravity().Length());
    if (!passes_unseen(world, input, bodies) && !struck) break;
    if (ring_) ring_->start_again();
  }
  if (ring_) ring_->read(solver_, world.GetGravity().Length(), dt_);
  write_impulses();
  move_bodies(input, bodies);
  for (const BodyIndex body : input.awake) slots_[body] = 0;
  drift_.end();
  return {.collide = watch.lap() - solving, .solve = solving};
}

/// From the velocities; finds the contacts ahead of what is fast.
void SmallSteps::expect_motion(b2World& world, const StepInput& input, std::span<b2Body* const> bodies) {
  fast_.expect(solver_, static_cast<int>(first_of_.size()), dt_);
  for (b2Contact* contact : collision_.touching())
    if (is_buried(*contact)) add_ground_ahead(input, *contact->GetFixtureB()->GetBody());
  // Below the line a body would be lost, so its ground is sought earlier.
  for (int slot = 1; slot <= std::ssize(first_of_); ++slot)
    if (fast_.is_half_fast(slot))
      for (b2Body* body : bodies_at<b2Body>(slot, first_of_, bodies)) add_ground_ahead(input, *body);
  for (const int slot : fast_.found())
    for (b2Body* body : bodies_at<b2Body>(slot, first_of_, bodies)) find_ahead(world, input, *body, true);
}

/// The ground is a line: Box2D pushes a body further down if its middle is below the line.
bool SmallSteps::is_buried(b2Contact& contact) {
  if (owner_of(*contact.GetFixtureA()) != ground_index) return false;
  if (!is_dynamic(*contact.GetFixtureB()->GetBody())) return false;
  b2WorldManifold place;
  contact.GetWorldManifold(&place);
  return place.normal.y < 0.0F;
}

/// After a step is solved: whether a body that was struck, and so moves fast, gets past something. Finds what is ahead
/// of it.
bool SmallSteps::passes_unseen(b2World& world, const StepInput& input, std::span<b2Body* const> bodies) {
  const auto known = static_cast<std::ptrdiff_t>(ahead_.size());
  fast_.follow(solver_);
  for (const int slot : fast_.found())
    for (b2Body* body : bodies_at<b2Body>(slot, first_of_, bodies)) find_ahead(world, input, *body, false);
  return std::any_of(ahead_.begin() + known, ahead_.end(),
                     [&](const Ahead& each) { return fast_.passes(solver_, each.point); });
}

void SmallSteps::freeze(b2World& world, const StepInput& input, std::span<const BodyIndex> bodies,
                        std::span<b2Body* const> from) {
  // A body may fall asleep before its first step.
  if (bodies.back() >= detected_) collision_.collide(world, std::ssize(bodies), *team_);
  detected_ = input.states.size();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (input.images[bodies[i]].sides != 0) continue;
    const int shape = input.states.shape[bodies[i]];
    ring_->put_to_sleep(bodies[i], solver_body(*from[i], input.templates[shape].mass), resistance_.reach(shape));
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (const b2ContactEdge* edge = from[i]->GetContactList(); edge != nullptr; edge = edge->next) {
      const BodyIndex other =
          owner_of(edge->contact->GetFixtureA()->GetBody() == from[i] ? *edge->contact->GetFixtureB()
                                                                      : *edge->contact->GetFixtureA());
      if (other >= 0 && input.states.asleep[other] == 0) continue;
      const bool falls_asleep_too = is_dynamic(*edge->other);
      if (edge->contact->IsTouching() && !is_buried(*edge->contact) && !(falls_asleep_too && other < bodies[i]))
        keep(*edge->contact, input);
    }
  }
  for (b2Body* body : from) keep_near(world, input, *body);
}

void SmallSteps::keep(b2Contact& contact, const StepInput& input) {
  b2WorldManifold place;
  contact.GetWorldManifold(&place);
  keep(fixtures_of(contact), *contact.GetManifold(), place, input);
}

/// Points of a body that falls asleep with what it does not touch yet, but may by the displacements of sleeping bodies.
/// Box2D finds no contacts between bodies that sleep, and others only within their skins.
void SmallSteps::keep_near(b2World& world, const StepInput& input, b2Body& body) {
  const float reach = ring_->reach();
  const BodyIndex own = input.original(owner_of(*body.GetFixtureList()));
  found_near_.clear();
  for (b2Fixture* fixture = body.GetFixtureList(); fixture != nullptr; fixture = fixture->GetNext()) {
    find_around(world, {fixture, {}, 0.5F * reach}, 0.5F * reach);
    for (b2Fixture* other : found_) {
      const BodyIndex side = input.original(owner_of(*other));
      const bool awake = side >= 0 && !ring_->has(side);
      if (awake || ring_->touch(own, side)) continue;
      if (const std::optional<Meeting> met = meet({other, {}, 0.5F * reach}, {fixture, {}, 0.5F * reach}, reach))
        found_near_.push_back(*met);
    }
  }
  for (const Meeting& met : found_near_)
    keep(unknown_pair(*met.a.fixture, *met.b.fixture), met.manifold, met.place, input);
}

void SmallSteps::keep(const Fixtures& pair, const b2Manifold& manifold, const b2WorldManifold& place,
                      const StepInput& input) {
  int number = 0;
  for (const ContactPoint<2>& point : points_of(pair, manifold, place, input, {})) {
    SleepingPoint<2> kept{
        .a = input.original(owner_of(*pair.a)), .b = input.original(owner_of(*pair.b)), .contact = point, .key = {}};
    kept.key = {static_cast<std::uint64_t>(tag_of(*pair.a)), static_cast<std::uint64_t>(tag_of(*pair.b)),
                manifold.points[number].id.key};
    ring_->keep(kept);
    ++number;
  }
}

SolverBody<2> SmallSteps::thaw(BodyIndex body, WarmStart& warm) {
  released_.clear();
  SolverBody<2> state = ring_->wake(body, released_);
  for (std::size_t i = 0; i < released_.size();) {
    const PointKey& pair = released_[i].key;
    const Tag a{pair.a};
    const Tag b{pair.b};
    SavedContact saved{std::min(a, b), std::max(a, b), {}};
    const float rolling = released_[i].contact.rolling_impulse[0];
    if (rolling != 0.0F) {
      const Rolling kept{saved.low, saved.high, b > a ? rolling : -rolling};
      rolling_.insert(std::ranges::upper_bound(rolling_, kept.pair(), {}, &Rolling::pair), kept);
    }
    for (int k = 0; k < b2_maxManifoldPoints && i < released_.size() && released_[i].key.a == pair.a &&
                    released_[i].key.b == pair.b;
         ++k, ++i) {
      const ContactPoint<2>& point = released_[i].contact;
      saved.points[k] = {released_[i].key.point, point.normal_impulse, point.friction_impulse.dot(tangent_of(point))};
    }
    warm.save(saved);
  }
  return state;
}

void SmallSteps::add_bodies(const StepInput& input, std::span<b2Body* const> bodies) {
  solver_.start();
  sources_.clear();
  for (const BodyIndex sleeper : sleepers_) slots_[sleeper] = 0;
  sleepers_.clear();
  first_of_.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const BodyIndex body = input.awake[i];
    const Image& image = input.images[body];  // comes after what it is an image of
    if (image.sides != 0) {
      slots_[body] = slots_[image.of];
      continue;
    }
    first_of_.push_back(i);
    slots_[body] = solver_.add(solver_body(*bodies[i], input.templates[input.states.shape[body]].mass));
  }
  for (const Push<2>& push : input.pushes) {
    const b2MassData& mass = input.templates[input.states.shape[push.body]].mass;
    solver_.push(slots_[push.body], push.force.cast<float>() / mass.mass);
  }
  obstacle_slots_.assign(input.obstacles.size(), 0);
  for (std::size_t i = 0; i < input.obstacles.size(); ++i) {
    const b2Body* from = input.obstacles[i];
    if (from == nullptr || from->GetType() != b2_kinematicBody) continue;
    if (from->GetLinearVelocity() == b2Vec2_zero && from->GetAngularVelocity() == 0.0F) continue;
    SolverBody<2> body;
    body.velocity = to_solver(from->GetLinearVelocity());
    body.spin[0] = from->GetAngularVelocity();
    obstacle_slots_[i] = solver_.add(body);
  }
}

/// For a contact with this normal.
int SmallSteps::slot_of(BodyIndex owner, const VecF<2>& normal, const StepInput& input) {
  if (owner <= first_obstacle) {
    const int number = first_obstacle - owner;
    if (input.belts.empty() || input.belts[number].isZero(0.0)) return obstacle_slots_[number];
    return solver_.add_belt(input.belts[number].cast<float>(), normal);
  }
  if (owner < 0) return 0;
  if (ring_ && ring_->has(input.original(owner))) return ring_->join(input.original(owner), solver_);
  if (slots_[owner] == 0) {
    const b2MassData& mass = input.templates[input.states.shape[owner]].mass;
    SolverBody<2> sleeper;
    sleeper.inverse_mass = 1.0F / mass.mass;
    sleeper.inverse_inertia(0, 0) = 1.0F / mass.I;
    slots_[owner] = solver_.add(sleeper);
    sleepers_.push_back(owner);
  }
  return slots_[owner];
}

/// The centre of a fixture's body at the start of the step.
b2Vec2 SmallSteps::start_of(b2Fixture& fixture, const BodyStates<2>& states) const {
  const BodyIndex owner = owner_of(fixture);
  if (owner >= 0) return to_engine(states.pose[owner].position);
  return fixture.GetBody()->GetPosition() - from_solver(drift_of(owner).way);
}

void SmallSteps::add_points_ahead(const StepInput& input) {
  for (Ahead& each : ahead_) {
    each.point.a = slot_of(owner_of(each.a), each.point.normal, input);
    each.point.b = slot_of(owner_of(each.b), each.point.normal, input);
    solver_.add(each.point);
    sources_.push_back({each.a, each.b, nullptr, each.number});
  }
}

void SmallSteps::add_contacts(const StepInput& input) {
  for (b2Contact* contact : collision_.touching()) {
    if (is_buried(*contact)) continue;
    const Fixtures pair = fixtures_of(*contact);
    b2WorldManifold place;
    contact->GetWorldManifold(&place);
    const int a = slot_of(owner_of(*pair.a), to_solver(place.normal), input);
    const int b = slot_of(owner_of(*pair.b), to_solver(place.normal), input);
    int number = 0;
    const Motions moved{drift_of(owner_of(*pair.a)), drift_of(owner_of(*pair.b))};
    for (ContactPoint<2> point : points_of(pair, *contact->GetManifold(), place, input, moved)) {
      point.a = a;
      point.b = b;
      solver_.add(point);
      sources_.push_back({tag_of(*pair.a), tag_of(*pair.b), contact, number++});
    }
  }
}

SmallSteps::Fixtures SmallSteps::fixtures_of(b2Contact& contact) {
  return {contact.GetFixtureA(), contact.GetFixtureB(), contact.GetFriction(), contact.GetRestitution(), &contact};
}

/// Of which Box2D has no contact.
SmallSteps::Fixtures SmallSteps::unknown_pair(b2Fixture& a, b2Fixture& b) {
  return {&a, &b, b2MixFriction(a.GetFriction(), b.GetFriction()),
          static_cast<float>(pair_restitution(a.GetRestitution(), b.GetRestitution())), nullptr};
}

/// Without their slots; valid until the next call. `moved`: of the sides, when their contact was found.
std::span<const ContactPoint<2>> SmallSteps::points_of(const Fixtures& pair, const b2Manifold& manifold,
                                                       const b2WorldManifold& place, const StepInput& input,
                                                       const Motions& moved) {
  points_.clear();
  ContactPoint<2> point;
  point.normal = to_solver(place.normal);
  point.friction = pair.friction;
  point.restitution = pair.restitution;
  resistance_.add_to(point, input.states, owner_of(*pair.a), owner_of(*pair.b));
  if (point.rolling_arm > 0.0F) add_rolling_impulse(pair, point);
  const b2Vec2 centre_a = start_of(*pair.a, input.states) + from_solver(moved.a.way);
  const b2Vec2 centre_b = start_of(*pair.b, input.states) + from_solver(moved.b.way);
  Motions asleep;  // which the poses in Box2D do not contain
  if (ring_) {
    asleep.a = ring_->shift(input.original(owner_of(*pair.a)));
    asleep.b = ring_->shift(input.original(owner_of(*pair.b)));
  }
  const VecF<2> tangent = to_solver(b2Cross(place.normal, 1.0F));
  for (int i = 0; i < manifold.pointCount; ++i) {
    point.gap = place.separations[i] + 2.0F * skin;
    const b2Vec2 half = 0.5F * point.gap * place.normal;  // Box2D's point is in the middle of the gap
    point.arm_a = to_solver(place.points[i] - half - centre_a);
    point.arm_b = to_solver(place.points[i] + half - centre_b);
    if (pair.contact != nullptr) {
      point.normal_impulse = manifold.points[i].normalImpulse;
      point.friction_impulse = manifold.points[i].tangentImpulse * tangent;
    }
    point.gap += point.opening(asleep.a, asleep.b) - point.opening(moved.a, moved.b);
    points_.push_back(point);
    point.rolling_impulse.setZero();  // that of the pair is in its first point
  }
  return points_;
}

StepMotion<2> SmallSteps::drift_of(BodyIndex owner) const { return drift_.of(owner, owner >= 0 ? slots_[owner] : 0); }

void SmallSteps::add_rolling_impulse(const Fixtures& pair, ContactPoint<2>& point) const {
  const Tag a = tag_of(*pair.a);
  const Tag b = tag_of(*pair.b);
  const std::pair<Tag, Tag> sought = std::minmax(a, b);
  const auto found = std::ranges::lower_bound(rolling_, sought, {}, &Rolling::pair);
  if (found != rolling_.end() && found->pair() == sought)
    point.rolling_impulse[0] = b == found->high ? found->impulse : -found->impulse;
}

/// 0: does not move in this step.
int SmallSteps::moving_slot(BodyIndex owner) const {
  if (owner <= first_obstacle) return obstacle_slots_[first_obstacle - owner];
  return owner >= 0 && solver_.body(slots_[owner]).moves ? slots_[owner] : 0;
}

Mover SmallSteps::mover_of(b2Fixture& fixture) const {
  const BodyIndex owner = owner_of(fixture);
  const int slot = moving_slot(owner);
  if (slot == 0) return {&fixture, {}, 0.0F};
  const StepMotion<2> drift = drift_of(owner);
  if (owner >= 0)
    return {.fixture = &fixture, .motion = fast_.motion(slot), .turn = fast_.turn(fast_.motion(slot)), .drift = drift};
  const StepMotion<2> motion{dt_ * solver_.body(slot).velocity, dt_ * solver_.body(slot).spin};
  return {.fixture = &fixture,
          .motion = motion,
          .turn = fast_.turn_of_obstacle(first_obstacle - owner, motion),
          .drift = drift};
}

/// Contacts of a fast body that begin within the step. `first`: the first time in the step.
void SmallSteps::find_ahead(b2World& world, const StepInput& input, b2Body& body, bool first) {
  for (b2Fixture* fixture = body.GetFixtureList(); fixture != nullptr; fixture = fixture->GetNext()) {
    const Mover fast = mover_of(*fixture);
    find_around(world, fast, fast_.longest());
    for (b2Fixture* other : found_) {
      const BodyIndex owner = owner_of(*other);
      const bool both = owner >= 0 && moving_slot(owner) != 0 && fast_.is_fast(moving_slot(owner));
      if (first ? both && tag_of(*other) < tag_of(*fixture) : is_known(*fixture, *other)) continue;
      const Mover second = mover_of(*other);
      if ((second.motion.way - fast.motion.way).norm() + second.turn + fast.turn <= fast_.limit()) continue;
      if (const std::optional<Meeting> met = meet(second, fast, fast_.near())) add_ahead(*met, input);
    }
  }
  add_ground_ahead(input, body);
}

/// The fixtures in the mover's box and `margin` [m] around it, but for the ground.
void SmallSteps::find_around(b2World& world, const Mover& mover, float margin) {
  b2AABB box = swept(mover);
  const b2Vec2 around(margin, margin);
  box.lowerBound -= around;
  box.upperBound += around;
  found_.clear();
  FixtureFinder finder(found_);
  world.QueryAABB(&finder, box);
  std::erase_if(found_, [&](b2Fixture* other) {
    return other->GetBody() == mover.fixture->GetBody() || owner_of(*other) == ground_index ||
           !b2ContactFilter().ShouldCollide(mover.fixture, other);
  });
  std::ranges::sort(found_, {}, [](b2Fixture* other) { return tag_of(*other); });
}

bool SmallSteps::is_known(b2Fixture& one, b2Fixture& other) const {
  return std::ranges::any_of(ahead_, [&](const Ahead& each) {
    return (each.a == tag_of(one) && each.b == tag_of(other)) || (each.a == tag_of(other) && each.b == tag_of(one));
  });
}

void SmallSteps::add_ahead(const Meeting& met, const StepInput& input) {
  b2Fixture& a = *met.a.fixture;
  b2Fixture& b = *met.b.fixture;
  const Motions moved{met.a.motion.after(met.share), met.b.motion.after(met.share)};
  for (const ContactPoint<2>& point : points_of(unknown_pair(a, b), met.manifold, met.place, input, moved))
    add_ahead(tag_of(a), tag_of(b), point, *b.GetBody());
}

void SmallSteps::add_ground_ahead(const StepInput& input, b2Body& body) {
  const BodyIndex owner = owner_of(*body.GetFixtureList());
  if (input.images[owner].sides != 0) return;
  const Tag ground = make_tag(ground_index, 0);
  const Tag tag = make_tag(owner, 0);
  if (std::ranges::any_of(ahead_, [&](const Ahead& each) { return each.a == ground && each.b == tag; })) return;
  points_.clear();
  fast_.meet_ground(slots_[owner], input.states.shape[owner], input.states.pose[owner], true, points_);
  for (ContactPoint<2>& point : points_) {
    resistance_.add_to(point, input.states, ground_index, owner);
    add_ahead(ground, tag, point, body);
  }
}

/// Adds nothing where Box2D already has that point between `body_b` and the owner of `a`.
void SmallSteps::add_ahead(Tag a, Tag b, ContactPoint<2> point, const b2Body& body_b) {
  const b2Vec2 place = body_b.GetPosition() + from_solver(point.arm_b);
  for (const b2ContactEdge* edge = body_b.GetContactList(); edge != nullptr; edge = edge->next) {
    if (!edge->contact->IsTouching() || is_buried(*edge->contact)) continue;
    const BodyIndex other =
        owner_of(edge->contact->GetFixtureA()->GetBody() == &body_b ? *edge->contact->GetFixtureB()
                                                                    : *edge->contact->GetFixtureA());
    if (other != owner_of(a)) continue;
    b2WorldManifold known;
    edge->contact->GetWorldManifold(&known);
    for (int i = 0; i < edge->contact->GetManifold()->pointCount; ++i)
      if (b2Distance(known.points[i], place) < fast_.corner()) return;
  }
  point.a = moving_slot(owner_of(a));
  point.b = moving_slot(owner_of(b));
  const bool same_pair = !ahead_.empty() && ahead_.back().a == a && ahead_.back().b == b;
  ahead_.push_back({.a = a, .b = b, .number = same_pair ? ahead_.back().number + 1 : 0, .point = point});
}

void SmallSteps::write_impulses() {
  rolling_.clear();
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const ContactPoint<2>& point = solver_.points()[i];
    const Source& source = sources_[i];
    if (source.contact != nullptr) {
      b2ManifoldPoint& stored = source.contact->GetManifold()->points[source.number];
      stored.normalImpulse = point.normal_impulse;
      stored.tangentImpulse = point.friction_impulse.dot(tangent_of(point));
    }
    if (point.rolling_arm > 0.0F && source.number == 0 && point.rolling_impulse[0] != 0.0F)
      rolling_.push_back({std::min(source.a, source.b), std::max(source.a, source.b),
                          source.b > source.a ? point.rolling_impulse[0] : -point.rolling_impulse[0]});
  }
  std::ranges::sort(rolling_, {}, &Rolling::pair);
}

/// Box2D's own limits of a step hold.
void SmallSteps::move_bodies(const StepInput& input, std::span<b2Body* const> bodies) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const SolverBody<2>& from = solver_.body(slots_[input.awake[i]]);
    b2Body& body = *bodies[i];
    const float longest = b2_maxTranslation / std::max(from.way.norm(), b2_maxTranslation);
    const float largest = b2_maxRotation / std::max(std::abs(from.turn[0]), b2_maxRotation);
    body.SetLinearVelocity(from_solver(longest * from.velocity));
    body.SetAngularVelocity(largest * from.spin[0]);
    const Pose<2>& start = input.states.pose[input.awake[i]];
    const b2Vec2 to = to_engine(start.position) + from_solver(longest * from.way);
    const float angle = static_cast<float>(start.rotation.angle()) + largest * from.turn[0];
    if (to.IsValid() && b2IsValid(angle))
      body.SetTransform(to, angle);  // else engine_read() finds a velocity that is not finite
  }
}

void SmallSteps::gather(const BodyStates<2>& states, std::vector<Contact<2>>& out) const {
  ordered_.clear();
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const Source& source = sources_[i];
    const bool swap = listed_under_second(owner_of(source.a), owner_of(source.b), states.asleep);
    const Tag first = swap ? source.b : source.a;
    const Tag second = swap ? source.a : source.b;
    ordered_.push_back({pair_order(owner_of(first), owner_of(second)), pair_order(piece_of(second), piece_of(first)),
                        static_cast<std::uint32_t>(i), swap});
  }
  std::ranges::sort(ordered_);
  for (const Listed& listed : ordered_) {
    const Source& source = sources_[listed.source];
    const ContactPoint<2>& point = solver_.points()[listed.source];
    if (source.contact == nullptr && point.normal_sum == 0.0F) continue;  // did not touch
    out.push_back(solved_contact(solver_, point, owner_of(source.a), owner_of(source.b), listed.swapped, states));
  }
}

}  // namespace talus::box2d
