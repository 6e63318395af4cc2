#pragma once
// What is in a region.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/measure/pile_form.h"
#include "common/measure/volume_within.h"
#include "common/world/world.h"

namespace talus {

struct RegionReading {
  int bodies = 0;                      // whose centre of mass is inside
  double solid_volume = 0.0;           // of all bodies, the parts that are inside [m^3], in 2D [m^2]
  std::optional<double> packing = {};  // over the volume that obstacles and ground leave free
  std::string packing_reason = {};     // why there is none
  double mean_speed = 0.0;             // of the bodies inside [m/s]
  double kinetic_energy = 0.0;         // of the bodies inside [J]
  Applicable<SurfacePlane> surface = {};
};

/// Measures one region. Each call must be given a world with the same shapes and obstacles.
///
/// The surface is that of all bodies which sleep or touch something, where the highest of them is in the region: what
/// flies is no part of it. It has a slope where gravity is vertical, 16 such bodies are in the region, and the surface
/// departs from a plane by D at most, in the root of the mean square.
template <int Dim>
class RegionMeter {
 public:
  /// `extent` [m] > 0 is D.
  RegionMeter(const RegionParams<Dim>& params, double extent) : form_(params), extent_(extent) {}

  /// Notes which bodies touch something, while World::contacts() are those of the step and no body has fallen asleep or
  /// woken since.
  void note_contacts(const World<Dim>& world);

  /// `ground`: its height, minus infinity without [m]. Surfaces are those of the last note_contacts().
  RegionReading read(const World<Dim>& world, double ground);

 private:
  double solid_volume(const Shape<Dim>& shape, int number, const Pose<Dim>& pose);
  double free_volume(const World<Dim>& world, double ground);
  Applicable<SurfacePlane> surface(const World<Dim>& world) const;

  RegionForm<Dim> form_;
  std::vector<Vec<Dim>> images_;                       // from a body to where the world repeats it, and to itself
  double extent_;                                      // D [m]
  std::vector<std::uint8_t> touches_;                  // [body]
  std::vector<std::vector<ConvexPiece<Dim>>> pieces_;  // by shape, as far as they were needed
  std::vector<ConvexPiece<Dim>> placed_;               // scratch
  std::vector<int> obstacles_;                         // in the region's bounds
  std::optional<double> free_volume_;                  // with these, unless one of them may move [m^3]
};

}  // namespace talus
