#pragma once
// The stacking structure of section 3.1: a cone or wedge cut into layers.

#include <vector>

#include "common/math/vector.h"

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
  double radius = 0.0;    // r_i: half-width at the bottom [m]
  double volume = 0.0;    // v_i [m^3], in 2D [m^2]
  double capacity = 0.0;  // c_i = v_i / v_obj
  int count = 0;          // m_i: bodies whose centre of mass lies within
  int sleeping = 0;       // of these, asleep

  double density() const { return capacity > 0.0 ? count / capacity : 0.0; }  // rho_i
};

/// Geometry and counts of one pile; PileSet keeps the counts.
template <int Dim>
struct Pile {
  Vec<Dim> centre = Vec<Dim>::Zero();  // middle of the base [m]
  double alpha = 0.0;                  // slope [rad]
  double structure_size = 0.0;         // N of section 3.1: how many bodies the structure has room for
  double height = 0.0;                 // h [m]
  double radius = 0.0;                 // r, of the base [m]
  std::vector<Layer> layers;           // bottom-up, at least one

  /// Layer of a point, or -1 outside: by height, then within the layer's radius. A point above the apex counts to the
  /// top layer, as example 4 of the paper describes.
  int layer_of(const Vec<Dim>& point) const;

  /// Sum of m_i over sum of c_i (section 3.2).
  double occupation_ratio() const;
};

/// The structure with room for `structure_size` bodies, empty (section 3.1). k = max(1, floor(h / D)) layers of equal
/// thickness h / k, so their volumes sum to N v_obj.
template <int Dim>
Pile<Dim> make_pile(const Vec<Dim>& centre, double alpha, double structure_size, const TypicalBody& body);

}  // namespace talus
