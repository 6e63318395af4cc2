#include "common/measure/surface.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/math/require.h"

namespace talus {
namespace {

constexpr int columns_per_bin = 4;

/// Columns around the grid's centre: `side` along each horizontal axis, numbered x first. Each has its highest body.
template <int Dim>
class Columns {
 public:
  explicit Columns(const ProfileGrid<Dim>& grid)
      : grid_(grid), width_(grid.bin_width / columns_per_bin), side_(2 * grid.bins * columns_per_bin) {
    std::size_t count = 1;
    for (int axis = 0; axis + 1 < Dim; ++axis) count *= side_;
    tops_.assign(count, 0.0);
    highest_.assign(count, -1);
  }

  void raise(const Box<Dim>& bounds, int body) {
    const double top = bounds.max()[Dim - 1] - grid_.base;
    const auto [x_first, x_last] = covered(bounds, 0);
    if constexpr (Dim == 2) {
      for (int x = x_first; x <= x_last; ++x) lift(x, top, body);
    } else {
      const auto [y_first, y_last] = covered(bounds, 1);
      for (int y = y_first; y <= y_last; ++y)
        for (int x = x_first; x <= x_last; ++x) lift(y * side_ + x, top, body);
    }
  }

  std::size_t size() const { return tops_.size(); }
  double top(std::size_t column) const { return tops_[column]; }
  /// -1: none.
  int highest(std::size_t column) const { return highest_[column]; }

  /// Middle of a column, seen from the grid's centre.
  Vec<Dim - 1> middle(std::size_t column) const {
    const int index = static_cast<int>(column);
    if constexpr (Dim == 2)
      return Vec<1>(along(index));
    else
      return Vec2(along(index % side_), along(index / side_));
  }

  /// Columns are put together into cells as wide as a bin, numbered x first.
  std::size_t cells() const { return tops_.size() / static_cast<std::size_t>(std::pow(columns_per_bin, Dim - 1)); }
  std::size_t cell_of(std::size_t column) const {
    const std::size_t x = column % side_ / columns_per_bin;
    if constexpr (Dim == 2)
      return x;
    else
      return column / side_ / columns_per_bin * (side_ / columns_per_bin) + x;
  }

 private:
  double along(int index) const { return (index - 0.5 * side_ + 0.5) * width_; }
  void lift(int column, double top, int body) {
    if (top <= tops_[column]) return;
    tops_[column] = top;
    highest_[column] = body;
  }
  /// First and last column whose middle lies within the box along an axis.
  std::pair<int, int> covered(const Box<Dim>& bounds, int axis) const {
    const auto column = [&](double place) { return (place - grid_.centre[axis]) / width_ + 0.5 * side_ - 0.5; };
    const double first = std::clamp(std::ceil(column(bounds.min()[axis])), 0.0, static_cast<double>(side_));
    const double last = std::clamp(std::floor(column(bounds.max()[axis])), -1.0, side_ - 1.0);
    return {static_cast<int>(first), static_cast<int>(last)};
  }

  const ProfileGrid<Dim>& grid_;
  double width_;
  int side_;
  std::vector<double> tops_;
  std::vector<int> highest_;
};

/// A mean over columns: where, how high, of how many.
template <int Axes>
struct Sample {
  Vec<Axes> at = Vec<Axes>::Zero();
  double height = 0.0;
  double columns = 0.0;
};

/// Least squares, each sample weighted by its columns.
template <int Axes>
struct LinearFit {
  Vec<Axes> at = Vec<Axes>::Zero();  // mean of all, through which it goes at `height`
  double height = 0.0;
  double columns = 0.0;
  Eigen::Matrix<double, Axes, Axes> spread = Eigen::Matrix<double, Axes, Axes>::Zero();  // sum of squares around `at`
  Vec<Axes> slope = Vec<Axes>::Zero();
  double residuals = 0.0;  // sum of squares

  explicit LinearFit(std::span<const Sample<Axes>> samples) {
    for (const Sample<Axes>& sample : samples) {
      columns += sample.columns;
      at += sample.columns * sample.at;
      height += sample.columns * sample.height;
    }
    at /= columns;
    height /= columns;
    Vec<Axes> rise = Vec<Axes>::Zero();
    for (const Sample<Axes>& sample : samples) {
      spread += sample.columns * (sample.at - at) * (sample.at - at).transpose();
      rise += sample.columns * (sample.height - height) * (sample.at - at);
    }
    slope = spread.inverse() * rise;
    for (const Sample<Axes>& sample : samples) {
      const double off = sample.height - height - slope.dot(sample.at - at);
      residuals += sample.columns * off * off;
    }
  }

  /// Standard error of the angle of the steepest line, which goes along `direction` [rad].
  double angle_error(std::size_t samples, const Vec<Axes>& direction) const {
    const double variance =
        residuals / static_cast<double>(samples - Axes - 1) * direction.dot(spread.inverse() * direction);
    return std::sqrt(variance) / (1.0 + slope.squaredNorm());
  }
};

/// Of the surface where it is that of `counted` bodies, by cell.
template <int Dim>
std::vector<Sample<Dim - 1>> surface_samples(std::span<const PlacedBody<Dim>> bodies,
                                             std::span<const std::uint8_t> counted, const ProfileGrid<Dim>& grid) {
  Columns<Dim> columns(grid);
  for (std::size_t i = 0; i < bodies.size(); ++i) columns.raise(bodies[i].bounds, static_cast<int>(i));
  std::vector<Sample<Dim - 1>> samples(columns.cells());
  for (std::size_t column = 0; column < columns.size(); ++column) {
    const int body = columns.highest(column);
    if (body < 0 || counted[body] == 0) continue;
    Sample<Dim - 1>& sample = samples[columns.cell_of(column)];
    sample.at += columns.middle(column);
    sample.height += columns.top(column);
    sample.columns += 1.0;
  }
  std::erase_if(samples, [](const Sample<Dim - 1>& sample) { return sample.columns == 0.0; });
  for (Sample<Dim - 1>& sample : samples) {
    sample.at /= sample.columns;
    sample.height /= sample.columns;
  }
  return samples;
}

}  // namespace

template <int Dim>
std::vector<ProfileBin> height_profile(std::span<const PlacedBody<Dim>> bodies, const ProfileGrid<Dim>& grid) {
  require(grid.bin_width > 0.0, "bin_width", grid.bin_width, "must be > 0");
  require(grid.bins >= 1, "bins", grid.bins, "must be >= 1");
  Columns<Dim> columns(grid);
  for (const PlacedBody<Dim>& body : bodies) columns.raise(body.bounds, 0);
  std::vector<ProfileBin> profile(Dim == 2 ? 2 * grid.bins : grid.bins);
  const double start = Dim == 2 ? -grid.bins * grid.bin_width : 0.0;
  for (std::size_t column = 0; column < columns.size(); ++column) {
    const double at = Dim == 2 ? columns.middle(column)[0] : columns.middle(column).norm();
    const auto bin = static_cast<std::size_t>((at - start) / grid.bin_width);
    if (bin >= profile.size()) continue;  // the square's corners, beyond the last ring
    profile[bin].at += at;
    profile[bin].height += columns.top(column);
    ++profile[bin].columns;
  }
  for (ProfileBin& bin : profile) {
    bin.at /= bin.columns;
    bin.height /= bin.columns;
  }
  return profile;
}

double profile_difference(std::span<const ProfileBin> a, std::span<const ProfileBin> b) {
  if (a.size() != b.size())
    throw std::invalid_argument(fmt::format("profiles of {} and {} bins: must be on one grid", a.size(), b.size()));
  double squares = 0.0;
  double columns = 0.0;
  for (std::size_t bin = 0; bin < a.size(); ++bin) {
    if (std::abs(a[bin].at - b[bin].at) > 1e-9) throw std::invalid_argument("profiles: must be on one grid");
    if (a[bin].height <= 0.0 && b[bin].height <= 0.0) continue;
    const double gap = a[bin].height - b[bin].height;
    squares += a[bin].columns * gap * gap;
    columns += a[bin].columns;
  }
  return columns > 0.0 ? std::sqrt(squares / columns) : 0.0;
}

AngleOfRepose angle_of_repose(std::span<const ProfileBin> profile, double radius) {
  std::vector<Sample<1>> flank;
  for (const ProfileBin& bin : profile) {
    const double r = std::abs(bin.at);
    if (r < 0.1 * radius || r > 0.9 * radius) continue;
    flank.push_back({Vec<1>(r), bin.height, static_cast<double>(bin.columns)});
  }
  AngleOfRepose angle;
  angle.bins = static_cast<int>(flank.size());
  if (angle.bins < 3) return angle;
  const LinearFit<1> fit(flank);
  const double slope = -fit.slope[0];
  angle.angle = std::atan(slope);
  angle.apex = fit.height + slope * fit.at[0];
  angle.foot = slope > 0.0 ? angle.apex / slope : 0.0;
  angle.standard_error = fit.angle_error(flank.size(), Vec<1>(1.0));
  return angle;
}

template <int Dim>
SurfacePlane surface_plane(std::span<const PlacedBody<Dim>> bodies, std::span<const std::uint8_t> counted,
                           const ProfileGrid<Dim>& grid) {
  constexpr double least_spread = 0.5;  // [bins^2], variance along each axis; of three bins it is 2/3
  const std::vector<Sample<Dim - 1>> samples = surface_samples(bodies, counted, grid);
  SurfacePlane plane;
  plane.cells = static_cast<int>(samples.size());
  if (plane.cells <= Dim) return plane;
  const LinearFit<Dim - 1> fit(samples);
  const double narrowest = fit.spread.template selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() / fit.columns;
  plane.wide = narrowest >= least_spread * grid.bin_width * grid.bin_width;
  if (!plane.wide) return plane;
  const double steepest = fit.slope.norm();
  plane.angle = std::atan(steepest);
  plane.standard_error = fit.angle_error(
      samples.size(), steepest > 0.0 ? Vec<Dim - 1>(fit.slope / steepest) : Vec<Dim - 1>(Vec<Dim - 1>::Unit(0)));
  plane.roughness = std::sqrt(fit.residuals / fit.columns);
  return plane;
}

template std::vector<ProfileBin> height_profile(std::span<const PlacedBody<2>>, const ProfileGrid<2>&);
template std::vector<ProfileBin> height_profile(std::span<const PlacedBody<3>>, const ProfileGrid<3>&);
template SurfacePlane surface_plane(std::span<const PlacedBody<2>>, std::span<const std::uint8_t>,
                                    const ProfileGrid<2>&);
template SurfacePlane surface_plane(std::span<const PlacedBody<3>>, std::span<const std::uint8_t>,
                                    const ProfileGrid<3>&);

}  // namespace talus
