#include "common/simulation/event_clock.h"

#include <algorithm>

namespace talus {
namespace {

/// Of the layers of a pile; 0 for one that is not there yet.
template <int Dim>
double greatest_density(std::span<const Pile<Dim>> piles, int pile) {
  double greatest = 0.0;
  if (pile < std::ssize(piles))
    for (const Layer& layer : piles[pile].layers) greatest = std::max(greatest, layer.density());
  return greatest;
}

}  // namespace

template <int Dim>
EventClock<Dim>::EventClock(const std::vector<Event<Dim>>& events) {
  for (const Event<Dim>& event : events) {
    Condition condition{.number = static_cast<int>(waiting_.size()),
                        .time = event.time,
                        .rest = event.when == when_at_rest,
                        .pile = event.pile,
                        .bodies = event.bodies};
    if (event.when == when_layer_density) condition.density = event.density;
    waiting_.push_back(condition);
  }
}

template <int Dim>
std::span<const int> EventClock<Dim>::update(double time, int bodies, bool at_rest, std::span<const Pile<Dim>> piles) {
  due_.clear();
  std::erase_if(waiting_, [&](const Condition& condition) {
    const bool is_due = condition.rest      ? at_rest
                        : condition.density ? greatest_density(piles, condition.pile) > *condition.density
                        : condition.time    ? time >= *condition.time - time_rounding
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
bool EventClock<Dim>::waits_for_layers() const {
  return std::ranges::any_of(waiting_, [](const Condition& condition) { return condition.density.has_value(); });
}

template <int Dim>
bool EventClock<Dim>::waits() const {
  return std::ranges::any_of(waiting_, [](const Condition& condition) { return condition.rest || condition.time; });
}

template class EventClock<2>;
template class EventClock<3>;

}  // namespace talus
