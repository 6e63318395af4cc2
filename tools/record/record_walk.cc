#include "tools/record/record_walk.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "tools/record/record_file.h"

namespace talus {
namespace {

RecordedIdentity identity_of(const MomentReader& reader) {
  if (!reader.run()) return {};
  return {reader.run()->backend, reader.run()->policy, reader.run()->version, reader.run()->reason};
}

/// Whether the event completed a moment.
bool take(const LogEvent& event, const std::filesystem::path& file, MomentReader& reader) {
  const auto channel = channel_named(event.channel);
  try {
    return channel && reader.take(*channel, event.data);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace

template <int Dim>
WalkResult walk_record(const Scene<Dim>& scene, LogReader& log, const std::filesystem::path& file,
                       const std::function<void(const Moment&)>& visit) {
  MomentReader reader(Dim, limits_of(scene));
  OneRun run;
  std::int64_t last_step = 0;
  std::vector<SleepEvent> later_events;
  for (LogEvent event; log.next(event);) {
    run.see(event, file);
    if (!take(event, file, reader)) continue;
    const Moment& moment = reader.moment();
    if (moment.step > last_step)
      visit(moment);
    else
      later_events.insert(later_events.end(), moment.events.begin(), moment.events.end());
    last_step = moment.step;
  }
  later_events.insert(later_events.end(), reader.later_events().begin(), reader.later_events().end());
  return {.damage = {.bytes = log.damage().bytes,
                     .undecodable = reader.undecodable(),
                     .lost_events = reader.lost(Channel::sleep)},
          .run = identity_of(reader),
          .last = reader.moment(),
          .later_events = std::move(later_events)};
}

template WalkResult walk_record(const Scene<2>&, LogReader&, const std::filesystem::path&,
                                const std::function<void(const Moment&)>&);
template WalkResult walk_record(const Scene<3>&, LogReader&, const std::filesystem::path&,
                                const std::function<void(const Moment&)>&);

}  // namespace talus
