#include "common/scene/read_fields.h"

namespace talus {
namespace {

std::optional<Rotation<2>> read_angle(TableReader& table) {
  table.refuse("axis", "means nothing where dimension = 2");
  if (!table.has("angle_deg")) {
    return std::nullopt;
  }
  double angle = 0.0;
  table.read_degrees("angle_deg", angle, between(-360.0, 360.0));
  return Rotation<2>(angle);
}

std::optional<Rotation<3>> read_angle_about_axis(TableReader& table) {
  if (!table.has("angle_deg") && !table.has("axis")) {
    return std::nullopt;
  }
  double angle = 0.0;
  Vec3 axis = Vec3::UnitZ();
  table.require("angle_deg");
  table.require("axis");
  table.read_degrees("angle_deg", angle, between(-360.0, 360.0));
  table.read("axis", axis, coordinate());
  if (axis.norm() < 1e-6) {
    table.reject("axis", "must have a length, of any size");
    return std::nullopt;
  }
  return Rotation<3>(Eigen::AngleAxisd(angle, axis.normalized()));
}

}  // namespace

std::string read_kind(TableReader& table, const std::vector<std::string>& kinds) {
  std::string kind;
  table.require("kind");
  table.read("kind", kind, kinds);
  if (kind.empty()) {
    table.allow_unknown_keys();  // which keys belong here depends on the kind
  }
  return kind;
}

void read_surface(TableReader& table, Material& material) {
  table.read("friction", material.friction, between(0.0, 1e3));
  table.read("restitution", material.restitution, between(0.0, 1.0));
}

template <int Dim>
Vec<Dim> read_size(TableReader& table, std::string_view key) {
  Vec<Dim> size = Vec<Dim>::Ones();
  table.require(key);
  table.read(key, size, length());
  return size;
}

template <int Dim>
std::optional<Rotation<Dim>> read_rotation(TableReader& table) {
  if constexpr (Dim == 2) {
    return read_angle(table);
  } else {
    return read_angle_about_axis(table);
  }
}

template std::optional<Rotation<2>> read_rotation<2>(TableReader&);
template std::optional<Rotation<3>> read_rotation<3>(TableReader&);
template Vec<2> read_size<2>(TableReader&, std::string_view);
template Vec<3> read_size<3>(TableReader&, std::string_view);

}  // namespace talus
