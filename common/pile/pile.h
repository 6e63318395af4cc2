#pragma once
// The stacking structure of section 3.1: a cone or wedge cut into layers; within walls, a prism under it (section 3.5).

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/math/vector.h"
#include "common/pile/boundary.h"

namespace talus {

/// Time between updates of what changes slowly in a pile: its place, its slope and what depends on it [s], in the time
/// of the engine (UnitScale). Chosen, not measured: a hundredth of the time in which the scenes' piles grow.
inline constexpr double slow_update_interval = 0.5;

/// The same in steps of `dt` [s], at least 1.
inline std::int64_t steps_between_slow_updates(double dt) {
  return std::max<std::int64_t>(1, std::llround(slow_update_interval / dt));
}

/// The body for which a pile's layers are made: means over the bodies that the scene's sources will drop.
struct TypicalBody {
  double bounding_volume = 1.0;  // v_obj [m^3], in 2D [m^2]
  double extent = 1.0;           // D [m]
  double mass = 1.0;             // [kg]
};

/// Densities of a layer at which the run's policy changes what it does. Below 0: it has no such threshold.
struct LayerThresholds {
  double sleep = -1.0;  // up to it no body of the layer falls asleep
  double wake = -1.0;   // above it the pile wakes
};

/// One slice, as thick as the largest extent of a body or thicker.
struct Layer {
  double bottom = 0.0;              // height above the pile's base [m]
  double top = 0.0;                 // [m]
  double radius = 0.0;              // r_i: half-width at the bottom [m]; within walls, to the nearest point of the edge
  double volume = 0.0;              // v_i [m^3], in 2D [m^2]
  double capacity = 0.0;            // c_i = v_i / v_obj
  int count = 0;                    // m_i: bodies whose centre of mass lies within
  int sleeping = 0;                 // of these, asleep
  LayerThresholds thresholds = {};  // in copies for pages and messages (set_thresholds() of the policy)

  double density() const { return capacity > 0.0 ? count / capacity : 0.0; }  // rho_i
};

/// Geometry and counts of one pile; PileSet keeps the counts.
template <int Dim>
struct Pile {
  Vec<Dim> centre = Vec<Dim>::Zero();     // middle of the base [m]
  double alpha = 0.0;                     // slope [rad]
  bool slope_controlled = false;          // whether the pile is held at alpha (PileParams::control_slope)
  double structure_size = 0.0;            // N of section 3.1: how many bodies the structure has room for
  double lift = 0.0;                      // height of the part with upright sides; 0 without walls [m]
  double height = 0.0;                    // h, lift included [m]
  double radius = 0.0;                    // r, of the base; within walls, to the nearest one [m]
  std::optional<Boundary<Dim>> boundary;  // the walls, once the pile touches them
  std::vector<Layer> layers;              // bottom-up; empty only for a pile that merged into another
  int merged_into = -1;                   // number of that pile

  /// Layer of a point, or -1 outside: by height, then within the layer's radius or walls. A point above the apex counts
  /// to the top layer, as example 4 of the paper describes.
  int layer_of(const Vec<Dim>& point) const;

  /// Whether a point lies within twice the base's radius, at any height: a structure of the wrong slope leaves some of
  /// its bodies out.
  bool reaches(const Vec<Dim>& point) const;

  /// Equation (2), d of a point in a layer: 1 on the axis, falling to 0 at the layer's edge.
  double closeness(const Vec<Dim>& point, const Layer& layer) const;

  /// Sum of m_i over sum of c_i (section 3.2); the latter equals the structure size up to rounding.
  double occupation_ratio() const;
};

/// A pile of a plane scene in space: it lies in y = 0, walls stand left and right of it.
Pile<3> in_space(const Pile<2>& pile);
inline Pile<3> in_space(const Pile<3>& pile) { return pile; }

/// Number of the pile that a point belongs to: of the piles that reach it the one with the nearest axis; -1: none.
template <int Dim>
int nearest_pile(std::span<const Pile<Dim>> piles, const Vec<Dim>& point);

/// An empty structure with room for `structure_size` bodies (section 3.1): k = max(1, floor(h / D)) layers of equal
/// thickness h / k, so that their volumes sum to N v_obj. Within walls the base grows until it touches the nearest
/// wall. From then on it fills the container and the tip, of slope alpha, is lifted, at most up to the rim; beyond that
/// the structure's N stays below `structure_size`.
template <int Dim>
Pile<Dim> make_pile(const Vec<Dim>& centre, double alpha, double structure_size, const TypicalBody& body,
                    const std::optional<Boundary<Dim>>& boundary = {});

}  // namespace talus
