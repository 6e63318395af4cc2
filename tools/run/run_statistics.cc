#include "tools/run/run_statistics.h"

#include <numeric>

namespace talus {
namespace {

constexpr std::size_t last_steps = 100;

double simulation_time(const PhaseTimes& phases) { return phases.total() - phases.observe; }

}  // namespace

template <int Dim>
void RunStatistics<Dim>::on_frame(const Frame<Dim>& frame) {
  ++steps_;
  awake_ += static_cast<std::int64_t>(frame.world.awake().size());
  body_steps_ += frame.world.states().size() - frame.world.removals();
  for (const SleepEvent& event : frame.events) ++(event.woke ? woken_ : slept_);
  const PhaseTimes& now = frame.phases;
  sum_ += now;
  last_.push_back(simulation_time(now));
  if (last_.size() > last_steps) last_.pop_front();
}

template <int Dim>
double RunStatistics<Dim>::mean_step_ms() const {
  return steps_ > 0 ? 1e3 * simulation_time(sum_) / static_cast<double>(steps_) : 0.0;
}

template <int Dim>
double RunStatistics<Dim>::last_step_ms() const {
  if (last_.empty()) return 0.0;
  return 1e3 * std::accumulate(last_.begin(), last_.end(), 0.0) / static_cast<double>(last_.size());
}

template class RunStatistics<2>;
template class RunStatistics<3>;

}  // namespace talus
