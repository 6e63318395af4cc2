#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/math/vector.h"

namespace talus {

/// Cuts space into cells of one width along its first `Axes` axes: with Dim - 1 axes into vertical columns, with Dim
/// axes into blocks.
template <int Axes>
class Grid {
 public:
  using Cell = std::array<int, Axes>;

  /// Bound of coordinates [m] and cell numbers: an int and an engine's float still hold it.
  static constexpr double coordinate_limit = 1e9;

  /// `width` [m] > 0.
  explicit Grid(double width) : width_(width) {}

  double width() const { return width_; }

  template <typename Vector>
  Cell cell_of(const Vector& position) const {
    Cell cell;
    for (std::size_t axis = 0; axis < cell.size(); ++axis) {
      const double number = std::floor(position[axis] / width_);
      cell[axis] = static_cast<int>(std::clamp(number, -coordinate_limit, coordinate_limit));
    }
    return cell;
  }

  /// Whether the position is in the cell, faster than cell_of(); at the very border of a cell the two may differ.
  template <typename Vector>
  bool holds(const Cell& cell, const Vector& position) const {
    for (std::size_t axis = 0; axis < cell.size(); ++axis) {
      const double within = position[axis] - cell[axis] * width_;
      if (!(within >= 0.0 && within < width_)) return false;
    }
    return true;
  }

  /// The box around the cells from `first` to `last` on each axis of the grid, unbounded on other axes.
  template <int Dim>
  Box<Dim> box_of(const Cell& first, const Cell& last) const {
    Box<Dim> box(Vec<Dim>::Constant(-coordinate_limit), Vec<Dim>::Constant(coordinate_limit));
    for (std::size_t axis = 0; axis < first.size(); ++axis) {
      box.min()[axis] = first[axis] * width_;
      box.max()[axis] = (last[axis] + 1) * width_;
    }
    return box;
  }

  /// The middle of a cell; 0 on axes that are not of the grid.
  template <int Dim>
  Vec<Dim> middle_of(const Cell& cell) const {
    Vec<Dim> middle = Vec<Dim>::Zero();
    for (std::size_t axis = 0; axis < cell.size(); ++axis) middle[axis] = (cell[axis] + 0.5) * width_;
    return middle;
  }

  /// The cell and those that share a face, an edge or a corner with it.
  static std::vector<Cell> around(const Cell& cell) {
    std::vector<Cell> cells = {cell};
    for (std::size_t axis = 0; axis < cell.size(); ++axis) {
      const std::size_t known = cells.size();
      for (const int step : {-1, 1}) {
        for (std::size_t i = 0; i < known; ++i) {
          cells.push_back(cells[i]);
          cells.back()[axis] += step;
        }
      }
    }
    return cells;
  }

 private:
  double width_;  // [m]
};

}  // namespace talus
