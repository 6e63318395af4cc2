#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "common/text/printable.h"
#include "lcmtypes/decode.h"
#include "lcmtypes/run_info.h"
#include "tools/commands/commands.h"
#include "tools/monitor/sequence_tracker.h"
#include "tools/output/output.h"
#include "tools/record/log_messages.h"
#include "tools/record/log_repair.h"
#include "tools/record/record_file.h"
#include "tools/report/json_text.h"

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

/// Messages of one channel.
struct ChannelCount {
  std::int64_t messages = 0;
  std::int64_t bytes = 0;
  std::int64_t undecodable = 0;
  SequenceTracker numbers;
};

/// What a log holds, gathered in one pass.
class LogSummary {
 public:
  void take(const LogEvent& event) {
    ChannelCount& channel = channels_[event.channel];
    ++channel.messages;
    channel.bytes += static_cast<std::int64_t>(event.data.size());
    if (!is_of_run(event)) return;
    const MessageHeader header = header_of(event);
    if (message_json(event).is_null()) {
      ++channel.undecodable;
      return;
    }
    if (channel.messages == 1) channel.numbers.expect(header.seq);
    channel.numbers.see(header.seq);
    if (!begin_) begin_ = header.time;
    end_ = std::max(end_, header.time);
    if (talus_lcm::talus_run_v1 run; decode(event.data, run).empty()) take(run);
    if (talus_lcm::talus_event_v2 done; decode(event.data, done).empty()) take(done);
    if (talus_lcm::talus_bodies_v1 bodies; decode(event.data, bodies).empty()) take(bodies);
  }

  Json json(const std::filesystem::path& file, const LogDamage& damage) const {
    Json json = {{"file", file.string()}, {"bytes", std::filesystem::file_size(file)}};
    json["run"] = run_ ? Json(short_id(run_->run_id)) : Json();
    json["runs"] = runs_.size();
    const auto text = [&](std::string talus_lcm::talus_run_v1::*field) { return run_ ? (*run_).*field : ""; };
    json["scene"] = text(&talus_lcm::talus_run_v1::scene);
    json["backend"] = text(&talus_lcm::talus_run_v1::backend);
    json["policy"] = text(&talus_lcm::talus_run_v1::policy);
    json["version"] = text(&talus_lcm::talus_run_v1::version);
    json["seed"] = run_ ? static_cast<std::uint64_t>(run_->seed) : 0;
    json["dimension"] = run_ ? run_->dimension : 0;
    json["reason"] = text(&talus_lcm::talus_run_v1::reason);
    json["begin_s"] = begin_.value_or(0.0);
    json["end_s"] = end_;
    json["bodies"] = bodies_;
    json["frames"] = frames_;
    json["key_frames"] = key_frames_;
    json["events"] = events_;
    json["damaged_places"] = damage.places;
    json["damaged_bytes"] = damage.bytes;
    json["channels"] = Json::array();
    for (const auto& [name, count] : channels_)
      json["channels"].push_back({{"name", name},
                                  {"messages", count.messages},
                                  {"bytes", count.bytes},
                                  {"missing", count.numbers.lost()},
                                  {"undecodable", count.undecodable}});
    return json;
  }

 private:
  void take(const talus_lcm::talus_run_v1& message) {
    constexpr std::size_t counted = 1000;  // forged messages may name as many as they like
    if (runs_.size() < counted) runs_.insert(message.run_id);
    run_ = message;
  }

  void take(const talus_lcm::talus_event_v2& message) {
    constexpr std::size_t most = 1000;
    if (events_.size() < most)
      events_.push_back({{"number", message.number}, {"step", message.step}, {"text", message.text}});
  }

  void take(const talus_lcm::talus_bodies_v1& message) {
    if (!message.body.empty()) bodies_ = std::max(bodies_, message.body.back() + 1);
    if (message.part != 0) return;
    frames_ += message.step > last_step_ ? 1 : 0;
    last_step_ = std::max(last_step_, message.step);
    key_frames_ += message.key_frame != 0 ? 1 : 0;
  }

  std::map<std::string, ChannelCount> channels_;
  std::set<std::int64_t> runs_;
  std::optional<talus_lcm::talus_run_v1> run_;  // the last message about the run
  std::optional<double> begin_;                 // [s]
  double end_ = 0.0;                            // [s]
  Json events_ = Json::array();                 // of the scene
  std::int32_t bodies_ = 0;
  std::int64_t frames_ = 0;
  std::int64_t key_frames_ = 0;
  std::int64_t last_step_ = -1;
};

void print_info(const Json& json) {
  const auto text = [&](const char* key) { return printable(json[key].get<std::string>()); };
  print_result("{}: {:.1f} MB, {:.2f} to {:.2f} s\n", text("file"), json["bytes"].get<double>() / 1e6,
               json["begin_s"].get<double>(), json["end_s"].get<double>());
  if (json["run"].is_null())
    print_result("no run is named in it\n");
  else
    print_result("run {}: {} on {}, policy {}, seed {}, {}\n", text("run"), text("scene"), text("backend"),
                 text("policy"), json["seed"].get<std::uint64_t>(),
                 text("reason").empty() ? "without an end" : "ended: " + text("reason"));
  print_result("{} bodies, {} frames of output, {} of them key frames\n", json["bodies"].get<int>(),
               json["frames"].get<std::int64_t>(), json["key_frames"].get<std::int64_t>());
  for (const Json& event : json["events"])
    print_result("  event {} before step {}: {}\n", event["number"].get<int>(), event["step"].get<std::int64_t>(),
                 printable(event["text"].get<std::string>()));
  for (const Json& channel : json["channels"]) {
    print_result("  {:<14} {:>8} messages {:>12} bytes", printable(channel["name"].get<std::string>()),
                 channel["messages"].get<std::int64_t>(), channel["bytes"].get<std::int64_t>());
    for (const char* fault : {"missing", "undecodable"})
      if (const auto number = channel[fault].get<std::int64_t>(); number > 0) print_result(", {} {}", number, fault);
    print_result("\n");
  }
  if (const auto bytes = json["damaged_bytes"].get<std::uint64_t>(); bytes > 0)
    print_result("damaged: {} bytes in {} places; `talus info --repair` writes what is whole\n", bytes,
                 json["damaged_places"].get<std::uint64_t>());
}

struct InfoOptions {
  std::string run;
  std::string out;
  bool json = false;
  bool messages = false;
  bool repair = false;
  MessageChoice choice;
};

void summarize(const std::filesystem::path& file, bool as_json) {
  LogReader log(file.string());
  LogSummary summary;
  for (LogEvent event; log.next(event);) summary.take(event);
  const Json json = summary.json(file, log.damage());
  if (as_json)
    print_result("{}\n", json_text(json, 2));
  else
    print_info(json);
}

void info(const InfoOptions& options) {
  const std::filesystem::path file = record_file(options.run);
  if (options.repair)
    repair_log(file, options.out);
  else if (options.messages)
    print_messages(file, options.choice);
  else
    summarize(file, options.json);
}

}  // namespace

void add_info_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("info", "What a record or another LCM event log holds");
  auto options = std::make_shared<InfoOptions>();
  command->add_option("run", options->run, "Run folder or event log")->required()->check(not_empty());
  CLI::Option* json = command->add_flag("--json", options->json, "As JSON");
  CLI::Option* messages =
      command->add_flag("--messages", options->messages, "Print its messages instead, a JSON object a line");
  command
      ->add_option("--channel", options->choice.channels,
                   "Only messages of this channel, as TALUS_SLEEP; may be repeated")
      ->check(not_empty())
      ->needs(messages);
  command->add_option("--from", options->choice.from, "Simulated time from which on messages are printed [s]")
      ->check(number_between(0.0, 1e9))
      ->capture_default_str()
      ->needs(messages);
  command->add_option("--to", options->choice.to, "Simulated time up to which they are [s]; default: the end")
      ->check(number_between(0.0, 1e9))
      ->needs(messages);
  CLI::Option* repair =
      command->add_flag("--repair", options->repair, "Copy what is whole of a damaged record to --out instead");
  CLI::Option* out =
      command->add_option("-o,--out", options->out, "Run folder to make")->check(not_empty())->needs(repair);
  repair->needs(out)->excludes(messages)->excludes(json);
  json->excludes(messages);
  command->footer(
      "Examples:\n  talus info runs/pour\n  talus info runs/pour --messages --channel TALUS_SLEEP --from 2 --to 3\n"
      "  talus info runs/hurt --repair --out runs/whole\n"
      "Other programs of LCM stop at the first damage, or crash.");
  command->callback([options, &exit_code] {
    info(*options);
    exit_code = exit_codes::success;
  });
}

}  // namespace talus
