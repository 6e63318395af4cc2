// Bodies at given places, as the reader of scene files makes them.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/scene/read_scene.h"
#include "common/scene/typical_body.h"

namespace talus::scene_body_test {
namespace {

constexpr const char* head_2d =
    "title = \"Bodies\"\ndimension = 2\nshape.brick = {kind = \"box\", size = [1.0, 0.5]}\n[[body]]\n";
constexpr const char* head_3d =
    "title = \"Bodies\"\ndimension = 3\nshape.cube = {kind = \"box\", size = [1, 1, 1]}\n[[body]]\n";

template <int Dim>
Scene<Dim> scene_of(const std::string& body) {
  return std::get<Scene<Dim>>(parse_scene((Dim == 2 ? head_2d : head_3d) + body, "text"));
}

template <int Dim>
std::vector<Vec<Dim>> places(const Scene<Dim>& scene) {
  std::vector<Vec<Dim>> result;
  for (const InitialBody<Dim>& body : scene.bodies) result.push_back(body.def.pose.position);
  return result;
}

/// The first error of a scene, without its place; empty if there is none.
std::string error_of(const std::string& text) {
  try {
    parse_scene(text, "text");
  } catch (const SceneErrors& errors) {
    const SceneError& first = errors.errors().front();
    return fmt::format("{}: {}", first.field, first.rule);
  }
  return "";
}

TEST(SceneBodies, NeedNoSource) {
  const Scene<2> scene = scene_of<2>("position = [1.0, 4.0]\nvelocity = [2.0, 3.0]\nspin = 0.5\nangle_deg = 90\n");
  ASSERT_EQ(scene.bodies.size(), 1U);
  const BodyDef<2>& body = scene.bodies[0].def;
  EXPECT_EQ(body.pose.position, Vec2(1.0, 4.0));
  EXPECT_EQ(body.velocity, Vec2(2.0, 3.0));
  EXPECT_EQ(body.spin[0], 0.5);
  EXPECT_NEAR(body.pose.rotation.angle(), 1.5707963, 1e-6);
  EXPECT_EQ(scene.bodies_planned(), 1);
  EXPECT_DOUBLE_EQ(typical_body(scene).mass, 500.0);
}

TEST(SceneBodies, RepeatFromTheirPlaceOn) {
  const Scene<2> scene =
      scene_of<2>("position = [9.5, 0.25]\nrepeat = [2, 2]\nstep = [1.0, 0.5]\nstagger = [0.5, 0]\n");
  const std::vector<Vec2> expected = {{9.5, 0.25}, {10.5, 0.25}, {10.0, 0.75}, {11.0, 0.75}};
  EXPECT_EQ(places(scene), expected);
}

TEST(SceneBodies, TaperToAPyramidThatEndsInOneBody) {
  const Scene<3> scene = scene_of<3>("position = [0, 0, 0.5]\nrepeat = [3, 3, 9]\nstep = [1, 1, 1]\ntaper = 1\n");
  ASSERT_EQ(scene.bodies.size(), 9U + 4U + 1U);
  EXPECT_EQ(places(scene).back(), Vec3(1.0, 1.0, 2.5));
}

TEST(SceneBodies, ThatAreOneDeepTaperAlongTheirLength) {
  const Scene<3> scene = scene_of<3>("position = [0, 0, 0.5]\nrepeat = [3, 1, 3]\nstep = [1, 1, 1]\ntaper = 1\n");
  EXPECT_EQ(scene.bodies.size(), 3U + 2U + 1U);
}

TEST(SceneBodies, TurnByOneStepMoreEach) {
  const Scene<3> scene = scene_of<3>(
      "position = [0, 0, 0.5]\nrepeat = [1, 1, 3]\nstep = [0, 0, 1]\naxis = [0, 0, 1]\nangle_deg = 10\n"
      "angle_step_deg = 5\n");
  const Rotation<3> last(Eigen::AngleAxisd(20.0 * 3.14159265358979 / 180.0, Vec3::UnitZ()));
  EXPECT_LT(scene.bodies.back().def.pose.rotation.angularDistance(last), 1e-9);
}

// So that a hull may be given in the world's coordinates.
TEST(SceneBodies, ArePlacedByTheOriginOfTheirShapesAxes) {
  const Scene<2> scene =
      std::get<Scene<2>>(parse_scene("title = \"Hull\"\ndimension = 2\nbody = [{}]\n"
                                     "shape.h = {kind = \"hull\", corners = [[4, 1], [6, 1], [6, 3], [4, 3]]}\n",
                                     "text"));
  EXPECT_LT((places(scene).front() - Vec2(5.0, 2.0)).norm(), 1e-12);
}

TEST(SceneBodies, ThatAreFixedAreObstacles) {
  const Scene<2> scene = scene_of<2>("position = [0, 3]\nrepeat = [4, 2]\nstep = [2, 2]\nfixed = true\n");
  EXPECT_EQ(scene.bodies.size(), 0U);
  EXPECT_EQ(scene.world.obstacles.size(), 8U);
}

TEST(SceneBodies, MayTouchButNotOverlap) {
  const auto second = [](double x) {
    return fmt::format("{}position = [0, 0.25]\n[[body]]\nposition = [{}, 0.25]\n", head_2d, x);
  };
  EXPECT_EQ(error_of(second(1.0)), "");
  EXPECT_EQ(error_of(second(0.996)), "");
  EXPECT_EQ(error_of(second(0.9)),
            "body[1].position: must leave no overlap above 0.005 m: it is 0.1 m deep in body 0 of body[0]");
}

// The boxes around them overlap by a third of a metre.
TEST(SceneBodies, AreComparedByTheirTrueShapes) {
  const std::string discs =
      "title = \"Discs\"\ndimension = 2\nshape.disc = {kind = \"ball\", radius = 0.5}\n"
      "body = [{position = [0, 0.5]}, {position = [0.71, 1.21]}]\n";
  EXPECT_EQ(error_of(discs), "");
}

TEST(SceneBodies, OverlapNeitherGroundNorObstacleNorEachOtherOfOneTable) {
  const auto error = [](const std::string& rest) { return error_of(head_2d + rest); };
  EXPECT_EQ(error("position = [0, 0.2]\n"),
            "body[0].position: must leave no overlap above 0.005 m: it is 0.05 m deep in the ground");
  EXPECT_EQ(error("position = [0, 5]\n[[obstacle]]\nkind = \"box\"\nposition = [0, 5]\nsize = [0.4, 9]\n"),
            "body[0].position: must leave no overlap above 0.005 m: it is 0.7 m deep in obstacle[0]");
  EXPECT_EQ(error("position = [0, 5]\nrepeat = [3, 1]\nstep = [0.9, 0]\n"),
            "body[0].step: must leave no overlap above 0.005 m: its body 1 is 0.1 m deep in body 0 of body[0]");
}

TEST(SceneBodies, AllInOnePlaceAreRefusedAtOnce) {
  EXPECT_EQ(error_of(head_2d + std::string("position = [0, 5]\nrepeat = [300, 300]\nstep = [0, 0]\n")),
            "body[0].step: must leave no overlap above 0.005 m: its body 1 is 0.5 m deep in body 0 of body[0]");
}

// Each small disc is near the large one, but near few of its like.
TEST(SceneBodies, OfVeryDifferentSizesAreComparedWithThoseNearThem) {
  const auto scene = [](double x) {
    return fmt::format(
        "title = \"Discs\"\ndimension = 2\nshape.small = {{kind = \"ball\", radius = 0.1}}\n"
        "shape.large = {{kind = \"ball\", radius = 40, density = 0.0005}}\n[[body]]\nshape = \"large\"\nposition = [0, "
        "40]\n"
        "[[body]]\nshape = \"small\"\nposition = [0, 81]\nrepeat = [100, 200]\nstep = [0.2, 0.2]\n"
        "[[body]]\nshape = \"small\"\nposition = [{}, 40]\n",
        x);
  };
  EXPECT_EQ(error_of(scene(40.11)), "");
  EXPECT_EQ(error_of(scene(40.0)),
            "body[2].position: must leave no overlap above 0.005 m: it is 0.1 m deep in body 0 of body[0]");
}

TEST(SceneBodies, AreLimitedInNumberTogetherWithThoseOfTheSources) {
  EXPECT_EQ(error_of(std::string(head_2d) + "position = [0, 5]\nrepeat = [10000, 1000]\nstep = [1, 1]\n" +
                     "[[source]]\ncount = 1\n"),
            "body[0].repeat: must leave at most 100000 bodies and obstacles at the start; sources drop more");
}

TEST(SourceGrid, OfOneRotationIsSpacedByTheTrueShape) {
  const auto error = [](double spacing, const std::string& rest) {
    return error_of(
        fmt::format("title = \"Rain\"\ndimension = 2\nshape.brick = {{kind = \"box\", size = [1.0, 0.5]}}\n"
                    "[[source]]\ngrid = [3, 2]\nspacing = [{}, {}]\n{}\n",
                    spacing, 0.5 * spacing, rest));
  };
  EXPECT_EQ(error(1.0, "angle_deg = 0"), "");
  EXPECT_EQ(error(0.9, "angle_deg = 0"),
            "source[0].spacing: must be at least 1 m, so that no two bodies of a grid touch");
  EXPECT_EQ(error(1.0, ""), "source[0].spacing: must be at least 1.118 m, so that no two bodies of a grid touch");
}

}  // namespace
}  // namespace talus::scene_body_test
