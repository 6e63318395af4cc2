#include "tools/bench/bench_options.h"

#include <fmt/format.h>

namespace talus {
namespace {

/// " --OPTION VALUE" for each value, quoted where a shell needs it.
std::string repeated(const std::string& option, const std::vector<std::string>& values) {
  std::string text;
  for (const std::string& value : values) {
    const bool quoted = value.find_first_of(" []{}'\"$*") != std::string::npos;
    const std::string quote = quoted ? "'" : "";
    text += fmt::format(" --{} {}{}{}", option, quote, value, quote);
  }
  return text;
}

}  // namespace

BenchOptions completed(BenchOptions options, const std::string& name) {
  options.name = name;
  if (options.rounds == 0) options.rounds = options.quick ? 2 : 5;
  if (options.seeds == 0) options.seeds = options.quick ? 1 : 3;
  if (options.quick && options.share == 1.0) options.share = 0.5;
  if (options.out.empty()) options.out = std::filesystem::path("bench") / (options.quick ? name + "-quick" : name);
  return options;
}

std::string command_of(const BenchOptions& options) {
  std::string command = "talus bench " + options.name;
  if (options.quick) command += " --quick";
  command += repeated("scene", options.scenes) + repeated("backend", options.backends) +
             repeated("policy", options.policies) + repeated("set", options.settings);
  command += fmt::format(" --rounds {} --seeds {}", options.rounds, options.seeds);
  if (options.share != (options.quick ? 0.5 : 1.0)) command += fmt::format(" --share {}", options.share);
  if (options.reference) command += " --reference";
  if (!options.errors) command += " --no-errors";
  return command;
}

}  // namespace talus
