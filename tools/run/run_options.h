#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/override.h"

namespace talus {

/// What is run.
struct SceneChoice {
  std::string scene;                  // file, or the name of a scene in scenes/
  std::string backend;                // empty: the dimension's first
  std::string policy;                 // empty: the scene's
  std::string accuracy;               // empty: the scene's
  std::vector<std::string> settings;  // path=value, applied to the scene file before it is checked
  std::optional<std::int64_t> seed;   // not given: the scene's
  bool force = false;                 // also outside of the engine's window, with warnings
};

/// The values that options put into the scene, so that they are checked and recorded like the file's own.
std::vector<Override> overrides_of(const SceneChoice& choice);

/// Options of `talus run`.
struct RunOptions : SceneChoice {
  std::optional<double> pace;           // simulated seconds per second; not given: the scene's
  std::optional<std::int64_t> threads;  // that share a step; not given: the scene's
  std::filesystem::path out;            // run folder; empty: a new one under runs/
  std::string lcm_url;                  // empty: LCM_DEFAULT_URL, else LCM's own default with ttl=0
  bool telemetry = true;                // live over LCM
  double telemetry_hz = 60.0;           // pile messages a second of wall time; 0: every step
  double bodies_hz = 30.0;              // pose messages a second of wall time; 0: none
  std::string against;                  // policy to time the run against; empty: none
  bool strict = false;                  // exit code 1 when a warning was given
  bool measure_drift = false;           // at the end wake all bodies and measure how far the sleeping ones move
  bool probe_drift = true;  // at the end estimate by a short simulation how far the sleeping bodies would move
  bool hash_only = false;   // print the end hash and nothing else; write no folder unless `out` is given
  bool quiet = false;       // print no warnings: the caller has them
};

}  // namespace talus
