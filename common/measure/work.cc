#include "common/measure/work.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/math/require.h"

namespace talus {

double contacts_skipped(const Work& run, const Work& full) {
  return full.contacts > 0 ? 1.0 - static_cast<double>(run.contacts) / static_cast<double>(full.contacts) : 0.0;
}

template <int Dim>
void WorkCounter<Dim>::on_frame(const Frame<Dim>& frame) {
  const BodyStates<Dim>& states = frame.world.states();
  work_.body_steps += std::count(states.removed.begin(), states.removed.end(), std::uint8_t{0});
  work_.simulated += static_cast<std::int64_t>(frame.world.awake().size());
  if (count_contacts_) work_.contacts += static_cast<std::int64_t>(frame.world.contacts().size());
}

template <int Dim>
Hindsight hindsight(const Trajectory<Dim>& full, std::span<const double> extents, double x, double window, int first,
                    int last) {
  require(x > 0.0, "x", x, "must be > 0");
  const int ahead = static_cast<int>(std::lround(window / full.frame_time()));
  require(ahead >= 1, "window", window, "must be at least a frame");
  const int end = std::min(last < 0 ? full.frames() : last, full.frames() - ahead);
  std::int64_t all = 0;
  std::int64_t moving = 0;
  const auto moves = [&](int frame, BodyIndex body) {
    const Vec<Dim> here = full.position(frame, body);
    const double far = x * extents[full.shape(body)];
    for (int later = frame + 1; later <= frame + ahead && full.present(later, body); ++later)
      if ((full.position(later, body) - here).norm() > far) return true;
    return false;
  };
  for (int frame = std::max(first, 0); frame < end; ++frame) {
    for (BodyIndex body = 0; body < full.bodies(frame); ++body) {
      if (!full.present(frame, body)) continue;
      ++all;
      moving += moves(frame, body);
    }
  }
  if (all == 0) return {};
  const double share = static_cast<double>(moving) / static_cast<double>(all);
  return {share, moving > 0 ? 1.0 / share : std::numeric_limits<double>::infinity()};
}

template class WorkCounter<2>;
template class WorkCounter<3>;
template Hindsight hindsight(const Trajectory<2>&, std::span<const double>, double, double, int, int);
template Hindsight hindsight(const Trajectory<3>&, std::span<const double>, double, double, int, int);

}  // namespace talus
