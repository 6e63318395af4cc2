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
  static inline Watcher<dimension> watcher;  // outlives the simulations that poured() returns

  static Scene<dimension> shipped(const std::string& name, int seed) {
    const std::string file = name + (dimension == 2 ? "_2d.toml" : "_3d.toml");
    auto scene = std::get<Scene<dimension>>(read_scene(std::filesystem::path(TALUS_SOURCE_DIR) / "scenes" / file));
    scene.seed = static_cast<std::uint64_t>(seed);
    return scene;
  }

  static Scene<dimension> scene(int bodies, int seed, double alpha) {
    auto scene = shipped("steep_pile", seed);
    scene.sources[0].count = bodies;
    scene.piles[0].alpha = alpha;
    return scene;
  }

  static void run_on(Simulation<dimension>& simulation, double seconds) {
    const double end = simulation.time() + seconds;
    while (simulation.time() < end) simulation.step();
  }

  /// Fifteen seconds after the pour. May warn of energy: in one of fifty pours bodies that land in a column at 16 m/s
  /// rebound with a ninth of their kinetic energy, and the ledger tolerates a tenth.
  static Simulation<dimension> poured(const Scene<dimension>& scene) {
    auto simulation = simulation_on<Backend>(scene);
    simulation.add_observer(watcher);
    while (!simulation.emitter().finished()) simulation.step();
    run_on(simulation, 15.0);
    for (const Warning& warning : simulation.warnings())
      if (warning.kind != WarningKind::energy) ADD_FAILURE() << account(warning);
    return simulation;
  }

  /// Of the cone or wedge with the heap's centre of mass and median radius [rad].
  static double slope(const Simulation<dimension>& simulation) {
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
      sum += slope(poured(one));
    }
    return sum / runs;
  }

  /// The paper's figure 3: at the end, and again ten seconds after all bodies woke.
  static void expect_slope_of_bunnies(int degrees, int seed, double most_off) {
    SCOPED_TRACE(seed);
    auto simulation = poured(shipped("bunny_matrices_" + std::to_string(degrees), seed));
    EXPECT_NEAR(slope(simulation) / degree, degrees, most_off);
    simulation.thaw_all();
    run_on(simulation, 10.0);
    EXPECT_NEAR(slope(simulation) / degree, degrees, most_off) << "after all were woken";
  }
};
TYPED_TEST_SUITE(SlopeControl, SmallStepsBackends, BackendName);

// Slopes of small piles scatter by 1 degree, so means of four by half of one; the test allows three times that, and 1
// degree by which a pile under a spout may be too flat.
TYPED_TEST(SlopeControl, MakesAPileMuchSteeperThanItsBodiesTakeByThemselves) {
  const double setpoint = 55.0 * degree;
  const double controlled = this->mean_slope(150, 4, setpoint);
  EXPECT_NEAR(controlled, setpoint, 2.5 * degree);
  EXPECT_GT(controlled, this->mean_slope(150, 4, setpoint, false) + 8.0 * degree);
}

TYPED_TEST(SlopeControl, HoldsUnderEachPolicyThatDecides) {
  for (const char* policy : {"full", "paper"}) {
    auto one = this->scene(150, 1, 50.0 * degree);
    one.policy.kind = policy;
    EXPECT_NEAR(this->slope(this->poured(one)) / degree, 50.0, 4.0) << policy;
  }
}

TYPED_TEST(SlopeControl, MakesThePilesOfFigureThreeWhichStandOnceAllAreWoken) {
  this->expect_slope_of_bunnies(35, 1, 3.0);
  this->expect_slope_of_bunnies(45, 1, 3.0);
}

template <typename Backend>
class LongSlopeControl : public SlopeControl<Backend> {};
TYPED_TEST_SUITE(LongSlopeControl, SmallStepsBackends, BackendName);

// Slopes of these piles scatter by 1 degree, so means of sixteen by a quarter.
TYPED_TEST(LongSlopeControl, IsWithinThreeDegreesOfTheSetpointOnAverage) {
  for (const double setpoint : {45.0, 50.0, 55.0})
    EXPECT_NEAR(this->mean_slope(400, 16, setpoint * degree) / degree, setpoint, 3.0);
}

// The difference of two means of eight scatters by 2 degrees.
TYPED_TEST(LongSlopeControl, DoesNotFlattenASteeperPile) {
  EXPECT_NEAR(this->mean_slope(150, 8, 20.0 * degree), this->mean_slope(150, 8, 20.0 * degree, false), 6.0 * degree);
}

// In 3D, where bunnies stand at 38 degrees once something has stopped them, one of eight is 3.5 degrees too steep.
TYPED_TEST(LongSlopeControl, MakesThePilesOfFigureThreeOverSeeds) {
  for (const int seed : {2, 3, 4, 5, 6})
    for (const int degrees : {35, 45}) this->expect_slope_of_bunnies(degrees, seed, 4.0);
}

}  // namespace
}  // namespace talus::slope_control_test
