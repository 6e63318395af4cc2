#include <gtest/gtest.h>

#include <numbers>

#include "common/scene/read_scene.h"

namespace talus::scene_parse_test {
namespace {

constexpr double tolerance = 1e-12;  // rounding only

Scene<2> flat(const std::string& rest) {
  const std::string start = "title = \"A scene\"\ndimension = 2\n[shape.L]\nkind = \"L\"\n";
  return std::get<Scene<2>>(parse_scene(start + rest, "flat"));
}

Scene<3> full(const std::string& rest) {
  const std::string start = "title = \"A scene\"\ndimension = 3\n[shape.L]\nkind = \"L\"\n";
  return std::get<Scene<3>>(parse_scene(start + rest, "full"));
}

TEST(SceneFile, LeavesTheStructsDefaultsAlone) {
  const Scene<3> scene = full("[[source]]\n");
  const Source<3> standard;
  EXPECT_EQ(scene.sources[0].position, standard.position);
  EXPECT_EQ(scene.sources[0].count, standard.count);
  EXPECT_FALSE(scene.sources[0].orientation.has_value());
  EXPECT_EQ(scene.world.dt, WorldDescription<3>().dt);
  EXPECT_EQ(scene.run.frames, RunParams().frames);
}

TEST(SceneFile, GivesAnglesInDegrees) {
  const Scene<2> scene = flat("[[source]]\nangle_deg = 90\n[[pile]]\nalpha_deg = 30\n");
  EXPECT_NEAR(scene.piles[0].alpha.value(), std::numbers::pi / 6.0, tolerance);
  EXPECT_NEAR((*scene.sources[0].orientation * Vec2(1, 0) - Vec2(0, 1)).norm(), 0.0, tolerance);
}

TEST(SceneFile, TurnsAboutAnAxisOfAnyLength) {
  const Scene<3> scene = full("[[source]]\naxis = [0, 0, 7]\nangle_deg = 90\n");
  EXPECT_NEAR((*scene.sources[0].orientation * Vec3(1, 0, 0) - Vec3(0, 1, 0)).norm(), 0.0, tolerance);
}

TEST(SceneFile, GivesTheStepByItsInverse) {
  EXPECT_EQ(flat("[[source]]\n[world]\nsteps_per_second = 240\n").world.dt, 1.0 / 240.0);
}

TEST(SceneFile, NumbersShapesByName) {
  const Scene<2> scene = flat(
      "[shape.ball]\nkind = \"ball\"\nradius = 0.5\n[[source]]\nshape = \"ball\"\n[[source]]\nshape = [\"ball\", "
      "\"L\"]\n"
      "[[source]]\n");
  ASSERT_EQ(scene.world.shapes.size(), 2u);
  EXPECT_EQ(scene.world.shapes[0].name, "L");
  EXPECT_EQ(scene.world.shapes[1].name, "ball");
  EXPECT_EQ(scene.sources[0].shapes, std::vector<int>({1}));
  EXPECT_EQ(scene.sources[1].shapes, std::vector<int>({1, 0}));
  EXPECT_EQ(scene.sources[2].shapes, std::vector<int>({0, 1}));
}

TEST(SceneFile, LetsTheEngineSleepOnlyIfItsPolicyIsTheEngines) {
  EXPECT_TRUE(flat("[[source]]\n[policy]\nkind = \"engine\"\n").world.engine_sleep);
  EXPECT_FALSE(flat("[[source]]\n[policy]\nkind = \"full\"\n").world.engine_sleep);
  EXPECT_FALSE(flat("[[source]]\n").world.engine_sleep);
}

TEST(SceneFile, KnowsEveryKindOfShape) {
  const Scene<3> scene = full(
      "[shape.box]\nkind = \"box\"\nsize = [1, 2, 3]\n[shape.capsule]\nkind = \"capsule\"\nlength = 2\nradius = 0.5\n"
      "[shape.hull]\nkind = \"hull\"\ncorners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]\n[[source]]\n");
  EXPECT_NEAR(scene.world.shapes[0].volume, 0.4 * (0.4 + 0.24), tolerance);
  EXPECT_NEAR(scene.world.shapes[1].volume, 6.0, tolerance);
  EXPECT_NEAR(scene.world.shapes[2].volume, std::numbers::pi * (0.25 + 4.0 / 3.0 * 0.125), tolerance);
  EXPECT_NEAR(scene.world.shapes[3].volume, 1.0 / 6.0, tolerance);
}

TEST(SceneFile, KnowsShapesThatAreNotConvex) {
  const std::string polygon =
      "[shape.P]\nkind = \"polygon\"\ncorners = [[0, 0], [1, 0], [1, 0.4], [0.4, 0.4], [0.4, 1], [0, 1]]\n";
  const std::string ring =
      "[shape.R]\nkind = \"ring\"\nouter_radius = 0.5\ninner_radius = 0.3\nparts = 6\n[[source]]\n";
  const Scene<2> plane = flat(polygon + ring);
  EXPECT_NEAR(plane.world.shapes[1].volume, 0.64, tolerance);
  EXPECT_EQ(plane.world.shapes[1].pieces.size(), 2u);
  EXPECT_NEAR(plane.world.shapes[2].volume, 3.0 * std::sin(std::numbers::pi / 3.0) * (0.25 - 0.09), tolerance);
  const Scene<3> space = full(polygon + "depth = 0.5\n" + ring);
  EXPECT_NEAR(space.world.shapes[1].volume, 0.32, tolerance);
  EXPECT_EQ(space.world.shapes[2].pieces.size(), 6u);
}

TEST(Obstacle, IsPlacedByTheOriginOfItsOwnAxes) {
  const Scene<2> scene = flat(
      "[[obstacle]]\nkind = \"hull\"\ncorners = [[3, 0], [5, 0], [3, 1]]\n[[source]]\n"
      "[[obstacle]]\nkind = \"L\"\nposition = [2, 3]\nangle_deg = 90\n");
  const auto bounds = [](const Obstacle<2>& obstacle) { return bounds_at(obstacle.shape, obstacle.pose); };
  EXPECT_TRUE(bounds(scene.world.obstacles[0]).isApprox(Box<2>(Vec2(3, 0), Vec2(5, 1)), tolerance));
  // An L from its corner (2, 3), turned: along x to the left, along z upwards.
  EXPECT_TRUE(bounds(scene.world.obstacles[1]).isApprox(Box<2>(Vec2(1, 3), Vec2(2, 4)), tolerance));
}

// Bounds of all obstacles and the sum of their volumes.
template <int Dim>
std::pair<Box<Dim>, double> outline(const Scene<Dim>& scene) {
  Box<Dim> all;
  double volume = 0.0;
  for (const Obstacle<Dim>& wall : scene.world.obstacles) {
    all.extend(bounds_at(wall.shape, wall.pose));
    volume += wall.shape.volume;
  }
  return {all, volume};
}

TEST(Container, HasWallsAroundItsInside) {
  const auto [box, area] = outline(
      flat("[[obstacle]]\nkind = \"container\"\nposition = [1, 0]\ninner_size = [4, 3]\nwall = 0.5\n[[source]]\n"));
  EXPECT_TRUE(box.isApprox(Box<2>(Vec2(-1.5, 0), Vec2(3.5, 3)), tolerance));
  EXPECT_NEAR(area, 2.0 * 0.5 * 3.0, tolerance);
}

TEST(Container, IsClosedAtItsEdges) {
  const std::string text = "[[obstacle]]\nkind = \"container\"\ninner_size = [4, 2, 3]\nwall = 0.5\nfloor = true\n";
  const auto [box, volume] = outline(full(text + "[[source]]\n"));
  EXPECT_TRUE(box.isApprox(Box<3>(Vec3(-2.5, -1.5, -0.5), Vec3(2.5, 1.5, 3.0)), tolerance));
  // All of the outer box that is not inside: with edges doubled or missing it would be more or less.
  EXPECT_NEAR(volume, 5.0 * 3.0 * 3.5 - 4.0 * 2.0 * 3.0, tolerance);
}

TEST(Container, CanBeTilted) {
  const auto [box, area] = outline(
      flat("[[obstacle]]\nkind = \"container\"\nangle_deg = 90\ninner_size = [4, 3]\nwall = 0.5\n[[source]]\n"));
  EXPECT_TRUE(box.isApprox(Box<2>(Vec2(-3, -2.5), Vec2(0, 2.5)), tolerance));
}

TEST(Container, CanBeRoundOrAnyConvexPolygon) {
  const auto [round, round_volume] =
      outline(full("[[obstacle]]\nkind = \"container\"\nradius = 2\nheight = 3\nwall = 0.5\n[[source]]\n"));
  // The walls touch the circle with their inner faces, so two of them lie across each axis.
  const double sides = 32.0 * std::tan(std::numbers::pi / 32.0);
  EXPECT_NEAR(round_volume, 3.0 * sides * (2.5 * 2.5 - 2.0 * 2.0), 1e-9);
  EXPECT_GE(round.max().x(), 2.5);
  EXPECT_LT(round.max().x(), 2.5 / std::cos(std::numbers::pi / 32.0) + 1e-9);
  const auto [triangle, volume] =
      outline(full("[[obstacle]]\nkind = \"container\"\ncorners = [[3, 0], [0, 4], [0, 0]]\nheight = 2\nwall = "
                   "1\nfloor = true\n[[source]]\n"));
  // A triangle of sides 3, 4, 5 has the inscribed circle of radius 1; its walls widen that to radius 2, area 6 to 24.
  EXPECT_NEAR(volume, 2.0 * (24.0 - 6.0) + 24.0, 1e-9);
  EXPECT_NEAR(triangle.min().z(), -1.0, tolerance);
}

TEST(PileInWalls, AreBuiltWhereTheyHaveAThickness) {
  const std::string pile =
      "[[source]]\n[[pile]]\nalpha_deg = 30\nat = [1, 2, 0]\n[pile.boundary]\nrim = 3\nwall = 0.5\n";
  const auto [box, volume] = outline(full(pile + "kind = \"box\"\nsize = [4, 6]\n"));
  EXPECT_TRUE(box.isApprox(Box<3>(Vec3(-1.5, -1.5, 0), Vec3(3.5, 5.5, 3)), tolerance));
  EXPECT_NEAR(volume, 3.0 * (5.0 * 7.0 - 4.0 * 6.0), tolerance);
  const Scene<3> convex =
      full(pile + "kind = \"convex\"\ncorners = [[-1, -1], [-1, 1], [2, 1], [2, -1]]\nfloor = true\n");
  EXPECT_EQ(convex.world.obstacles.size(), 5u);
  EXPECT_NEAR(convex.piles[0].boundary->area(), 6.0, 1e-8);
  EXPECT_NEAR(convex.piles[0].boundary->inner_radius(), 1.0, tolerance);
  EXPECT_EQ(full(pile + "kind = \"cylinder\"\nradius = 1.5\n").world.obstacles.size(), 32u);
}

TEST(PileInWalls, HasThemAroundItsMiddle) {
  const Scene<3> scene = full(
      "[[source]]\n[[pile]]\nalpha_deg = 30\nat = [1, 2, 0]\n[pile.boundary]\nkind = \"box\"\nsize = [4, 6]\nrim = 3\n"
      "[[pile]]\nalpha_deg = 30\nat = [9, 0, 0]\n[pile.boundary]\nkind = \"cylinder\"\nradius = 2\nrim = 1\n");
  EXPECT_NEAR(scene.piles[0].boundary->area(), 24.0, tolerance);
  EXPECT_EQ(scene.piles[0].boundary->rim, 3.0);
  EXPECT_NEAR(scene.piles[1].boundary->area(), 4.0 * std::numbers::pi, 1e-9);
}

TEST(Source, SpreadsByTheRadiusOfItsLargestBodyAlongAxesWithOneRow) {
  const std::string balls = "[shape.large]\nkind = \"ball\"\nradius = 1.5\n";
  EXPECT_EQ(full(balls + "[[source]]\n").sources[0].spread, Vec3(1.5, 1.5, 0));
  EXPECT_EQ(full(balls + "[[source]]\ngrid = [3, 1, 1]\nspacing = [9, 0, 0]\n").sources[0].spread, Vec3(0, 1.5, 0));
  EXPECT_EQ(full(balls + "[[source]]\nspread = [0, 0, 0]\n").sources[0].spread, Vec3::Zero());
}

std::string error_of(const std::string& text) {
  try {
    parse_scene(text, "scene");
  } catch (const SceneErrors& errors) {
    return errors.what();
  }
  return "no error";
}

// The step of the accuracy lets bodies be faster than that of 1/60 s.
TEST(SceneLimits, AreThoseOfTheStepThatTheAccuracyChooses) {
  const std::string fast =
      "title = \"Fast\"\ndimension = 2\nground.present = false\nshape.disc = {kind = \"ball\", radius = 0.5}\n"
      "source = [{position = [0, 5], velocity = [0, -130]}]\n"
      "event = [{time = 1, do = \"kick\", velocity = [130, 0]}]\n"
      "obstacle = [{kind = \"box\", size = [1, 1], position = [50, 0], motion = {kind = \"belt\", surface_velocity = "
      "[130, 0]}}]\n";
  EXPECT_EQ(error_of(fast + "world.steps_per_second = 240\nrun.frame_rate = 30\n"), "no error");
  const std::string error = error_of(fast + "world.steps_per_second = 60\n");
  for (const char* field : {"source[0].velocity", "event[0].velocity", "obstacle[0].motion"})
    EXPECT_NE(error.find(field), std::string::npos) << error;
}

// The smallest bodies of a scene decide how much larger the engine has it: how far bodies may be follows from them.
TEST(SceneLimits, AreThoseOfTheUnitsThatTheSmallestBodyNeeds) {
  const std::string text =
      "title = \"Small\"\ndimension = 3\nground.present = false\nshape.ball = {kind = \"ball\", radius = 0.06}\n"
      "source = [{position = [0, 0, 2000], scale = {factors = [0.5]}}]\n"
      "obstacle = [{kind = \"box\", size = [1, 1, 1], position = [3000, 0, 0]}]\n";
  const std::string error = error_of(text);
  EXPECT_NE(error.find("scene:5:23: source[0].position"), std::string::npos) << error;
  EXPECT_NE(error.find("scene:6:"), std::string::npos) << error;
}

TEST(SceneShapes, HaveNamesWithoutTheMarksOfSizesAndVariants) {
  for (const char* name : {"h*b", "disc#2"})
    EXPECT_NE(error_of(std::string("title = \"Names\"\ndimension = 2\nbody = [{position = [0, 5]}]\nshape.\"") + name +
                       "\" = {kind = \"ball\", radius = 0.5}\n")
                  .find("NAME must have neither * nor #"),
              std::string::npos)
        << name;
}

TEST(SceneSeed, CountsBeyond32Bits) {
  const auto stone = [](const char* seed) {
    return std::get<Scene<2>>(
               parse_scene("title = \"Stone\"\ndimension = 2\nshape.stone = {kind = \"stone\", size = 1}\n"
                           "body = [{position = [0, 5]}]\nseed = " +
                               std::string(seed) + "\n",
                           "scene"))
        .world.shapes.front()
        .mass;
  };
  EXPECT_NE(stone("1"), stone("4294967297"));
  EXPECT_EQ(stone("1"), stone("1"));
}

}  // namespace
}  // namespace talus::scene_parse_test
