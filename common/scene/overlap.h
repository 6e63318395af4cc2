#pragma once
// Whether bodies at given places overlap.

#include <array>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "common/shape/convex_piece.h"
#include "common/world/world_description.h"

namespace talus {

/// Depth [m] up to which bodies may overlap at the start, in the units of the engine: Box2D's slop (b2_linearSlop), to
/// which it lets contacts sink in. From deeper overlap an engine throws bodies apart.
inline constexpr double most_overlap = 0.005;
inline double overlap_allowed(const UnitScale& units) { return most_overlap / units.lengths(); }

/// The deepest overlap of a body with what was there before it.
struct Overlap {
  double depth = 0.0;  // [m]
  std::string other;   // as messages name it: "obstacle[2]", "body 5 of body[1]"
};

/// Finds overlaps of bodies by their true shapes. Each body is compared with the bodies and obstacles near it.
template <int Dim>
class OverlapCheck {
 public:
  /// `world`: its ground and obstacles count, and bodies have its shapes. `absent`: by number, obstacles that are not
  /// there; empty: all are.
  explicit OverlapCheck(const WorldDescription<Dim>& world, std::span<const std::uint8_t> absent = {});

  /// Adds a body, the next one of the table of this path. Returns its deepest overlap; depth 0 if none is deeper than
  /// overlap_allowed(). What is fixed may overlap what is fixed.
  Overlap add(int shape, const Pose<Dim>& pose, bool fixed, const std::string& path);

 private:
  using Pieces = std::vector<ConvexPiece<Dim>>;
  using Cell = std::array<int, Dim>;
  struct CellHash {
    std::size_t operator()(const Cell& cell) const;
  };
  /// A body or an obstacle.
  struct Solid {
    int pieces = 0;  // index of shapes_; of an obstacle of obstacles_
    Pose<Dim> pose;
    Box<Dim> bounds;
    bool fixed = false;
    int name = 0;     // index of names_
    int number = -1;  // among the bodies of this name; -1: an obstacle
    int next = -1;    // solid in its cell; -1: the last
  };
  /// The solids with their position in one cell.
  struct Chain {
    int first = -1;
    int last = -1;
  };

  /// Solids of like width, all fixed or none: small ones near a large one are not compared with one another.
  struct Level {
    double width = 0.0;  // of a cell: no solid is wider [m]
    bool fixed = false;
    std::vector<int> solids;
    std::unordered_map<Cell, Chain, CellHash> cells;  // only looked up
  };

  /// A body that is added, with its pieces at its pose once they are needed.
  struct Added {
    Solid body;
    Pieces pieces;
    Overlap deepest;
  };

  /// At the solid's pose; `room` holds them where they are not kept.
  std::span<const ConvexPiece<Dim>> pieces_of(const Solid& solid, Pieces& room) const;
  void compare(Added& added, const Solid& other) const;
  std::string name_of(const Solid& solid) const;
  void compare_near(Added& added, const Level& level) const;
  void keep(const Solid& solid, double width);

  const WorldDescription<Dim>& world_;
  double allowed_;                 // [m]
  std::vector<Pieces> shapes_;     // of the world, in their own axes
  std::vector<Pieces> obstacles_;  // at their poses
  std::vector<Solid> solids_;
  std::vector<std::string> names_;
  std::vector<Level> levels_;
};

}  // namespace talus
