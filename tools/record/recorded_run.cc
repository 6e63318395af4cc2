#include "tools/record/recorded_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>

#include "common/text/printable.h"
#include "tools/record/record_file.h"
#include "tools/record/record_walk.h"

namespace talus {
namespace fs = std::filesystem;

namespace {

// Bounds what a forged step number costs.
constexpr std::size_t max_lost_frames = 1'000'000;

/// Adds the moment as a frame of output, and those that are missing before it as lost.
template <int Dim>
void add_frame(const Moment& moment, const fs::path& file, RecordedRun<Dim>& run) {
  const std::int64_t distance = run.frames.steps_per_frame();
  std::int64_t next = run.frames.frames() == 0 ? distance : run.frames.step(run.frames.frames());
  if (moment.step % distance != 0 || moment.step < next) return;  // the last state of an interrupted run
  for (; next < moment.step; next += distance) {
    if (moment.step > run.scene.steps() || run.damage.lost_steps.size() >= max_lost_frames) {
      throw std::invalid_argument(fmt::format("{}: step {}, but the run of its scene has {} steps", file.string(),
                                              moment.step, run.scene.steps()));
    }
    run.damage.lost_steps.push_back(next);
    run.frames.append_lost(next);
    run.contacts.emplace_back();
  }
  run.frames.append(states_of<Dim>(moment), moment.step, moment.bodies.unknown);
  run.contacts.push_back(contacts_of<Dim>(moment));
}

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

std::string record_bytes(const fs::path& folder) {
  LogReader log(record_file(folder).string());
  bool any = false;
  const auto visit = [&any](const Moment&) { any = true; };
  const WalkResult walk =
      std::visit([&]<int Dim>(const Scene<Dim>& scene) { return walk_record<Dim>(scene, log, folder, visit); },
                 scene_of_run(folder));
  if (!any) throw no_frame(folder, walk.damage.bytes);
  std::ifstream in(record_file(folder), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

AnyRecordedRun read_run(const fs::path& folder) {
  const AnyScene scene = scene_of_run(folder);
  LogReader log(record_file(folder).string());
  return read_record(scene, log, folder);
}

AnyRecordedRun read_record(const AnyScene& scene, LogReader& log, const fs::path& folder) {
  return std::visit(
      [&]<int Dim>(const Scene<Dim>& of_dimension) -> AnyRecordedRun {
        RecordedRun<Dim> run(of_dimension);
        const auto add = [&run](const std::vector<SleepEvent>& events) {
          run.events.insert(run.events.end(), events.begin(), events.end());
        };
        const WalkResult walk = walk_record<Dim>(of_dimension, log, folder, [&](const Moment& moment) {
          add(moment.events);
          add_frame(moment, folder, run);
        });
        add(walk.later_events);
        run.name = name_of_run(folder);
        run.backend = walk.run.backend;
        run.policy = walk.run.policy;
        run.reason = walk.run.reason;
        run.last = states_of<Dim>(walk.last);
        run.last_step = walk.last.step;
        run.done = walk.last.done;
        run.damage.bytes = walk.damage.bytes;
        run.damage.undecodable = walk.damage.undecodable;
        run.damage.lost_events = walk.damage.lost_events;
        run.damage.unknown_bodies = static_cast<int>(std::ranges::count(walk.last.bodies.unknown, 1));
        if (run.last_step > 0) return run;
        throw no_frame(folder, run.damage.bytes);
      },
      scene);
}

}  // namespace talus
