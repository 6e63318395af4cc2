#include "tools/picture/lighting.h"

#include <cmath>
#include <numbers>

namespace talus {
namespace {

constexpr int sun_lamps = 10;
constexpr int sky_lamps = 30;
constexpr int sun_resolution = 768;  // pixels of a lamp's z-buffer on each axis
constexpr int sky_resolution = 320;  // coarse: many shadows on top of one another are soft
constexpr double scattered = 0.09;   // light that comes from everywhere, so that nothing is quite black
constexpr double sun_share = 0.50;   // of the light on level ground
constexpr double sky_share = 1.0 - scattered - sun_share;
constexpr double sun_radius = 0.07;  // [rad] of the sun's disc; the real one's 0.005 would make hard shadows
constexpr double sky_base = 0.22;    // sine of the height of the lowest lamps; lower ones throw shadows without end
constexpr double golden_angle = std::numbers::pi * (3.0 - 2.2360679774997896);

/// Any two unit vectors that are orthogonal to `direction` and to each other.
std::pair<Vec3, Vec3> across(const Vec3& direction) {
  const Vec3 first = direction.unitOrthogonal();
  return {first, direction.cross(first)};
}

Vec3 sun_direction(const Projection<3>& eye) {
  const Vec3 right = eye.axes.row(0).transpose();
  Vec3 back = eye.axes.row(2).transpose();
  back.z() = 0.0;
  return (back.normalized() * 0.45 - right * 0.62 + Vec3::UnitZ() * 1.0).normalized();
}

}  // namespace

Lighting::Lighting(std::span<const Face> faces, const Box<3>& box, const Projection<3>& eye)
    : middle_(box.center()), reach_(0.5 * box.diagonal().norm()) {
  const Vec3 sun = sun_direction(eye);
  const auto [first, second] = across(sun);
  for (int i = 0; i < sun_lamps; ++i) {
    const double radius = sun_radius * std::sqrt((i + 0.5) / sun_lamps);
    const Vec3 offset = std::cos(golden_angle * i) * first + std::sin(golden_angle * i) * second;
    sun_.push_back(lamp((sun + radius * offset).normalized(), sun_share / sun_lamps / sun.z(), sun_resolution, box));
  }
  for (int i = 0; i < sky_lamps; ++i) {
    // Evenly over the sky above its base; the mean of the lamps' heights is the middle between base and zenith.
    const double z = std::lerp(sky_base, 1.0, (i + 0.5) / sky_lamps);
    const double r = std::sqrt(1.0 - z * z);
    const Vec3 direction(r * std::cos(golden_angle * i), r * std::sin(golden_angle * i), z);
    sky_.push_back(lamp(direction, sky_share / (0.5 * (1.0 + sky_base) * sky_lamps), sky_resolution, box));
  }
  for (std::vector<Lamp>* lamps : {&sun_, &sky_}) {
    for (Lamp& each : *lamps) {
      for (const Face& face : faces)
        if (face.normal.dot(each.direction) > 0.0) each.shadows.add(face, 0, each.projection);
    }
  }
}

Lighting::Lamp Lighting::lamp(const Vec3& direction, double strength, int resolution, const Box<3>& box) {
  Lamp made{direction, strength, Projection<3>::looking_along(direction, box.center(), 0.0),
            ZBuffer(resolution, resolution)};
  made.projection.scale = resolution / box.diagonal().norm();
  made.projection.shift = Vec2::Constant(0.5 * resolution);
  return made;
}

double Lighting::Lamp::reaching(const Vec3& point, const Vec3& normal) const {
  // Sampled a little above the surface: a z-buffer's pixels are coarser than the surface they show.
  const Vec3 seen = projection.project(point + 1.5 / projection.scale * normal);
  if (!(seen.x() >= 0.5 && seen.y() >= 0.5 && seen.x() < shadows.width() - 0.5 && seen.y() < shadows.height() - 0.5))
    return 1.0;
  // Interpolates between the four nearest pixels, so that a shadow's edge is as wide as a pixel.
  const int x = static_cast<int>(seen.x() - 0.5);
  const int y = static_cast<int>(seen.y() - 0.5);
  const double right = seen.x() - 0.5 - x;
  const double lower = seen.y() - 0.5 - y;
  const auto depth = static_cast<float>(seen.z());
  const auto lit = [&](int column, int row) { return shadows.nearness(column, row) <= depth ? 1.0 : 0.0; };
  return (1.0 - lower) * ((1.0 - right) * lit(x, y) + right * lit(x + 1, y)) +
         lower * ((1.0 - right) * lit(x, y + 1) + right * lit(x + 1, y + 1));
}

bool Lighting::open_ground(const Vec3& point, const Vec3& normal) const {
  return normal.z() > 0.999 && (point - middle_).norm() > reach_;
}

double Lighting::sum(const std::vector<Lamp>& lamps, const Vec3& point, const Vec3& normal) {
  double light = 0.0;
  for (const Lamp& lamp : lamps) {
    const double slant = normal.dot(lamp.direction);
    if (slant > 0.0) light += lamp.strength * slant * lamp.reaching(point, normal);
  }
  return light;
}

double Lighting::sun(const Vec3& point, const Vec3& normal) const {
  return open_ground(point, normal) ? sun_share : sum(sun_, point, normal);
}

double Lighting::sky(const Vec3& point, const Vec3& normal) const {
  return scattered + (open_ground(point, normal) ? sky_share : sum(sky_, point, normal));
}

}  // namespace talus
