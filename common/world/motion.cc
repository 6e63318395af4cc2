#include "common/world/motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

/// The value of a path of straight pieces; before the first corner and after the last one it stands still.
template <typename Value>
Value along_path(const std::vector<double>& times, const std::vector<Value>& values, double time) {
  const auto next = std::ranges::upper_bound(times, time);
  if (next == times.begin()) return values.front();
  if (next == times.end()) return values.back();
  const auto i = next - times.begin();
  const double share = (time - times[i - 1]) / (times[i] - times[i - 1]);
  return values[i - 1] + share * (values[i] - values[i - 1]);
}

double since(double start, const std::optional<double>& end, double time) {
  return std::max(0.0, (end ? std::min(time, *end) : time) - start);
}

}  // namespace

template <int Dim>
Vec<Dim> Motion<Dim>::shift_at(double time) const {
  Vec<Dim> shift = std::sin(full_turn * frequency * since(start, end, time)) * amplitude;
  if (!shifts.empty()) shift += along_path(times, shifts, time);
  return shift;
}

template <int Dim>
double Motion<Dim>::angle_at(double time) const {
  const double turned = speed * since(start, end, time);
  return angles.empty() ? turned : turned + along_path(times, angles, time);
}

template <int Dim>
Rotation<Dim> Motion<Dim>::turn_at(double time) const {
  if constexpr (Dim == 2)
    return Rotation<2>(angle_at(time));
  else
    return Rotation<3>(Eigen::AngleAxisd(angle_at(time), axis));
}

template <int Dim>
Vec<Dim> Motion<Dim>::belt_at(double time) const {
  return time < start || (end && time >= *end) ? Vec<Dim>::Zero() : belt;
}

template <int Dim>
bool Motion<Dim>::moves_after(double time) const {
  const bool goes_on = speed != 0.0 || frequency != 0.0 || !belt.isZero(0.0);
  return (goes_on && (!end || time < *end)) || (!times.empty() && time < times.back());
}

template <int Dim>
double Motion<Dim>::fastest_shift() const {
  double fastest = 0.0;
  for (std::size_t i = 1; i < shifts.size(); ++i)
    fastest = std::max(fastest, (shifts[i] - shifts[i - 1]).norm() / (times[i] - times[i - 1]));
  return fastest + full_turn * frequency * amplitude.norm();
}

template <int Dim>
double Motion<Dim>::fastest_turn() const {
  double fastest = 0.0;
  for (std::size_t i = 1; i < angles.size(); ++i)
    fastest = std::max(fastest, std::abs(angles[i] - angles[i - 1]) / (times[i] - times[i - 1]));
  return fastest + std::abs(speed);
}

template <int Dim>
Pose<Dim> Mover<Dim>::pose_at(double time, const Pose<Dim>& initial) const {
  const Rotation<Dim> turn = motion.turn_at(time);
  return {pivot + motion.shift_at(time) + turn * (initial.position - pivot), turn * initial.rotation};
}

template <int Dim>
std::vector<Obstacle<Dim>> obstacles_at(std::vector<Obstacle<Dim>> obstacles, const std::vector<Mover<Dim>>& movers,
                                        double time) {
  for (const Mover<Dim>& mover : movers)
    for (int k = mover.first; k < mover.first + mover.count; ++k)
      obstacles[k].pose = mover.pose_at(time, obstacles[k].pose);
  return obstacles;
}

template struct Motion<2>;
template struct Motion<3>;
template struct Mover<2>;
template struct Mover<3>;
template std::vector<Obstacle<2>> obstacles_at(std::vector<Obstacle<2>>, const std::vector<Mover<2>>&, double);
template std::vector<Obstacle<3>> obstacles_at(std::vector<Obstacle<3>>, const std::vector<Mover<3>>&, double);

}  // namespace talus
