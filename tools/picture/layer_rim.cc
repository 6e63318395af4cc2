#include "tools/picture/layer_rim.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus {

namespace {

std::vector<Horizontal<2>> directions(const Pile<2>&) { return {Horizontal<2>(-1.0), Horizontal<2>(1.0)}; }

/// All around, and to the corners between the walls.
std::vector<Horizontal<3>> directions(const Pile<3>& pile) {
  constexpr int points = 120;
  std::vector<double> angles;
  for (int i = 0; i < points; ++i) {
    angles.push_back(2.0 * std::numbers::pi * i / points);
  }
  const std::vector<Wall<3>> walls = pile.boundary ? pile.boundary->walls : std::vector<Wall<3>>();
  for (std::size_t i = 0; i < walls.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      Eigen::Matrix2d normals;
      normals << walls[i].normal.transpose(), walls[k].normal.transpose();
      if (std::abs(normals.determinant()) > 1e-9) {
        const Vec2 corner = normals.inverse() * Vec2(walls[i].distance, walls[k].distance);
        const double angle = std::atan2(corner.y(), corner.x());
        angles.push_back(angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle);
      }
    }
  }
  std::sort(angles.begin(), angles.end());
  std::vector<Horizontal<3>> all;
  for (const double angle : angles) {
    all.emplace_back(std::cos(angle), std::sin(angle));
  }
  return all;
}

}  // namespace

template <int Dim>
std::vector<Vec<Dim>> layer_rim(const Pile<Dim>& pile, const Layer& layer, double height) {
  std::vector<Vec<Dim>> rim;
  for (const Horizontal<Dim>& direction : directions(pile)) {
    // Inverse of the distance that Pile::closeness() measures with.
    const double scale = pile.boundary ? pile.radius * pile.boundary->gauge(direction) : 1.0;
    Vec<Dim> point = pile.centre;
    point.template head<Dim - 1>() += layer.radius / scale * direction;
    point[Dim - 1] += height;
    rim.push_back(point);
  }
  return rim;
}

template std::vector<Vec<2>> layer_rim(const Pile<2>&, const Layer&, double);
template std::vector<Vec<3>> layer_rim(const Pile<3>&, const Layer&, double);

}  // namespace talus
