#include "tools/monitor/record_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <deque>
#include <filesystem>
#include <lcm/lcm-cpp.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/text/printable.h"
#include "lcmtypes/event_log.h"
#include "lcmtypes/live_link.h"
#include "tools/commands/validators.h"
#include "tools/monitor/stop_signal.h"
#include "tools/output/output.h"

namespace talus {
namespace {

namespace fs = std::filesystem;
using RecordClock = std::chrono::steady_clock;

constexpr double no_limit = std::numeric_limits<double>::infinity();

struct BusRecordOptions {
  std::string url;
  std::string out;
  std::string channels = ".*";        // regular expression of LCM
  double seconds = no_limit;          // [s] of wall time, > 0: when to stop
  double megabytes = no_limit;        // [MB] > 0: when to stop
  double split_seconds = no_limit;    // [s] of wall time, > 0: length of a file
  double split_megabytes = no_limit;  // [MB] > 0: size of a file
  int keep = 0;                       // newest files that stay; 0: all

  bool splits() const { return split_seconds < no_limit || split_megabytes < no_limit; }
};

/// Whether more than `seconds` have passed.
bool is_over(RecordClock::time_point begin, double seconds) {
  return std::chrono::duration<double>(RecordClock::now() - begin).count() >= seconds;
}

/// Bytes of an event in a log, its header included.
double bytes_of(const LogEvent& event) { return static_cast<double>(28 + event.channel.size() + event.data.size()); }

/// Writes events to one log, or to several in turn.
class BusRecorder {
 public:
  explicit BusRecorder(const BusRecordOptions& options) : options_(options) { open(); }

  void write(LogEvent& event) {
    if (file_bytes_ > 0.0 && file_bytes_ + bytes_of(event) > 1e6 * options_.split_megabytes) open();
    log_->write(event);
    file_bytes_ += bytes_of(event);
    all_bytes_ += bytes_of(event);
    ++messages_;
    channels_.insert(event.channel);
  }

  /// To be called now and then.
  void tend() {
    log_->flush_after(1.0);
    if (file_bytes_ > 0.0 && is_over(opened_, options_.split_seconds)) open();
  }

  bool full() const { return all_bytes_ >= 1e6 * options_.megabytes; }

  void finish() {
    log_->flush();
    print_result("{}: {} messages, {:.1f} MB, {} channels, {} {}\n", printable(options_.out), messages_,
                 all_bytes_ / 1e6, channels_.size(), opened_files_, opened_files_ == 1 ? "file" : "files");
  }

 private:
  /// bus.lcm, or bus-0001.lcm, bus-0002.lcm, ... where there may be several.
  fs::path next_file() const {
    fs::path out = options_.out;
    if (!options_.splits()) return out;
    return out.parent_path() / fmt::format("{}-{:04}.lcm", out.stem().string(), opened_files_ + 1);
  }

  void open() {
    const fs::path file = next_file();
    if (fs::exists(file)) throw std::invalid_argument(fmt::format("--out: {} must not exist yet", file.string()));
    if (log_) log_->flush();
    log_ = std::make_unique<EventLog>(file.string());
    files_.push_back(file);
    ++opened_files_;
    file_bytes_ = 0.0;
    opened_ = RecordClock::now();
    if (options_.keep == 0 || std::ssize(files_) <= options_.keep) return;
    fs::remove(files_.front());
    files_.pop_front();
  }

  const BusRecordOptions& options_;
  std::unique_ptr<EventLog> log_;
  std::deque<fs::path> files_;  // that are there
  int opened_files_ = 0;
  RecordClock::time_point opened_;
  double file_bytes_ = 0.0;
  double all_bytes_ = 0.0;
  std::int64_t messages_ = 0;
  std::set<std::string> channels_;
};

/// Takes events from LCM; they are written outside of its calls, through which no exception may pass.
struct EventTaker {
  std::vector<LogEvent> events;

  void take(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
    if (channel == "LCM_SELF_TEST") return;  // of LCM itself, from each program that begins to listen
    const auto* bytes = static_cast<const std::uint8_t*>(buffer->data);
    events.push_back({.timestamp = buffer->recv_utime, .channel = channel, .data = {bytes, bytes + buffer->data_size}});
  }
};

void record_bus(const BusRecordOptions& options) {
  check_url(options.url);
  if (!options.out.ends_with(".lcm"))
    throw std::invalid_argument(fmt::format("--out = {}: must end in .lcm", options.out));
  if (options.keep > 0 && !options.splits())
    throw std::invalid_argument("--keep: must stand with --split-seconds or --split-megabytes");
  const LiveLink link = open_live_link(receiving_url(options.url));
  if (!link.lcm) throw std::runtime_error(link.problem);
  EventTaker taker;
  lcm::Subscription* subscription = link.lcm->subscribe(options.channels, &EventTaker::take, &taker);
  if (subscription == nullptr)
    throw std::invalid_argument(fmt::format("--channel = {}: must be a regular expression", options.channels));
  subscription->setQueueCapacity(0);  // as much as there is
  BusRecorder recorder(options);
  const std::atomic<bool>& stop = stop_signal();
  for (const auto begin = RecordClock::now(); !stop && !recorder.full() && !is_over(begin, options.seconds);) {
    // A signal ends the wait as an error does.
    if (link.lcm->handleTimeout(100) < 0 && !stop) throw std::runtime_error("LCM stopped receiving");
    for (LogEvent& event : std::exchange(taker.events, {}))
      if (!recorder.full()) recorder.write(event);
    recorder.tend();
  }
  recorder.finish();
}

void add_limits(CLI::App& command, BusRecordOptions& options) {
  const auto positive = number_between(0.0, 1e9, Bound::left_out);
  command.add_option("--seconds", options.seconds, "Stop after so many seconds; else Ctrl-C stops")->check(positive);
  command.add_option("--megabytes", options.megabytes, "Stop when so much was written")->check(positive);
  command
      .add_option("--split-seconds", options.split_seconds,
                  "Begin a new file after so many seconds: NAME-0001.lcm, ...")
      ->check(positive);
  command.add_option("--split-megabytes", options.split_megabytes, "Begin a new file before this size is passed")
      ->check(positive);
  command.add_option("--keep", options.keep, "Keep only so many of the newest files")->check(CLI::Range(1, 1'000'000));
}

}  // namespace

void add_record_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("record", "Write what goes over an LCM bus, of talus or not, into event logs");
  const auto options = std::make_shared<BusRecordOptions>();
  command->add_option("-o,--out", options->out, "Log to make; its name ends in .lcm")->required()->check(in_a_folder());
  command->add_option("--lcm-url", options->url, "Where to listen; else LCM_DEFAULT_URL, else this machine's runs")
      ->check(not_empty());
  command->add_option("--channel", options->channels, "Regular expression of the channels to record; default: all")
      ->check(not_empty());
  add_limits(*command, *options);
  command->footer(
      "Example: talus record --out bus.lcm --seconds 60\nThe log is for `talus info` and `talus cat`; LCM's tools play "
      "it.");
  command->callback([options] { record_bus(*options); });
}

}  // namespace talus
