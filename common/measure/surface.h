#pragma once
// A pile's surface: as a curve, height over the radius (3D) or over x (2D), and as a plane (2D: a line).

#include <cstdint>
#include <span>
#include <vector>

#include "common/measure/placed_body.h"

namespace talus {

/// Where the curve is sampled. Profiles are compared bin by bin, so runs of one ensemble take the same grid.
template <int Dim>
struct ProfileGrid {
  Vec<Dim - 1> centre = Vec<Dim - 1>::Zero();  // middle of the pile [m]
  double base = 0.0;                           // height of the ground [m]
  double bin_width = 0.5;  // [m] > 0, about D / 2; narrower bins show single bodies, wider ones blunt the peak
  int bins = 32;           // rings in 3D, strips to each side in 2D, >= 1; what lies beyond them is not seen
};

/// One ring (3D) or strip (2D).
struct ProfileBin {
  double at = 0.0;      // mean radius of its columns, in 2D their mean x - centre [m]
  double height = 0.0;  // mean height of its columns above the base; 0 where nothing lies [m]
  int columns = 0;
};

/// Surface height in vertical columns a quarter of a bin wide: the highest top of a body whose bounding box covers the
/// column's middle. Bounding boxes of turned bodies overstate by a part of D, everywhere alike, so slopes and
/// differences are right. 3D: `bins` rings outwards; 2D: 2 `bins` strips from left to right.
template <int Dim>
std::vector<ProfileBin> height_profile(std::span<const PlacedBody<Dim>> bodies, const ProfileGrid<Dim>& grid);

/// Root of the mean squared difference of two profiles on one grid [m], over the bins where at least one of them is
/// above the ground, each weighted by its columns. Throws std::invalid_argument if the grids differ.
double profile_difference(std::span<const ProfileBin> a, std::span<const ProfileBin> b);

/// Line through a pile's flank.
struct AngleOfRepose {
  double angle = 0.0;           // [rad]
  double standard_error = 0.0;  // [rad], of the fit alone: bins of one run; runs of an ensemble scatter more
  double apex = 0.0;            // height at which the line meets the axis [m]
  double foot = 0.0;            // radius at which it meets the ground [m]
  int bins = 0;                 // that the fit used; fewer than 3: all else is 0
};

/// Least squares over the bins between 10 and 90 % of `radius` [m] (both flanks in 2D), each weighted by its columns.
/// `radius` is the pile's: r95 of its bodies leaves out what rolled away.
AngleOfRepose angle_of_repose(std::span<const ProfileBin> profile, double radius);

/// Plane (2D: line) through a part of the surface.
struct SurfacePlane {
  double angle = 0.0;           // to the horizontal, >= 0 [rad]
  double standard_error = 0.0;  // [rad], of the fit alone
  double roughness = 0.0;       // root of the mean squared distance in height from the plane [m]
  int cells = 0;                // that the fit used
  bool wide = false;            // whether these reach over three bins along each axis; else all else is 0
};

/// Least squares over cells one bin wide. The surface is that of height_profile() for all `bodies`, where its highest
/// body is `counted`, which has a value for each of them.
template <int Dim>
SurfacePlane surface_plane(std::span<const PlacedBody<Dim>> bodies, std::span<const std::uint8_t> counted,
                           const ProfileGrid<Dim>& grid);

}  // namespace talus
