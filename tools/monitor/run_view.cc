#include "tools/monitor/run_view.h"

#include <algorithm>

#include "lcmtypes/sleep_message.h"

namespace talus {
namespace {

constexpr std::int64_t fewest_in_wave = 20;  // bodies that wake in one step, else a tenth of all

}  // namespace

std::vector<RunView::NumberedPile> RunView::piles() const {
  std::vector<NumberedPile> piles;
  const std::vector<Pile<3>>& all = reader_.moment().piles;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!all[i].layers.empty()) piles.push_back({static_cast<int>(i), &all[i]});
  return piles;
}

void RunView::remember(const talus_lcm::talus_sleep& message) {
  for (const SleepEvent& event : events_of(message)) sleep_.add(event);
}

/// A sample that is late is left out.
void RunView::remember(const talus_lcm::talus_stats& message) {
  counts_.add({.time = message.sim_time, .awake = message.awake, .asleep = message.asleep});
  sleep_.set_wave_size(std::max<std::int64_t>(fewest_in_wave, (std::int64_t{message.awake} + message.asleep) / 10));
}

}  // namespace talus
