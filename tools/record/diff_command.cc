#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "common/text/printable.h"
#include "tools/commands/commands.h"
#include "tools/output/output.h"
#include "tools/record/record_file.h"
#include "tools/report/json_text.h"

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

/// The first field in which two messages differ, as "poses[12]: 0.5, 0.25".
std::string first_difference(const Json& a, const Json& b, const std::string& path) {
  if (a.type() == b.type() && a.is_structured() && a.size() == b.size()) {
    if (a.is_object()) {
      for (const auto& [key, value] : a.items())
        if (b.contains(key) && value != b[key] && key != "crc32")
          return first_difference(value, b[key], path.empty() ? key : path + "." + key);
    } else {
      for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i] != b[i]) return first_difference(a[i], b[i], fmt::format("{}[{}]", path, i));
    }
  }
  const auto text = [](const Json& value) {
    return value.is_array() ? fmt::format("{} entries", value.size()) : json_text(value);
  };
  return fmt::format("{}: {} and {}", path, text(a), text(b));
}

std::string place_of(const LogEvent& event) {
  if (!is_of_run(event)) return event.channel;
  const MessageHeader header = header_of(event);
  return fmt::format("{} of step {}, {:.3f} s", event.channel, header.step, header.time);
}

/// Whether the messages of both logs are the same; says what differs first.
bool same_records(const std::string& run_a, const std::string& run_b) {
  LogReader log_a(record_file(run_a).string());
  LogReader log_b(record_file(run_b).string());
  LogEvent a;
  LogEvent b;
  for (std::int64_t number = 0;; ++number) {
    const bool in_a = log_a.next(a);
    const bool in_b = log_b.next(b);
    if (!in_a && !in_b) {
      print_result("the same {} messages\n", number);
      return true;
    }
    if (in_a != in_b) {
      print_result("the first {} messages are the same; then {} ends, and {} goes on with {}\n", number,
                   printable(in_a ? run_b : run_a), printable(in_a ? run_a : run_b), printable(place_of(in_a ? a : b)));
      return false;
    }
    if (a.channel == b.channel && a.data == b.data) continue;
    print_result("the first {} messages are the same\n", number);
    print_result("A: {}\nB: {}\n", printable(place_of(a)), printable(place_of(b)));
    if (a.channel == b.channel && is_of_run(a) && is_of_run(b))
      print_result("{}\n", printable(first_difference(message_json(a), message_json(b), "")));
    return false;
  }
}

}  // namespace

void add_diff_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("diff", "The first message in which two records differ");
  command->footer("Exit code 0: they are the same; 1: they differ. `talus compare` measures by how much.");
  struct Options {
    std::string a;
    std::string b;
  };
  auto options = std::make_shared<Options>();
  command->add_option("run_a", options->a, "Run folder or event log")->required()->check(not_empty());
  command->add_option("run_b", options->b, "Run folder or event log")->required()->check(not_empty());
  command->callback([options, &exit_code] {
    exit_code = same_records(options->a, options->b) ? exit_codes::success : exit_codes::failed;
  });
}

}  // namespace talus
