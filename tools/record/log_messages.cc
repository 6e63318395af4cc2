#include "tools/record/log_messages.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>
#include <stdexcept>

#include "lcmtypes/channels.h"
#include "tools/output/json_text.h"
#include "tools/output/output.h"
#include "tools/record/record_file.h"

namespace talus {
namespace {

bool is_wanted(const MessageChoice& choice, const LogEvent& event, std::int64_t begin) {
  const auto& names = choice.channels;
  if (!names.empty() && std::ranges::find(names, event.channel) == names.end()) return false;
  const double time = 1e-6 * (static_cast<double>(event.timestamp) - static_cast<double>(begin));
  return time >= choice.from && time <= choice.to;
}

/// A run without sleep events has no message on TALUS_SLEEP, which is no error. Throws std::invalid_argument on a name
/// that is neither of a run's channel nor of one in the log.
void check_silent_channels(const MessageChoice& choice, const std::set<std::string>& heard) {
  for (const std::string& channel : choice.channels)
    if (!heard.contains(channel)) {
      if (!channel_named(channel))
        throw std::invalid_argument(
            fmt::format("--channel = {}: must be a channel of the log, which has {}", channel, fmt::join(heard, ", ")));
      print_message("talus: --channel {}: no message in the log; its channels are {}", channel, fmt::join(heard, ", "));
    }
}

}  // namespace

void print_messages(const std::filesystem::path& file, const MessageChoice& choice) {
  LogReader log(file.string());
  std::optional<std::int64_t> begin;
  std::set<std::string> heard;
  for (LogEvent event; log.next(event);) {
    if (!begin) begin = event.timestamp;
    heard.insert(event.channel);
    if (!is_wanted(choice, event, *begin)) continue;
    nlohmann::ordered_json json = {
        {"channel", event.channel}, {"stamp_us", event.timestamp}, {"bytes", event.data.size()}};
    json["message"] = is_of_run(event) ? message_json(event) : nlohmann::ordered_json();
    print_result("{}\n", json_text(json));
  }
  if (!begin && log.damage().bytes > 0) throw no_event_log(file);
  if (log.damage().bytes > 0) print_message("{}: {} damaged bytes left out", file.string(), log.damage().bytes);
  check_silent_channels(choice, heard);
}

}  // namespace talus
