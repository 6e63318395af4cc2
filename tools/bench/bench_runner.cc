#include "tools/bench/bench_runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/measure/ensemble.h"
#include "common/world/world.h"
#include "tools/bench/error_meter.h"
#include "tools/bench/timed_run.h"
#include "tools/output/output.h"

namespace talus {
namespace {

RowKey key_at(const BenchCase& bench_case, Pass pass, int round) {
  RowKey key = key_of(bench_case);
  key.pass = pass;
  key.round = round;
  return key;
}

std::string as_time(double seconds) {
  if (seconds < 90.0) return fmt::format("{:.0f} s", seconds);
  return fmt::format("{:.0f} min", seconds / 60.0);
}

std::string text_of(const RowKey& key) {
  return fmt::format("{} {} {}{}{}, {}", key.scene, key.backend, key.policy, key.settings.empty() ? "" : " ",
                     key.settings, key.pass == Pass::timing ? fmt::format("round {}", key.round) : name_of(key.pass));
}

}  // namespace

BenchRunner::BenchRunner(BenchOptions options) : options_(std::move(options)), store_(options_.out / "rows.jsonl") {}

std::vector<BenchRunner::Task> BenchRunner::tasks() const {
  std::vector<Task> all;
  for (int round = 1; round <= options_.rounds; ++round) all.push_back({Pass::timing, round});
  if (options_.errors) all.push_back({Pass::against_full, 0});
  if (options_.errors && options_.reference) all.push_back({Pass::against_reference, 0});
  return all;
}

/// Baselines are timed once and compared with the reference only.
bool BenchRunner::missing(const BenchCase& bench_case, const Task& task) const {
  const bool wanted = !is_baseline(bench_case) || task.round == 1 || task.pass == Pass::against_reference;
  return wanted && store_.find(key_at(bench_case, task.pass, task.round)) == nullptr;
}

void BenchRunner::run(const std::vector<BenchGroup>& groups) {
  total_ = done_ = 0;
  for (const BenchGroup& group : groups) {
    for (const BenchCase& each : group.cases)
      for (const Task& task : tasks()) total_ += missing(each, task) ? 1 : 0;
  }
  watch_.lap();
  for (const BenchGroup& group : groups) {
    for (const Task& task : tasks()) {
      if (task.pass != Pass::timing) {
        measure_errors(group, task);
        continue;
      }
      for (const BenchCase& each : group.cases)
        if (missing(each, task)) time_once(each, task);
    }
  }
}

void BenchRunner::time_once(const BenchCase& bench_case, const Task& task) {
  const RowKey key = key_at(bench_case, task.pass, task.round);
  try {
    const TimedRun run =
        std::visit([&](const auto& scene) { return timed_run(scene, bench_case.backend); }, load(bench_case));
    finished({key, fmt::format("{:016x}", run.end_hash), run.values});
  } catch (const NonFiniteState& error) {
    failed(key, error);
  }
}

void BenchRunner::measure_errors(const BenchGroup& group, const Task& task) {
  const auto is_missing = [&](const BenchCase& each) { return missing(each, task); };
  if (std::ranges::none_of(group.cases, is_missing)) return;
  BenchCase baseline = group.full();
  if (task.pass == Pass::against_reference) baseline.policy = reference_policy;
  try {
    std::visit(
        [&]<int Dim>(const Scene<Dim>& scene) {
          const ErrorMeter<Dim> meter(scene, baseline.backend, options_.seeds);
          for (const BenchCase& each : group.cases) {
            if (!is_missing(each)) continue;
            const bool itself = key_of(each) == key_of(baseline);
            finished({key_at(each, task.pass, task.round), "",
                      itself ? meter.of_baseline() : meter.measure(std::get<Scene<Dim>>(load(each)))});
          }
        },
        load(baseline));
  } catch (const NonFiniteState& error) {
    failed(key_at(baseline, task.pass, task.round), error);
  }
}

void BenchRunner::failed(const RowKey& key, const std::exception& error) {
  spent_ += watch_.lap();
  ++done_;
  print_message("[{}/{}] {}: failed and left out: {}", done_, total_, text_of(key), error.what());
}

void BenchRunner::finished(const Row& row) {
  store_.add(row);
  spent_ += watch_.lap();
  ++done_;
  const double seconds = row.values["seconds"];
  print_message("[{}/{}] {}{}; about {} left", done_, total_, text_of(row.key),
                std::isnan(seconds) ? "" : fmt::format(": {:.3g} s", seconds),
                as_time(spent_ / done_ * (total_ - done_)));
}

Values BenchRunner::summary(const BenchCase& bench_case, const BenchCase& full, Pass pass) const {
  Values result;
  if (const Row* errors = store_.find(key_at(bench_case, pass, 0))) result = errors->values;
  std::vector<Values> rounds;
  for (const Row* row : store_.rounds(key_of(bench_case))) {
    Values values = row->values;
    if (const Row* other = store_.find(key_at(full, Pass::timing, row->key.round))) {
      values["speed_up"] = other->values["seconds"] / row->values["seconds"];
      values["speed_up_pour"] = other->values["pour_seconds"] / row->values["pour_seconds"];
      values["speed_up_last_100"] = other->values["last_100_ms"] / row->values["last_100_ms"];
    }
    rounds.push_back(values);
  }
  const auto over_rounds = [&](MeasureId id) {
    std::vector<double> numbers;
    for (const Values& values : rounds)
      if (std::isfinite(values[id])) numbers.push_back(values[id]);
    return numbers;
  };
  for (const MeasureId id : MeasureId::all()) {
    const std::vector<double> numbers = over_rounds(id);
    if (!numbers.empty()) result[id] = median(numbers);
  }
  for (const MeasureId id : std::initializer_list<MeasureId>{"seconds", "speed_up"}) {
    const std::vector<double> numbers = over_rounds(id);
    if (numbers.empty()) continue;
    result[id.with("_min")] = std::ranges::min(numbers);
    result[id.with("_max")] = std::ranges::max(numbers);
  }
  return result;
}

std::vector<std::string> BenchRunner::hashes(const BenchCase& bench_case) const {
  std::vector<std::string> all;
  for (const Row* row : store_.rounds(key_of(bench_case)))
    if (std::ranges::find(all, row->end_hash) == all.end()) all.push_back(row->end_hash);
  return all;
}

}  // namespace talus
