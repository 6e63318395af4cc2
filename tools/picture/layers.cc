#include "tools/picture/layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus {

template <int Dim>
Pile<Dim> with_coarse_layers(Pile<Dim> pile, int most) {
  const std::size_t together = (pile.layers.size() + most - 1) / most;
  std::vector<Layer> coarse;
  for (std::size_t i = 0; i < pile.layers.size(); ++i) {
    const Layer& fine = pile.layers[i];
    if (i % together == 0) {
      coarse.push_back(fine);
      continue;
    }
    Layer& layer = coarse.back();
    layer.top = fine.top;
    layer.volume += fine.volume;
    layer.capacity += fine.capacity;
    layer.count += fine.count;
    layer.sleeping += fine.sleeping;
  }
  pile.layers = std::move(coarse);
  return pile;
}

template Pile<2> with_coarse_layers(Pile<2>, int);
template Pile<3> with_coarse_layers(Pile<3>, int);

namespace {

std::vector<Horizontal<2>> directions(const Pile<2>&) { return {Horizontal<2>(-1.0), Horizontal<2>(1.0)}; }

/// All around, and to the corners between the walls.
std::vector<Horizontal<3>> directions(const Pile<3>& pile) {
  constexpr int points = 120;
  std::vector<double> angles;
  for (int i = 0; i < points; ++i) angles.push_back(2.0 * std::numbers::pi * i / points);
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
  for (const double angle : angles) all.emplace_back(std::cos(angle), std::sin(angle));
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

double layer_opacity(const Layer& layer) { return 0.10 + 0.22 * std::clamp(layer.density(), 0.0, 1.0); }

void DensityLabels::draw(cairo_t* canvas, const Vec2& at, const Layer& layer) {
  if (layer.count == 0) return;
  const TextStyle style = {.size = 0.82 * params_.font_size, .colour = params_.layer, .halo = 3.0};
  const std::string text = fmt::format("{:.2f}", layer.density());
  const Vec2 left = at + Vec2(0.4 * params_.font_size, 0.0);
  const Box<2> box(Vec2(left - Vec2(0.0, 0.6 * style.size)),
                   Vec2(left + Vec2(text_width(canvas, text, style), 0.6 * style.size)));
  if (std::ranges::any_of(taken_, [&](const Box<2>& other) { return other.intersects(box); })) return;
  taken_.push_back(box);
  draw_text(canvas, left + Vec2(0.0, 0.36 * style.size), text, style);
}

}  // namespace talus
