#include "sim2d/contacts_ahead.h"

#include <box2d/b2_distance.h>

#include <utility>

#include "sim2d/body_template.h"
#include "sim2d/conversions.h"

namespace talus::box2d {
namespace {

/// A copy of a fixture's shape with a skin that is thicker by `more` [m].
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

/// Contact of two discs or polygons. Returns whether they were swapped, as Box2D has it.
bool collide(b2Manifold& manifold, const b2Shape& a, const b2Transform& at_a, const b2Shape& b,
             const b2Transform& at_b) {
  const auto disc = [](const b2Shape& shape) { return static_cast<const b2CircleShape*>(&shape); };
  const auto polygon = [](const b2Shape& shape) { return static_cast<const b2PolygonShape*>(&shape); };
  const bool a_is_disc = a.GetType() == b2Shape::e_circle;
  const bool b_is_disc = b.GetType() == b2Shape::e_circle;
  if (a_is_disc && b_is_disc)
    b2CollideCircles(&manifold, disc(a), at_a, disc(b), at_b);
  else if (a_is_disc)
    b2CollidePolygonAndCircle(&manifold, polygon(b), at_b, disc(a), at_a);
  else if (b_is_disc)
    b2CollidePolygonAndCircle(&manifold, polygon(a), at_a, disc(b), at_b);
  else
    b2CollidePolygons(&manifold, polygon(a), at_a, polygon(b), at_b);
  return a_is_disc && !b_is_disc;
}

PieceGap<2> gap_between(const Mover& a, const Mover& b, float share) {
  b2DistanceInput input;
  input.proxyA.Set(a.fixture->GetShape(), 0);
  input.proxyB.Set(b.fixture->GetShape(), 0);
  input.transformA = a.after(share);
  input.transformB = b.after(share);
  input.useRadii = false;
  b2SimplexCache cache{};
  b2DistanceOutput output;
  b2Distance(&output, &cache, &input);
  const auto radius = [](const Mover& of) { return of.fixture->GetShape()->m_radius - skin; };
  b2Vec2 normal = output.pointB - output.pointA;
  normal.Normalize();
  return {output.distance - radius(a) - radius(b), to_solver(normal)};
}

}  // namespace

b2Transform Mover::after(float share) const {
  const b2Body& body = *fixture->GetBody();
  return {body.GetPosition() + from_solver(share * motion.way - drift.way),
          b2Rot(body.GetAngle() + share * motion.turn[0] - drift.turn[0])};
}

b2AABB swept(const Mover& mover) {
  b2AABB box = mover.fixture->GetAABB(0);
  const b2Vec2 way = from_solver(mover.motion.way);
  const b2AABB end = {box.lowerBound + way, box.upperBound + way};
  box.Combine(end);
  const float margin = mover.turn + mover.drift.way.norm();
  const b2Vec2 around(margin, margin);
  return {box.lowerBound - around, box.upperBound + around};
}

std::optional<Meeting> meet(const Mover& one, const Mover& other, float near) {
  const StepMotion<2> relative{other.motion.way - one.motion.way, SpinF<2>::Zero()};
  const float turns = one.turn + other.turn;
  if (!b2TestOverlap(swept({other.fixture, relative, turns}), one.fixture->GetAABB(0))) return std::nullopt;
  const std::optional<float> share =
      first_touch<2>(one.motion, other.motion, turns, near, [&](float at) { return gap_between(one, other, at); });
  if (!share) return std::nullopt;
  Meeting met{.a = one, .b = other, .share = *share, .manifold = {}, .place = {}};
  const EnginePiece thick = thickened(*other.fixture, (1.0F - *share) * (relative.way.norm() + turns));
  met.manifold.pointCount = 0;
  if (collide(met.manifold, *one.fixture->GetShape(), one.after(*share), base(thick), other.after(*share)))
    std::swap(met.a, met.b);
  if (met.manifold.pointCount == 0) return std::nullopt;
  met.place.Initialize(&met.manifold, met.a.after(*share), met.a.fixture->GetShape()->m_radius, met.b.after(*share),
                       met.b.fixture->GetShape()->m_radius);
  return met;
}

}  // namespace talus::box2d
