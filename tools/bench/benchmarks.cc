#include "tools/bench/benchmarks.h"

#include <array>

namespace talus {

std::span<const Benchmark> benchmarks() {
  static const std::array all = {
      Benchmark{"table1", "The paper's Table 1 with its own figures beside ours: scenes 1 to 6", bench_table1},
      Benchmark{"table2", "The paper's Table 2: sleeping threshold tau in example 2", bench_table2},
      Benchmark{"figures", "The paper's Figures 5 and 6: time and error per frame", bench_figures},
      Benchmark{"pareto", "Time against error over policies and their parameters", bench_pareto},
      Benchmark{"engines", "The same scenes in 2D on every engine, over ensembles", bench_engines},
      Benchmark{"convergence", "The full simulation over time step, iterations and friction directions",
                bench_convergence},
      Benchmark{"skips", "What a step leaves out, put back in turn: time, and whether the bits stay", bench_skips},
      Benchmark{"rest", "How soon all sleep once the last body has stopped, and what a step costs then", bench_rest},
      Benchmark{"rate", "Speed-up over the pouring rate", bench_rate},
      Benchmark{"scale", "What sleepers cost a step, freezing, thawing, memory, and the shock of waking", bench_scale}};
  return all;
}

}  // namespace talus
