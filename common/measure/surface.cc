#include "common/measure/surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/math/require.h"

namespace talus {
namespace {

constexpr int columns_per_bin = 4;

/// Columns around the grid's centre: `side` along each horizontal axis, numbered x first.
template <int Dim>
class Columns {
 public:
  explicit Columns(const ProfileGrid<Dim>& grid)
      : grid_(grid), width_(grid.bin_width / columns_per_bin), side_(2 * grid.bins * columns_per_bin) {
    std::size_t count = 1;
    for (int axis = 0; axis + 1 < Dim; ++axis) count *= side_;
    tops_.assign(count, 0.0);
  }

  void raise(const Box<Dim>& bounds) {
    const double top = bounds.max()[Dim - 1] - grid_.base;
    const auto [x_first, x_last] = covered(bounds, 0);
    if constexpr (Dim == 2) {
      for (int x = x_first; x <= x_last; ++x) lift(x, top);
    } else {
      const auto [y_first, y_last] = covered(bounds, 1);
      for (int y = y_first; y <= y_last; ++y)
        for (int x = x_first; x <= x_last; ++x) lift(y * side_ + x, top);
    }
  }

  std::size_t size() const { return tops_.size(); }
  double top(std::size_t column) const { return tops_[column]; }

  /// Middle of a column, seen from the grid's centre: its x in 2D, its radius in 3D.
  double at(std::size_t column) const {
    const int index = static_cast<int>(column);
    const double x = middle(index % side_);
    if constexpr (Dim == 2)
      return x;
    else
      return std::hypot(x, middle(index / side_));
  }

 private:
  double middle(int index) const { return (index - 0.5 * side_ + 0.5) * width_; }
  void lift(int column, double top) {
    double& present = tops_[column];
    present = std::max(present, top);
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
};

}  // namespace

template <int Dim>
std::vector<ProfileBin> height_profile(std::span<const PlacedBody<Dim>> bodies, const ProfileGrid<Dim>& grid) {
  require(grid.bin_width > 0.0, "bin_width", grid.bin_width, "must be > 0");
  require(grid.bins >= 1, "bins", grid.bins, "must be >= 1");
  Columns<Dim> columns(grid);
  for (const PlacedBody<Dim>& body : bodies) columns.raise(body.bounds);
  std::vector<ProfileBin> profile(Dim == 2 ? 2 * grid.bins : grid.bins);
  const double start = Dim == 2 ? -grid.bins * grid.bin_width : 0.0;
  for (std::size_t column = 0; column < columns.size(); ++column) {
    const auto bin = static_cast<std::size_t>((columns.at(column) - start) / grid.bin_width);
    if (bin >= profile.size()) continue;  // the square's corners, beyond the last ring
    profile[bin].at += columns.at(column);
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
  std::vector<ProfileBin> flank;
  double weight = 0.0;
  double mean_r = 0.0;
  double mean_h = 0.0;
  for (ProfileBin bin : profile) {
    bin.at = std::abs(bin.at);
    if (bin.at < 0.1 * radius || bin.at > 0.9 * radius) continue;
    flank.push_back(bin);
    weight += bin.columns;
    mean_r += bin.columns * bin.at;
    mean_h += bin.columns * bin.height;
  }
  AngleOfRepose fit;
  fit.bins = static_cast<int>(flank.size());
  if (fit.bins < 3) return fit;
  mean_r /= weight;
  mean_h /= weight;
  double rr = 0.0;
  double rh = 0.0;
  for (const ProfileBin& bin : flank) {
    rr += bin.columns * (bin.at - mean_r) * (bin.at - mean_r);
    rh += bin.columns * (bin.at - mean_r) * (bin.height - mean_h);
  }
  const double slope = -rh / rr;
  double residuals = 0.0;
  for (const ProfileBin& bin : flank) {
    const double off = bin.height - mean_h + slope * (bin.at - mean_r);
    residuals += bin.columns * off * off;
  }
  fit.angle = std::atan(slope);
  fit.apex = mean_h + slope * mean_r;
  fit.foot = slope > 0.0 ? fit.apex / slope : 0.0;
  fit.standard_error = std::sqrt(residuals / (fit.bins - 2) / rr) / (1.0 + slope * slope);
  return fit;
}

template std::vector<ProfileBin> height_profile(std::span<const PlacedBody<2>>, const ProfileGrid<2>&);
template std::vector<ProfileBin> height_profile(std::span<const PlacedBody<3>>, const ProfileGrid<3>&);

}  // namespace talus
