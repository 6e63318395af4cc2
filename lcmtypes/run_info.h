#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/scene/scene.h"

namespace talus {

/// Identity of a run, as in TALUS_RUN.
struct RunInfo {
  std::string scene;  // a short name, such as the scene file's without its ending
  std::string title = {};
  std::string backend;
  std::string policy;
  std::string version;
  std::uint64_t seed = 1;
  int dimension = 2;
  double dt = 1.0 / 60.0;                      // [s]
  std::int64_t steps = 0;                      // planned
  std::optional<double> tolerance = {};        // [D] of policy `adaptive`
  std::optional<double> score_threshold = {};  // of policy `paper`
  Vec3 gravity = Vec3(0.0, 0.0, -9.81);        // [m/s^2], y = 0 in 2D; at the start
  Ground ground = {};
  Periodic<3> sides = {};
  SolverParams solver = {};
};

/// The part of it that a scene gives.
template <int Dim>
RunInfo run_info(const Scene<Dim>& scene, const std::string& scene_name, const std::string& backend);

/// A number that the same run always gets, for its record.
std::int64_t record_id(const RunInfo& info);

/// A number that no other run gets, so that runs at the same time differ.
std::int64_t live_id(const RunInfo& info);

/// How people see a run's number: eight hexadecimal digits.
std::string short_id(std::int64_t run_id);

}  // namespace talus
