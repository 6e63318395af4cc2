// What the events of a scene have made of its world.

#include <gtest/gtest.h>

#include "common/scene/happened.h"
#include "common/scene/read_scene.h"

namespace talus::scene_happened_test {
namespace {

/// A shelf of two obstacles that is removed at 2 s, and gravity that is halved at 4 s; another obstacle moves.
Scene<2> shelf() {
  return std::get<Scene<2>>(parse_scene(
      "title = \"shelf\"\ndimension = 2\nshape.disc = {kind = \"ball\", radius = 0.5}\nbody = [{position = [0, 9]}]\n"
      "obstacle = [{kind = \"container\", inner_size = [6, 1], position = [0, 1.5], name = \"shelf\"},\n"
      "            {kind = \"ball\", radius = 1, position = [20, 0], motion = {kind = \"path\", times = [0, 4], "
      "shifts = [[0, 0], [4, 0]]}}]\n"
      "event = [{time = 2, do = \"remove\", obstacle = \"shelf\"}, {time = 4, do = \"gravity\", gravity = [0, -5]},\n"
      "         {time = 5, do = \"kick\", body = 0, velocity = [1, 0]}, {when = \"rest\", do = \"wake\"}]\n",
      "text"));
}

TEST(SceneHappened, WorldHasObstaclesAndGravityAsEventsLeftThem) {
  const Scene<2> scene = shelf();
  const std::vector<DoneEvent> done = {{0, 2.0}, {1, 4.0}};
  EXPECT_EQ(world_at<2>(scene, done, 1.9).obstacles.size(), 3U);
  EXPECT_EQ(world_at<2>(scene, done, 2.1).obstacles.size(), 1U);
  EXPECT_DOUBLE_EQ(world_at<2>(scene, done, 3.0).obstacles[0].pose.position.x(), 23.0);
  EXPECT_DOUBLE_EQ(world_at<2>(scene, done, 3.9).gravity, 9.81);
  EXPECT_DOUBLE_EQ(world_at<2>(scene, done, 4.1).gravity, 5.0);
}

TEST(SceneHappened, PolicyIsThatOfTheLastSwitch) {
  Scene<2> scene = shelf();
  scene.events[0] = {.action = EventAction::policy, .policy = "full"};
  EXPECT_EQ(policy_at<2>(scene, std::vector<DoneEvent>{{0, 2.0}}, 1.9).kind, "adaptive");
  EXPECT_EQ(policy_at<2>(scene, std::vector<DoneEvent>{{0, 2.0}}, 2.0).kind, "full");
}

TEST(SceneHappened, DrivesBodiesAsLongAsAForceActs) {
  Scene<2> scene = shelf();
  scene.movers.clear();
  scene.events[0] = {.action = EventAction::force, .seconds = 1.0};
  const std::vector<DoneEvent> done = {{0, 2.0}};
  EXPECT_TRUE(still_driven<2>(scene, done, 2.9));
  EXPECT_FALSE(still_driven<2>(scene, done, 3.0));
  scene.events[0].seconds.reset();
  EXPECT_TRUE(still_driven<2>(scene, done, 99.0));
}

TEST(SceneHappened, MovesUntilThePlansOfWhatIsLeftHaveEnded) {
  EXPECT_TRUE(still_driven<2>(shelf(), {}, 3.9));
  EXPECT_FALSE(still_driven<2>(shelf(), {}, 4.1));
  Scene<2> scene = shelf();
  scene.movers.front().first = 0;  // the shelf moves, and is removed at 2 s
  const std::vector<DoneEvent> done = {{0, 2.0}};
  EXPECT_TRUE(still_driven<2>(scene, done, 1.9));
  EXPECT_FALSE(still_driven<2>(scene, done, 2.1));
  scene.gravity_motion = Motion<2>{.speed = 1.0};
  EXPECT_TRUE(still_driven<2>(scene, done, 2.1));
}

TEST(SceneHappened, EventsHaveATextOfAFewWords) {
  const Scene<2> scene = shelf();
  EXPECT_EQ(event_text(scene, 0), "remove obstacle shelf");
  EXPECT_EQ(event_text(scene, 1), "gravity [0.0, -5.0]");
  EXPECT_EQ(event_text(scene, 2), "kick some bodies");
  EXPECT_EQ(event_text(scene, 3), "wake all bodies");
}

}  // namespace
}  // namespace talus::scene_happened_test
