#include "sim2d/body_template.h"

#include <algorithm>
#include <cmath>

#include "sim2d/conversions.h"
#include "sim2d/tag.h"

namespace talus::box2d {

b2FixtureDef fixture_of(const Material& material, const SolverParams& solver) {
  b2FixtureDef fixture;
  fixture.density = 0.0F;
  fixture.friction = static_cast<float>(material.friction);
  fixture.restitution = static_cast<float>(material.restitution);
  fixture.restitutionThreshold = static_cast<float>(solver.restitution_threshold);
  return fixture;
}

namespace {

/// Where the skin of a polygon has an effect on the other pieces [m].
struct Skins {
  double around_discs = 0.0;  // added to their radius
  double within_sides = 0.0;  // taken off a capsule's sides, so that they lie flush with its ends
};

b2CircleShape disc(const Vec2& centre, double radius, const Skins& skins) {
  b2CircleShape circle;
  circle.m_p = to_engine(centre);
  circle.m_radius = static_cast<float>(radius + skins.around_discs);
  return circle;
}

b2PolygonShape rectangle(const Pose<2>& pose, const Vec2& half) {
  b2PolygonShape polygon;
  const b2Vec2 h = to_engine(half);
  polygon.SetAsBox(h.x, h.y, to_engine(pose.position), engine_angle(pose.rotation.angle()));
  return polygon;
}

/// Filled in by hand: b2PolygonShape::Set() welds corners closer than 2.5 mm and aborts on what it then finds flat.
b2PolygonShape convex_polygon(const HullPiece<2>& hull) {
  b2PolygonShape polygon;
  polygon.m_count = static_cast<int>(hull.corners.size());
  for (std::size_t i = 0; i < hull.corners.size(); ++i) {
    const Vec2 side = (hull.corners[(i + 1) % hull.corners.size()] - hull.corners[i]).normalized();
    polygon.m_vertices[i] = to_engine(hull.corners[i]);
    polygon.m_normals[i] = to_engine(Vec2(side.y(), -side.x()));
  }
  polygon.m_centroid = to_engine(mass_properties<2>(hull).centre);
  return polygon;
}

void append_capsule(std::vector<EnginePiece>& out, const Vec2& a, const Vec2& b, double radius, const Skins& skins) {
  out.emplace_back(disc(a, radius, skins));
  out.emplace_back(disc(b, radius, skins));
  const Vec2 along = b - a;
  const Pose<2> middle{(a + b) / 2.0, Rotation<2>(std::atan2(along.y(), along.x()))};
  const double half_width = std::max(radius - skins.within_sides, radius / 4.0);
  out.emplace_back(rectangle(middle, {along.norm() / 2.0, half_width}));
}

void append(std::vector<EnginePiece>& out, const BoxPiece<2>& box, const Skins& /*skins*/) {
  out.emplace_back(rectangle(box.pose, box.half));
}

void append(std::vector<EnginePiece>& out, const HullPiece<2>& hull, const Skins& skins) {
  if (hull.corners.size() == 1)
    out.emplace_back(disc(hull.corners[0], hull.radius, skins));
  else if (hull.corners.size() == 2)
    append_capsule(out, hull.corners[0], hull.corners[1], hull.radius, skins);
  else
    out.emplace_back(convex_polygon(hull));
}

}  // namespace

std::vector<EnginePiece> engine_pieces(const Shape<2>& shape, const SolverParams& solver) {
  const Skins skins = solver.small_steps() ? Skins{.around_discs = skin} : Skins{.within_sides = skin};
  std::vector<EnginePiece> out;
  for (const Piece<2>& piece : shape.pieces) std::visit([&](const auto& kind) { append(out, kind, skins); }, piece);
  return out;
}

EnginePiece moved(const EnginePiece& piece, const b2Transform& pose) {
  EnginePiece copy = piece;
  if (auto* circle = std::get_if<b2CircleShape>(&copy)) {
    circle->m_p = b2Mul(pose, circle->m_p);
  } else {
    auto& polygon = std::get<b2PolygonShape>(copy);
    for (int i = 0; i < polygon.m_count; ++i) {
      polygon.m_vertices[i] = b2Mul(pose, polygon.m_vertices[i]);
      polygon.m_normals[i] = b2Mul(pose.q, polygon.m_normals[i]);
    }
    polygon.m_centroid = b2Mul(pose, polygon.m_centroid);
  }
  return copy;
}

b2Fixture* attach(b2Body& body, b2FixtureDef as, std::span<const EnginePiece> pieces, BodyIndex owner) {
  b2Fixture* last = nullptr;
  int number = 0;
  for (const EnginePiece& piece : pieces) {
    as.shape = &base(piece);
    as.userData = to_user_data(make_tag(owner, number++));
    last = body.CreateFixture(&as);
  }
  return last;
}

BodyTemplate make_body_template(const Shape<2>& shape, const SolverParams& solver) {
  b2MassData mass;
  mass.mass = static_cast<float>(shape.mass);
  mass.center.SetZero();
  mass.I = static_cast<float>(shape.inertia(0, 0));
  return {engine_pieces(shape, solver), fixture_of(shape.material, solver), mass};
}

}  // namespace talus::box2d
