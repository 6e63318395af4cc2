#include "tools/serve/shape_text.h"

#include <fmt/format.h>

#include <numbers>

#include "common/math/angle.h"
#include "common/scene/read_shape.h"
#include "common/scene/toml_text.h"

namespace talus {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

template <int Dim>
std::string point_text(const Vec<Dim>& point) {
  std::vector<std::string> parts;
  for (const double part : point) parts.push_back(toml_text(part));
  return toml_array(parts);
}

/// Kind and size of a piece, in axes that `at` gives.
template <int Dim>
std::string kind_text(const Piece<Dim>& piece, Pose<Dim>& at) {
  at = Pose<Dim>();
  if (const auto* box = std::get_if<BoxPiece<Dim>>(&piece)) {
    at = box->pose;
    return fmt::format("kind = \"box\"\nsize = {}\n", point_text<Dim>(2.0 * box->half));
  }
  const auto& hull = std::get<HullPiece<Dim>>(piece);
  if (hull.corners.size() == 1) {
    at.position = hull.corners[0];
    return fmt::format("kind = \"ball\"\nradius = {}\n", toml_text(hull.radius));
  }
  if (hull.round()) {
    const Vec<Dim> along = hull.corners[1] - hull.corners[0];
    at.position = 0.5 * (hull.corners[0] + hull.corners[1]);
    at.rotation = turn_to(along);
    return fmt::format("kind = \"capsule\"\nlength = {}\nradius = {}\n", toml_text(along.norm() + 2.0 * hull.radius),
                       toml_text(hull.radius));
  }
  std::vector<std::string> corners;
  for (const Vec<Dim>& corner : hull.corners) corners.push_back(point_text<Dim>(corner));
  return fmt::format("kind = \"hull\"\ncorners = {}\n", toml_array(corners));
}

std::string surface_text(const Material& material) {
  return fmt::format("friction = {}\nrestitution = {}\n", toml_text(material.friction),
                     toml_text(material.restitution));
}

}  // namespace

std::string turn_text(const Rotation<2>& rotation) {
  const double angle = degrees * std::remainder(rotation.angle(), 2.0 * std::numbers::pi);
  return angle == 0.0 ? "" : fmt::format("angle_deg = {:.7g}\n", angle);
}

std::string turn_text(const Rotation<3>& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  if (turn.angle() == 0.0) return "";
  const Vec3& axis = turn.axis();
  return fmt::format("angle_deg = {:.7g}\naxis = [{:.8f}, {:.8f}, {:.8f}]\n", degrees * turn.angle(), axis.x(),
                     axis.y(), axis.z());
}

/// Names come in the order of their shapes: first those of tables, a stone's with its variants, then sizes of sources.
template <int Dim>
std::vector<NamedShape> named_shapes(const Scene<Dim>& scene) {
  std::vector<NamedShape> names;
  for (const Shape<Dim>& shape : scene.world.shapes) names.push_back({shape.name, shape.name});
  for (NamedShape& shape : names) {
    const std::size_t mark = shape.base.find(variant_mark);
    if (mark == std::string::npos) continue;
    shape.base.resize(mark);
    shape.name.clear();
  }
  for (const Source<Dim>& source : scene.sources)
    if (!source.shares.empty())
      for (const int shape : source.shapes) names[shape] = {};
  return names;
}

template <int Dim>
std::string shape_text(const Shape<Dim>& shape, const std::string& name) {
  std::string tables;
  std::string parts;
  for (std::size_t i = 0; i < shape.pieces.size(); ++i) {
    Pose<Dim> at;
    const std::string part = fmt::format("{}_part_{}", name, i);
    tables += fmt::format("\n[shape.{}]\n{}density = {}\n", part, kind_text(shape.pieces[i], at),
                          toml_text(shape.material.density));
    parts += fmt::format("\n[[shape.{}.parts]]\nshape = \"{}\"\nposition = {}\n{}", name, part,
                         point_text<Dim>(at.position), turn_text(at.rotation));
  }
  tables += fmt::format("\n[shape.{}]\nkind = \"compound\"\n{}rolling_friction = {}\n", name,
                        surface_text(shape.material), toml_text(shape.material.rolling_friction));
  if (!shape.colour.empty()) tables += fmt::format("colour = {}\n", toml_text(std::string_view(shape.colour)));
  return tables + parts;
}

template <int Dim>
std::string obstacle_text(const Shape<Dim>& shape, const Pose<Dim>& pose) {
  std::string text;
  for (const Piece<Dim>& piece : shape.pieces) {
    Pose<Dim> at;
    const std::string kind = kind_text(piece, at);
    const Pose<Dim> placed = {pose * at.position, pose.rotation * at.rotation};
    text += fmt::format("\n[[obstacle]]\n{}position = {}\n{}{}", kind, point_text<Dim>(placed.position),
                        turn_text(placed.rotation), surface_text(shape.material));
  }
  return text;
}

template std::vector<NamedShape> named_shapes(const Scene<2>&);
template std::vector<NamedShape> named_shapes(const Scene<3>&);
template std::string shape_text(const Shape<2>&, const std::string&);
template std::string shape_text(const Shape<3>&, const std::string&);
template std::string obstacle_text(const Shape<2>&, const Pose<2>&);
template std::string obstacle_text(const Shape<3>&, const Pose<3>&);

}  // namespace talus
