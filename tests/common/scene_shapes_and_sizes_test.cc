// Cones, ellipses, stones and sizes, as the reader of scene files makes them.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "common/scene/read_scene.h"
#include "common/scene/read_shape.h"
#include "common/shape/colour.h"
#include "tests/common/temporary_folder.h"

namespace talus::scene_shapes_and_sizes_test {
namespace {

template <int Dim>
Scene<Dim> scene_of(const std::string& rest) {
  return std::get<Scene<Dim>>(parse_scene(fmt::format("title = \"Shapes\"\ndimension = {}\n{}\n", Dim, rest), "text"));
}

/// The first error without its place; empty if there is none.
std::string error_of(const std::string& rest) {
  try {
    scene_of<2>(rest);
  } catch (const SceneErrors& errors) {
    return fmt::format("{}: {}", errors.errors().front().field, errors.errors().front().rule);
  }
  return "";
}

template <int Dim>
Shape<Dim> shape_of(const std::string& keys) {
  return scene_of<Dim>(
             fmt::format("shape.one = {{{}}}\nbody = [{{position = {}}}]", keys, Dim == 2 ? "[0, 9]" : "[0, 0, 9]"))
      .world.shapes.at(0);
}

TEST(SceneShapes, OfAConeHaveItsVolumeButForTheFlatSides) {
  EXPECT_NEAR(shape_of<2>("kind = \"cone\", height = 2, radius = 0.5").volume, 1.0, 1e-9);
  const double round = std::numbers::pi * 0.25 * 2.0 / 3.0;
  EXPECT_NEAR(shape_of<3>("kind = \"cone\", height = 2, radius = 0.5, sides = 32").volume, round, 0.01 * round);
}

TEST(SceneShapes, OfAnEllipseHaveItsSizeAndArea) {
  const Shape<2> flat = shape_of<2>("kind = \"ellipse\", size = [2, 1], corners = 32");
  EXPECT_NEAR(flat.bounds.sizes().x(), 2.0, 1e-9);
  EXPECT_NEAR(flat.volume, std::numbers::pi * 0.5, 0.01 * flat.volume);
  const Shape<3> solid = shape_of<3>("kind = \"ellipse\", size = [2, 1, 1], corners = 200");
  const double volume = 4.0 / 3.0 * std::numbers::pi * 0.25;
  EXPECT_NEAR(solid.volume, volume, 0.05 * volume);
}

template <int Dim>
std::vector<Shape<Dim>> stones(int seed, const std::string& more = "") {
  return scene_of<Dim>(fmt::format("seed = {}\nshape.rock = {{kind = \"stone\"{}}}\nbody = [{{position = {}}}]", seed,
                                   more, Dim == 2 ? "[0, 9]" : "[0, 0, 9]"))
      .world.shapes;
}

template <int Dim>
std::vector<double> volumes_of_stones(int seed, const std::string& more = "") {
  std::vector<double> volumes;
  for (const Shape<Dim>& shape : stones<Dim>(seed, more)) volumes.push_back(shape.volume);
  return volumes;
}

TEST(SceneShapes, OfStonesFollowFromTheSeed) {
  EXPECT_EQ(volumes_of_stones<2>(1), volumes_of_stones<2>(1));
  EXPECT_NE(volumes_of_stones<2>(1), volumes_of_stones<2>(2));
  EXPECT_EQ(volumes_of_stones<3>(1, ", variants = 3").size(), 3U);
  EXPECT_NE(volumes_of_stones<3>(1)[0], volumes_of_stones<3>(1)[1]);
}

TEST(SceneShapes, OfRoughStonesAreMadeWithEachSeed) {
  for (int seed = 1; seed <= 30; ++seed) {
    for (const double volume : volumes_of_stones<2>(seed, ", roughness = 0.9")) EXPECT_GT(volume, 0.005);
    for (const double volume : volumes_of_stones<3>(seed, ", roughness = 0.9, elongation = 3"))
      EXPECT_GT(volume, 0.001);
  }
}

TEST(SceneShapes, OfAStoneAreTheHullOfItsCorners) {
  for (int seed = 1; seed <= 30; ++seed)
    for (const Shape<2>& shape : stones<2>(seed, ", roughness = 0.9")) {
      const auto& corners = std::get<HullPiece<2>>(shape.pieces.at(0)).corners;
      const std::size_t count = corners.size();
      // The corners lie all around the origin, so their hull contains it.
      for (std::size_t i = 0; i < count; ++i) {
        const Vec2 edge = corners[(i + 1) % count] - corners[i];
        const Vec2 origin = shape.reference - corners[i];
        EXPECT_GT(edge.x() * origin.y() - edge.y() * origin.x(), 0.0) << "seed " << seed << ", " << shape.name;
      }
    }
}

constexpr const char* discs =
    "shape.disc = {{kind = \"ball\", radius = 0.5}}\n"
    "source = [{{position = [0, 20], scale = {{{}}}}}]";

TEST(SceneSizes, OfAUniformDistributionAreItsQuantiles) {
  const auto scene = scene_of<2>(fmt::format(fmt::runtime(discs), "uniform = [0.5, 1.5], classes = 4"));
  ASSERT_EQ(scene.world.shapes.size(), 5U);
  EXPECT_NEAR(scene.world.shapes[1].bounds.sizes().x(), 0.625, 1e-9);
  EXPECT_NEAR(scene.world.shapes[1].mass, 0.625 * 0.625 * scene.world.shapes[0].mass, 1e-6);
  EXPECT_NEAR(scene.world.shapes[1].inertia(0, 0), std::pow(0.625, 4) * scene.world.shapes[0].inertia(0, 0), 1e-6);
  EXPECT_EQ(scene.sources[0].shapes, (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(scene.sources[0].shares, (std::vector<double>{0.25, 0.5, 0.75, 1.0}));
}

TEST(SceneSizes, OfALognormalDistributionHaveAMedianOfOne) {
  const auto scene = scene_of<2>(fmt::format(fmt::runtime(discs), "lognormal = 0.3, classes = 3"));
  ASSERT_EQ(scene.world.shapes.size(), 4U);
  EXPECT_NEAR(scene.world.shapes[2].bounds.sizes().x(), 1.0, 1e-6);
  EXPECT_NEAR(scene.world.shapes[3].bounds.sizes().x(), std::exp(0.3 * 0.967422), 1e-5);  // 5/6 quantile of a normal
}

TEST(SceneSizes, OfAListHaveItsShares) {
  const auto scene = scene_of<2>(fmt::format(fmt::runtime(discs), "factors = [0.5, 1], shares = [3, 1]"));
  EXPECT_EQ(scene.sources[0].shares, (std::vector<double>{0.75, 1.0}));
}

TEST(SceneSizes, AreMeantByTheNameOfTheirShapeInAnEvent) {
  const auto scene = scene_of<2>(fmt::format(fmt::runtime(discs), "factors = [0.5, 1, 2]") +
                                 "\nevent = [{time = 1, do = \"remove\", shape = \"disc\"}]");
  EXPECT_EQ(scene.events.at(0).shapes, (std::vector<int>{0, 1, 2, 3}));
}

TEST(SceneSizes, ThatAreTooManyAreRefused) {
  std::string sources = "shape.rock = {kind = \"stone\", variants = 100}\n";
  for (int i = 0; i < 3; ++i)
    sources +=
        fmt::format("[[source]]\nposition = [{}, 20]\nscale = {{uniform = [0.5, 1.5], classes = 100}}\n", 50 * i);
  EXPECT_EQ(error_of(sources), "source[1].scale: must make at most 20000 shapes in all");
}

TEST(SceneSizes, ThatMakeNoDistributionAreRefused) {
  EXPECT_EQ(error_of(fmt::format(fmt::runtime(discs), "uniform = [1.5, 0.5]")),
            "source[0].scale.uniform: must be two factors, the smaller first");
  EXPECT_EQ(error_of(fmt::format(fmt::runtime(discs), "classes = 3")),
            "source[0].scale: must have one of uniform, lognormal and factors");
  EXPECT_EQ(error_of(fmt::format(fmt::runtime(discs), "factors = [1, 2], shares = [1]")),
            "source[0].scale.shares: must be as many as factors");
  EXPECT_EQ(error_of(fmt::format(fmt::runtime(discs), "factors = [1, 2], classes = 5")),
            "source[0].scale.classes: means nothing beside factors");
  EXPECT_EQ(error_of(fmt::format(fmt::runtime(discs), "uniform = [1, 2], shares = [1]")),
            "source[0].scale.shares: means nothing without factors");
}

TEST(SceneGravity, MayBeAVector) {
  const auto scene = scene_of<2>(
      "shape.disc = {kind = \"ball\", radius = 0.5}\nbody = [{position = [0, 9]}]\n"
      "world.gravity = [3, -4]");
  EXPECT_NEAR(scene.world.gravity, 5.0, 1e-12);
  EXPECT_NEAR(scene.world.down.x(), 0.6, 1e-12);
  EXPECT_NEAR(scene.world.down.y(), -0.8, 1e-12);
}

constexpr const char* gate =
    "shape.disc = {{kind = \"ball\", radius = 0.5}}\nbody = [{{position = [0, 9]}}]\n"
    "obstacle = [{{kind = \"box\", size = [1, 1], name = \"gate\"}}]\nevent = [{{{}}}]";

TEST(SceneEventKeys, ThatMakeNoEventAreRefusedWithTheirRule) {
  const auto error = [](const std::string& keys) { return error_of(fmt::format(fmt::runtime(gate), keys)); };
  EXPECT_EQ(error("time = 1, do = \"remove\", obstacle = \"gate\""), "");
  EXPECT_EQ(error("time = 1, when = \"rest\", do = \"wake\""), "event[0]: must have one of time, when and bodies");
  EXPECT_EQ(error("time = 1, do = \"remove\", obstacle = \"gat\""), "event[0].obstacle: must be gate");
  EXPECT_EQ(error("time = 1, do = \"wake\", rate = 3"), "event[0].rate: means nothing for do = \"wake\"");
  EXPECT_EQ(error("time = 1, do = \"rate\", rate = 3"),
            "event[0].source: must be the number of a source, of which there are 0");
  EXPECT_EQ(error("time = 1, do = \"kick\", body = [0.5]"), "event[0].body: must be whole numbers");
  EXPECT_EQ(error("time = 1, do = \"policy\""), "event[0].policy: must be given");
}

TEST(SceneInclude, ValuesHoldWhereTheSceneGivesNone) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "base.toml") << "title = \"Base\"\ndimension = 2\nseed = 7\n"
                                                "shape.disc = {kind = \"ball\", radius = 0.5, friction = 0.1}\n"
                                                "source = [{position = [0, 20]}, {position = [9, 20]}]\n";
  std::ofstream(folder.path() / "scene.toml") << "include = \"base.toml\"\ntitle = \"Scene\"\n"
                                                 "shape.disc.friction = 0.9\nsource = [{position = [0, 30]}]\n";
  const auto scene = std::get<Scene<2>>(read_scene(folder.path() / "scene.toml"));
  EXPECT_EQ(scene.title, "Scene");
  EXPECT_EQ(scene.seed, 7U);
  EXPECT_EQ(scene.world.shapes.at(0).material.friction, 0.9);
  EXPECT_EQ(scene.sources.size(), 1U);
  EXPECT_EQ(scene.toml.find("include"), std::string::npos) << "a run folder's scene stands alone";
  EXPECT_EQ(std::get<Scene<2>>(parse_scene(scene.toml, "text")).seed, 7U);
}

TEST(SceneInclude, ErrorsHaveTheFileAndLineOfTheValue) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "base.toml") << "title = \"Base\"\ndimension = 2\n"
                                                "shape.disc = {kind = \"ball\", radius = -1}\n";
  std::ofstream(folder.path() / "scene.toml") << "include = \"base.toml\"\nsource = [{position = [0, 30]}]\n";
  try {
    read_scene(folder.path() / "scene.toml");
    FAIL();
  } catch (const SceneErrors& errors) {
    EXPECT_TRUE(errors.errors().front().file.ends_with("base.toml")) << errors.what();
    EXPECT_EQ(errors.errors().front().line, 3) << errors.what();
  }
}

TEST(SceneInclude, OfWhatIsNoOtherFileBesideOrBelowIsRefusedWhereItStands) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe.toml").c_str(), 0600), 0);
  std::ofstream(folder.path() / "base.toml") << "include = \"scene.toml\"\n";
  const std::string unreadable = "must be a regular file that can be read";
  for (const auto& [name, told] : std::vector<std::pair<std::string, std::string>>{
           {"scene.toml", "must not lead back to a file that includes it"},
           {"../base.toml", "must be a file in or below the scene's folder"},
           {"missing.toml", unreadable},
           {"pipe.toml", unreadable},
           {"base.toml\\u0000", unreadable}}) {
    const std::string scene = folder / "scene.toml";
    std::ofstream(scene) << "# a scene\ninclude = \"" << name << "\"\n";
    try {
      read_scene(scene);
      ADD_FAILURE() << "no error: " << name;
    } catch (const SceneErrors& errors) {
      EXPECT_EQ(errors.what(), fmt::format("{}:2:11: include = \"{}\": {}", scene, name, told));
    }
  }
}

/// A dumbbell of two unit boxes on a rod, in 2D and in 3D.
template <int Dim>
Scene<Dim> dumbbell(const std::string& more = "") {
  const bool flat = Dim == 2;
  return scene_of<Dim>(fmt::format(
      "shape.end = {{kind = \"box\", size = {}, density = 2000}}\nshape.rod = {{kind = \"box\", size = {}, density = "
      "500}}\nbody = [{{position = {}}}]\n{}\n[shape.bell]\nkind = \"compound\"\nfriction = 0.7\ncolour = \"#0A0b0C\"\n"
      "parts = [{{shape = \"rod\"}}, {{shape = \"end\", position = {}}}, {{shape = \"end\", position = {}, angle_deg = "
      "90{}}}]",
      flat ? "[1, 1]" : "[1, 1, 1]", flat ? "[2, 0.5]" : "[2, 0.5, 0.5]", flat ? "[0, 9]" : "[0, 0, 9]", more,
      flat ? "[-1.5, 0]" : "[-1.5, 0, 0]", flat ? "[1.5, 0]" : "[1.5, 0, 0]", flat ? "" : ", axis = [0, 1, 0]"));
}

TEST(SceneShapes, OfACompoundHaveTheMassAndInertiaOfTheirParts) {
  const Scene<2> flat = dumbbell<2>();
  ASSERT_EQ(flat.world.shapes.size(), 1U);
  const Shape<2>& bell = flat.world.shapes[0];
  EXPECT_NEAR(bell.mass, 2.0 * 2000.0 + 500.0, 1e-9);
  EXPECT_NEAR(bell.reference.norm(), 0.0, 1e-12);
  EXPECT_NEAR(bell.inertia(0), 2.0 * 2000.0 * (2.0 / 12.0 + 2.25) + 500.0 * (4.0 + 0.25) / 12.0, 1e-6);
  EXPECT_EQ(bell.pieces.size(), 3U);
  EXPECT_EQ(bell.material.friction, 0.7);
  const Shape<3> solid = dumbbell<3>().world.shapes.at(0);
  EXPECT_NEAR(solid.mass, 2.0 * 2000.0 + 250.0, 1e-9);
  EXPECT_NEAR(solid.inertia(0, 0), 2.0 * 2000.0 * 2.0 / 12.0 + 250.0 * 0.5 / 12.0, 1e-6);
  EXPECT_NEAR(solid.inertia(1, 1), 2.0 * 2000.0 * (2.0 / 12.0 + 2.25) + 250.0 * 4.25 / 12.0, 1e-6);
}

TEST(SceneShapes, OfACompoundLieAboutTheCentreOfMassOfPartsOfDifferentDensity) {
  const Scene<2> scene = scene_of<2>(
      "shape.heavy = {kind = \"box\", size = [1, 1], density = 3000}\nshape.light = {kind = \"box\", size = [1, 1]}\n"
      "shape.both = {kind = \"compound\", parts = [{shape = \"light\"}, {shape = \"heavy\", position = [0, 1]}]}\n"
      "body = [{position = [0, 9]}]");
  EXPECT_NEAR(scene.world.shapes.at(0).reference.y(), -0.75, 1e-12);
  EXPECT_NEAR(scene.bodies.at(0).def.pose.position.y(), 9.75, 1e-12);
}

TEST(SceneShapes, OfACompoundAreDroppedAndTheirPartsOnlyWhereNamed) {
  EXPECT_EQ(dumbbell<2>().world.shapes.at(0).name, "bell");
  const Scene<2> scene = dumbbell<2>("source = [{position = [30, 9]}, {position = [60, 9], shape = \"end\"}]");
  ASSERT_EQ(scene.world.shapes.size(), 2U);
  EXPECT_EQ(scene.sources[0].shapes, std::vector<int>{0});
  EXPECT_EQ(scene.world.shapes[scene.sources[1].shapes.at(0)].name, "end");
}

TEST(SceneShapes, OfACompoundMayBeCompoundsAndTheFirstStone) {
  const Scene<2> scene = scene_of<2>(
      "shape.b = {kind = \"compound\", parts = [{shape = \"z\"}, {shape = \"s\", position = [4, 0]}]}\n"
      "shape.s = {kind = \"stone\"}\nshape.q = {kind = \"box\", size = [1, 1]}\n"
      "shape.z = {kind = \"compound\", parts = [{shape = \"q\"}, {shape = \"q\", position = [1, 0]}]}\n"
      "body = [{position = [0, 9]}, {position = [0, 19], shape = \"s\"}]");
  const Shape<2>& whole = scene.world.shapes.at(0);
  EXPECT_EQ(whole.name, "b");
  EXPECT_NEAR(whole.mass, 2000.0 + scene.world.shapes.at(1).mass, 1e-6);
}

TEST(SceneShapes, OfACompoundThatCannotBeMadeAreRefusedWithTheField) {
  const std::string box = "shape.box = {kind = \"box\", size = [1, 1]}\nbody = [{position = [0, 9], shape = \"c\"}]\n";
  EXPECT_EQ(error_of(box + "shape.c = {kind = \"compound\", parts = [{shape = \"bix\"}]}"),
            "shape.c.parts[0].shape: must be one of box, c");
  EXPECT_EQ(error_of(box + "shape.c = {kind = \"compound\", parts = [{shape = \"d\"}]}\n"
                           "shape.d = {kind = \"compound\", parts = [{shape = \"box\"}, {shape = \"c\"}]}"),
            "shape.d.parts[1].shape: must not have this shape as a part: c has d has c");
  EXPECT_EQ(error_of(box + "shape.c = {kind = \"compound\", parts = []}"), "shape.c.parts: must be one or more parts");
  EXPECT_EQ(error_of(box + "shape.c = {kind = \"compound\", density = 3, parts = [{shape = \"box\"}]}"),
            "shape.c.density: means nothing for a compound: each part has its own");
  EXPECT_EQ(error_of(box + "shape.c = {kind = \"compound\"}"), "shape.c.parts: must be given");
}

TEST(SceneShapes, OfCompoundsThatDoubleTheirPiecesAreRefused) {
  std::string text = "shape.s0 = {kind = \"box\", size = [1, 1]}\nbody = [{position = [0, 9], shape = \"s0\"}]\n";
  for (int i = 1; i <= 7; ++i) {
    const std::string part = fmt::format("{{shape = \"s{}\"}}", i - 1);
    text += fmt::format("shape.s{} = {{kind = \"compound\", parts = [{}]}}\n", i,
                        fmt::format("{}", fmt::join(std::vector<std::string>(i < 7 ? 3 : 2, part), ", ")));
  }
  EXPECT_EQ(error_of(text), "shape.s7.parts: must have at most 1000 convex pieces");
}

TEST(SceneShapes, OfCompoundsInsideEachOtherAreRefusedFromADepthOn) {
  std::string text = "shape.z = {kind = \"box\", size = [1, 1]}\nbody = [{position = [0, 9], shape = \"z\"}]\n";
  for (char name = 'a'; name < 'l'; ++name)
    text += fmt::format("shape.{} = {{kind = \"compound\", parts = [{{shape = \"{}\"}}]}}\n", name,
                        name == 'k' ? 'z' : static_cast<char>(name + 1));
  EXPECT_NE(error_of(text).find("must not be the 9th compound inside another"), std::string::npos) << error_of(text);
}

TEST(SceneShapes, OfACompoundWithPartsInEachOtherAreWarnedOf) {
  const Scene<2> scene = scene_of<2>(
      "shape.box = {kind = \"box\", size = [1, 1]}\nbody = [{position = [0, 9]}]\n"
      "shape.c = {kind = \"compound\", parts = [{shape = \"box\"}, {shape = \"box\", position = [0.9, 0]}]}");
  ASSERT_EQ(scene.reader_warnings.size(), 1U);
  EXPECT_NE(scene.reader_warnings[0].find("shape.c: parts[0] and parts[1] overlap by 0.1 m"), std::string::npos);
}

TEST(SceneShapes, HaveColoursByNameOrAsNumbers) {
  EXPECT_EQ(dumbbell<2>().world.shapes.at(0).colour, "#0a0b0c");
  EXPECT_EQ(shape_of<2>("kind = \"ball\", radius = 1, colour = \"white\"").colour, "#ffffff");
  EXPECT_EQ(shape_of<2>("kind = \"ball\", radius = 1").colour, "");
  EXPECT_EQ(error_of("shape.b = {kind = \"ball\", radius = 1, colour = \"#12345g\"}\nbody = [{position = [0, 9]}]"),
            "shape.b.colour: must be \"#rrggbb\" or one of black, blue, brown, green, grey, orange, pink, purple, red, "
            "sky, white, yellow");
}

TEST(SceneColours, TheManualNamesEachColour) {
  for (const auto& [name, colour] : named_colours)
    EXPECT_NE(colour_key.meaning.find(fmt::format("`{}`", name)), std::string_view::npos) << name;
}

}  // namespace
}  // namespace talus::scene_shapes_and_sizes_test
