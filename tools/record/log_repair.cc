#include "tools/record/log_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <vector>

#include "common/scene/read_scene.h"
#include "common/scene/write_scene.h"
#include "common/text/printable.h"
#include "lcmtypes/event_log.h"
#include "lcmtypes/run_info.h"
#include "lcmtypes/scene_message.h"
#include "lcmtypes/wire.h"
#include "tools/output/output.h"
#include "tools/record/record_file.h"
#include "tools/record/recorded_scene.h"
#include "tools/run/run_files.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

/// When an event is from [us].
struct EventTime {
  std::int64_t stamp = 0;                                    // in the log, under no checksum
  std::optional<std::pair<std::int64_t, std::int64_t>> own;  // run and time in the message, if it is of talus
};

/// Numbers of events whose stamps do not decrease, as many as there can be: the longest such sequence (Fredman 1975).
std::vector<std::size_t> ascending(const std::vector<EventTime>& times) {
  std::vector<std::size_t> ends;  // of the best sequence of each length
  std::vector<std::size_t> before(times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto at = std::ranges::upper_bound(ends, times[i].stamp, {}, [&](std::size_t n) { return times[n].stamp; });
    before[i] = at == ends.begin() ? i : *std::prev(at);
    at == ends.end() ? ends.push_back(i) : void(*at = i);
  }
  std::vector<std::size_t> sequence;
  if (ends.empty()) return sequence;
  std::size_t i = ends.back();
  for (sequence.push_back(i); before[i] != i; sequence.push_back(i)) i = before[i];
  std::ranges::reverse(sequence);
  return sequence;
}

/// Whether the stamp of the first or last event lies far from its neighbour's, further than their messages say or ten
/// times the length of the `rest`.
bool is_far(const EventTime& end, const EventTime& neighbour, double rest) {
  constexpr double far = 60e6;
  const double gap = std::abs(static_cast<double>(end.stamp) - static_cast<double>(neighbour.stamp));
  if (end.own && neighbour.own && end.own->first == neighbour.own->first)
    return gap - std::abs(static_cast<double>(end.own->second) - static_cast<double>(neighbour.own->second)) > far;
  return gap > far && gap > 10.0 * rest;
}

/// Gives each event a stamp that a player can go by; how many were changed.
std::int64_t mend_stamps(std::vector<EventTime>& times) {
  std::vector<std::size_t> good = ascending(times);
  const auto stamp = [&](std::size_t i) { return times[good[i]].stamp; };
  if (good.size() >= 4) {
    const std::size_t last = good.size() - 1;
    const double of_most = static_cast<double>(stamp(last - 1)) - static_cast<double>(stamp(1));
    if (is_far(times[good[last]], times[good[last - 1]], of_most)) good.pop_back();
    if (is_far(times[good[0]], times[good[1]], of_most)) good.erase(good.begin());
  }
  std::int64_t mended = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (next < good.size() && good[next] == i) {
      ++next;
      continue;
    }
    const std::int64_t replacement = stamp(next == 0 ? 0 : next - 1);
    mended += times[i].stamp == replacement ? 0 : 1;
    times[i].stamp = replacement;
  }
  return mended;
}

/// Whole events of a log, of one run or of all.
class ChosenEvents {
 public:
  ChosenEvents(const fs::path& file, const std::string& run) : log_(file.string()), run_(run) {}

  bool next(LogEvent& event) {
    while (log_.next(event))
      if (run_.empty() || (is_of_run(event) && short_id(header_of(event).run_id) == run_)) return true;
    return false;
  }
  const LogDamage& damage() const { return log_.damage(); }

 private:
  LogReader log_;
  const std::string& run_;
};

std::vector<EventTime> times_of(const fs::path& file, const std::string& run) {
  std::vector<EventTime> times;
  ChosenEvents events(file, run);
  for (LogEvent event; events.next(event);) {
    EventTime& time = times.emplace_back(EventTime{event.timestamp, std::nullopt});
    if (is_of_run(event)) time.own = {header_of(event).run_id, header_of(event).utime};
  }
  if (times.empty() && run.empty()) throw no_event_log(file);
  if (times.empty())
    throw std::invalid_argument(fmt::format("--run = {}: must be a run that is in {}", run, file.string()));
  return times;
}

/// Writes the scene's files of a record into the folder of its copy, where the record lacks them the scene `beside` it,
/// and tells what is missing then.
void write_scene(const std::vector<SceneFile>& recorded, const fs::path& beside, const fs::path& out) {
  if (!recorded.empty() && recorded.front().name == scene_file_name)
    write_scene_files(recorded, out);
  else if (fs::is_regular_file(beside))
    fs::copy_file(beside, out / scene_file_name);
  try {
    fs::exists(out / scene_file_name) ? read_scene(out / scene_file_name) : scene_of_run(out);
  } catch (const std::exception& error) {
    print_message("the record does not hold all files of its scene: {}", error.what());
  }
}

}  // namespace

void repair_log(const fs::path& file, const std::string& run, const fs::path& out) {
  if (fs::exists(out)) throw std::invalid_argument(fmt::format("--out = {}: must not exist yet", out.string()));
  std::vector<EventTime> times = times_of(file, run);
  const std::int64_t mended = mend_stamps(times);
  fs::create_directories(out);
  SceneFilesReader scene;
  EventLog log((out / run_files::record).string());
  ChosenEvents events(file, run);
  std::size_t copied = 0;
  for (LogEvent event; events.next(event);) {  // to the end: what is damaged there counts too
    if (copied == times.size()) continue;
    event.timestamp = times[copied++].stamp;
    log.write(event);
    talus_lcm::talus_scene message;
    if (event.channel == name_of(Channel::scene) && decode(event.data, message).empty()) scene.take(message);
  }
  log.flush();
  print_result("{}: {} whole messages; {} damaged bytes in {} places left out, {} stamps mended\n",
               printable(out.string()), copied, events.damage().bytes, events.damage().places, mended);
  const bool of_run = std::ranges::any_of(times, [](const EventTime& time) { return time.own.has_value(); });
  if (of_run) write_scene(scene.files(), file.parent_path() / scene_file_name, out);
}

}  // namespace talus
