#pragma once
// Which runs a benchmark takes.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/bench/bench_run.h"
#include "tools/sweep/file_hashes.h"

namespace talus {

/// What `talus bench` is told.
struct BenchOptions {
  std::vector<std::string> scenes;    // files or names
  std::string preset;                 // empty: none
  std::vector<std::string> policies;  // empty: the preset's, else full, paper, adaptive and the reference
  std::vector<std::string> settings;  // as for `talus sweep`
  std::vector<std::string> backends;  // empty: the first of each dimension
  std::filesystem::path out;
  int seeds = 0;  // 0: three, quick two
  int jobs = 1;
  bool quick = false;
  bool force = false;
  BenchExtras extras;
  std::vector<FileHashes> files;  // of each scene in all its cases
};

/// A table or figure of the paper.
struct BenchPreset {
  std::string_view name;
  std::string_view about;
};
std::span<const BenchPreset> bench_presets();

/// The options with what the preset and --quick add. Throws std::invalid_argument without a scene.
BenchOptions completed(BenchOptions options);

/// The scenes' files, absolute. Throws std::invalid_argument where two have one name.
std::vector<std::filesystem::path> files_of(const BenchOptions& options);

/// All combinations of scene, engine, settings, policy and seed; those that share a seed side by side. Of `full`,
/// `engine` and `reference`, combinations that differ in settings of a policy alone are one. Throws
/// std::invalid_argument and SceneErrors where a run is not possible.
std::vector<BenchCase> bench_cases(const BenchOptions& options);

/// What BenchOptions::files must be for these cases.
std::vector<FileHashes> hashes_of(const BenchOptions& options, const std::vector<BenchCase>& cases);

/// Cases from `first` on that are compared with each other, and so are measured one after the other: those of a scene,
/// an engine and a seed.
struct BenchRound {
  int first = 0;
  int count = 0;
};
std::vector<BenchRound> rounds_of(const std::vector<BenchCase>& cases);

/// The paper's own numbers for a run: speed-up, and in Table 1 the error [%].
struct PapersNumbers {
  double speed_up = BenchNumbers::none;
  double error = BenchNumbers::none;
};

/// Nothing where the paper has no such run.
std::optional<PapersNumbers> papers_numbers(const BenchCase& bench_case, std::string_view preset);

}  // namespace talus
