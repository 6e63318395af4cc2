#include "tools/bench/bench_folder.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "common/text/file.h"
#include "tools/pool/job_folder.h"

namespace talus {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* bench_file = "bench.json";
constexpr const char* same_bench = "the same benchmark of the same scenes";

/// All but the folder and the jobs, which change no result. The files of the scenes are part of what a benchmark is.
Json json_of(const BenchOptions& options) {
  return {{"scenes", options.scenes},
          {"files", options.files},
          {"preset", options.preset},
          {"policies", options.policies},
          {"settings", options.settings},
          {"backends", options.backends},
          {"seeds", options.seeds},
          {"quick", options.quick},
          {"force", options.force},
          {"drift", options.extras.drift},
          {"motion_error", options.extras.motion_error},
          {"frames", options.extras.frames}};
}

std::string text_of(const BenchOptions& options) {
  return json_of(options).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

fs::path row_file(const fs::path& folder, int number) { return folder / "rows" / fmt::format("{:05}.json", number); }

/// The row of a case, as its file has it. A file without a whole row counts for none, so that the case is measured
/// again.
BenchRow kept_row(const fs::path& file, const BenchCase& bench_case) {
  const std::string line = file_contents(file).value_or("");
  try {
    const std::string failure = Json::parse(line).value("failure", "");
    return failure.empty() ? row_of(bench_case, line) : BenchRow{bench_case, {}, {}, {}, failure};
  } catch (const Json::exception&) {
    return {bench_case, {}, {}, {}, std::string(not_measured)};
  }
}

}  // namespace

void make_bench_folder(const fs::path& folder) { make_job_folder(folder, bench_file, same_bench); }

void begin_bench(const BenchOptions& options) {
  const fs::path file = options.out / bench_file;
  BenchOptions other_force = options;  // changes no result
  other_force.force = !options.force;
  const std::string before = file_contents(file).value_or(text_of(options));
  if (before != text_of(options) && before != text_of(other_force)) throw other_job(options.out, same_bench);
  fs::create_directories(options.out / "rows");
  write_file(file, text_of(options));
}

BenchOptions read_bench(const fs::path& folder) {
  try {
    const Json json = Json::parse(file_contents(folder / bench_file).value_or(""));
    return {.scenes = json.at("scenes"),
            .preset = json.at("preset"),
            .policies = json.at("policies"),
            .settings = json.at("settings"),
            .backends = json.at("backends"),
            .out = fs::absolute(folder).lexically_normal(),
            .seeds = json.at("seeds"),
            .quick = json.at("quick"),
            .force = json.at("force"),
            .extras = {json.at("drift"), json.at("motion_error"), json.at("frames")},
            .files = json.at("files")};
  } catch (const Json::exception&) {
    throw std::invalid_argument(fmt::format("{}: must be a folder that `talus bench` has made", folder.string()));
  }
}

void keep_outcome(const fs::path& folder, int number, const TaskOutcome& outcome) {
  const fs::path file = row_file(folder, number);
  const Json failure = {{"failure", outcome.text}};
  write_file(file, outcome.failed ? failure.dump(-1, ' ', false, Json::error_handler_t::replace) : outcome.text);
}

std::vector<BenchRow> kept_rows(const fs::path& folder, const std::vector<BenchCase>& cases) {
  std::vector<BenchRow> rows;
  for (int i = 0; i < std::ssize(cases); ++i) rows.push_back(kept_row(row_file(folder, i), cases[i]));
  return rows;
}

}  // namespace talus
