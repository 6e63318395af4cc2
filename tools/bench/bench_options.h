#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace talus {

/// Options of `talus bench`. Empty lists: the benchmark's own choice.
struct BenchOptions {
  /// Of the benchmark, as in `talus bench NAME`.
  std::string name;
  std::vector<std::string> scenes;
  std::vector<std::string> backends;
  std::vector<std::string> policies;
  /// path=value, for every case.
  std::vector<std::string> settings;
  /// Folder of rows and report; empty: bench/NAME.
  std::filesystem::path out;
  /// Folder for NAME.md and its figures, to be included in manuals; empty: not written.
  std::filesystem::path docs;
  /// Timed runs of each case, 1..1000; 0: five, quick two.
  int rounds = 0;
  /// Independent seeds of each case for shapes, distributions and drift, 1..100; 0: three, quick one.
  int seeds = 0;
  /// Share of a scene's frames to run, in (0, 1]; quick: half unless given.
  double share = 1.0;
  bool quick = false;
  /// Errors against the converged simulation too; one run of it costs about ten full runs.
  bool reference = false;
  /// False: times only.
  bool errors = true;
};

/// Fills in the defaults.
BenchOptions completed(BenchOptions options, const std::string& name);

/// The command that measures the same again, with all that differs from a plain `talus bench NAME`, rounds and seeds;
/// folders are left out.
std::string command_of(const BenchOptions& options);

}  // namespace talus
