#include "common/measure/shape_statistics.h"

#include <algorithm>

#include "common/math/require.h"
#include "common/measure/ensemble.h"

namespace talus {

template <int Dim>
Vec<Dim - 1> middle(std::span<const PlacedBody<Dim>> bodies) {
  Vec<Dim - 1> sum = Vec<Dim - 1>::Zero();
  for (const PlacedBody<Dim>& body : bodies) sum += horizontal<Dim>(body.centre);
  return bodies.empty() ? sum : Vec<Dim - 1>(sum / static_cast<double>(bodies.size()));
}

template <int Dim>
ShapeStatistics<Dim> shape_statistics(std::span<const PlacedBody<Dim>> bodies, const ProfileGrid<Dim>& grid) {
  ShapeStatistics<Dim> statistics;
  statistics.bodies = static_cast<int>(bodies.size());
  statistics.profile = height_profile<Dim>(bodies, grid);
  if (bodies.empty()) return statistics;
  double mass = 0.0;
  for (const PlacedBody<Dim>& body : bodies) {
    statistics.centre += body.mass * body.centre;
    mass += body.mass;
    statistics.peak = std::max(statistics.peak, height<Dim>(body.bounds.max()) - grid.base);
  }
  statistics.centre /= mass;
  statistics.centre_height = height<Dim>(statistics.centre) - grid.base;
  const std::vector<double> distances = radii<Dim>(bodies, grid.centre);
  statistics.r50 = quantile(distances, 0.5);
  statistics.r95 = quantile(distances, 0.95);
  statistics.repose = angle_of_repose(statistics.profile, statistics.r95);
  return statistics;
}

template <int Dim>
ProfileGrid<Dim> grid_around(std::span<const PlacedBody<Dim>> bodies, double base, double extent) {
  require(extent > 0.0, "extent", extent, "must be > 0");
  constexpr int most_bins = Dim == 2 ? 2000 : 250;  // in 3D the columns are a square of 16 bins' area each
  ProfileGrid<Dim> grid{.centre = middle<Dim>(bodies), .base = base, .bin_width = 0.5 * extent};
  double reach = 0.0;
  for (const double radius : radii<Dim>(bodies, grid.centre)) reach = std::max(reach, radius);
  grid.bins = static_cast<int>(std::clamp(reach / grid.bin_width + 2.0, 3.0, static_cast<double>(most_bins)));
  return grid;
}

template ProfileGrid<2> grid_around(std::span<const PlacedBody<2>>, double, double);
template ProfileGrid<3> grid_around(std::span<const PlacedBody<3>>, double, double);
template Vec<1> middle<2>(std::span<const PlacedBody<2>>);
template Vec<2> middle<3>(std::span<const PlacedBody<3>>);
template ShapeStatistics<2> shape_statistics(std::span<const PlacedBody<2>>, const ProfileGrid<2>&);
template ShapeStatistics<3> shape_statistics(std::span<const PlacedBody<3>>, const ProfileGrid<3>&);

}  // namespace talus
