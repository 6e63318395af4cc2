// Obstacles that move by plan, as the reader of scene files makes them.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/scene/read_scene.h"

namespace talus::scene_motion_test {
namespace {

std::string scene_text(const std::string& motion, int dimension = 2) {
  const bool flat = dimension == 2;
  return fmt::format(
      "title = \"Motion\"\ndimension = {}\nshape.ball = {{kind = \"ball\", radius = 0.5}}\nbody = [{{position = {}}}]\n"
      "[[obstacle]]\nkind = \"container\"\nposition = {}\ninner_size = {}\nmotion = {{{}}}\n",
      dimension, flat ? "[0, 9]" : "[0, 0, 9]", flat ? "[3, 1]" : "[3, 0, 1]", flat ? "[2, 2]" : "[2, 2, 2]", motion);
}

template <int Dim>
Mover<Dim> mover_of(const std::string& motion) {
  const auto scene = std::get<Scene<Dim>>(parse_scene(scene_text(motion, Dim), "text"));
  EXPECT_EQ(scene.movers.size(), 1U);
  return scene.movers.at(0);
}

/// The first error without its place; empty if there is none.
std::string error_of(const std::string& motion, int dimension = 2) {
  try {
    parse_scene(scene_text(motion, dimension), "text");
  } catch (const SceneErrors& errors) {
    return fmt::format("{}: {}", errors.errors().front().field, errors.errors().front().rule);
  }
  return "";
}

TEST(SceneMotion, OfAContainerMovesAllItsWalls) {
  const auto scene =
      std::get<Scene<2>>(parse_scene(scene_text("kind = \"path\", times = [1, 2], shifts = [[0, 0], [0, 5]]"), "text"));
  const Mover<2>& mover = scene.movers.at(0);
  EXPECT_EQ(mover.first, 0);
  EXPECT_EQ(mover.count, 2);
  const auto later = obstacles_at(scene.world.obstacles, scene.movers, 1.5);
  for (int k : {0, 1}) {
    EXPECT_TRUE(scene.world.obstacles[k].moves);
    EXPECT_LT((later[k].pose.position - scene.world.obstacles[k].pose.position - Vec2(0.0, 2.5)).norm(), 1e-12);
  }
}

TEST(SceneMotion, OnAPathStandsStillBeforeAndAfter) {
  const Motion<2> motion =
      mover_of<2>("kind = \"path\", times = [1, 2, 4], shifts = [[0, 0], [2, 0], [2, 6]], angles_deg = [0, 90, 0]")
          .motion;
  EXPECT_EQ(motion.shift_at(0.0), Vec2(0.0, 0.0));
  EXPECT_EQ(motion.shift_at(1.5), Vec2(1.0, 0.0));
  EXPECT_EQ(motion.shift_at(3.0), Vec2(2.0, 3.0));
  EXPECT_EQ(motion.shift_at(9.0), Vec2(2.0, 6.0));
  EXPECT_NEAR(motion.angle_at(2.0), std::numbers::pi / 2.0, 1e-12);
  EXPECT_TRUE(motion.moves_after(3.9));
  EXPECT_FALSE(motion.moves_after(4.0));
}

TEST(SceneMotion, OfASineBeginsAtItsStartAndStopsAtItsEnd) {
  const Motion<2> motion =
      mover_of<2>("kind = \"sine\", amplitude = [0.5, 0], frequency = 1, start = 2, end = 3.25").motion;
  EXPECT_EQ(motion.shift_at(1.0), Vec2(0.0, 0.0));
  EXPECT_NEAR(motion.shift_at(2.25)[0], 0.5, 1e-12);
  EXPECT_NEAR(motion.shift_at(2.75)[0], -0.5, 1e-12);
  EXPECT_NEAR(motion.shift_at(10.0)[0], 0.5, 1e-12);
}

TEST(SceneMotion, OfATurnIsAboutThePositionOfTheObstacle) {
  const Mover<3> mover = mover_of<3>("kind = \"turn\", speed_deg = 90, axis = [0, 0, 2]");
  const Pose<3> later = mover.pose_at(1.0, {Vec3(4.0, 0.0, 1.0)});
  EXPECT_LT((later.position - Vec3(3.0, 1.0, 1.0)).norm(), 1e-12);
}

TEST(SceneMotion, IsRefusedWhereItIsIncompleteOrTooFast) {
  EXPECT_EQ(error_of("kind = \"sin\""), "obstacle[0].motion.kind: must be one of sine, turn, path, belt");
  EXPECT_EQ(error_of("kind = \"sine\", amplitude = [1, 0]"), "obstacle[0].motion.frequency: must be given");
  EXPECT_EQ(error_of("kind = \"turn\", speed_deg = 9", 3), "obstacle[0].motion.axis: must be given");
  EXPECT_EQ(error_of("kind = \"turn\", speed_deg = 9, axis = [0, 0, 1]"),
            "obstacle[0].motion.axis: means nothing where dimension = 2");
  EXPECT_EQ(error_of("kind = \"turn\", speed_deg = 9, start = 2, end = 1"),
            "obstacle[0].motion.end: must be after start");
  EXPECT_EQ(error_of("kind = \"path\", times = [1, 1], shifts = [[0, 0], [1, 0]]"),
            "obstacle[0].motion.times: must be two or more, each later than the one before");
  EXPECT_EQ(error_of("kind = \"path\", times = [1, 2], shifts = [[1, 0], [1, 0]]"),
            "obstacle[0].motion.shifts: must be 2, as many as times, the first of them 0");
  EXPECT_EQ(error_of("kind = \"sine\", amplitude = [50, 0], frequency = 10"),
            "obstacle[0].motion: must move at most at 120 m/s, here 3142");
  EXPECT_EQ(error_of("kind = \"path\", times = [0, 1000], shifts = [[0, 0], [9999, 0]]"),
            "obstacle[0].motion: must stay within 10000 m of the origin");
}

Scene<2> scene_with_gravity(const std::string& motion) {
  return std::get<Scene<2>>(
      parse_scene(fmt::format("title = \"Gravity\"\ndimension = 2\nshape.ball = {{kind = \"ball\", radius = 0.5}}\n"
                              "body = [{{position = [0, 9]}}]\nworld.gravity_motion = {{{}}}\n",
                              motion),
                  "text"));
}

std::string gravity_error(const std::string& motion) {
  try {
    scene_with_gravity(motion);
  } catch (const SceneErrors& errors) {
    return fmt::format("{}: {}", errors.errors().front().field, errors.errors().front().rule);
  }
  return "";
}

TEST(SceneGravity, TurnsByAnglesOrGoesFromVectorToVector) {
  const Scene<2> tilt = scene_with_gravity("kind = \"path\", times = [1, 3], angles_deg = [0, 90]");
  EXPECT_LT((tilt.gravity_at(0.5) - Vec2(0.0, -9.81)).norm(), 1e-12);
  EXPECT_LT((tilt.gravity_at(2.0) - 9.81 * Vec2(std::sqrt(0.5), -std::sqrt(0.5))).norm(), 1e-12);
  EXPECT_LT((tilt.gravity_at(9.0) - Vec2(9.81, 0.0)).norm(), 1e-12);
  const Scene<2> path = scene_with_gravity("kind = \"path\", times = [1, 3], gravity = [[0, -4], [2, 0]]");
  EXPECT_LT((path.gravity_at(0.0) - Vec2(0.0, -4.0)).norm(), 1e-12);
  EXPECT_LT((path.gravity_at(2.0) - Vec2(1.0, -2.0)).norm(), 1e-12);
}

TEST(SceneGravity, SwingsAboutItsValue) {
  const Scene<2> shaken = scene_with_gravity("kind = \"sine\", amplitude = [2, 0], frequency = 0.5, end = 1");
  EXPECT_LT((shaken.gravity_at(0.5) - Vec2(2.0, -9.81)).norm(), 1e-12);
  EXPECT_LT((shaken.gravity_at(5.0) - Vec2(0.0, -9.81)).norm(), 1e-12);
}

TEST(SceneGravity, NeedsOneKindOfValueForEachTime) {
  EXPECT_EQ(gravity_error("kind = \"path\", times = [1, 3]"),
            "world.gravity_motion: must have one of gravity and angles_deg");
  EXPECT_EQ(gravity_error("kind = \"path\", times = [1, 3], gravity = [[0, 1]]"),
            "world.gravity_motion.gravity: must be 2, as many as times");
  EXPECT_EQ(gravity_error("kind = \"path\", times = [3, 1], angles_deg = [0, 1]"),
            "world.gravity_motion.times: must be two or more, each later than the one before");
  EXPECT_EQ(gravity_error("kind = \"turn\", speed_deg = 3, start = 2, end = 1"),
            "world.gravity_motion.end: must be after start");
}

TEST(SceneGravity, IsChangedByPlanOrByEventsAndNotByBoth) {
  EXPECT_EQ(gravity_error("kind = \"turn\", speed_deg = 3}\nevent = [{time = 1, do = \"gravity\", gravity = [0, 1]}]\n"
                          "run = {frames = 3"),
            "event[0].do: must not be gravity where world.gravity_motion is given");
}

}  // namespace
}  // namespace talus::scene_motion_test
