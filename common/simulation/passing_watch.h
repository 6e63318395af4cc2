#pragma once

#include <span>
#include <vector>

#include "common/shape/convex_piece.h"
#include "common/world/world.h"

namespace talus {

/// Finds bodies that get past another body or an obstacle within a step, where contacts of later steps show nothing or
/// push them on. Engines keep the middle of a piece outside of other bodies. So a pair is found where the path of a
/// piece's middle, seen from the other side of the pair, leads through a piece there or well into it.
///
/// Costs O(awake) a step, and a search of neighbours for each body that moves by more than half the smallest radius
/// about a middle: no pair of slower ones gets that far in a step.
template <int Dim>
class PassingWatch {
 public:
  struct Finding {
    BodyIndex body = 0;
    double way = 0.0;  // relative to the other one, within the step [m]
  };

  PassingWatch(std::span<const Shape<Dim>> shapes, std::span<const Obstacle<Dim>> obstacles);

  /// Just before World::step().
  void start_step(const World<Dim>& world);
  /// Just after it. Valid until the next call.
  std::span<const Finding> end_step(const World<Dim>& world);

 private:
  /// What is tested of a shape, in its own axes.
  struct Solid {
    struct Part {
      ConvexPiece<Dim> piece;
      Box<Dim> bounds;
    };
    std::vector<Part> pieces;
    std::vector<Vec<Dim>> middles;  // centres of the pieces that are not thinner than thickness()
    double reach = 0.0;             // from the origin to the farthest point [m]
    double width = 0.0;             // of its thinnest piece [m]
    double core = 0.0;              // radius about the middles that other bodies do not reach [m]
  };
  /// A body or an obstacle, as contacts number them, in this step.
  struct Mover {
    BodyIndex index = 0;
    const Solid* solid = nullptr;
    Pose<Dim> from;
    Pose<Dim> to;
  };
  static Solid solid_of(const Shape<Dim>& shape);
  static double turn(const Mover& mover);
  static Box<Dim> swept(const Mover& mover);
  static double way(const Mover& a, const Mover& b);
  static bool passes(const Mover& a, const Mover& b);
  static bool enters(const Vec<Dim>& from, const Vec<Dim>& to, const Solid& solid);
  Mover mover(const World<Dim>& world, BodyIndex index) const;
  static Mover image_near(const Periodic<Dim>& sides, Mover mover, const Vec<Dim>& place);
  /// Memory of one thread.
  struct Search {
    std::vector<BodyIndex> near;  // scratch
    std::vector<Finding> findings;
  };
  void test_all(const World<Dim>& world, double margin);
  void test_neighbours(const World<Dim>& world, const Mover& fast, double margin, Search& search) const;
  void test(const Mover& fast, const Mover& other, std::vector<Finding>& findings) const;

  std::vector<Solid> solids_;     // by shape
  std::vector<Solid> obstacles_;  // by number
  double smallest_core_ = 0.0;    // of the bodies [m]
  std::vector<Pose<Dim>> from_;   // by body: where awake ones were before the step
  std::vector<Pose<Dim>> obstacles_from_;
  std::vector<Mover> fast_;  // in this step
  std::vector<Search> searches_;
  std::vector<Finding> findings_;
};

}  // namespace talus
