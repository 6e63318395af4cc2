// Slope control on every engine.

#include <filesystem>
#include <numbers>

#include "common/pile/angle_of_repose.h"
#include "common/scene/read_scene.h"
#include "common/simulation/simulation.h"
#include "tests/backends/backend.h"

namespace talus::slope_control_test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

template <typename Backend>
class SlopeControl : public ::testing::Test {
 protected:
  static constexpr int dimension = Backend::dim;

  static Scene<dimension> scene(int bodies, int seed, double alpha) {
    const std::string file = dimension == 2 ? "steep_pile_2d.toml" : "steep_pile_3d.toml";
    auto scene = std::get<Scene<dimension>>(read_scene(std::filesystem::path(TALUS_SOURCE_DIR) / "scenes" / file));
    scene.sources[0].count = bodies;
    scene.seed = static_cast<std::uint64_t>(seed);
    scene.piles[0].alpha = alpha;
    return scene;
  }

  /// Slope [rad] of the cone or wedge with the heap's centre of mass and median radius, fifteen seconds after the pour.
  static double slope(const Scene<dimension>& scene) {
    auto simulation = simulation_on<Backend>(scene);
    while (!simulation.emitter().finished()) simulation.step();
    for (int i = 0; i < 900; ++i) simulation.step();
    const Pile<dimension>& pile = simulation.piles().piles().front();
    std::vector<Vec<dimension>> positions;
    for (const Pose<dimension>& pose : simulation.world().states().pose)
      if (pile.reaches(pose.position)) positions.push_back(pose.position - pile.centre);
    return estimate_angle_of_repose<dimension>(positions);
  }

  static double mean_slope(int bodies, int runs, double alpha, bool controlled = true) {
    double sum = 0.0;
    for (int seed = 1; seed <= runs; ++seed) {
      auto one = scene(bodies, seed, alpha);
      one.piles[0].control_slope = controlled;
      sum += slope(one);
    }
    return sum / runs;
  }
};
TYPED_TEST_SUITE(SlopeControl, SmallStepsBackends, BackendName);

// Slopes of small piles scatter by 4 degrees in 2D, so means of four by 2; the test allows three times that.
TYPED_TEST(SlopeControl, MakesAPileMuchSteeperThanItsBodiesTakeByThemselves) {
  const double setpoint = 55.0 * degree;
  const double controlled = this->mean_slope(150, 4, setpoint);
  EXPECT_NEAR(controlled, setpoint, 6.0 * degree);
  EXPECT_GT(controlled, this->mean_slope(150, 4, setpoint, false) + 8.0 * degree);
}

template <typename Backend>
class LongSlopeControl : public SlopeControl<Backend> {};
TYPED_TEST_SUITE(LongSlopeControl, SmallStepsBackends, BackendName);

// Slopes of these piles scatter by 2 to 3 degrees, so means of sixteen by 0.7.
TYPED_TEST(LongSlopeControl, IsWithinThreeDegreesOfTheSetpointOnAverage) {
  for (const double setpoint : {45.0, 50.0, 55.0})
    EXPECT_NEAR(this->mean_slope(400, 16, setpoint * degree) / degree, setpoint, 3.0);
}

// The difference of two means of eight scatters by 2 degrees.
TYPED_TEST(LongSlopeControl, DoesNotFlattenASteeperPile) {
  EXPECT_NEAR(this->mean_slope(150, 8, 20.0 * degree), this->mean_slope(150, 8, 20.0 * degree, false), 6.0 * degree);
}

}  // namespace
}  // namespace talus::slope_control_test
