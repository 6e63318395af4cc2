#include <fmt/format.h>

#include <algorithm>

#include "common/policy/frame.h"
#include "lcmtypes/stats_message.h"
#include "tools/monitor/panels.h"

namespace talus {

void draw_phases(const RunView& view, const Area& area) {
  if (!view.stats() || view.stats()->timed == 0) {
    area.put(0, 0, "ms per step: not measured", Style::strong);
    return;
  }
  const PhaseTimes times = phase_times_of(*view.stats());
  area.put(0, 0, fmt::format("ms per step: {:.3g}", times.total()), Style::strong);
  int place = 0;
  const int rows = 5;
  for (const Phase& phase : all_phases) {
    const bool part = phase.meaning.starts_with("of it");
    area.put(1 + place % rows, place / rows * 19,
             fmt::format("{}{:<{}} {:>7.3f}", part ? " " : "", phase.name, part ? 8 : 9, times.*phase.time));
    ++place;
  }
}

std::vector<Channel> channels_of(const RunView& view) {
  std::vector<Channel> channels(usual_channels.begin(), usual_channels.end());
  for (const Channel channel : all_channels)
    if (std::ranges::count(usual_channels, channel) == 0 && view.reader().received(channel) > 0)
      channels.push_back(channel);
  return channels;
}

void draw_channels(const Heard& heard, const HeardRun& run, const Area& area) {
  area.put(0, 0, "channel         /s   kB/s   lost   bad", Style::strong);
  int row = 1;
  for (const Channel channel : channels_of(run.view())) {
    const RateMeter::Rate rate = run.entry->rates[static_cast<std::size_t>(channel)].rate(heard.now);
    const std::int64_t lost = run.view().reader().lost(channel);
    const std::int64_t bad = heard.listener.undecodable(channel);
    const std::string_view name = std::string_view(talus::name_of(channel)).substr(channel_prefix.size());
    area.put(row, 0, fmt::format("{:<12} {:>5.1f} {:>6.1f}", name, rate.messages, rate.bytes / 1e3));
    area.put(row, 25, fmt::format("{:>6}", count_text(static_cast<double>(lost))),
             lost > 0 ? Style::alert : Style::good);
    area.put(row, 32, fmt::format("{:>5}", count_text(static_cast<double>(bad), 5)),
             bad > 0 ? Style::alert : Style::good);
    ++row;
  }
}

}  // namespace talus
