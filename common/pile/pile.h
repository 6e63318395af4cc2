#pragma once
// The stacking structure of section 3.1: a cone or wedge cut into layers; within walls, a prism under it (section 3.5).

#include <optional>
#include <span>
#include <vector>

#include "common/math/vector.h"
#include "common/pile/boundary.h"

namespace talus {

/// What bodies of a pile are taken to be like: the means over the bodies that the scene's sources will drop.
struct TypicalBody {
  double bounding_volume = 1.0;  // v_obj [m^3], in 2D [m^2]
  double extent = 1.0;           // D [m]
  double mass = 1.0;             // [kg]
};

/// One slice, as thick as the largest extent of a body or thicker.
struct Layer {
  double bottom = 0.0;    // height above the pile's base [m]
  double top = 0.0;       // [m]
  double radius = 0.0;    // r_i: half-width at the bottom [m]; within walls, to the nearest point of the edge
  double volume = 0.0;    // v_i [m^3], in 2D [m^2]
  double capacity = 0.0;  // c_i = v_i / v_obj
  int count = 0;          // m_i: bodies whose centre of mass lies within
  int sleeping = 0;       // of these, asleep

  double density() const { return capacity > 0.0 ? count / capacity : 0.0; }  // rho_i
};

/// Geometry and counts of one pile; PileSet keeps the counts.
template <int Dim>
struct Pile {
  Vec<Dim> centre = Vec<Dim>::Zero();     // middle of the base [m]
  double alpha = 0.0;                     // slope [rad]
  bool held = false;                      // to that slope, steeper than its bodies would lie by themselves
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

  /// Sum of m_i over sum of c_i (section 3.2), which is the structure size but for rounding.
  double occupation_ratio() const;
};

/// Number of the pile that a point belongs to: of those that reach it the one whose axis is nearest; -1: none.
template <int Dim>
int nearest_pile(std::span<const Pile<Dim>> piles, const Vec<Dim>& point);

/// The structure with room for `structure_size` bodies, empty (section 3.1). k = max(1, floor(h / D)) layers of equal
/// thickness h / k, so their volumes sum to N v_obj. Within walls the base grows until it touches the nearest; from
/// then on it fills them and the tip, of slope alpha, is lifted, up to the rim: there N stays below what was asked for.
template <int Dim>
Pile<Dim> make_pile(const Vec<Dim>& centre, double alpha, double structure_size, const TypicalBody& body,
                    const std::optional<Boundary<Dim>>& boundary = {});

}  // namespace talus
