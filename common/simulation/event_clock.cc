#include "common/simulation/event_clock.h"

#include <algorithm>

namespace talus {

template <int Dim>
EventClock<Dim>::EventClock(const std::vector<Event<Dim>>& events) {
  for (const Event<Dim>& event : events)
    waiting_.push_back({static_cast<int>(waiting_.size()), event.time, event.when == when_at_rest, event.bodies});
}

template <int Dim>
std::span<const int> EventClock<Dim>::update(double time, int bodies, bool at_rest) {
  constexpr double rounding = 1e-9;  // [s]: a time that is a whole number of steps is not a step late
  due_.clear();
  std::erase_if(waiting_, [&](const Condition& condition) {
    const bool is_due = condition.rest   ? at_rest
                        : condition.time ? time >= *condition.time - rounding
                                         : bodies >= condition.bodies;
    if (is_due) due_.push_back(condition.number);
    at_rest = at_rest && !(is_due && condition.rest);
    return is_due;
  });
  return due_;
}

template <int Dim>
bool EventClock<Dim>::waits_for_rest() const {
  return std::ranges::any_of(waiting_, &Condition::rest);
}

template <int Dim>
bool EventClock<Dim>::waits() const {
  return std::ranges::any_of(waiting_, [](const Condition& condition) { return condition.rest || condition.time; });
}

template class EventClock<2>;
template class EventClock<3>;

}  // namespace talus
