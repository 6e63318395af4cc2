#pragma once
// The cells of `talus bench truth`: scenes that differ in friction, shape, pour, ground, gravity and dimension.

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// Where heights, radii and spill of a cell's bodies are measured.
struct TruthGeometry {
  /// Inclination of the plane through the origin that is the ground, downwards along x [rad]; 0: the scene's ground.
  double slope = 0.0;
  /// A body is spilled whose centre lies farther from the origin along a horizontal axis [m], or lower [m]: over the
  /// walls of a bin, out of a hopper, off the end of a slope.
  double inside_half_width = std::numeric_limits<double>::infinity();
  double inside_above = -std::numeric_limits<double>::infinity();

  /// Whether there is anything that bodies can leave.
  bool has_spill() const;
};

/// Time [s] in which a heap must have come to rest: 10 s at 9.81 m/s^2, in other gravity as long as takes the same
/// motion there.
double calm_time(double gravity);

/// A scene to be measured.
struct TruthCell {
  /// As in tables and for --cells: `2d-f0.2-L-r6.6-slope-g9.81`, or a scene's name.
  std::string name;
  int dimension = 2;
  double friction = 0.6;
  TruthGeometry geometry;
  /// The scene as TOML; empty: that of `file`, or where this is empty too the scene of this name that comes with talus.
  std::string text;
  /// A scene of the user's, which runs as long as its `[run]` frames take.
  std::filesystem::path file;
};

/// The factors with the names of their values, as in a cell's name.
struct TruthFactor {
  std::string_view name;
  std::vector<std::string_view> values;
};
const std::vector<TruthFactor>& truth_factors();

/// How many bodies a cell drops, and how many at 0.5 a second, where each takes two seconds of simulation.
struct TruthBodies {
  int most = 200;
  int slow = 60;
};

/// The cell with these values of truth_factors(), by number.
TruthCell truth_cell(const std::vector<int>& values, const TruthBodies& bodies);

/// The cell of this name; nothing where the name is not made of values of all factors in their order.
std::optional<TruthCell> truth_cell_named(std::string_view name, const TruthBodies& bodies);

/// The first `count` cells of the covering design of this seed (covering_design.h).
std::vector<TruthCell> truth_design(std::uint64_t seed, int count, const TruthBodies& bodies);

/// The scenes of `--scenes`: files, names of scenes that come with talus, and folders. Of a folder the `.toml` files
/// are taken in order of their names. Throws std::invalid_argument where there is none, or two have the same name.
std::vector<TruthCell> truth_scene_files(const std::vector<std::string>& given);

/// The scenes of the paper's Table 1 and the sizes of its video, in both dimensions.
std::vector<TruthCell> truth_scenes();

}  // namespace talus
