#include <memory>
#include <string>

#include "common/math/require.h"
#include "tools/commands/commands.h"
#include "tools/output/json_text.h"
#include "tools/output/output.h"
#include "tools/record/log_messages.h"
#include "tools/record/log_repair.h"
#include "tools/record/log_summary.h"
#include "tools/record/record_file.h"

namespace talus {
namespace {

struct InfoOptions {
  std::string run;
  std::string out;
  std::string one_run;
  bool json = false;
  bool messages = false;
  bool repair = false;
  MessageChoice choice;
};

void summarize(const std::filesystem::path& file, bool as_json) {
  const nlohmann::ordered_json summary = log_summary(file);
  if (as_json)
    print_result("{}\n", json_text(summary, 2));
  else
    print_log_summary(summary);
}

void info(const InfoOptions& options) {
  const std::filesystem::path file = record_file(options.run);
  require(options.choice.from <= options.choice.to, "--to", options.choice.to, "must not be before --from");
  if (options.repair)
    repair_log(file, options.one_run, options.out);
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
  command
      ->add_option("--from", options->choice.from,
                   "Time from which on messages are printed [s after the first]; default: all")
      ->check(number_between(0.0, 1e9))
      ->needs(messages);
  command->add_option("--to", options->choice.to, "Time up to which they are [s after the first]; default: the end")
      ->check(number_between(0.0, 1e9))
      ->needs(messages);
  CLI::Option* repair =
      command->add_flag("--repair", options->repair, "Copy what is whole of a damaged log to --out instead");
  command
      ->add_option("--run", options->one_run, "Of several runs in the log copy only this one, as `talus info` names it")
      ->check(not_empty())
      ->needs(repair);
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
