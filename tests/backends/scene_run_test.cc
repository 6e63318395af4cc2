// The scenes of this project, their first second and more, on every engine that fits.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/measure/shape_statistics.h"
#include "common/scene/read_scene.h"
#include "common/scene/typical_body.h"
#include "common/simulation/simulation.h"
#include "tests/backends/backend.h"

namespace talus::scene_run_test {
namespace {

namespace fs = std::filesystem;

const fs::path scene_folder = fs::path(TALUS_SOURCE_DIR) / "scenes";

template <typename Backend>
class SceneRun : public ::testing::Test {
 protected:
  static constexpr int dimension = Backend::dim;

  static std::string ending() { return dimension == 2 ? "_2d.toml" : "_3d.toml"; }
};

TYPED_TEST_SUITE(SceneRun, SmallStepsBackends, BackendName);

TYPED_TEST(SceneRun, DropsWhatIsDueAndKeepsItAboveTheGround) {
  constexpr int dim = TypeParam::dim;
  int count = 0;
  for (const auto& entry : fs::directory_iterator(scene_folder)) {
    if (!entry.path().string().ends_with(TestFixture::ending())) continue;
    SCOPED_TRACE(entry.path());
    const auto scene = std::get<Scene<dim>>(read_scene(entry.path()));
    auto simulation = simulation_on<TypeParam>(scene);
    while (simulation.time() < 70.0 / 60.0) simulation.step();
    double due = 0.0;
    for (const Source<dim>& source : scene.sources)
      if (source.start == 0.0) due += std::min<double>(source.count, 1.0 * source.rate);
    EXPECT_GE(simulation.emitter().emitted(), due) << "within a second, as its sources promise";
    for (const Pose<dim>& pose : simulation.world().states().pose) {
      // Nothing may be inside the ground by more than a step's fall of the fastest.
      EXPECT_GT(height<dim>(pose.position), -0.3);
    }
    ++count;
  }
  EXPECT_GE(count, 11);
}

// Section 3.2: a pile of which only the kind is known lies where the first body touches down.
TYPED_TEST(SceneRun, APileWithoutAPlaceBeginsWhereTheFirstBodyTouchesDown) {
  constexpr int dim = TypeParam::dim;
  const std::string name = dim == 2 ? "drop_in_a_pile_2d.toml" : "drop_in_a_pile_3d.toml";
  auto scene = std::get<Scene<dim>>(read_scene(scene_folder / name));
  scene.piles = {PileParams<dim>{}};
  scene.sources.resize(1);
  scene.sources[0].position[0] = 3.0;
  auto simulation = simulation_on<TypeParam>(scene);
  while (simulation.piles().piles().empty() && simulation.frame().step < 600) simulation.step();
  ASSERT_EQ(simulation.piles().piles().size(), 1U);
  const Vec<dim>& centre = simulation.piles().piles().front().centre;
  const double extent = typical_body(scene).extent;
  EXPECT_NEAR(centre[0], 3.0, 0.5 * extent) << "the contact lies on the body that fell";
  EXPECT_NEAR(height<dim>(centre), scene.world.ground.height, 0.01 * extent);
}

// A pile whose slope is not given tells it: that of the cone or wedge with the heap's centre of mass and median radius.
// The last tenth of the bodies may have come after the last measurement, the heap may have slid since, and what rolled
// far away belongs to no pile.
TYPED_TEST(SceneRun, APileWithoutASlopeFindsItsOwn) {
  constexpr int dim = TypeParam::dim;
  const std::vector<Override> few = {{"source[0].count=150"}};
  auto scene = std::get<Scene<dim>>(read_scene(scene_folder / ("drop_in_a_pile" + TestFixture::ending()), few));
  scene.piles[0].alpha.reset();
  auto simulation = simulation_on<TypeParam>(scene);
  while (!simulation.emitter().finished()) simulation.step();
  for (int i = 0; i < 300; ++i) simulation.step();
  const std::vector<PlacedBody<dim>> bodies = placed_bodies<dim>(scene.world.shapes, simulation.world().states());
  const ProfileGrid<dim> grid = grid_around<dim>(bodies, scene.world.ground.height, typical_body(scene).extent);
  const ShapeStatistics<dim> shape = shape_statistics<dim>(bodies, grid);
  const double apex = (dim == 3 ? 4.0 : 3.0) * shape.centre_height;
  const double foot = shape.r50 / (dim == 3 ? 0.5 : 1.0 - std::sqrt(0.5));
  // The slope is measured while the pile grows; afterwards the pile settles.
  EXPECT_NEAR(simulation.piles().piles().front().alpha, std::atan2(apex, foot), 0.15);
}

// 50 rings do not fill the box: not one of them may get through its walls or its floor, or over its rim.
TYPED_TEST(SceneRun, KeepsRingsInTheirBox) {
  constexpr int dim = TypeParam::dim;
  const std::vector<Override> few = {{"source[0].count=25"}, {"source[1].count=25"}};
  const fs::path file = scene_folder / ("rings_in_a_box" + TestFixture::ending());
  const auto scene = std::get<Scene<dim>>(read_scene(file, few));
  const Boundary<dim>& box = *scene.piles.at(0).boundary;
  auto simulation = simulation_on<TypeParam>(scene);
  while (simulation.time() < 400.0 / 60.0) simulation.step();
  const BodyStates<dim>& states = simulation.world().states();
  ASSERT_EQ(states.size(), 50);
  for (std::size_t i = 0; i < states.pose.size(); ++i) {
    const Box<dim> bounds = bounds_at(scene.world.shapes[0], states.pose[i]);
    // Contacts may be pressed in by the engines' slop and half a step of the pour's 14 m/s.
    EXPECT_GT(height<dim>(bounds.min()), -0.12) << "body " << i;
    EXPECT_LT(height<dim>(bounds.max()), box.rim) << "body " << i;
    EXPECT_LT(box.gauge(horizontal<dim>(states.pose[i].position)), 1.0) << "body " << i;
  }
}

// Walls and floor that [pile.boundary] builds are closed: there is no ground to catch what gets through.
TYPED_TEST(SceneRun, KeepsBallsInWallsBuiltAroundAPile) {
  constexpr int dim = TypeParam::dim;
  const bool flat = dim == 2;
  const std::string text = fmt::format(
      "title = \"Balls in walls\"\ndimension = {}\nground = {{present = false}}\nshape.ball = {{kind = \"ball\", "
      "radius = 0.3}}\n"
      "[[source]]\ncount = 30\nrate = 6\nposition = {}\nvelocity = {}\n[[pile]]\nalpha_deg = 30\nat = {}\n"
      "[pile.boundary]\n{}\nrim = 3\nwall = 0.5\nfloor = true\n",
      dim, flat ? "[5, 6]" : "[5, 5, 6]", flat ? "[0.5, -8]" : "[0.5, 0.3, -8]", flat ? "[5, 2]" : "[5, 5, 2]",
      flat ? "kind = \"box\"\nsize = [6]" : "kind = \"cylinder\"\nradius = 1.5");
  const auto scene = std::get<Scene<dim>>(parse_scene(text, "text"));
  auto simulation = simulation_on<TypeParam>(scene);
  for (int i = 0; i < 480; ++i) simulation.step();
  const std::vector<Pose<dim>>& poses = simulation.world().states().pose;
  ASSERT_EQ(poses.size(), 30u);
  for (const Pose<dim>& pose : poses) {
    const Vec<dim> place = pose.position - *scene.piles[0].at;
    EXPECT_GT(height<dim>(place), 0.2);
    EXPECT_LT(scene.piles[0].boundary->gauge(horizontal<dim>(place)), 1.0);
  }
}

// What has just left a spout is slow for a tenth of a second, and so is what an impact has thrown up: a spout that took
// these for the pile would climb, here to a hundred metres.
TYPED_TEST(SceneRun, ASpoutDoesNotClimbOnWhatItHasJustDropped) {
  constexpr int dim = TypeParam::dim;
  const bool flat = dim == 2;
  const std::string text = fmt::format(
      "title = \"A spout that swings\"\ndimension = {}\nshape.box = {{kind = \"box\", size = {}}}\n[[source]]\n"
      "count = 60\nrate = 15\nposition = {}\nsweep = {}\nsweep_period = 2\nride_above = 1.5\n",
      dim, flat ? "[0.3, 0.3]" : "[0.3, 0.3, 0.3]", flat ? "[0, 1.5]" : "[0, 0, 1.5]", flat ? "[3, 0]" : "[3, 0, 0]");
  auto simulation = simulation_on<TypeParam>(std::get<Scene<dim>>(parse_scene(text, "text")));
  double highest = 0.0;
  while (!simulation.emitter().finished() && simulation.frame().step < 600) {
    simulation.step();
    for (const Pose<dim>& pose : simulation.world().states().pose)
      highest = std::max(highest, height<dim>(pose.position));
  }
  EXPECT_TRUE(simulation.emitter().finished());
  EXPECT_LT(highest, 1.5 + 2.5) << "where the spout turns, boxes heap up to one and a half metres";
}

// Bodies of a grid appear in one step, without touching.
TYPED_TEST(SceneRun, DropsAGridAtOnce) {
  constexpr int dim = TypeParam::dim;
  const fs::path file = scene_folder / ("bunny_matrices_45" + TestFixture::ending());
  const auto scene = std::get<Scene<dim>>(read_scene(file));
  auto simulation = simulation_on<TypeParam>(scene);
  const int grid = dim == 2 ? 100 : 108;
  const double period = grid / scene.sources[0].rate;
  simulation.step();
  EXPECT_EQ(simulation.emitter().emitted(), grid);
  while (simulation.time() < period - 0.01) simulation.step();
  EXPECT_EQ(simulation.emitter().emitted(), grid);
  while (simulation.time() < period + 0.04) simulation.step();
  EXPECT_EQ(simulation.emitter().emitted(), 2 * grid) << "the next grid, as many bodies later";
}

}  // namespace
}  // namespace talus::scene_run_test
