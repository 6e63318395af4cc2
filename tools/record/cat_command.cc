#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "tools/commands/commands.h"
#include "tools/commands/validators.h"
#include "tools/output/output.h"
#include "tools/record/record_file.h"
#include "tools/report/json_text.h"

namespace talus {
namespace {

struct CatOptions {
  std::string run;
  std::vector<std::string> channels;
  double from = 0.0;
  double to = std::numeric_limits<double>::infinity();
};

bool is_wanted(const CatOptions& options, const LogEvent& event) {
  const auto& names = options.channels;
  if (!names.empty() && std::find(names.begin(), names.end(), event.channel) == names.end()) return false;
  if (!is_of_run(event)) return true;
  const double time = header_of(event).time;
  return time >= options.from && time <= options.to;
}

void cat(const CatOptions& options) {
  LogReader log(record_file(options.run).string());
  for (LogEvent event; log.next(event);) {
    if (!is_wanted(options, event)) continue;
    nlohmann::ordered_json json = {{"channel", event.channel}, {"bytes", event.data.size()}};
    json["message"] = is_of_run(event) ? message_json(event) : nlohmann::ordered_json();
    print_result("{}\n", json_text(json));
  }
  if (log.damage().bytes > 0) print_message("{}: {} damaged bytes left out", options.run, log.damage().bytes);
}

}  // namespace

void add_cat_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("cat", "Print the messages of a record, a JSON object a line");
  auto options = std::make_shared<CatOptions>();
  command->add_option("run", options->run, "Run folder or event log")->required()->check(not_empty());
  command->add_option("--channel", options->channels, "Only this channel, as TALUS_SLEEP; may be repeated")
      ->check(not_empty());
  command->add_option("--from", options->from, "Simulated time from which on messages are printed [s]")
      ->check(number_between(0.0, 1e9))
      ->capture_default_str();
  command->add_option("--to", options->to, "Simulated time up to which they are [s]; default: the end")
      ->check(number_between(0.0, 1e9));
  command->footer("Example: talus cat runs/pour --channel TALUS_SLEEP --from 2 --to 3");
  command->callback([options, &exit_code] {
    cat(*options);
    exit_code = exit_codes::success;
  });
}

}  // namespace talus
