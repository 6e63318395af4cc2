#include "tools/record/log_summary.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <map>
#include <optional>
#include <vector>

#include "common/text/printable.h"
#include "lcmtypes/run_info.h"
#include "lcmtypes/run_message.h"
#include "lcmtypes/sequence_tracker.h"
#include "lcmtypes/wire.h"
#include "tools/output/output.h"
#include "tools/record/record_file.h"

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_listed = 1000;  // forged messages may name as many runs and events as they like

double in_seconds(std::int64_t microseconds) { return 1e-6 * static_cast<double>(microseconds); }

/// The stamps of the events, in the order of the log.
class StampCount {
 public:
  void take(std::int64_t stamp) {
    if (!begin_) {
      begin_ = end_ = stamp;
      return;
    }
    if (stamp < end_) ++backward_;
    const double gap = in_seconds(stamp) - in_seconds(end_);
    if (gap > longest_gap_) {
      longest_gap_ = gap;
      gap_at_ = end_;
    }
    end_ = std::max(end_, stamp);
  }

  Json json() const {
    if (!begin_) return nullptr;
    return {{"begin_s", in_seconds(*begin_)},
            {"end_s", in_seconds(end_)},
            {"longest_gap_s", longest_gap_},
            {"longest_gap_at_s", in_seconds(gap_at_) - in_seconds(*begin_)},
            {"backward", backward_}};
  }

 private:
  std::optional<std::int64_t> begin_;
  std::int64_t end_ = 0;  // the latest
  std::int64_t backward_ = 0;
  double longest_gap_ = 0.0;  // [s]
  std::int64_t gap_at_ = 0;
};

/// Messages of one run.
class RunCount {
 public:
  /// An event that message_json() decodes.
  void take(const LogEvent& event) {
    const MessageHeader header = header_of(event);
    const auto [numbers, first] = numbers_.try_emplace(event.channel);
    if (first) numbers->second.expect(header.seq);
    numbers->second.see(header.seq);
    if (!begin_) begin_ = header.time;
    end_ = std::max(end_, header.time);
    const double ahead = in_seconds(event.timestamp) - in_seconds(header.utime);
    if (!ahead_) ahead_ = ahead;
    apart_ = std::max(apart_, std::abs(ahead - *ahead_));
    if (talus_lcm::talus_run run; decode(event.data, run).empty()) run_ = run;
    if (talus_lcm::talus_event done; decode(event.data, done).empty()) take(done);
    if (talus_lcm::talus_bodies bodies; decode(event.data, bodies).empty()) take(bodies);
  }

  std::int64_t missing(const std::string& channel) const {
    const auto numbers = numbers_.find(channel);
    return numbers == numbers_.end() ? 0 : numbers->second.lost();
  }

  Json json(std::int64_t id) const {
    const talus_lcm::talus_run run = run_.value_or(talus_lcm::talus_run{});
    return {{"run", short_id(id)},
            {"scene", run.scene},
            {"backend", run.backend},
            {"solver", run.solver},
            {"policy", run.policy},
            {"version", run.version},
            {"seed", static_cast<std::uint64_t>(run.seed)},
            {"dimension", run.dimension},
            {"reason", run.reason},
            {"begin_s", begin_.value_or(0.0)},
            {"end_s", end_},
            {"stamps_apart_s", apart_},
            {"bodies", bodies_},
            {"frames", frames_},
            {"key_frames", key_frames_},
            {"events", events_}};
  }

 private:
  void take(const talus_lcm::talus_event& message) {
    const auto is_this = [&](const Json& listed) { return listed["number"] == message.number; };
    if (message.happened_step < 0 || events_.size() >= most_listed || std::ranges::any_of(events_, is_this)) return;
    events_.push_back({{"number", message.number}, {"step", message.happened_step}, {"text", message.text}});
  }

  void take(const talus_lcm::talus_bodies& message) {
    if (!message.body.empty()) bodies_ = std::max(bodies_, message.body.back() + 1);
    if (message.part != 0) return;
    frames_ += message.step > last_step_ ? 1 : 0;
    last_step_ = std::max(last_step_, message.step);
    key_frames_ += message.key_frame != 0 ? 1 : 0;
  }

  std::map<std::string, SequenceTracker> numbers_;  // by channel
  std::optional<talus_lcm::talus_run> run_;         // the last message about the run
  std::optional<double> begin_;                     // [s] simulated
  double end_ = 0.0;                                // [s] simulated
  std::optional<double> ahead_;                     // [s] of the first stamp before the time in its message
  double apart_ = 0.0;                              // [s] how far this changes
  Json events_ = Json::array();                     // of the scene
  std::int32_t bodies_ = 0;
  std::int64_t frames_ = 0;
  std::int64_t key_frames_ = 0;
  std::int64_t last_step_ = -1;
};

/// Messages of one channel.
struct ChannelCount {
  std::int64_t messages = 0;
  std::int64_t bytes = 0;
  std::int64_t undecodable = 0;
};

class LogCount {
 public:
  void take(const LogEvent& event) {
    stamps_.take(event.timestamp);
    ChannelCount& channel = channels_[event.channel];
    ++channel.messages;
    channel.bytes += static_cast<std::int64_t>(event.data.size());
    if (!is_of_run(event)) return;
    note_format(event);
    if (message_json(event).is_null()) {
      ++channel.undecodable;
      return;
    }
    const std::int64_t id = header_of(event).run_id;
    auto run = std::ranges::find(runs_, id, &std::pair<std::int64_t, RunCount>::first);
    if (run == runs_.end() && runs_.size() < most_listed) run = runs_.insert(run, {id, RunCount()});
    if (run != runs_.end()) run->second.take(event);
  }

  Json json() const {
    Json json = {{"stamps", stamps_.json()},
                 {"other_format", other_format_.empty() ? Json() : Json(other_format_)},
                 {"runs", Json::array()},
                 {"channels", Json::array()}};
    for (const auto& [id, run] : runs_) json["runs"].push_back(run.json(id));
    for (const auto& [name, count] : channels_) {
      std::int64_t missing = 0;
      for (const auto& [id, run] : runs_) missing = sum_of_counts(missing, run.missing(name));
      json["channels"].push_back({{"name", name},
                                  {"messages", count.messages},
                                  {"bytes", count.bytes},
                                  {"missing", missing},
                                  {"undecodable", count.undecodable}});
    }
    return json;
  }

 private:
  void note_format(const LogEvent& event) {
    if (!other_format_.empty() || event.channel != name_of(Channel::run)) return;
    if (const auto other = other_format(event.data)) other_format_ = text_of(*other);
  }

  StampCount stamps_;
  std::string other_format_;  // of a run whose messages this talus does not read; empty: of none
  std::map<std::string, ChannelCount> channels_;
  std::vector<std::pair<std::int64_t, RunCount>> runs_;  // by id, in the order of the log
};

std::string shown_text(const Json& text) { return printable(text.get<std::string>()); }

/// A stamp of our records is simulated time, one of a bus the time of day.
std::string text_of_stamps(const Json& stamps) {
  const double begin = stamps["begin_s"].get<double>();
  const double end = stamps["end_s"].get<double>();
  constexpr double year_2001 = 1e9;
  constexpr double year_2286 = 1e10;
  if (begin < year_2001 || begin > year_2286) return fmt::format("{:.2f} to {:.2f} s", begin, end);
  return fmt::format("{:%Y-%m-%d %H:%M:%S} UTC and {:.2f} s from there on",
                     fmt::gmtime(static_cast<std::time_t>(begin)), end - begin);
}

void print_stamps(const Json& json) {
  const Json& stamps = json["stamps"];
  std::int64_t messages = 0;
  for (const Json& channel : json["channels"]) messages += channel["messages"].get<std::int64_t>();
  const double gap = stamps["longest_gap_s"].get<double>();
  const double mean = (stamps["end_s"].get<double>() - stamps["begin_s"].get<double>()) /
                      static_cast<double>(std::max<std::int64_t>(1, messages));
  if (gap >= 1.0 && gap > 10.0 * mean)
    print_result("  no message for {:.2f} s, from {:.2f} s after the first stamp on\n", gap,
                 stamps["longest_gap_at_s"].get<double>());
  if (const auto backward = stamps["backward"].get<std::int64_t>(); backward > 0)
    print_result("  {} stamps are earlier than one before them; `talus info --repair` mends these\n", backward);
}

void print_run_of_log(const Json& run) {
  const std::string reason = shown_text(run["reason"]);
  if (run["dimension"] == 0)
    print_result("run {}: no message that describes it can be read\n", shown_text(run["run"]));
  else
    print_result("run {}: {} on {}, policy {}, seed {}, {}\n", shown_text(run["run"]), shown_text(run["scene"]),
                 solved_by(shown_text(run["backend"]), shown_text(run["solver"])), shown_text(run["policy"]),
                 run["seed"].get<std::uint64_t>(), reason.empty() ? "without an end" : "ended: " + reason);
  print_result("  {:.2f} to {:.2f} s simulated, {} bodies, {} frames of output, {} of them key frames\n",
               run["begin_s"].get<double>(), run["end_s"].get<double>(), run["bodies"].get<int>(),
               run["frames"].get<std::int64_t>(), run["key_frames"].get<std::int64_t>());
  if (const double apart = run["stamps_apart_s"].get<double>(); apart >= 1.0)
    print_result("  its stamps and the times in its messages run apart by {:.2f} s\n", apart);
  for (const Json& event : run["events"])
    print_result("  event {} before step {}: {}\n", event["number"].get<int>(), event["step"].get<std::int64_t>(),
                 shown_text(event["text"]));
}

}  // namespace

Json log_summary(const std::filesystem::path& file) {
  LogReader log(file.string());
  LogCount count;
  std::int64_t events = 0;
  for (LogEvent event; log.next(event); ++events) count.take(event);
  if (events == 0 && log.damage().bytes > 0) throw no_event_log(file);
  Json json = {{"file", file.string()},
               {"bytes", std::filesystem::file_size(file)},
               {"damaged_places", log.damage().places},
               {"damaged_bytes", log.damage().bytes}};
  json.update(count.json());
  return json;
}

void print_log_summary(const Json& summary) {
  const bool empty = summary["stamps"].is_null();
  print_result("{}: {:.1f} MB, {}\n", shown_text(summary["file"]), summary["bytes"].get<double>() / 1e6,
               empty ? "no message" : "stamps " + text_of_stamps(summary["stamps"]));
  if (!empty) print_stamps(summary);
  if (!summary["other_format"].is_null())
    print_result("messages of {}: the scene must be run again\n", shown_text(summary["other_format"]));
  if (summary["runs"].empty()) print_result("no run of talus is in it\n");
  for (const Json& run : summary["runs"]) print_run_of_log(run);
  for (const Json& channel : summary["channels"]) {
    print_result("  {:<14} {:>8} messages {:>12} bytes", shown_text(channel["name"]),
                 channel["messages"].get<std::int64_t>(), channel["bytes"].get<std::int64_t>());
    for (const char* fault : {"missing", "undecodable"})
      if (const auto number = channel[fault].get<std::int64_t>(); number > 0) print_result(", {} {}", number, fault);
    print_result("\n");
  }
  if (const auto bytes = summary["damaged_bytes"].get<std::uint64_t>(); bytes > 0)
    print_result("damaged: {} bytes in {} places; `talus info --repair` writes what is whole\n", bytes,
                 summary["damaged_places"].get<std::uint64_t>());
}

}  // namespace talus
