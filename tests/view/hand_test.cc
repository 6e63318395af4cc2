// Bodies pulled along and added by hand in `talus view SCENE`, on every engine.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <variant>

#include "common/scene/read_scene.h"
#include "tests/view/engine_list.h"
#include "tools/run/make_simulation.h"
#include "tools/serve/hand_command.h"
#include "tools/serve/shown_run.h"

namespace talus::hand_test {
namespace {

class Hand : public ::testing::TestWithParam<EngineChoice> {
 protected:
  static constexpr double gravity = 10.0;

  /// Unit cubes at these heights, one above the other, on the ground.
  AnyScene cubes(const std::string& policy, const std::vector<double>& heights, double g = gravity,
                 const std::string& more = "") const {
    const bool flat = GetParam().first == 2;
    std::string text = fmt::format(
        "title = \"cubes\"\ndimension = {}\nshape.cube = {{kind = \"box\", size = {}}}\nshape.ball = {{kind = "
        "\"ball\", "
        "radius = 0.5}}\npolicy = {{kind = \"{}\"}}\nworld = {{gravity = {}}}\nrun = {{frames = 3000}}\n[[pile]]\n",
        GetParam().first, flat ? "[1, 1]" : "[1, 1, 1]", policy, g);
    for (const double height : heights)
      text += fmt::format("[[body]]\nshape = \"cube\"\nposition = [{}{}]\n", flat ? "0, " : "0, 0, ", height);
    return parse_scene(text + more, "cubes.toml", {});
  }

  /// Calls `test` with a simulation of the scene and its dimension.
  template <class Test>
  void simulate(const AnyScene& scene, const Test& test) const {
    std::visit(
        [&]<int Dim>(const Scene<Dim>& of_dimension) {
          auto simulation = make_simulation(of_dimension, GetParam().second);
          test.template operator()<Dim>(simulation);
        },
        scene);
  }
};

INSTANTIATE_TEST_SUITE_P(Engines, Hand, ::testing::ValuesIn(all_engines()), name_of_engine);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Hand);  // in a build without engines

template <int Dim>
Vec<Dim> place(double x, double z) {
  Vec<Dim> place = Vec<Dim>::Zero();
  place[0] = x;
  place[Dim - 1] = z;
  return place;
}

TEST_P(Hand, PulledBodyGoesToTheTargetWithoutOvershooting) {
  simulate(cubes("full", {5.0}, 0.0), []<int Dim>(Simulation<Dim>& simulation) {
    simulation.pull({.body = 0, .point = Vec<Dim>::Zero(), .target = place<Dim>(3.0, 5.0)});
    double farthest = 0.0;
    for (int step = 0; step < 600; ++step) {
      simulation.step();
      farthest = std::max(farthest, simulation.world().states().pose[0].position[0]);
    }
    EXPECT_NEAR(farthest, 3.0, 0.01) << "critically damped";
    EXPECT_LT(simulation.world().states().velocity[0].norm(), 1e-2) << "m/s";
  });
}

/// By how much the spring of a pull is stretched that carries a body [m]. At rest it is a twentieth of the extent. The
/// spring is solved once a step, for a velocity that takes up v1 = (v + rate^2 dt stretch) / (1 + rate dt)^2; then
/// gravity is added in k sub-steps. A body that hangs ends each step where it began, so v1 = g dt (k + 1) / 2k.
template <int Dim>
double stretch(const Simulation<Dim>& simulation, double g) {
  const double extent = simulation.world().shape_of(0).extent;
  const double dt = 1.0 / 60.0;
  const double longer = 1.0 + std::sqrt(pull_stiffness * g / extent) * dt;
  const double k = SolverParams{}.sub_steps;
  const double share = (k + 1.0) / (2.0 * k);
  return extent / pull_stiffness * (share * longer * longer + 1.0 - share);
}

TEST_P(Hand, PulledBodyHangsFromItsPointAndFallsOnceReleased) {
  simulate(cubes("adaptive", {0.5}), []<int Dim>(Simulation<Dim>& simulation) {
    for (int step = 0; step < 300; ++step) simulation.step();
    ASSERT_EQ(simulation.world().states().asleep[0], 1);
    simulation.pull({.body = 0, .point = Vec<Dim>::Zero(), .target = place<Dim>(0.0, 4.0)});
    for (int step = 0; step < 600; ++step) simulation.step();
    EXPECT_NEAR(height<Dim>(simulation.world().states().pose[0].position), 4.0 - stretch(simulation, gravity), 1e-4);
    EXPECT_EQ(simulation.world().states().asleep[0], 0) << "a pulled body stays awake";
    simulation.release();
    for (int step = 0; step < 300; ++step) simulation.step();
    EXPECT_NEAR(height<Dim>(simulation.world().states().pose[0].position), 0.5, 0.03);
  });
}

TEST_P(Hand, PulledBodyHangsAsFarBelowTheTargetOnceGravityHasChanged) {
  const double less = gravity / 4.0;
  const std::string event = fmt::format("[[event]]\ndo = \"gravity\"\ntime = 0.5\ngravity = [{}{}]\n",
                                        GetParam().first == 2 ? "0, " : "0, 0, ", -less);
  simulate(cubes("full", {0.5}, gravity, event), [less]<int Dim>(Simulation<Dim>& simulation) {
    for (int step = 0; step < 60; ++step) simulation.step();
    simulation.pull({.body = 0, .point = Vec<Dim>::Zero(), .target = place<Dim>(0.0, 4.0)});
    for (int step = 0; step < 900; ++step) simulation.step();
    EXPECT_NEAR(height<Dim>(simulation.world().states().pose[0].position), 4.0 - stretch(simulation, less), 1e-4);
  });
}

TEST_P(Hand, WhatLiesOnAPulledBodyWakes) {
  simulate(cubes("adaptive", {0.5, 1.5, 2.5}), []<int Dim>(Simulation<Dim>& simulation) {
    for (int step = 0; step < 600; ++step) simulation.step();
    for (int body = 0; body < 3; ++body) ASSERT_EQ(simulation.world().states().asleep[body], 1) << body;
    simulation.pull({.body = 0, .point = Vec<Dim>::Zero(), .target = place<Dim>(6.0, 0.5)});
    for (int step = 0; step < 600; ++step) simulation.step();
    const auto& poses = simulation.world().states().pose;
    EXPECT_GT(poses[0].position[0], 4.0);
    EXPECT_LT(height<Dim>(poses[2].position), 2.0) << "it no longer rests on the tower";
  });
}

TEST_P(Hand, AFarTargetEjectsNothing) {
  simulate(cubes("adaptive", {0.5, 1.5, 2.5, 3.5}), []<int Dim>(Simulation<Dim>& simulation) {
    for (int step = 0; step < 300; ++step) simulation.step();
    simulation.pull({.body = 1, .point = place<Dim>(0.5, 0.5), .target = place<Dim>(1000.0, 1000.0)});
    const double extent = simulation.world().shape_of(0).extent;
    const double fastest = 0.5 * std::sqrt(pull_stiffness * gravity * extent);
    for (int step = 0; step < 240; ++step) {
      simulation.step();
      for (const Vec<Dim>& velocity : simulation.world().states().velocity)
        ASSERT_LT(velocity.norm(), 1.5 * fastest) << "the grabbed point turns about the centre besides";
    }
    EXPECT_GT(height<Dim>(simulation.world().states().pose[1].position), 4.0) << "it comes out of the tower";
  });
}

TEST_P(Hand, AnAddedBodyIsOneMoreAtAFreePlaceAndFalls) {
  const auto run = show_run(cubes("adaptive", {0.5, 1.5}), GetParam().second, "cubes.toml", true);
  for (int step = 0; step < 300; ++step) run->step();
  std::vector<double> at(GetParam().first, 0.0);
  at.back() = 0.6;  // within the lower cube
  EXPECT_EQ(run->add("ball", at), "");
  EXPECT_EQ(run->kick(2, std::vector<double>(GetParam().first, 0.0)), "") << "it is body 2";
  EXPECT_NE(run->kick(3, std::vector<double>(GetParam().first, 0.0)), "");
  for (int step = 0; step < 120; ++step) run->step();
  const auto account = nlohmann::json::parse(run->account(2));
  ASSERT_EQ(account["supports"].size(), 1U);
  EXPECT_EQ(account["supports"][0]["on"], 1) << "raised above the tower, it has fallen onto it";
}

TEST_P(Hand, WrongCommandsAreRefusedWithTheirRule) {
  const auto run = show_run(cubes("adaptive", {0.5}), GetParam().second, "cubes.toml", true);
  run->step();
  const auto answer = [&](const std::string& text) {
    try {
      return read_hand_command(nlohmann::ordered_json::parse(text))(*run);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
  };
  const std::string zeros = GetParam().first == 2 ? "[0, 0]" : "[0, 0, 0]";
  const auto with = [&](const std::string& text) { return fmt::format(fmt::runtime(text), fmt::arg("o", zeros)); };
  const auto begins = [](const std::string& text, const std::string& start) { return text.rfind(start, 0) == 0; };
  EXPECT_PRED2(begins, answer(with(R"({{"do": "add", "shape": "cone", "position": {o}}})")),
               "shape: the scene has none");
  EXPECT_PRED2(begins, answer(with(R"({{"do": "add", "position": {o}}})")), "shape: must be");
  EXPECT_PRED2(begins, answer(R"({"do": "add", "shape": "ball", "position": [1]})"), "position: must be");
  EXPECT_PRED2(begins, answer(R"({"do": "add", "shape": "ball", "position": [1e9, 0, 0]})"), "position: must be");
  EXPECT_PRED2(begins, answer(with(R"({{"do": "pull", "body": 1, "point": {o}, "to": {o}}})")), "body 1: is not");
  EXPECT_PRED2(begins, answer(with(R"({{"do": "pull", "body": 0, "point": {o}}})")), "to: must be");
  EXPECT_PRED2(begins, answer(with(R"({{"do": "pull", "body": 0, "point": [9, 0, 0], "to": {o}}})")), "point: must be");
  EXPECT_EQ(answer(R"({"do": "release"})"), "");
}

}  // namespace
}  // namespace talus::hand_test
