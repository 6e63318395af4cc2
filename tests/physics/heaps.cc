// Heaps and packings against measured laws of granular matter.

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "common/math/angle.h"
#include "common/math/random.h"
#include "common/measure/shape_statistics.h"
#include "tests/physics/stage.h"

namespace talus {
namespace {

/// Balls rain into a box without friction at its walls; the share of the inner space that they fill.
struct Packing3 {
  double friction = 0.0;
  std::vector<double> operator()(const PhysicsCell& cell) const {
    constexpr double half = 3.5;  // of the box's inner width, in diameters [m]
    constexpr int balls = 600;
    const Material material{.friction = friction};
    Stage<3> stage(cell, material);
    stage.rate(120.0);
    for (const double side : {-1.0, 1.0}) {
      stage.fixed_box(Vec3(1.0, 10.0, 60.0), Vec3(side * (half + 0.5), 0.0, 30.0), 0.0, material);
      stage.fixed_box(Vec3(10.0, 1.0, 60.0), Vec3(0.0, side * (half + 0.5), 30.0), 0.0, material);
    }
    const int ball = stage.ball(0.5, material);
    std::mt19937_64 random(1);
    for (int i = 0; i < balls; ++i) {
      const int layer = i / 25;
      const Vec3 lattice(1.3 * (i % 5 - 2), 1.3 * (i / 5 % 5 - 2), 0.7 + 1.2 * layer);
      stage.body(ball, lattice + uniform_within<3>(Vec3(0.1, 0.1, 0.05), random));
    }
    StageRun<3> run = stage.run();
    run.until(20.0);
    return {inner_share(run, half), run.penetration()};
  }

  /// Solid share by a lattice of sample points 1.5 diameters from walls, floor and surface.
  static double inner_share(const StageRun<3>& run, double half) {
    const double reach = half - 1.5;
    double top = 0.0;
    for (BodyIndex i = 0; i < run.states().size(); ++i) top = std::max(top, run.at(i)[2]);
    int inside = 0;
    int points = 0;
    for (double x = -reach; x <= reach; x += 0.1)
      for (double y = -reach; y <= reach; y += 0.1)
        for (double z = 1.5; z <= top - 2.5; z += 0.1) {
          ++points;
          inside += covered(run, Vec3(x, y, z)) ? 1 : 0;
        }
    return points == 0 ? std::nan("") : static_cast<double>(inside) / points;
  }
  static bool covered(const StageRun<3>& run, const Vec3& point) {
    for (BodyIndex i = 0; i < run.states().size(); ++i)
      if ((run.at(i) - point).squaredNorm() < 0.25) return true;
    return false;
  }
};

/// Slope of a heap of L shapes or boxes poured with a friction [degrees].
template <int Dim>
double slope_of_heap(const PhysicsCell& cell, double friction, std::uint64_t seed) {
  const Material material{.friction = friction};
  Stage<Dim> stage(cell, material);
  stage.scene.seed = seed;
  stage.box(1.0, 0.5, 0.5, material);
  stage.scene.sources = {{.count = 150,
                          .rate = 6.0,
                          .position = place<Dim>(0.0, 14.0),
                          .spread = place<Dim>(0.5, 0.0),
                          .velocity = place<Dim>(0.0, -8.0)}};
  StageRun<Dim> run = stage.run();
  run.until(35.0);
  const auto bodies = placed_bodies<Dim>(run.world().shapes(), run.states());
  const double extent = run.world().shape_of(0).extent;
  const ProfileGrid<Dim> grid = grid_around<Dim>(bodies, 0.0, extent);
  return in_degrees(shape_statistics<Dim>(bodies, grid).repose.angle);
}

/// Mean slope of eight heaps [degrees].
template <int Dim>
double mean_slope(const PhysicsCell& cell, double friction) {
  constexpr int seeds = 8;
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) sum += slope_of_heap<Dim>(cell, friction, seed);
  return sum / seeds;
}

/// The slope at three frictions: rises from the first to the second and from the second to the third.
struct Repose {
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    const double low = mean_slope<Dim>(cell, 0.2);
    const double middle = mean_slope<Dim>(cell, 0.5);
    const double high = mean_slope<Dim>(cell, 0.9);
    return {middle - low, high - middle};
  }
};

constexpr std::string_view repose_rises = "the angle of repose rises with friction (Zhou et al. 2001)";
constexpr std::string_view repose_saturates =
    "boxes topple before they slide, so more friction changes little; as measured, three times the scatter of eight "
    "heaps";

}  // namespace

std::vector<PhysicsCase> heap_cases() {
  std::vector<PhysicsCase> cases;
  for (const bool smooth : {true, false}) {
    const double friction = smooth ? 0.0 : 1.0;
    PhysicsCase packing{.group = "heaps",
                        .name = fmt::format("packing-{:g}", friction),
                        .setup = fmt::format("600 balls of 1 m fall into a box of 7 m, friction {:g}", friction),
                        .gates = {{"solid share inside", "", smooth ? 0.635 : 0.58, smooth ? 0.02 : 0.035,
                                   smooth ? "random close packing of equal spheres, 0.63 to 0.65"
                                          : "between random loose packing, 0.55 less the scatter of a sample, 0.005, "
                                            "and close packing"},
                                  {"deepest overlap", "m", 0.0, 0.05, "rigid bodies; a twentieth of a diameter"}},
                        .slow = true};
    packing.in_space = Packing3{friction};
    cases.push_back(std::move(packing));
  }
  cases.push_back(measured({.group = "heaps",
                            .name = "repose",
                            .setup = "heaps of 150 boxes poured at friction 0.2, 0.5 and 0.9, eight seeds each",
                            .gates = {{"slope at 0.5 less that at 0.2", "degrees", 15.0, 15.0, repose_rises},
                                      {"slope at 0.9 less that at 0.5", "degrees", 0.0, 6.5, repose_saturates}},
                            .policies = every_policy,
                            .slow = true},
                           Repose{}));
  return cases;
}

}  // namespace talus
