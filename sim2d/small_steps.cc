#include "sim2d/small_steps.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <tuple>

#include "sim2d/conversions.h"

namespace talus::box2d {
namespace {

// A step is solved again when a body that was struck in it gets past something out of its expected reach: a
// chain of so many may be struck in a step.
constexpr int rounds = 8;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

VecF<2> vector(const b2Vec2& v) { return {v.x, v.y}; }
b2Vec2 to_box2d(const VecF<2>& v) { return {v.x(), v.y()}; }

/// Of a polygon or line: contacts are known so long before the bodies touch, and none is lost while a corner lifts by
/// less [m].
float skin_of(const b2Fixture& fixture) {
  return fixture.GetType() == b2Shape::e_circle ? 0.0F : fixture.GetShape()->m_radius;
}

/// Ascending as (first, second) are.
std::uint64_t ascending_pair(std::int32_t first, std::int32_t second) {
  constexpr std::uint32_t sign = 0x80000000;
  return (std::uint64_t{static_cast<std::uint32_t>(first) ^ sign} << 32U) | (static_cast<std::uint32_t>(second) ^ sign);
}

/// As Box2D has it.
VecF<2> tangent_of(const ContactPoint<2>& point) { return {point.normal.y(), -point.normal.x()}; }

SolverBody<2> solver_body(const b2Body& from, const b2MassData& mass) {
  SolverBody<2> body;
  body.velocity = vector(from.GetLinearVelocity());
  body.spin[0] = from.GetAngularVelocity();
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

/// A copy of a fixture's shape whose skin is `more` thicker.
EnginePiece thickened(const b2Fixture& fixture, float more) {
  if (fixture.GetType() == b2Shape::e_circle) {
    b2CircleShape circle = static_cast<const b2CircleShape&>(*fixture.GetShape());
    circle.m_radius += more;
    return circle;
  }
  b2PolygonShape polygon = static_cast<const b2PolygonShape&>(*fixture.GetShape());
  polygon.m_radius += more;
  return polygon;
}

/// Contact of two shapes, of which the second is a disc or a polygon and the first may be a line too. Returns whether
/// they were swapped, as Box2D has it.
bool collide(b2Manifold& manifold, const b2Shape& a, const b2Transform& at_a, const b2Shape& b,
             const b2Transform& at_b) {
  const auto disc = [](const b2Shape& shape) { return static_cast<const b2CircleShape*>(&shape); };
  const auto polygon = [](const b2Shape& shape) { return static_cast<const b2PolygonShape*>(&shape); };
  const bool b_is_disc = b.GetType() == b2Shape::e_circle;
  switch (a.GetType()) {
    case b2Shape::e_edge:
      if (b_is_disc)
        b2CollideEdgeAndCircle(&manifold, static_cast<const b2EdgeShape*>(&a), at_a, disc(b), at_b);
      else
        b2CollideEdgeAndPolygon(&manifold, static_cast<const b2EdgeShape*>(&a), at_a, polygon(b), at_b);
      return false;
    case b2Shape::e_circle:
      if (b_is_disc) {
        b2CollideCircles(&manifold, disc(a), at_a, disc(b), at_b);
        return false;
      }
      b2CollidePolygonAndCircle(&manifold, polygon(b), at_b, disc(a), at_a);
      return true;
    default:
      if (b_is_disc)
        b2CollidePolygonAndCircle(&manifold, polygon(a), at_a, disc(b), at_b);
      else
        b2CollidePolygons(&manifold, polygon(a), at_a, polygon(b), at_b);
      return false;
  }
}

}  // namespace

SmallSteps::SmallSteps(const WorldDescription<2>& description)
    : params_{.sub_steps = description.solver.sub_steps,
              .restitution_threshold = static_cast<float>(description.solver.restitution_threshold)},
      dt_(static_cast<float>(description.dt)) {
  double thinnest = std::numeric_limits<double>::infinity();
  bool rolls = false;
  for (const Shape<2>& shape : description.shapes) {
    reach_ = std::max(reach_, static_cast<float>(shape.extent));
    reaches_.push_back(static_cast<float>(bounding_radius(shape)));
    thinnest = std::min(thinnest, least_width(shape));
    arms_.push_back(rolling_arm(shape));
    rolls = rolls || arms_.back() > 0.0;
  }
  if (!rolls) arms_.clear();
  fast_ = static_cast<float>(thinnest / 4.0);
}

EngineTimes SmallSteps::step(b2World& world, const StepInput& input, std::span<b2Body* const> bodies) {
  const double start = now();
  // Box2D gives access to its contact manager for reading only.
  const_cast<b2ContactManager&>(world.GetContactManager()).Collide();  // NOLINT(*-const-cast)
  detected_ = input.states.size();
  expect_motion(world, input, bodies);
  if (ring_) ring_->start();
  double solving = 0.0;
  for (int round = 0; round < rounds; ++round) {
    add_bodies(input, bodies);
    for (const Ahead& each : ahead_) add_points(each.pair, each.manifold, each.place, input);
    add_contacts(world, input);
    if (ring_) ring_->extend(solver_, obstacle_slots_);
    const double added = now();
    solver_.solve(params_, vector(world.GetGravity()), dt_);
    solving += now() - added;
    if (!passes_unseen(world, input, bodies)) break;
    if (ring_) ring_->start_again();
  }
  if (ring_) ring_->read(solver_, world.GetGravity().Length());
  write_impulses();
  move_bodies(input, bodies);
  for (const BodyIndex sleeper : sleepers_) slots_[sleeper] = 0;
  sleepers_.clear();
  for (const BodyIndex body : input.awake) slots_[body] = 0;
  return {.collide = now() - start - solving, .solve = solving};
}

/// From the velocities; finds the contacts ahead of what is fast.
void SmallSteps::expect_motion(b2World& world, const StepInput& input, std::span<b2Body* const> bodies) {
  slots_.resize(input.states.shape.size(), 0);
  expected_.clear();
  ahead_.clear();
  fast_bodies_.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Image& image = input.images[input.awake[i]];
    if (image.sides == 0) expected_.push_back(motion_by_velocity(*bodies[i]));
    // An image comes after what it is an image of.
    slots_[input.awake[i]] = image.sides == 0 ? static_cast<int>(expected_.size()) : slots_[image.of];
    if (is_fast(expected_of(input.awake[i]))) fast_bodies_.push_back(bodies[i]);
  }
  find_ahead(world, true);
}

SmallSteps::Motion SmallSteps::motion_by_velocity(const b2Body& body) const {
  return {dt_ * body.GetLinearVelocity(), dt_ * reach_ * std::abs(body.GetAngularVelocity())};
}

/// After a step is solved: whether a body that was struck, and so moves fast, gets past something. Finds what is ahead
/// of it.
bool SmallSteps::passes_unseen(b2World& world, const StepInput& input, std::span<b2Body* const> bodies) {
  fast_bodies_.clear();
  const auto motion_of_slot = [&](int slot) {
    const SolverBody<2>& body = solver_.body(slot);
    return Motion{to_box2d(body.way), reach_ * std::abs(body.turn[0])};
  };
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (!is_fast(expected_of(input.awake[i])) && is_fast(motion_of_slot(slots_[input.awake[i]])))
      fast_bodies_.push_back(bodies[i]);
  for (b2Body* body : fast_bodies_) {
    const int slot = slots_[owner_of(*body->GetFixtureList())];
    expected_[slot - 1] = motion_of_slot(slot);
  }
  const auto known = static_cast<std::ptrdiff_t>(ahead_.size());
  find_ahead(world, false);
  return std::any_of(ahead_.begin() + known, ahead_.end(), [&](const Ahead& each) { return is_passed(each); });
}

/// Whether the motion of the step presses the two into each other by more than `fast_`.
bool SmallSteps::is_passed(const Ahead& ahead) const {
  const auto way = [&](b2Fixture& fixture, const b2Vec2& at) {
    const BodyIndex owner = owner_of(fixture);
    if (owner < 0 || slots_[owner] == 0) return dt_ * fixture.GetBody()->GetLinearVelocityFromWorldPoint(at);
    const SolverBody<2>& body = solver_.body(slots_[owner]);
    return to_box2d(body.way) + b2Cross(body.turn[0], at - fixture.GetBody()->GetWorldCenter());
  };
  const float skins = skin_of(*ahead.pair.a) + skin_of(*ahead.pair.b);
  for (int i = 0; i < ahead.manifold.pointCount; ++i) {
    const b2Vec2& at = ahead.place.points[i];
    const b2Vec2 apart = way(*ahead.pair.b, at) - way(*ahead.pair.a, at);
    if (ahead.place.separations[i] + skins + b2Dot(apart, ahead.place.normal) < -fast_) return true;
  }
  return false;
}

void SmallSteps::set_ring(const std::optional<SleepRing>& ring) {
  ring_.reset();
  if (ring) ring_.emplace(*ring);
}

void SmallSteps::freeze(b2World& world, const StepInput& input, std::span<const BodyIndex> bodies,
                        std::span<b2Body* const> from) {
  // A body may fall asleep before its first step.
  if (bodies.back() >= detected_)
    const_cast<b2ContactManager&>(world.GetContactManager()).Collide();  // NOLINT(*-const-cast)
  detected_ = input.states.size();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (input.images[bodies[i]].sides != 0) continue;
    const int shape = input.states.shape[bodies[i]];
    ring_->put_to_sleep(bodies[i], solver_body(*from[i], input.templates[shape].mass), reaches_[shape]);
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (const b2ContactEdge* edge = from[i]->GetContactList(); edge != nullptr; edge = edge->next) {
      const BodyIndex other =
          owner_of(edge->contact->GetFixtureA()->GetBody() == from[i] ? *edge->contact->GetFixtureB()
                                                                      : *edge->contact->GetFixtureA());
      if (other >= 0 && input.states.asleep[other] == 0) continue;
      const bool falls_asleep_too = is_dynamic(*edge->other);
      if (edge->contact->IsTouching() && !(falls_asleep_too && other < bodies[i])) keep(*edge->contact, input);
    }
  }
}

void SmallSteps::keep(b2Contact& contact, const StepInput& input) {
  b2WorldManifold place;
  contact.GetWorldManifold(&place);
  const Fixtures pair{contact.GetFixtureA(), contact.GetFixtureB(), contact.GetFriction(), contact.GetRestitution(),
                      &contact};
  int number = 0;
  for (const ContactPoint<2>& point : points_of(pair, *contact.GetManifold(), place, input)) {
    SleepingPoint<2> kept{
        .a = input.original(owner_of(*pair.a)), .b = input.original(owner_of(*pair.b)), .contact = point, .key = {}};
    if (number > 0) kept.contact.rolling_impulse.setZero();
    kept.key = {static_cast<std::uint64_t>(tag_of(*pair.a)), static_cast<std::uint64_t>(tag_of(*pair.b)),
                contact.GetManifold()->points[number].id.key};
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
    if (rolling != 0.0F) rolling_.push_back({saved.low, saved.high, b > a ? rolling : -rolling});
    for (int k = 0; k < b2_maxManifoldPoints && i < released_.size() && released_[i].key.a == pair.a &&
                    released_[i].key.b == pair.b;
         ++k, ++i) {
      const ContactPoint<2>& point = released_[i].contact;
      saved.points[k] = {released_[i].key.point, point.normal_impulse, point.friction_impulse.dot(tangent_of(point))};
    }
    warm.save(saved);
  }
  sort_rolling();
  return state;
}

void SmallSteps::skip() {
  if (ring_) ring_->start();
}

void SmallSteps::forget(BodyIndex side) {
  if (ring_) ring_->forget(side);
}

void SmallSteps::add_bodies(const StepInput& input, std::span<b2Body* const> bodies) {
  solver_.start();
  sources_.clear();
  for (const BodyIndex sleeper : sleepers_) slots_[sleeper] = 0;
  sleepers_.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const BodyIndex body = input.awake[i];
    if (input.images[body].sides == 0)
      solver_.add(solver_body(*bodies[i], input.templates[input.states.shape[body]].mass));
  }
  for (const Push<2>& push : input.pushes) {
    const b2MassData& mass = input.templates[input.states.shape[push.body]].mass;
    solver_.push(slots_[push.body], push.force.cast<float>() / mass.mass);
  }
  obstacle_slots_.assign(input.obstacles.size(), 0);
  for (std::size_t i = 0; i < input.obstacles.size(); ++i) {
    const b2Body* from = input.obstacles[i];
    if (from == nullptr || from->GetType() != b2_kinematicBody) continue;
    SolverBody<2> body;
    body.velocity = vector(from->GetLinearVelocity());
    body.spin[0] = from->GetAngularVelocity();
    obstacle_slots_[i] = solver_.add(body);
  }
}

/// For a contact with this normal.
int SmallSteps::slot_of(b2Fixture& fixture, const b2Vec2& normal, const StepInput& input) {
  const BodyIndex owner = owner_of(fixture);
  if (owner <= first_obstacle) {
    const int number = first_obstacle - owner;
    if (input.belts.empty() || input.belts[number].isZero(0.0)) return obstacle_slots_[number];
    return solver_.add_belt(input.belts[number].cast<float>(), vector(normal));
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

/// A sleeper's body in Box2D is one that it shares with others.
b2Vec2 SmallSteps::centre_of(b2Fixture& fixture, const BodyStates<2>& states) {
  const BodyIndex owner = owner_of(fixture);
  return owner >= 0 && !is_dynamic(*fixture.GetBody()) ? to_engine(states.pose[owner].position)
                                                       : fixture.GetBody()->GetWorldCenter();
}

void SmallSteps::add_contacts(b2World& world, const StepInput& input) {
  for (b2Contact* contact = world.GetContactList(); contact != nullptr; contact = contact->GetNext()) {
    if (!contact->IsTouching()) continue;
    b2WorldManifold place;
    contact->GetWorldManifold(&place);
    add_points(
        {contact->GetFixtureA(), contact->GetFixtureB(), contact->GetFriction(), contact->GetRestitution(), contact},
        *contact->GetManifold(), place, input);
  }
}

void SmallSteps::add_points(const Fixtures& pair, const b2Manifold& manifold, const b2WorldManifold& place,
                            const StepInput& input) {
  const int a = slot_of(*pair.a, place.normal, input);
  const int b = slot_of(*pair.b, place.normal, input);
  int number = 0;
  for (ContactPoint<2> point : points_of(pair, manifold, place, input)) {
    point.a = a;
    point.b = b;
    solver_.add(point);
    sources_.push_back({tag_of(*pair.a), tag_of(*pair.b), pair.contact, number++});
  }
}

/// Without their slots; valid until the next call.
std::span<const ContactPoint<2>> SmallSteps::points_of(const Fixtures& pair, const b2Manifold& manifold,
                                                       const b2WorldManifold& place, const StepInput& input) {
  points_.clear();
  ContactPoint<2> point;
  point.normal = vector(place.normal);
  point.friction = pair.friction;
  point.restitution = pair.restitution;
  if (!arms_.empty()) add_rolling(pair, input, point);
  const b2Vec2 centre_a = centre_of(*pair.a, input.states);
  const b2Vec2 centre_b = centre_of(*pair.b, input.states);
  const VecF<2> tangent = vector(b2Cross(place.normal, 1.0F));
  const float skins = skin_of(*pair.a) + skin_of(*pair.b);
  for (int i = 0; i < manifold.pointCount; ++i) {
    point.gap = place.separations[i] + skins;
    const b2Vec2 half = 0.5F * point.gap * place.normal;  // Box2D's point is in the middle of the gap
    point.arm_a = vector(place.points[i] - half - centre_a);
    point.arm_b = vector(place.points[i] + half - centre_b);
    if (pair.contact != nullptr) {
      point.normal_impulse = manifold.points[i].normalImpulse;
      point.friction_impulse = manifold.points[i].tangentImpulse * tangent;
    }
    if (ring_)
      point.gap += point.normal.dot(shift_of(input.original(owner_of(*pair.b)), point.arm_b) -
                                    shift_of(input.original(owner_of(*pair.a)), point.arm_a));
    points_.push_back(point);
  }
  return points_;
}

/// Of a sleeper's point, which Box2D does not know.
VecF<2> SmallSteps::shift_of(BodyIndex side, const VecF<2>& arm) const {
  return side >= 0 && ring_->has(side) ? ring_->shift(side, arm) : VecF<2>::Zero();
}

void SmallSteps::add_rolling(const Fixtures& pair, const StepInput& input, ContactPoint<2>& point) const {
  const auto arm_of = [&](b2Fixture& fixture) {
    const BodyIndex owner = owner_of(fixture);
    return owner >= 0 ? std::optional(arms_[input.states.shape[owner]]) : std::optional<double>();
  };
  point.rolling_arm = static_cast<float>(arm_of_pair(arm_of(*pair.a), arm_of(*pair.b)));
  const Tag a = tag_of(*pair.a);
  const Tag b = tag_of(*pair.b);
  const auto key = [](const Rolling& each) { return std::tuple(each.low, each.high); };
  const auto found = std::ranges::lower_bound(rolling_, std::tuple(std::min(a, b), std::max(a, b)), {}, key);
  if (found != rolling_.end() && key(*found) == std::tuple(std::min(a, b), std::max(a, b)))
    point.rolling_impulse[0] = b == found->high ? found->impulse : -found->impulse;
}

/// Of an awake body as expected.
SmallSteps::Motion SmallSteps::motion_of(b2Fixture& fixture) const {
  const BodyIndex owner = owner_of(fixture);
  if (owner < 0) return motion_by_velocity(*fixture.GetBody());
  return is_dynamic(*fixture.GetBody()) ? expected_of(owner) : Motion{};
}

bool SmallSteps::is_fast(const Motion& motion) const { return motion.longest() > fast_; }

/// Contacts of `fast_bodies_` that begin within the step: found once they overlap, they might be beyond each other.
/// `first`: the first time in the step.
void SmallSteps::find_ahead(b2World& world, bool first) {
  if (fast_bodies_.empty()) return;
  float longest = 0.0F;
  for (const Motion& motion : expected_) longest = std::max(longest, motion.longest());
  for (b2Body* body : fast_bodies_)
    for (b2Fixture* fixture = body->GetFixtureList(); fixture != nullptr; fixture = fixture->GetNext())
      find_ahead(world, *fixture, longest, first);
}

bool SmallSteps::is_known(const b2Fixture& one, const b2Fixture& other) const {
  return std::ranges::any_of(ahead_, [&](const Ahead& each) {
    return (each.pair.a == &one && each.pair.b == &other) || (each.pair.a == &other && each.pair.b == &one);
  });
}

/// `others`: the longest way of any body in the step [m].
void SmallSteps::find_ahead(b2World& world, b2Fixture& fixture, float others, bool first) {
  const b2Body& body = *fixture.GetBody();
  const auto [way, turn] = motion_of(fixture);
  b2AABB box = fixture.GetAABB(0);
  b2AABB end = {box.lowerBound + way, box.upperBound + way};
  box.Combine(end);
  const b2Vec2 around(turn + others, turn + others);
  box.lowerBound -= around;
  box.upperBound += around;
  found_.clear();
  FixtureFinder finder(found_);
  world.QueryAABB(&finder, box);
  std::erase_if(found_, [&](b2Fixture* other) {
    if (other->GetBody() == &body || !b2ContactFilter().ShouldCollide(&fixture, other)) return true;
    if (!is_dynamic(*other->GetBody()) || !is_fast(motion_of(*other))) return false;
    return first ? tag_of(*other) < tag_of(fixture) : is_known(fixture, *other);  // found from there
  });
  for (const b2ContactEdge* edge = body.GetContactList(); edge != nullptr; edge = edge->next)
    if (edge->contact->IsTouching() &&
        (edge->contact->GetFixtureA() == &fixture || edge->contact->GetFixtureB() == &fixture))
      std::erase(found_, edge->contact->GetFixtureA() == &fixture ? edge->contact->GetFixtureB()
                                                                  : edge->contact->GetFixtureA());
  std::ranges::sort(found_, {}, [](b2Fixture* other) { return tag_of(*other); });
  for (b2Fixture* other : found_) {
    const b2Body& of_other = *other->GetBody();
    const Motion of = motion_of(*other);
    const float ahead = (of.way - way).Length() + turn + of.turn;
    const EnginePiece thick = thickened(fixture, ahead);
    Ahead found;
    found.manifold.pointCount = 0;
    const bool swapped =
        collide(found.manifold, *other->GetShape(), of_other.GetTransform(), base(thick), body.GetTransform());
    if (found.manifold.pointCount == 0) continue;
    found.pair = {other, &fixture, b2MixFriction(other->GetFriction(), fixture.GetFriction()),
                  std::sqrt(other->GetRestitution() * fixture.GetRestitution()), nullptr};
    if (swapped) std::swap(found.pair.a, found.pair.b);
    const b2Fixture& a = *found.pair.a;
    const b2Fixture& b = *found.pair.b;
    found.place.Initialize(&found.manifold, a.GetBody()->GetTransform(), a.GetShape()->m_radius,
                           b.GetBody()->GetTransform(), b.GetShape()->m_radius);
    ahead_.push_back(found);
  }
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
  sort_rolling();
}

void SmallSteps::sort_rolling() {
  std::ranges::sort(rolling_, {}, [](const Rolling& each) { return std::tuple(each.low, each.high); });
}

/// Box2D's own limits of a step hold.
void SmallSteps::move_bodies(const StepInput& input, std::span<b2Body* const> bodies) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const SolverBody<2>& from = solver_.body(slots_[input.awake[i]]);
    b2Body& body = *bodies[i];
    const float longest = b2_maxTranslation / std::max(from.way.norm(), b2_maxTranslation);
    const float largest = b2_maxRotation / std::max(std::abs(from.turn[0]), b2_maxRotation);
    body.SetLinearVelocity(to_box2d(longest * from.velocity));
    body.SetAngularVelocity(largest * from.spin[0]);
    const b2Vec2 to = body.GetPosition() + to_box2d(longest * from.way);
    const float angle = body.GetAngle() + largest * from.turn[0];
    if (to.IsValid() && b2IsValid(angle)) body.SetTransform(to, angle);  // else the velocity tells it
  }
}

void SmallSteps::gather(const BodyStates<2>& states, std::vector<Contact<2>>& out) const {
  const auto awake = [&](BodyIndex body) { return body >= 0 && states.asleep[body] == 0; };
  ordered_.clear();
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const Source& source = sources_[i];
    const BodyIndex a = owner_of(source.a);
    const BodyIndex b = owner_of(source.b);
    const bool swap = !awake(a) || (awake(b) && b < a);
    const Tag first = swap ? source.b : source.a;
    const Tag second = swap ? source.a : source.b;
    ordered_.push_back({ascending_pair(owner_of(first), owner_of(second)),
                        ascending_pair(piece_of(second), piece_of(first)), static_cast<std::uint32_t>(i), swap});
  }
  std::ranges::sort(ordered_);
  for (const Listed& listed : ordered_) {
    const Source& source = sources_[listed.source];
    const ContactPoint<2>& point = solver_.points()[listed.source];
    if (source.contact == nullptr && point.normal_sum == 0.0F) continue;  // did not touch
    const SolverBody<2>& a = solver_.body(point.a);
    const SolverBody<2>& b = solver_.body(point.b);
    const auto moved = [](const SolverBody<2>& body, const VecF<2>& arm) -> VecF<2> {
      return body.way + body.turn[0] * VecF<2>(-arm.y(), arm.x());
    };
    const float gap = point.gap + point.normal.dot(moved(b, point.arm_b) - moved(a, point.arm_a));
    const double sign = listed.swapped ? 1.0 : -1.0;  // the result's normal points to its first body
    Contact<2>& contact = out.emplace_back();
    contact.a = owner_of(listed.swapped ? source.b : source.a);
    contact.b = owner_of(listed.swapped ? source.a : source.b);
    const VecF<2>& arm = listed.swapped ? point.arm_b : point.arm_a;
    contact.point = states.pose[contact.a].position + arm.cast<double>();
    contact.normal = sign * point.normal.cast<double>();
    contact.normal_impulse = point.normal_sum;
    contact.friction_impulse = sign * point.friction_sum.cast<double>();
    contact.approach_speed = std::max(0.0F, point.approach_speed);
    contact.depth = -gap;
  }
}

}  // namespace talus::box2d
