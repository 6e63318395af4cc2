#include "tools/view/hidden_bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_set>

namespace talus {
namespace {

constexpr int cover = 2;  // full cells around a hidden one

/// Three coordinates of 21 bits each.
using Cell = std::uint64_t;
using Cells = std::unordered_set<Cell>;

constexpr int axis_bits = 21;
constexpr double half_range = 1 << (axis_bits - 1);

Cell cell_at(const Vec3& point, double width) {
  Cell cell = 0;
  for (const double part : point) {
    const double place = std::clamp(std::floor(part / width), 2.0 * cover - half_range, half_range - 2.0 * cover);
    cell = cell << axis_bits | static_cast<Cell>(place + half_range);
  }
  return cell;
}

constexpr Cell height_of(Cell cell) { return cell & ((Cell{1} << axis_bits) - 1); }

/// The cells that are enclosed along one axis: each of the `cover` neighbours on both sides is in the set or lies below
/// the height `ground`.
Cells eroded(const Cells& cells, Cell step, Cell ground) {
  Cells inner;
  for (const Cell cell : cells) {
    const auto full = [&](Cell other) { return cells.contains(other) || height_of(other) < ground; };
    bool enclosed = true;
    for (int away = 1; away <= cover && enclosed; ++away)
      enclosed = full(cell + static_cast<Cell>(away) * step) && full(cell - static_cast<Cell>(away) * step);
    if (enclosed) inner.insert(cell);
  }
  return inner;
}

}  // namespace

template <int Dim>
std::vector<std::uint8_t> hidden_bodies(std::span<const Shape<Dim>> shapes, const BodyStates<Dim>& states,
                                        std::optional<double> ground) {
  std::vector<std::uint8_t> hidden(states.size(), 0);
  if constexpr (Dim == 3) {
    double width = 0.0;
    for (const Shape<3>& shape : shapes) width = std::max(width, shape.extent);
    if (states.size() < fewest_to_hide || width <= 0.0) return hidden;
    const auto sleeps = [&](BodyIndex body) { return states.asleep[body] != 0 && states.removed[body] == 0; };
    const Vec3 origin(0.0, 0.0, ground.value_or(0.0));  // so that the ground lies between cells
    Cells cells;
    for (BodyIndex body = 0; body < states.size(); ++body)
      if (sleeps(body)) cells.insert(cell_at(states.pose[body].position - origin, width));
    const Cell lowest = ground ? height_of(cell_at(Vec3::Zero(), width)) : 0;
    for (int axis = 0; axis < 3; ++axis) cells = eroded(cells, Cell{1} << (axis * axis_bits), lowest);
    for (BodyIndex body = 0; body < states.size(); ++body)
      if (sleeps(body) && cells.contains(cell_at(states.pose[body].position - origin, width))) hidden[body] = 1;
  }
  return hidden;
}

template std::vector<std::uint8_t> hidden_bodies(std::span<const Shape<2>>, const BodyStates<2>&,
                                                 std::optional<double>);
template std::vector<std::uint8_t> hidden_bodies(std::span<const Shape<3>>, const BodyStates<3>&,
                                                 std::optional<double>);

}  // namespace talus
