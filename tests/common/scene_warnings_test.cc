#include <gtest/gtest.h>

#include "common/scene/read_scene.h"
#include "common/scene/warnings.h"

namespace talus::scene_warnings_test {
namespace {

// The warnings of a scene of one ball shape, which has none, with something added or changed.
std::string warnings_with(std::vector<Override> overrides) {
  const std::string text =
      "title = \"A scene\"\ndimension = 3\nshape.ball = {kind = \"ball\", radius = 0.5}\n"
      "source = [{rate = 2, count = 10}]\npile = [{alpha_deg = 20}]\n";
  std::string lines;
  for (const std::string& line : warnings(std::get<Scene<3>>(parse_scene(text, "text", overrides))))
    lines += line + "\n";
  return lines;
}

void expect_one(const std::string& lines, const std::string& part) {
  EXPECT_NE(lines.find(part), std::string::npos) << lines;
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 1) << lines;
}

TEST(Warnings, AreNoneForASoundScene) { EXPECT_EQ(warnings_with({}), ""); }

TEST(Warnings, TellOfASpoutThatCannotKeepUp) {
  expect_one(warnings_with({{"source[0].rate=5"}}), "source[0]: is to make 5 bodies a second, but");
}

TEST(Warnings, TellOfBodiesThatAreDueAfterTheEnd) {
  expect_one(warnings_with({{"run.frames=60"}}), "source[0]: its last body is due at 4.5 s, the run ends at 2 s");
}

TEST(Warnings, TellOfMotionsThatSinglePrecisionRoundsAway) {
  const auto platform_at = [](const std::string& x, const std::string& speed) {
    return warnings_with(
        {{"obstacle=[{kind = \"box\", size = [2, 2, 0.5], position = [" + x +
          ", 0, 1], motion = {kind = \"path\", times = [0, 1], shifts = [[0, 0, 0], [" + speed + ", 0, 0]]}}]"}});
  };
  EXPECT_EQ(platform_at("0", "0.001"), "");
  EXPECT_EQ(platform_at("1000", "0.2"), "");
  expect_one(platform_at("20", "0.001"), "obstacle[0].motion: of 1.7e-05 m a step at most, up to 21 m");
  expect_one(platform_at("20", "0.001"), "go up to 6 % too far or too short");
  expect_one(platform_at("1000", "0.001"), "go up to 100 % too far or too short");
}

TEST(Warnings, TellOfEventsThatCannotHappen) {
  EXPECT_EQ(warnings_with({{"event=[{time = 5, do = \"wake\", body = [9]}]"}}), "");
  expect_one(warnings_with({{"event=[{time = 1e6, do = \"wake\"}]"}}), "event[0]: is due at 1e+06 s, the run ends at");
  expect_one(warnings_with({{"event=[{bodies = 11, do = \"wake\"}]"}}),
             "event[0]: waits for 11 bodies, the scene has 10");
  expect_one(warnings_with({{"event=[{time = 5, do = \"wake\", body = [3, 10]}]"}}), "event[0]: there is no body 10");
}

TEST(Warnings, NameRulesThatRingsReplace) {
  expect_one(warnings_with({{"policy.adaptive.wake_height=0.1"}}),
             "policy.adaptive.wake_height has no effect: policy.adaptive.rings is 2");
  expect_one(warnings_with({{"policy.adaptive.ring_still_speed=0.1"}, {"policy.adaptive.rings=0"}}),
             "policy.adaptive.ring_still_speed has no effect: policy.adaptive.rings is 0");
  EXPECT_EQ(warnings_with({{"policy.adaptive.wake_height=0.1"}, {"policy.adaptive.rings=0"}}), "");
  EXPECT_EQ(warnings_with({{"policy.adaptive.wake_height=0.1"}, {"policy.kind=full"}}), "");
}

TEST(Warnings, TellOfSizesThatEnginesHoldBadly) {
  expect_one(warnings_with({{"shape.ball.radius=0.09"}, {"source[0].position=[0, 0, 4]"}}),
             "shape.ball: 0.18 to 0.18 m wide");
}

TEST(Warnings, TellOfMassesThatAreTooDifferent) {
  const Override heavy{"shape.heavy={kind=\"ball\", radius=0.5, density=20000}"};
  const Override solver{"world.solver.kind=\"engine\""};
  expect_one(warnings_with({heavy, solver}), "masses differ by a factor of 20");
  EXPECT_EQ(warnings_with({heavy, solver, {"world.solver.velocity_iterations=50"}}), "");
}

TEST(Warnings, TellOfVolumesThatAreTooDifferentForOnePile) {
  expect_one(warnings_with({{"shape.large={kind=\"ball\", radius=0.65}"}, {"source[0].rate=1.9"}}),
             "bounding boxes differ by a factor of 2.2");
}

TEST(Warnings, DoNotMindOneLargeBodyThatIsThrownIntoAPile) {
  const Override large{"shape.large={kind=\"ball\", radius=0.65}"};
  const Override sources{"source=[{shape=\"ball\", rate=1.9, count=60}, {shape=\"large\", count=1}]"};
  EXPECT_EQ(warnings_with({large, sources, {"run.frames=1200"}}), "");
}

TEST(Warnings, TellOfAPolicyThatControlsNoSlopes) {
  expect_one(warnings_with({{"pile[0].control_slope=true"}, {"policy.kind=engine"}}), "they raise no friction");
  EXPECT_EQ(warnings_with({{"pile[0].control_slope=true"}}), "");
}

TEST(Warnings, TellOfAPolicyWithoutAPile) {
  expect_one(warnings_with({{"pile=[]"}, {"policy.kind=paper"}}), "without any [[pile]]");
  EXPECT_EQ(warnings_with({{"pile=[]"}, {"policy.kind=full"}}), "");
}

TEST(Warnings, TellOfSettingsOfTheOtherSolver) {
  const Override own{"world.solver.kind=\"engine\""};
  expect_one(warnings_with({{"world.solver.velocity_iterations=50"}}),
             "world.solver.velocity_iterations has no effect");
  expect_one(warnings_with({own, {"world.solver.sub_steps=4"}}), "world.solver.sub_steps has no effect");
  EXPECT_EQ(warnings_with({own, {"world.solver.velocity_iterations=50"}}), "");
  EXPECT_EQ(warnings_with({own, {"accuracy=fast"}}), "") << "its sub-steps are of the other solver";
  EXPECT_EQ(warnings_with({{"world.solver.sub_steps=4"}}), "");
}

TEST(Warnings, AdviseNoIterationsUnderSmallSteps) {
  EXPECT_EQ(warnings_with({{"shape.heavy={kind=\"ball\", radius=0.5, density=20000}"}}), "");
}

TEST(Warnings, TellOfBodiesThatGoFartherThanTheirThicknessInAStep) {
  // 0.3 m thick from 18 m: sqrt(2 g 18) = 18.8 m/s, 0.313 m a step.
  const Override plate{"shape.ball={kind=\"box\", size=[1, 1, 0.3]}"};
  const Override rate{"source[0].rate=1.5"};
  const Override steps{"world.steps_per_second=60"};
  const Override far_fall{"source[0].position=[0, 0, 18]"};
  expect_one(warnings_with({plate, rate, steps, far_fall}),
             "bodies arrive at 18.8 m/s and go 1 times their thickness in a step");
  expect_one(warnings_with({plate, rate, steps, far_fall}), "steps_per_second = 126 helps");
  EXPECT_EQ(warnings_with({plate, rate, far_fall}), "");  // the accuracy chooses 120
  EXPECT_EQ(warnings_with({plate, rate, steps, {"source[0].position=[0, 0, 16]"}}), "");
}

TEST(Warnings, TellOfImpactsThatAddEnergyWithTheEnginesOwnSolversOnly) {
  const Override engine{"world.solver.kind=engine"};
  expect_one(warnings_with({{"shape.ball.restitution=1"}, engine}), "above 0.99 impacts add energy");
  EXPECT_EQ(warnings_with({{"shape.ball.restitution=0.99"}, engine}), "");
  EXPECT_EQ(warnings_with({{"shape.ball.restitution=1"}}), "");
}

TEST(Warnings, TellOfLongSteps) { expect_one(warnings_with({{"world.steps_per_second=30"}}), "below 60"); }

constexpr EngineTraits slow_engine = {.name = "slow",
                                      .fastest_step = 0.25,
                                      .sinking_fall = 0.1,
                                      .awake_bytes = 1e4,
                                      .sleeper_bytes = 1e3,
                                      .awake_seconds = 1e-5};

// The same scene's warnings for an engine that moves bodies by at most 15 m/s.
std::string engine_warnings_with(std::vector<Override> overrides) {
  const std::string text =
      "title = \"A scene\"\ndimension = 3\nshape.ball = {kind = \"ball\", radius = 0.5}\n"
      "source = [{rate = 2, count = 10}]\n";
  std::string lines;
  for (const std::string& line : engine_warnings(std::get<Scene<3>>(parse_scene(text, "text", overrides)), slow_engine))
    lines += line + "\n";
  return lines;
}

TEST(EngineWarnings, AreNoneForASoundScene) { EXPECT_EQ(engine_warnings_with({}), ""); }

TEST(EngineWarnings, TellOfAFallThatIsTooFastWithHeightAndSpeed) {
  expect_one(engine_warnings_with({{"source[0].position=[0,0,20]"}}), "a fall of 20 m ends at 19.81 m/s");
}

TEST(EngineWarnings, TellOfGravityThatPressesBodiesIntoTheGround) {
  const std::string lines = engine_warnings_with({{"world.gravity=400"}, {"world.steps_per_second=60"}});
  EXPECT_NE(lines.find("a step's fall of 0.111 m is more than a tenth"), std::string::npos) << lines;
}

TEST(EngineWarnings, ForetellTimeAndMemoryOfManyBodiesAtOnce) {
  const std::vector<Override> grid = {{"source[0].count=1000000"},
                                      {"source[0].grid=[1000,1000,1]"},
                                      {"source[0].spacing=[2,2,2]"},
                                      {"source[0].position=[0,0,10]"}};
  expect_one(engine_warnings_with(grid), "1000000 bodies awake at once take 10 s a step or more and about 10 GB");
  EXPECT_EQ(engine_warnings_with({{"source[0].count=1000000"}}), "");
  std::vector<Override> awake = {{"source[0].count=30000"}, {"policy.kind=full"}};
  expect_one(engine_warnings_with(awake), "30000 bodies awake at once");
}

}  // namespace
}  // namespace talus::scene_warnings_test
