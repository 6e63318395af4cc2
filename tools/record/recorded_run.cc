#include "tools/record/recorded_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>

#include "common/text/printable.h"
#include "lcmtypes/decode.h"
#include "lcmtypes/translate.h"
#include "tools/monitor/sequence_tracker.h"
#include "tools/record/record_file.h"
#include "tools/record/state_reader.h"

namespace talus {
namespace fs = std::filesystem;

namespace {

// Bounds what a forged step number costs.
constexpr std::size_t max_lost_frames = 1'000'000;

template <int Dim>
class RunReader {
 public:
  explicit RunReader(const Scene<Dim>& scene)
      : run_(scene), states_(static_cast<int>(scene.bodies_planned()), static_cast<int>(scene.world.shapes.size())) {
    sleep_numbers_.expect(0);
  }

  void take(const LogEvent& event) {
    if (const auto channel = channel_named(event.channel))
      with_message_of(*channel, [&](auto message) { decode_and_take(event, message); });
  }

  RecordedRun<Dim> finish() {
    run_.last = states_.states();
    run_.last_step = states_.step();
    run_.damage.lost_events = sleep_numbers_.lost();
    for (std::size_t i = 0; i < states_.unknown().size(); ++i)
      run_.damage.unknown_bodies += states_.unknown()[i] != 0 ? 1 : 0;
    return std::move(run_);
  }

 private:
  template <class Message>
  void decode_and_take(const LogEvent& event, Message& message) {
    if constexpr (requires { this->take(message); }) {
      if (decode(event.data, message).empty())
        take(message);
      else
        ++run_.damage.undecodable;
    }
  }

  void take(const talus_lcm::talus_run_v1& message) {
    if (message.dimension != Dim) {
      throw std::invalid_argument(
          fmt::format("run.lcm is of a run in {}D: must be {}D as its scene", message.dimension, Dim));
    }
    run_.backend = message.backend;
    run_.policy = message.policy;
    run_.reason = message.reason;
  }

  void take(const talus_lcm::talus_sleep_v1& message) {
    const std::int64_t lost_before = sleep_numbers_.lost();
    sleep_numbers_.see(message.seq);
    if (sleep_numbers_.lost() > lost_before) states_.note_lost_events();
    for (const SleepEvent& event : events_of(message)) {
      states_.note_event(event.body);
      run_.events.push_back(event);
    }
  }

  void take(const talus_lcm::talus_event_v2& message) {
    if (message.number >= std::ssize(run_.scene.events))
      throw std::invalid_argument(
          fmt::format("run.lcm: event {}, but the scene has {} events", message.number, run_.scene.events.size()));
    run_.done.push_back({message.number, message.sim_time - run_.scene.world.dt});
  }

  void take(const talus_lcm::talus_bodies_v1& message) {
    if (!states_.take(message)) return;
    const std::int64_t step = states_.step();
    const std::int64_t distance = run_.frames.steps_per_frame();
    std::int64_t next = run_.frames.frames() == 0 ? distance : run_.frames.step(run_.frames.frames());
    if (step % distance != 0 || step < next) return;  // the last state of an interrupted run; a frame again
    for (; next < step; next += distance) {
      if (step > run_.scene.steps() || run_.damage.lost_steps.size() >= max_lost_frames) {
        throw std::invalid_argument(
            fmt::format("run.lcm: step {}, but the run of its scene has {} steps", step, run_.scene.steps()));
      }
      run_.damage.lost_steps.push_back(next);
      run_.frames.append_lost(next);
    }
    run_.frames.append(states_.states(), step, states_.unknown());
  }

  RecordedRun<Dim> run_;
  StateReader<Dim> states_;
  SequenceTracker sleep_numbers_;  // of the messages with sleep events
};

std::string plural(std::size_t number, const char* noun) {
  return fmt::format("{} {}{}", number, noun, number == 1 ? "" : "s");
}

}  // namespace

std::string text_of(const RecordDamage& damage) {
  constexpr std::size_t shown = 10;
  std::vector<std::string> parts;
  if (!damage.lost_steps.empty()) {
    const auto first = std::span(damage.lost_steps).first(std::min(damage.lost_steps.size(), shown));
    parts.push_back(fmt::format("{} left out (step{} {}{})", plural(damage.lost_steps.size(), "frame"),
                                damage.lost_steps.size() == 1 ? "" : "s", fmt::join(first, ", "),
                                damage.lost_steps.size() > shown ? ", ..." : ""));
  }
  if (damage.lost_events > 0) parts.push_back(fmt::format("{} messages of sleep events missing", damage.lost_events));
  if (damage.undecodable > 0) parts.push_back(fmt::format("{} messages not decodable", damage.undecodable));
  if (damage.bytes > 0) parts.push_back(plural(damage.bytes, "damaged byte"));
  if (damage.unknown_bodies > 0)
    parts.push_back(fmt::format("{} bodies of unknown pose in the last state", damage.unknown_bodies));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string name_of_run(const fs::path& folder) {
  const fs::path base = folder.filename().empty() ? folder.parent_path() : folder;
  return printable(base.filename().string());
}

std::invalid_argument no_frame(const fs::path& folder, std::uint64_t damaged_bytes) {
  return std::invalid_argument(
      fmt::format("{}: run.lcm holds no frame; the run ended before its first one, or all are damaged ({} damaged "
                  "bytes)",
                  folder.string(), damaged_bytes));
}

AnyRecordedRun read_run(const fs::path& folder) {
  const AnyScene scene = scene_of_run(folder);
  LogReader log(record_file(folder).string());
  return read_record(scene, log, folder);
}

AnyRecordedRun read_record(const AnyScene& scene, LogReader& log, const fs::path& folder) {
  return std::visit(
      [&]<int Dim>(const Scene<Dim>& of_dimension) -> AnyRecordedRun {
        RunReader<Dim> reader(of_dimension);
        OneRun one;
        for (LogEvent event; log.next(event);) {
          one.see(event, folder);
          reader.take(event);
        }
        RecordedRun<Dim> run = reader.finish();
        run.name = name_of_run(folder);
        run.damage.bytes = log.damage().bytes;
        if (run.last_step > 0) return run;
        throw no_frame(folder, run.damage.bytes);
      },
      scene);
}

}  // namespace talus
