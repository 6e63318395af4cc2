#pragma once
// Measures cases in rounds: a ratio within a round holds on a machine whose load changes.

#include <exception>
#include <string>
#include <vector>

#include "common/simulation/stopwatch.h"
#include "tools/bench/bench_case.h"
#include "tools/bench/bench_options.h"
#include "tools/bench/row_store.h"

namespace talus {

class BenchRunner {
 public:
  /// `options` completed. Rows go to options.out / rows.jsonl; a row that is there is not measured again.
  explicit BenchRunner(BenchOptions options);

  /// Measures all rows of the groups that are missing; progress and the time left go to standard error.
  void run(const std::vector<BenchGroup>& groups);

  const BenchOptions& options() const { return options_; }

  /// Numbers of a case: medians over the rounds of the timings, speed-ups over `full` within each round with their
  /// range, and the measures of `pass`.
  Values summary(const BenchCase& bench_case, const BenchCase& full, Pass pass = Pass::against_full) const;

  /// End hashes of all rounds, each once.
  std::vector<std::string> hashes(const BenchCase& bench_case) const;

 private:
  struct Task {
    Pass pass;
    int round;  // 0 unless timing
  };
  std::vector<Task> tasks() const;
  bool missing(const BenchCase& bench_case, const Task& task) const;
  void time_once(const BenchCase& bench_case, const Task& task);
  void measure_errors(const BenchGroup& group, const Task& task);
  void finished(const Row& row);
  void failed(const RowKey& key, const std::exception& error);

  BenchOptions options_;
  RowStore store_;
  Stopwatch watch_;
  double spent_ = 0.0;  // on rows of this call [s]
  int done_ = 0;
  int total_ = 0;
};

}  // namespace talus
