#pragma once
// What is in a region.

#include <optional>
#include <string>
#include <vector>

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
};

/// Measures one region. Each call must be given a world with the same shapes and obstacles.
template <int Dim>
class RegionMeter {
 public:
  explicit RegionMeter(const RegionParams<Dim>& params) : form_(params) {}

  /// `ground`: its height, minus infinity without [m].
  RegionReading read(const World<Dim>& world, double ground);

 private:
  double solid_volume(const Shape<Dim>& shape, int number, const Pose<Dim>& pose);
  double free_volume(const World<Dim>& world, double ground);

  RegionForm<Dim> form_;
  std::vector<Vec<Dim>> images_;                       // from a body to where the world repeats it, and to itself
  std::vector<std::vector<ConvexPiece<Dim>>> pieces_;  // by shape, as far as they were needed
  std::vector<ConvexPiece<Dim>> placed_;               // scratch
  std::vector<int> obstacles_;                         // in the region's bounds
  std::optional<double> free_volume_;                  // with these, unless one of them may move [m^3]
};

}  // namespace talus
