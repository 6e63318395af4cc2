#pragma once
// The benchmarks by name. Each measures the rows that are missing and writes its results.

#include <span>
#include <string>

#include "tools/bench/bench_options.h"

namespace talus {

/// The paper's Table 1: its examples, with the paper's own figures beside ours.
void bench_table1(const BenchOptions& options);
/// The paper's Table 2: example 2 over tau.
void bench_table2(const BenchOptions& options);
/// The paper's Figures 5 and 6: time and error per frame.
void bench_figures(const BenchOptions& options);
/// Time against error over policies and parameters.
void bench_pareto(const BenchOptions& options);
/// The same scenes in a plane on every engine, side by side.
void bench_engines(const BenchOptions& options);

/// Time step, iterations and friction directions of the full simulation: at which settings a pile stays the same.
void bench_convergence(const BenchOptions& options);

/// What a step leaves out: each debug option in turn, which puts the work back.
void bench_skips(const BenchOptions& options);

/// How soon all sleep after the last body has stopped, and what steps cost from then on.
void bench_rest(const BenchOptions& options);

/// Speed-up over the pouring rate.
void bench_rate(const BenchOptions& options);
/// What sleepers cost: steps, freezing and thawing, memory; and what waking does to a pile.
void bench_scale(const BenchOptions& options);

struct Benchmark {
  std::string name;
  std::string help;
  void (*run)(const BenchOptions& options);
};

std::span<const Benchmark> benchmarks();

}  // namespace talus
