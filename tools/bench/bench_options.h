#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace talus {

/// What `talus bench` was asked for. Empty lists: what the benchmark itself takes.
struct BenchOptions {
  std::vector<std::string> scenes;
  std::vector<std::string> backends;
  std::vector<std::string> policies;
  std::vector<std::string> settings;  // of every case
  std::filesystem::path out;          // folder of rows and report; empty: bench/NAME
  int rounds = 0;                     // timed runs of each case, 1..1000; 0: five, quick two
  int twins = 0;                      // runs a side for shapes, 1..100; 0: three, quick one
  double share = 1.0;                 // of a scene's frames, in (0, 1]; quick: half unless asked otherwise
  bool quick = false;
  bool reference = false;  // errors against the converged simulation too; one run of it costs about ten
  bool errors = true;      // without: times only
};

/// Fills in what was not asked for. Throws std::invalid_argument on values out of range.
BenchOptions completed(BenchOptions options, const std::string& name);

}  // namespace talus
