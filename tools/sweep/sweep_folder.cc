#include "tools/sweep/sweep_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "common/text/file.h"
#include "common/text/printable.h"
#include "tools/pool/job_folder.h"
#include "tools/run/run_files.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

constexpr const char* sweep_file = "sweep.json";
constexpr const char* same_sweep = "the same sweep of the same scene";
constexpr const char* work_folder = "at_work";
constexpr const char* failure_folder = "failed";

nlohmann::json json_of(const Sweep& sweep) {
  nlohmann::json json = {{"file", sweep.scene.string()},
                         {"files", sweep.files},
                         {"backend", sweep.backend},
                         {"force", sweep.force},
                         {"measure_drift", sweep.measure_drift},
                         {"probe_drift", sweep.probe_drift},
                         {"plot", sweep.plot},
                         {"axes", nlohmann::json::array()}};
  for (const SweepAxis& axis : sweep.axes) json["axes"].push_back({{"path", axis.path}, {"values", axis.values}});
  return json;
}

std::string text_of(const Sweep& sweep) {
  return json_of(sweep).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

/// What makes a sweep the same when it is started again: all but what changes no result.
std::string identity(Sweep sweep) {
  sweep.scene = sweep.scene.stem();
  sweep.force = false;
  sweep.plot.clear();
  return text_of(sweep);
}

std::string run_name(int number) { return fmt::format("run_{:04}", number); }

/// The number in run_NNNN or run_NNNN.MORE; none for other names.
std::optional<int> run_number_in(const std::string& name) {
  constexpr std::string_view prefix = "run_";
  int number = 0;
  if (!name.starts_with(prefix)) return std::nullopt;
  const char* first = name.data() + prefix.size();
  return std::from_chars(first, name.data() + name.size(), number).ec == std::errc() ? std::optional(number)
                                                                                     : std::nullopt;
}

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::error_code unused;
  std::vector<fs::path> entries;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, unused)) entries.push_back(entry.path());
  return entries;
}

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

/// The last lines of a text, on one.
std::string last_lines(const std::string& text) {
  constexpr std::size_t most = 400;  // [bytes]
  std::string end = text.substr(text.size() - std::min(text.size(), most));
  while (end.ends_with('\n')) end.pop_back();
  std::ranges::replace(end, '\n', ' ');
  return printable(end);
}

}  // namespace

void make_sweep_folder(const fs::path& folder) { make_job_folder(folder, sweep_file, same_sweep); }

void begin_sweep(const Sweep& sweep) {
  if (fs::exists(sweep.folder / sweep_file) && identity(read_sweep(sweep.folder)) != identity(sweep))
    throw other_job(sweep.folder, same_sweep);
  write_file(sweep.folder / sweep_file, text_of(sweep));
  fs::remove_all(sweep.folder / work_folder);
  fs::create_directories(sweep.folder / work_folder);
  fs::create_directories(sweep.folder / failure_folder);
}

Sweep read_sweep(const fs::path& folder) {
  const fs::path file = folder / sweep_file;
  std::ifstream stream(file);
  try {
    const nlohmann::json json = nlohmann::json::parse(stream);
    Sweep sweep{.folder = fs::absolute(folder).lexically_normal(),
                .scene = json.at("file").get<std::string>(),
                .files = json.at("files"),
                .backend = json.at("backend"),
                .force = json.at("force"),
                .measure_drift = json.at("measure_drift"),
                .probe_drift = json.at("probe_drift"),
                .plot = json.at("plot"),
                .axes = {}};
    for (const nlohmann::json& axis : json.at("axes")) sweep.axes.push_back({axis.at("path"), axis.at("values")});
    return sweep;
  } catch (const nlohmann::json::exception&) {
    throw std::invalid_argument(fmt::format("{}: must be a folder that `talus sweep` has made", folder.string()));
  }
}

fs::path run_folder(const Sweep& sweep, int number) { return sweep.folder / run_name(number); }

fs::path part_folder(const Sweep& sweep, int number, int process) {
  return sweep.folder / work_folder / fmt::format("{}.{}.{}", run_name(number), host_name(), process);
}

fs::path part_messages(const fs::path& part) { return part.string() + ".txt"; }

fs::path failure_file(const Sweep& sweep, int number) {
  return sweep.folder / failure_folder / (run_name(number) + ".txt");
}

nlohmann::json summary_of(const fs::path& folder) {
  std::ifstream stream(folder / run_files::summary);
  auto summary = nlohmann::json::parse(stream, nullptr, false);
  return summary.is_object() ? summary : nlohmann::json::object();
}

std::string reason_of(const nlohmann::json& summary) { return summary.value("reason", ""); }

bool is_finished(const Sweep& sweep, int number) {
  return reason_of(summary_of(run_folder(sweep, number))) == "finished";
}

int warnings_of(const nlohmann::json& summary) {
  std::size_t count = 0;
  for (const char* kind : {"outside_window", "scene_warnings", "warnings"})
    if (summary.contains(kind)) count += summary[kind].size();
  return static_cast<int>(count);
}

RunStates::RunStates(const Sweep& sweep) : failures_(sweep.folder / failure_folder) {
  for (const fs::path& file : entries_of(failures_))
    if (const auto number = run_number_in(file.filename())) failed_.insert(*number);
  for (const fs::path& file : entries_of(sweep.folder / work_folder))
    if (const auto number = run_number_in(file.filename()); number && file.extension() == ".txt")
      begun_[*number] = file;
}

RunState RunStates::of(int number, const std::string& reason) const {
  if (reason == "finished") return RunState::finished;
  if (begun_.contains(number)) return RunState::begun;
  if (failed_.contains(number) || (!reason.empty() && reason != "interrupted")) return RunState::failed;
  return RunState::waiting;
}

std::string RunStates::end_of_messages(int number) const {
  const auto begun = begun_.find(number);
  const fs::path file = begun != begun_.end() ? begun->second : failures_ / (run_name(number) + ".txt");
  return last_lines(file_contents(file).value_or(""));
}

}  // namespace talus
