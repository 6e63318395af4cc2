#include "tools/record/log_messages.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/output/output.h"
#include "tools/record/record_file.h"
#include "tools/report/json_text.h"

namespace talus {
namespace {

bool is_wanted(const MessageChoice& choice, const LogEvent& event) {
  const auto& names = choice.channels;
  if (!names.empty() && std::ranges::find(names, event.channel) == names.end()) return false;
  if (!is_of_run(event)) return true;
  const double time = header_of(event).time;
  return time >= choice.from && time <= choice.to;
}

}  // namespace

void print_messages(const std::filesystem::path& file, const MessageChoice& choice) {
  LogReader log(file.string());
  for (LogEvent event; log.next(event);) {
    if (!is_wanted(choice, event)) continue;
    nlohmann::ordered_json json = {{"channel", event.channel}, {"bytes", event.data.size()}};
    json["message"] = is_of_run(event) ? message_json(event) : nlohmann::ordered_json();
    print_result("{}\n", json_text(json));
  }
  if (log.damage().bytes > 0) print_message("{}: {} damaged bytes left out", file.string(), log.damage().bytes);
}

}  // namespace talus
