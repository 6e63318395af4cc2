#pragma once
// What a scene measures while it runs, as plain structs.

#include <optional>
#include <string>
#include <vector>

#include "common/math/vector.h"

namespace talus {

/// Part of a line (2D) or of a plane (3D) through which bodies are counted. gate_fields has the unit, range and effect
/// of each field.
template <int Dim>
struct GateParams {
  std::string name;
  std::vector<Vec<Dim>> corners = {};  // 2D: both ends; 3D: a corner and its two neighbours; empty: a disc
  Vec<Dim> centre = Vec<Dim>::Zero();
  Vec<Dim> normal = Vec<Dim>::Unit(Dim - 1);
  double radius = 1.0;
  double jam_after = 20.0;

  /// The direction of a passage that counts as forward; not a unit vector. In 2D it points to the right, seen from the
  /// first end towards the second.
  Vec<Dim> forward() const;
};

/// Part of space in which bodies are counted: a box, a ball (2D: a disc) or all between two heights.
template <int Dim>
struct RegionParams {
  std::string name;
  std::vector<Vec<Dim>> box = {};  // lower and upper corner
  std::optional<Vec<Dim>> centre = {};
  double radius = 1.0;
  std::vector<double> layer = {};  // lower and upper height
};

/// The force of bodies on the ground and on obstacles, together.
template <int Dim>
struct LoadParams {
  std::string name;
  bool on_ground = false;
  std::vector<int> obstacles = {};  // indices of Scene::obstacle_names
  Vec<Dim> about = Vec<Dim>::Zero();
  std::vector<double> heights = {};  // between slices of the profile; empty: none
};

template <int Dim>
struct Instruments {
  std::vector<GateParams<Dim>> gates = {};
  std::vector<RegionParams<Dim>> regions = {};
  std::vector<LoadParams<Dim>> loads = {};

  bool empty() const { return gates.empty() && regions.empty() && loads.empty(); }
};

template <int Dim>
Vec<Dim> GateParams<Dim>::forward() const {
  if (corners.empty()) return normal;
  const Vec<Dim> side = corners[1] - corners[0];
  if constexpr (Dim == 2)
    return {side.y(), -side.x()};
  else
    return side.cross(corners[2] - corners[0]);
}

}  // namespace talus
