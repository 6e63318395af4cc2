#include "common/measure/divergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace talus {

template <int Dim>
void check_comparable(const Trajectory<Dim>& a, const Trajectory<Dim>& b) {
  if (std::abs(a.frame_time() - b.frame_time()) > 1e-9 * a.frame_time()) {
    throw std::invalid_argument(
        fmt::format("frame_time = {} s against {} s: must be equal", a.frame_time(), b.frame_time()));
  }
  if (a.frames() == 0 || b.frames() == 0) return;
  const double start_a = static_cast<double>(a.step(0)) * a.step_time();
  const double start_b = static_cast<double>(b.step(0)) * b.step_time();
  if (std::abs(start_a - start_b) > 1e-6 * a.frame_time())
    throw std::invalid_argument(fmt::format("first frame at {} s against {} s: must be equal", start_a, start_b));
}

template <int Dim>
std::vector<double> position_differences(const Trajectory<Dim>& a, const Trajectory<Dim>& b) {
  check_comparable(a, b);
  std::vector<double> means;
  for (int j = 0; j < std::min(a.frames(), b.frames()); ++j) {
    double sum = 0.0;
    int present = 0;
    for (BodyIndex i = 0; i < std::min(a.bodies(j), b.bodies(j)); ++i) {
      if (!a.present(j, i) || !b.present(j, i)) continue;
      sum += a.way(b.position(j, i), a.position(j, i)).norm();
      ++present;
    }
    means.push_back(present > 0 ? sum / present : 0.0);
  }
  return means;
}

template void check_comparable(const Trajectory<2>&, const Trajectory<2>&);
template void check_comparable(const Trajectory<3>&, const Trajectory<3>&);
template std::vector<double> position_differences(const Trajectory<2>&, const Trajectory<2>&);
template std::vector<double> position_differences(const Trajectory<3>&, const Trajectory<3>&);

}  // namespace talus
