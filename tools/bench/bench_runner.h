#pragma once
// Measures cases: in rounds, so that a ratio within a round holds on a machine that is busy now and then.

#include <exception>
#include <string>
#include <vector>

#include "common/simulation/stopwatch.h"
#include "tools/bench/bench_case.h"
#include "tools/bench/bench_options.h"
#include "tools/bench/row_store.h"

namespace talus {

/// Cases that are compared with one another: one scene and engine at one time step and solver setting. The first is
/// the full simulation.
struct BenchGroup {
  std::vector<BenchCase> cases;
};

class BenchRunner {
 public:
  /// `options` completed. Rows go to options.out / rows.csv; what stands there is not measured again.
  explicit BenchRunner(BenchOptions options);

  /// Measures all rows of the groups that are missing, and tells on standard error how far it is.
  void run(const std::vector<BenchGroup>& groups);

  const RowStore& rows() const { return store_; }
  const BenchOptions& options() const { return options_; }

  /// Numbers of a case: medians over the rounds of what was timed, ratios to `full` within each round as `speed_up`,
  /// `speed_up_min` and `speed_up_max`, and the measures of `which` ("errors" or "reference").
  Values summary(const BenchCase& bench_case, const BenchCase& full, const std::string& which = "errors") const;

  /// End hashes of all rounds, each once.
  std::vector<std::string> hashes(const BenchCase& bench_case) const;

 private:
  void time_rounds(const BenchGroup& group);
  void time_once(const BenchCase& bench_case, const std::string& round);
  void measure_errors(const BenchGroup& group, const std::string& which);
  bool missing(const BenchCase& bench_case, const std::string& round) const;
  void finished(const Row& row);
  void failed(const BenchCase& bench_case, const std::string& round, const std::exception& error);

  BenchOptions options_;
  RowStore store_;
  Stopwatch watch_;
  double spent_ = 0.0;  // on rows of this call [s]
  int done_ = 0;
  int total_ = 0;
};

}  // namespace talus
