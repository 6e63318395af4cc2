#include "tools/bench/bench_options.h"

#include "common/math/require.h"

namespace talus {

BenchOptions completed(BenchOptions options, const std::string& name) {
  require(options.rounds >= 0 && options.rounds <= 1000, "--rounds", options.rounds, "must be 1 to 1000");
  require(options.seeds >= 0 && options.seeds <= 100, "--seeds", options.seeds, "must be 1 to 100");
  require(options.share > 0.0 && options.share <= 1.0, "--share", options.share, "must be above 0 and at most 1");
  if (options.rounds == 0) options.rounds = options.quick ? 2 : 5;
  if (options.seeds == 0) options.seeds = options.quick ? 1 : 3;
  if (options.quick && options.share == 1.0) options.share = 0.5;
  if (options.out.empty()) options.out = std::filesystem::path("bench") / (options.quick ? name + "-quick" : name);
  return options;
}

}  // namespace talus
