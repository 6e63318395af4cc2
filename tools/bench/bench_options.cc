#include "tools/bench/bench_options.h"

namespace talus {

BenchOptions completed(BenchOptions options, const std::string& name) {
  if (options.rounds == 0) options.rounds = options.quick ? 2 : 5;
  if (options.seeds == 0) options.seeds = options.quick ? 1 : 3;
  if (options.quick && options.share == 1.0) options.share = 0.5;
  if (options.out.empty()) options.out = std::filesystem::path("bench") / (options.quick ? name + "-quick" : name);
  return options;
}

}  // namespace talus
