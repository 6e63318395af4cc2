#include "common/measure/compare.h"

#include <algorithm>
#include <stdexcept>

#include "common/measure/divergence.h"
#include "common/measure/ensemble.h"

namespace talus {
namespace {

/// D over the bodies of a frame.
template <int Dim>
double mean_extent(const Trajectory<Dim>& run, int frame, std::span<const double> extents) {
  std::vector<double> all;
  all.reserve(run.bodies(frame));
  for (BodyIndex i = 0; i < run.bodies(frame); ++i) all.push_back(extents[run.shape(i)]);
  return all.empty() ? 1.0 : mean(all);
}

template <int Dim>
std::vector<double> distances_at(const Trajectory<Dim>& a, const Trajectory<Dim>& b, int frame) {
  std::vector<double> distances;
  for (BodyIndex i = 0; i < std::min(a.bodies(frame), b.bodies(frame)); ++i) {
    if (!a.present(frame, i) || !b.present(frame, i)) continue;
    distances.push_back(a.way(b.position(frame, i), a.position(frame, i)).norm());
  }
  return distances;
}

}  // namespace

template <int Dim>
std::optional<FirstDifference> first_difference(const Trajectory<Dim>& a, const Trajectory<Dim>& b) {
  for (int frame = 0; frame < std::min(a.frames(), b.frames()); ++frame) {
    for (BodyIndex i = 0; i < std::max(a.bodies(frame), b.bodies(frame)); ++i)
      if (!a.same(frame, b, i)) return FirstDifference{a.step(frame), i};
  }
  return std::nullopt;
}

template <int Dim>
int last_common_frame(const Trajectory<Dim>& a, const Trajectory<Dim>& b) {
  int last = std::min(a.frames(), b.frames()) - 1;
  while (last >= 0 && (a.lost(last) || b.lost(last))) --last;
  return last;
}

template <int Dim>
std::vector<double> extents_of(std::span<const Shape<Dim>> shapes) {
  std::vector<double> extents;
  extents.reserve(shapes.size());
  for (const Shape<Dim>& shape : shapes) extents.push_back(shape.extent);
  return extents;
}

template <int Dim>
RunComparison<Dim> compare_runs(const Trajectory<Dim>& a, const Trajectory<Dim>& b, std::span<const Shape<Dim>> shapes,
                                double gravity, const ProfileGrid<Dim>& grid, double fastest) {
  check_comparable(a, b);
  RunComparison<Dim> result;
  result.frames = std::min(a.frames(), b.frames());
  const int last = last_common_frame(a, b);
  if (last < 0) throw std::invalid_argument("runs: must have a frame in common");
  result.last = last;
  for (int frame = 0; frame < result.frames; ++frame) result.left_out += a.lost(frame) || b.lost(frame) ? 1 : 0;
  const std::vector<double> extents = extents_of(shapes);
  const double extent = mean_extent<Dim>(a, last, extents);
  result.first_difference = first_difference(a, b);
  result.motion = motion_errors<Dim>(a, b, extents, gravity);
  result.motion_mean = average(result.motion);
  result.position_mean = position_differences(a, b);
  for (double& value : result.position_mean) value /= extent;
  const std::vector<double> distances = distances_at(a, b, last);
  result.position_p95 = quantile(distances, 0.95) / extent;
  result.position_max = quantile(distances, 1.0) / extent;

  const std::vector<PlacedBody<Dim>> bodies_a = placed_bodies(shapes, a, last, fastest);
  const std::vector<PlacedBody<Dim>> bodies_b = placed_bodies(shapes, b, last, fastest);
  result.shape_a = shape_statistics<Dim>(bodies_a, grid);
  result.shape_b = shape_statistics<Dim>(bodies_b, grid);
  result.profile_rms = profile_difference(result.shape_a.profile, result.shape_b.profile) / extent;
  if (!bodies_a.empty() && !bodies_b.empty()) {
    result.z = distribution_distance(heights<Dim>(bodies_a), heights<Dim>(bodies_b));
    result.r = distribution_distance(radii<Dim>(bodies_a, grid.centre), radii<Dim>(bodies_b, grid.centre));
  }
  return result;
}

template std::optional<FirstDifference> first_difference(const Trajectory<2>&, const Trajectory<2>&);
template std::optional<FirstDifference> first_difference(const Trajectory<3>&, const Trajectory<3>&);
template int last_common_frame(const Trajectory<2>&, const Trajectory<2>&);
template int last_common_frame(const Trajectory<3>&, const Trajectory<3>&);
template std::vector<double> extents_of(std::span<const Shape<2>>);
template std::vector<double> extents_of(std::span<const Shape<3>>);
template RunComparison<2> compare_runs(const Trajectory<2>&, const Trajectory<2>&, std::span<const Shape<2>>, double,
                                       const ProfileGrid<2>&, double);
template RunComparison<3> compare_runs(const Trajectory<3>&, const Trajectory<3>&, std::span<const Shape<3>>, double,
                                       const ProfileGrid<3>&, double);

}  // namespace talus
