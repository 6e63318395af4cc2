#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>

#include "common/text/printable.h"
#include "lcmtypes/decode.h"
#include "lcmtypes/encode.h"
#include "lcmtypes/event_log.h"
#include "tools/commands/commands.h"
#include "tools/commands/validators.h"
#include "tools/output/output.h"
#include "tools/record/record_file.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

struct CutOptions {
  std::string run;
  std::string out;
  double from = 0.0;
  double to = std::numeric_limits<double>::infinity();
};

void for_each_event(const fs::path& file, const std::function<void(LogEvent&)>& visit) {
  LogReader log(file.string());
  for (LogEvent event; log.next(event);) visit(event);
}

/// Time [s] of the last key frame at or before `time`, from which on a reader has all poses; 0 where there is none.
double key_frame_before(const fs::path& file, double time) {
  double found = 0.0;
  for_each_event(file, [&](const LogEvent& event) {
    talus_lcm::talus_bodies bodies;
    if (event.channel != name_of(Channel::bodies) || header_of(event).time > time) return;
    if (decode(event.data, bodies).empty() && bodies.key_frame != 0 && bodies.part == 0) found = bodies.sim_time;
  });
  return found;
}

/// Copies a stretch of a record. Its messages are numbered from 0, so that a reader misses none; gaps within stay.
class Cutter {
 public:
  Cutter(const fs::path& file, double from, double to) : file_(file), from_(key_frame_before(file, from)), to_(to) {
    for_each_event(file_, [&](const LogEvent& event) {
      if (!is_of_run(event) || !belongs(event)) return;
      const MessageHeader header = header_of(event);
      const std::size_t channel = channel_of_name(event.channel);
      if (header.time < from_)
        ++before_[channel];
      else if (!shift_[channel])
        shift_[channel] = header.seq - before_[channel];
    });
  }

  /// [s] at which the stretch begins.
  double from() const { return from_; }

  std::int64_t copy(const fs::path& out) {
    EventLog log(out.string());
    std::int64_t copied = 0;
    for_each_event(file_, [&](LogEvent& event) {
      if (!belongs(event)) return;
      if (is_of_run(event)) adapt(event);
      log.write(event);
      ++copied;
    });
    log.flush();
    return copied;
  }

 private:
  static std::size_t channel_of_name(const std::string& name) {
    return static_cast<std::size_t>(std::find(channel_names.begin(), channel_names.end(), name) -
                                    channel_names.begin());
  }

  /// The beginning of the run and its shapes stand before each stretch.
  bool belongs(const LogEvent& event) const {
    if (!is_of_run(event)) return true;
    const double time = header_of(event).time;
    if (event.channel == name_of(Channel::shapes) || (event.channel == name_of(Channel::run) && time == 0.0))
      return true;
    return time >= from_ && time <= to_;
  }

  void adapt(LogEvent& event) const {
    const MessageHeader header = header_of(event);
    const std::int64_t shift = header.time < from_ ? 0 : shift_[channel_of_name(event.channel)].value_or(0);
    talus_lcm::talus_run run;
    if (event.channel == name_of(Channel::run) && decode(event.data, run).empty()) {
      for (std::size_t i = 0; i < run.channels.size(); ++i) {
        const std::size_t channel = channel_of_name(run.channels[i]);
        if (channel >= shift_.size() || header.time < from_) continue;
        run.sent[i] = std::max<std::int64_t>(0, run.sent[i] - shift_[channel].value_or(run.sent[i]));
      }
      run.encode(event.data.data(), 0, static_cast<int>(event.data.size()));
    }
    renumber(event.data, header.seq - shift);
  }

  fs::path file_;
  double from_;
  double to_;
  // By channel: messages that stand before the stretch, and what the numbers of those within are lowered by.
  std::array<std::int64_t, channel_names.size()> before_{};
  std::array<std::optional<std::int64_t>, channel_names.size()> shift_;
};

/// Makes the folder of the new record, with the scene if the old one has it.
void make_folder_like(const fs::path& run, const fs::path& out) {
  if (fs::exists(out)) throw std::invalid_argument(fmt::format("--out = {}: must not exist yet", out.string()));
  fs::create_directories(out);
  const fs::path scene = fs::is_directory(run) ? run / "scene.toml" : run.parent_path() / "scene.toml";
  if (fs::is_regular_file(scene)) fs::copy_file(scene, out / "scene.toml");
}

void cut(const CutOptions& options) {
  if (options.to < options.from) throw std::invalid_argument("--to: must be --from or later");
  const fs::path file = record_file(options.run);
  Cutter cutter(file, options.from, options.to);
  make_folder_like(options.run, options.out);
  const std::int64_t copied = cutter.copy(fs::path(options.out) / "run.lcm");
  print_result("{}: {} messages; it begins at {:.2f} s, with the key frame before --from\n", printable(options.out),
               copied, cutter.from());
}

void repair(const std::string& run, const std::string& out) {
  const fs::path file = record_file(run);
  make_folder_like(run, out);
  EventLog log((fs::path(out) / "run.lcm").string());
  LogReader reader(file.string());
  std::int64_t copied = 0;
  for (LogEvent event; reader.next(event); ++copied) log.write(event);
  log.flush();
  print_result("{}: {} whole messages; {} damaged bytes in {} places left out\n", printable(out), copied,
               reader.damage().bytes, reader.damage().places);
}

}  // namespace

void add_cut_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("cut", "Copy a stretch of a record into a run folder of its own");
  auto options = std::make_shared<CutOptions>();
  command->add_option("run", options->run, "Run folder or event log")->required()->check(not_empty());
  command->add_option("--from", options->from, "Simulated time at which it begins, or a little earlier [s]")
      ->check(number_between(0.0, 1e9))
      ->capture_default_str();
  command->add_option("--to", options->to, "Simulated time at which it ends [s]; default: the end")
      ->check(number_between(0.0, 1e9));
  command->add_option("-o,--out", options->out, "Run folder to make")->required()->check(not_empty());
  command->footer("Example: talus cut runs/pour --from 5 --to 8 --out runs/part");
  command->callback([options, &exit_code] {
    cut(*options);
    exit_code = exit_codes::success;
  });
}

void add_repair_command(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("repair", "Copy what is whole of a damaged record into a run folder of its own");
  struct Options {
    std::string run;
    std::string out;
  };
  auto options = std::make_shared<Options>();
  command->add_option("run", options->run, "Run folder or event log")->required()->check(not_empty());
  command->add_option("-o,--out", options->out, "Run folder to make")->required()->check(not_empty());
  command->footer(
      "Other programs of LCM stop at the first damage, or crash. Example: talus repair runs/hurt --out runs/whole");
  command->callback([options, &exit_code] {
    repair(options->run, options->out);
    exit_code = exit_codes::success;
  });
}

}  // namespace talus
