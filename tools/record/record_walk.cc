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
bool take(const LogEvent& event, const std::filesystem::path& file, MomentReader& reader,
          const std::function<void(std::int64_t)>& before) {
  const auto channel = channel_named(event.channel);
  try {
    return channel && reader.take(*channel, event.data, before);
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
  bool whole = false;  // a moment that was not visited yet: the end of a run says some things of it again
  const auto show = [&] {
    if (std::exchange(whole, false)) visit(reader.moment());
  };
  const auto before = [&](std::int64_t step) {
    if (step != reader.moment().step) show();
  };
  for (LogEvent event; log.next(event);) {
    run.see(event, file);
    if (take(event, file, reader, before)) whole = true;
  }
  show();
  return {.damage = {.bytes = log.damage().bytes,
                     .undecodable = reader.undecodable(),
                     .lost_events = reader.lost(Channel::sleep),
                     .missing = reader.lost()},
          .run = identity_of(reader),
          .last = reader.moment(),
          .later_events = reader.later_events()};
}

template WalkResult walk_record(const Scene<2>&, LogReader&, const std::filesystem::path&,
                                const std::function<void(const Moment&)>&);
template WalkResult walk_record(const Scene<3>&, LogReader&, const std::filesystem::path&,
                                const std::function<void(const Moment&)>&);

}  // namespace talus
