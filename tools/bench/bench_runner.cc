#include "tools/bench/bench_runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/world/errors.h"
#include "tools/bench/error_meter.h"
#include "tools/bench/timed_run.h"

namespace talus {

namespace {

RowKey key_at(const BenchCase& bench_case, const std::string& round) {
  RowKey key = key_of(bench_case);
  key.round = round;
  return key;
}

std::string as_time(double seconds) {
  if (seconds < 90.0) return fmt::format("{:.0f} s", seconds);
  return fmt::format("{:.0f} min", seconds / 60.0);
}

/// Of an even number: between the two in the middle.
double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

/// Whether the case has such a row: what is measured against is timed once, and is told against the reference only.
bool wanted(const BenchCase& bench_case, const std::string& round) {
  return !is_yardstick(bench_case) || round == "1" || round == "reference";
}

}  // namespace

BenchRunner::BenchRunner(BenchOptions options) : options_(std::move(options)), store_(options_.out / "rows.csv") {}

bool BenchRunner::missing(const BenchCase& bench_case, const std::string& round) const {
  return wanted(bench_case, round) && store_.find(key_at(bench_case, round)) == nullptr;
}

void BenchRunner::run(const std::vector<BenchGroup>& groups) {
  std::vector<std::string> rounds;
  for (int round = 1; round <= options_.rounds; ++round) rounds.push_back(std::to_string(round));
  if (options_.errors) rounds.emplace_back("errors");
  if (options_.errors && options_.reference) rounds.emplace_back("reference");
  total_ = done_ = 0;
  for (const BenchGroup& group : groups) {
    for (const BenchCase& each : group.cases) {
      total_ += static_cast<int>(
          std::count_if(rounds.begin(), rounds.end(), [&](const std::string& round) { return missing(each, round); }));
    }
  }
  watch_.lap();
  for (const BenchGroup& group : groups) {
    time_rounds(group);
    if (options_.errors) measure_errors(group, "errors");
    if (options_.errors && options_.reference) measure_errors(group, "reference");
  }
}

void BenchRunner::time_rounds(const BenchGroup& group) {
  for (int round = 1; round <= options_.rounds; ++round) {
    for (const BenchCase& each : group.cases) {
      if (missing(each, std::to_string(round))) time_once(each, std::to_string(round));
    }
  }
}

void BenchRunner::time_once(const BenchCase& bench_case, const std::string& round) {
  try {
    const TimedRun run =
        std::visit([&](const auto& scene) { return timed_run(scene, bench_case.backend); }, load(bench_case));
    finished({key_at(bench_case, round), fmt::format("{:016x}", run.end_hash), run.values});
  } catch (const NonFiniteState& error) {
    failed(bench_case, round, error);
  }
}

void BenchRunner::measure_errors(const BenchGroup& group, const std::string& which) {
  const auto is_missing = [&](const BenchCase& each) { return missing(each, which); };
  if (std::none_of(group.cases.begin(), group.cases.end(), is_missing)) return;
  const BenchCase& full = group.cases.front();
  BenchCase baseline = full;
  if (which == "reference") baseline.policy = reference_policy;
  try {
    std::visit(
        [&]<int Dim>(const Scene<Dim>& scene) {
          const ErrorMeter<Dim> meter(scene, full.backend, options_.twins);
          for (const BenchCase& each : group.cases) {
            if (!is_missing(each)) continue;
            const bool itself = key_of(each) == key_of(baseline);
            finished({key_at(each, which), "",
                      itself ? meter.of_baseline() : meter.measure(std::get<Scene<Dim>>(load(each)))});
          }
        },
        load(baseline));
  } catch (const NonFiniteState& error) {
    failed(baseline, which, error);
  }
}

void BenchRunner::failed(const BenchCase& bench_case, const std::string& round, const std::exception& error) {
  spent_ += watch_.lap();
  ++done_;
  fmt::print(stderr, "[{}/{}] {} {} {}, {}: failed, left out: {}\n", done_, total_, bench_case.scene,
             bench_case.backend, bench_case.policy, round, error.what());
}

void BenchRunner::finished(const Row& row) {
  store_.add(row);
  spent_ += watch_.lap();
  ++done_;
  const RowKey& key = row.key;
  const double seconds = value_of(row.values, "seconds");
  fmt::print(stderr, "[{}/{}] {} {} {}{}{}, {}{}; about {} left\n", done_, total_, key.scene, key.backend, key.policy,
             key.settings.empty() ? "" : " ", key.settings,
             std::isnan(seconds) ? key.round : fmt::format("round {}: ", key.round),
             std::isnan(seconds) ? "" : fmt::format("{:.3g} s", seconds), as_time(spent_ / done_ * (total_ - done_)));
}

Values BenchRunner::summary(const BenchCase& bench_case, const BenchCase& full, const std::string& which) const {
  Values result;
  if (const Row* errors = store_.find(key_at(bench_case, which))) result = errors->values;
  std::map<std::string, std::vector<double>> by_name;
  for (const Row* row : store_.rounds(key_of(bench_case))) {
    for (const auto& [name, value] : row->values) by_name[name].push_back(value);
    const Row* other = store_.find(key_at(full, row->key.round));
    if (other == nullptr) continue;
    const auto ratio = [&](const std::string& name) {
      return value_of(other->values, name) / value_of(row->values, name);
    };
    by_name["speed_up"].push_back(ratio("seconds"));
    by_name["speed_up_pour"].push_back(ratio("pour_seconds"));
    by_name["speed_up_last_100"].push_back(ratio("last_100_ms"));
  }
  for (const auto& [name, values] : by_name) result[name] = median(values);
  for (const char* name : {"seconds", "speed_up"}) {
    if (!by_name.contains(name)) continue;
    const auto [low, high] = std::minmax_element(by_name[name].begin(), by_name[name].end());
    result[fmt::format("{}_min", name)] = *low;
    result[fmt::format("{}_max", name)] = *high;
  }
  return result;
}

std::vector<std::string> BenchRunner::hashes(const BenchCase& bench_case) const {
  std::vector<std::string> all;
  for (const Row* row : store_.rounds(key_of(bench_case))) {
    if (std::find(all.begin(), all.end(), row->end_hash) == all.end()) all.push_back(row->end_hash);
  }
  return all;
}

}  // namespace talus
