#include <gtest/gtest.h>

#include "common/scene/read_scene.h"
#include "tests/common/scene_description.h"

namespace talus::scene_override_test {
namespace {

const std::string text = R"(title = "A scene"
dimension = 2
[shape.L]
kind = "L"
[[source]]
position = [0.0, 10.0]
[[source]]
position = [5.0, 10.0]
[policy]
tau = 0.5
)";

Scene<2> with(std::initializer_list<Override> overrides) {
  return std::get<Scene<2>>(parse_scene(text, "a.toml", std::vector<Override>(overrides)));
}

std::string error_of(const std::string& one) {
  try {
    with({{one}});
  } catch (const SceneErrors& errors) {
    return errors.what();
  }
  return "no error";
}

TEST(Override, TakesThePlaceOfAValue) { EXPECT_EQ(with({{"policy.tau=0.4"}}).policy.paper.tau, 0.4); }

TEST(Override, PutsInWhatIsNotThere) {
  EXPECT_EQ(with({{"run.frames=7"}}).run.frames, 7);
  EXPECT_EQ(with({{"world.solver.velocity_iterations=50"}}).world.solver.velocity_iterations, 50);
}

TEST(Override, CountsFromZero) {
  const Scene<2> scene = with({{"source[1].rate=3"}});
  EXPECT_EQ(scene.sources[0].rate, Source<2>().rate);
  EXPECT_EQ(scene.sources[1].rate, 3.0);
}

TEST(Override, ReachesIntoAnArray) { EXPECT_EQ(with({{"source[1].position[0]=7"}}).sources[1].position, Vec2(7, 10)); }

TEST(Override, NeedsNoQuotesAroundAText) {
  EXPECT_EQ(with({{"policy.kind=engine"}}).policy.kind, "engine");
  EXPECT_EQ(with({{"title=Two words"}}).title, "Two words");
  EXPECT_EQ(with({{"policy.kind=\"full\""}}).policy.kind, "full");
}

TEST(Override, GivenLastWins) { EXPECT_EQ(with({{"policy.tau=0.4"}, {"policy.tau=0.3"}}).policy.paper.tau, 0.3); }

TEST(Override, MayGiveAWholeTable) { EXPECT_EQ(with({{"run={frames=3, frame_rate=60}"}}).run.frames, 3); }

TEST(WrongOverride, ThatIsNotUtf8IsRefused) {
  EXPECT_NE(error_of("title=\xFF\xFE").find("must be UTF-8"), std::string::npos);
}

TEST(WrongOverride, IsNamedInItsError) {
  EXPECT_EQ(error_of("policy.tau=2"), "--set policy.tau=2: policy.tau = 2: must be at least 0 and below 1");
  EXPECT_EQ(error_of("source[0].rate=fast"), "--set source[0].rate=fast: source[0].rate = \"fast\": must be a number");
}

TEST(WrongOverride, OfAnIncludeIsRefused) {
  try {
    with({{"include=base.toml"}});
    ADD_FAILURE() << "no error";
  } catch (const SceneErrors& errors) {
    EXPECT_NE(std::string(errors.what()).find("include must be given in the file"), std::string::npos);
  }
}

TEST(WrongOverride, FromAnotherOptionIsNamedByThatOption) {
  try {
    with({{"seed=-1", "--seed -1"}});
    FAIL() << "a negative seed was taken";
  } catch (const SceneErrors& errors) {
    EXPECT_STREQ(errors.what(), "--seed -1: seed = -1: must be at least 0");
  }
}

TEST(WrongOverride, OfAnUnknownPathIsToldTheNearest) {
  EXPECT_EQ(error_of("policy.tua=0.4"),
            "--set policy.tua=0.4: policy.tua = 0.4: no such key here (did you mean \"tau\"?)");
  EXPECT_EQ(error_of("polcy.tau=0.4"),
            "--set polcy.tau=0.4: polcy = {...}: no such key here (did you mean \"policy\"?)");
}

TEST(WrongOverride, OfANameOrNumberThatTheSceneDoesNotHaveSaysSo) {
  EXPECT_EQ(error_of("shape.l.friction=1"),
            "--set shape.l.friction=1: the scene has no shape \"l\" (did you mean \"L\"?)");
  EXPECT_EQ(error_of("shape.stone.friction=1"), "--set shape.stone.friction=1: the scene has no shape \"stone\"");
  EXPECT_EQ(error_of("obstacle[0].friction=1"), "--set obstacle[0].friction=1: [0]: the scene has no obstacle");
  EXPECT_EQ(error_of("sorce[0].rate=1"),
            "--set sorce[0].rate=1: [0]: the scene has no sorce (did you mean \"source\"?)");
  EXPECT_EQ(error_of("source[7].rate=1"), "--set source[7].rate=1: [7]: there are only 2, counted from 0");
  EXPECT_EQ(with({{"shape.disc={kind=\"ball\", radius=1}"}}).world.shapes.size(), 2U) << "a whole shape may be added";
}

TEST(WrongOverride, OfAPathThatLeadsNowhereIsRefused) {
  EXPECT_EQ(error_of("source[2].rate=3"), "--set source[2].rate=3: [2]: there are only 2, counted from 0");
  EXPECT_EQ(error_of("source.rate=3"),
            "--set source.rate=3: \"rate\" follows an array: say which of it, as in source[0].rate");
  EXPECT_EQ(error_of("policy[0]=3"), "--set policy[0]=3: [0] follows what is no array");
  EXPECT_EQ(error_of("[0].rate=3"), "--set [0].rate=3: [0] follows what is no array");
  EXPECT_EQ(error_of("[0]=3"), "--set [0]=3: [0] follows what is no array");
  EXPECT_EQ(error_of("title.x=3"), "--set title.x=3: \"x\" follows what is no table");
}

TEST(WrongOverride, WithoutAPathOrAValueIsRefused) {
  for (const std::string one : {"", "=", "=3", "policy.tau", "policy..tau=3", "source[=3", "source[0.rate=7",
                                "source[0]rate=7", "policy.tau =0.3", "source[x].rate=3", "policy.tau="}) {
    EXPECT_TRUE(error_of(one).starts_with("--set " + one)) << error_of(one);
  }
}

TEST(SceneAsRun, HoldsTheOverrides) {
  const Scene<2> scene = with({{"policy.tau=0.4"}, {"run.frames=7"}, {"title=It's \"so\""}});
  EXPECT_EQ(description(std::get<Scene<2>>(parse_scene(scene.toml, "b.toml"))), description(scene));
  EXPECT_EQ(std::get<Scene<2>>(parse_scene(scene.toml, "b.toml")).policy.paper.tau, 0.4);
}

TEST(SceneAsRun, IsTheFileItselfWithoutOverrides) { EXPECT_EQ(with({}).toml, text); }

}  // namespace
}  // namespace talus::scene_override_test
