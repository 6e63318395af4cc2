#include "common/measure/motion_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/math/require.h"
#include "common/measure/divergence.h"

namespace talus {
namespace {

/// Turn between two frames: axis times angle [rad], in 2D the angle.
template <int Dim>
Spin<Dim> turn(const Trajectory<Dim>& run, int frame, BodyIndex body) {
  const Rotation<Dim> between = run.rotation(frame + 1, body) * run.rotation(frame, body).inverse();
  if constexpr (Dim == 2) {
    return Spin<2>(between.smallestAngle());
  } else {
    const Eigen::AngleAxisd turned(between);
    return turned.axis() * turned.angle();
  }
}

/// Sums of one frame, from which all measures follow.
template <int Dim>
struct FrameSums {
  double unit = 0.0;  // m0
  int bodies = 0;
  int moving = 0;
  double relative = 0.0, difference = 0.0, floored = 0.0, full = 0.0, other = 0.0, turn_difference = 0.0, turned = 0.0;

  void add_motion(const Vec<Dim>& m, const Vec<Dim>& m_other) {
    const double length = m.norm();
    const double gap = (m - m_other).norm();
    ++bodies;
    difference += gap;
    full += length;
    other += m_other.norm();
    floored += gap / std::max(length, unit);
    if (length > 0.0) {
      ++moving;
      relative += gap / length;
    }
  }

  MotionError error() const {
    if (bodies == 0) return {};
    const double n = bodies;
    MotionError error;
    error.bodies = bodies;
    error.left_out = 1.0 - moving / n;
    error.relative = moving > 0 ? relative / moving : std::numeric_limits<double>::quiet_NaN();
    error.absolute = difference / n / unit;
    error.floored = floored / n;
    error.ratio = difference / (full + n * unit);
    error.symmetric = difference / (full + other + n * unit);
    error.turning = turn_difference / (turned + n * unit);
    return error;
  }
};

}  // namespace

template <int Dim>
std::vector<MotionError> motion_errors(const Trajectory<Dim>& full, const Trajectory<Dim>& other,
                                       std::span<const double> extents, double gravity) {
  check_comparable(full, other);
  require(gravity > 0.0, "gravity", gravity, "must be > 0");
  const int frames = std::min(full.frames(), other.frames());
  std::vector<MotionError> errors;
  errors.reserve(std::max(frames - 1, 0));
  for (int j = 0; j + 1 < frames; ++j) {
    FrameSums<Dim> sums;
    sums.unit = gravity * full.frame_time() * full.frame_time();
    const BodyIndex bodies = std::min(full.bodies(j), other.bodies(j));
    for (BodyIndex i = 0; i < bodies; ++i) {
      if (!full.present(j, i) || !full.present(j + 1, i) || !other.present(j, i) || !other.present(j + 1, i)) continue;
      sums.add_motion(full.way(full.position(j, i), full.position(j + 1, i)),
                      other.way(other.position(j, i), other.position(j + 1, i)));
      const double extent = extents[full.shape(i)];
      const Spin<Dim> turn_full = turn(full, j, i);
      sums.turn_difference += extent * (turn_full - turn(other, j, i)).norm();
      sums.turned += extent * turn_full.norm();
    }
    errors.push_back(sums.error());
  }
  return errors;
}

MotionError average(std::span<const MotionError> errors) {
  MotionError mean;
  int frames = 0;
  int with_motion = 0;
  double left_out = 0.0;
  for (const MotionError& error : errors) {
    if (error.bodies == 0) continue;
    ++frames;
    mean.bodies += error.bodies;
    left_out += error.left_out * error.bodies;
    if (!std::isnan(error.relative)) {
      ++with_motion;
      mean.relative += error.relative;
    }
    mean.absolute += error.absolute;
    mean.floored += error.floored;
    mean.ratio += error.ratio;
    mean.symmetric += error.symmetric;
    mean.turning += error.turning;
  }
  if (frames == 0) return mean;
  mean.left_out = left_out / mean.bodies;
  mean.relative = with_motion > 0 ? mean.relative / with_motion : std::numeric_limits<double>::quiet_NaN();
  for (double* value : {&mean.absolute, &mean.floored, &mean.ratio, &mean.symmetric, &mean.turning}) *value /= frames;
  mean.bodies /= frames;
  return mean;
}

template std::vector<MotionError> motion_errors(const Trajectory<2>&, const Trajectory<2>&, std::span<const double>,
                                                double);
template std::vector<MotionError> motion_errors(const Trajectory<3>&, const Trajectory<3>&, std::span<const double>,
                                                double);

}  // namespace talus
