// The present state of a run as a scene file.

#include "tools/serve/saved_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <variant>

#include "common/scene/read_scene.h"
#include "tests/view/engine_list.h"
#include "tools/run/make_simulation.h"

namespace talus::saved_scene_test {
namespace {

class SavedScene : public ::testing::TestWithParam<EngineChoice> {
 protected:
  static AnyScene scene(const std::string& text) { return parse_scene(text, "saved.toml", {}); }

  int dimension() const { return GetParam().first; }
  /// A vector of the dimension; y is 0.
  std::string at(double x, double z) const {
    return dimension() == 2 ? fmt::format("[{}, {}]", x, z) : fmt::format("[{}, 0.0, {}]", x, z);
  }

  /// Two columns between two walls, a gate that goes after a second, and a source.
  std::string columns() const {
    std::string text = fmt::format(
        "title = \"columns\"\ndimension = {}\nrun = {{frames = 300}}\nshape.cube = {{kind = \"box\", size = {}}}\n"
        "shape.disc = {{kind = \"ball\", radius = 0.5, rolling_friction = 0.2}}\n[[pile]]\n"
        "[[source]]\nshape = \"cube\"\ncount = 8\nrate = 4.0\nposition = {}\n"
        "[source.scale]\nfactors = [0.7, 1.0]\n",
        dimension(), dimension() == 2 ? "[1, 1]" : "[1, 1, 1]", at(0, 12));
    for (const auto& [name, x] : {std::pair("left", -4.0), std::pair("right", 4.0)})
      text += fmt::format("[[obstacle]]\nname = \"{}\"\nkind = \"box\"\nsize = {}\nposition = {}\n", name,
                          dimension() == 2 ? "[0.5, 3]" : "[0.5, 3, 3]", at(x, 1.5));
    text += "[[event]]\ntime = 1.0\ndo = \"remove\"\nobstacle = \"left\"\n[[event]]\ntime = 5.0\ndo = \"wake\"\n";
    for (const double x : {-1.5, 1.5})
      for (int i = 0; i < 4; ++i)
        text += fmt::format("[[body]]\nshape = \"{}\"\nposition = {}\n", i < 3 ? "cube" : "disc", at(x, 0.5 + i));
    return text;
  }

  /// Calls `test` with the scene that a run of so many steps saves, and with the run.
  template <class Prepare, class Test>
  void save(const std::string& text, int steps, const Prepare& prepare, const Test& test) const {
    std::visit(
        [&]<int Dim>(const Scene<Dim>& first) {
          auto simulation = make_simulation(first, GetParam().second);
          for (int step = 0; step < steps; ++step) simulation.step();
          prepare(simulation);
          const std::string saved = saved_scene(first, simulation);
          SCOPED_TRACE(saved);
          test.template operator()<Dim>(std::get<Scene<Dim>>(scene(saved)), simulation);
        },
        scene(text));
  }
};

INSTANTIATE_TEST_SUITE_P(Engines, SavedScene, ::testing::ValuesIn(all_engines()), name_of_engine);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(SavedScene);  // in a build without engines

constexpr auto nothing = [](auto&) {};

/// Places are rounded to less than 1e-6 of the smallest shape.
constexpr double rounding = 2e-6;

template <int Dim>
void expect_bodies(const Scene<Dim>& saved, const Simulation<Dim>& run) {
  const BodyStates<Dim>& states = run.world().states();
  std::size_t next = 0;
  for (BodyIndex body = 0; body < states.size(); ++body) {
    if (states.removed[body] != 0) continue;
    ASSERT_LT(next, saved.bodies.size());
    const InitialBody<Dim>& placed = saved.bodies[next++];
    EXPECT_LT((placed.def.pose.position - states.pose[body].position).norm(), rounding) << "body " << body;
    EXPECT_LT((placed.def.velocity - states.velocity[body]).norm(), rounding) << "body " << body;
    const Vec<Dim> corner = Vec<Dim>::Ones();
    EXPECT_LT((placed.def.pose.rotation * corner - states.pose[body].rotation * corner).norm(), rounding);
    EXPECT_EQ(placed.asleep, states.asleep[body] != 0);
    const Shape<Dim>& shape = saved.world.shapes[placed.def.shape];
    EXPECT_NEAR(shape.mass, run.world().shape_of(body).mass, 1e-9 * shape.mass);
  }
  EXPECT_EQ(next, saved.bodies.size());
}

TEST_P(SavedScene, PlacesTheBodiesWhereTheyAre) {
  save(columns(), 150, nothing, []<int Dim>(const Scene<Dim>& saved, const Simulation<Dim>& run) {
    ASSERT_GT(run.world().states().size(), 10);
    expect_bodies(saved, run);
    EXPECT_EQ(saved.bodies_planned(), 16) << "with those still to come";
    EXPECT_EQ(saved.run.frames, 300 - 75);
  });
}

TEST_P(SavedScene, FirstStepShowsTheSamePile) {
  save(columns(), 900, nothing, [this]<int Dim>(const Scene<Dim>& saved, const Simulation<Dim>& run) {
    auto again = make_simulation(saved, GetParam().second);
    again.step();
    const BodyStates<Dim>& states = run.world().states();
    ASSERT_EQ(again.world().states().size(), states.size());
    for (BodyIndex body = 0; body < states.size(); ++body)
      if (states.asleep[body] != 0)
        EXPECT_LT((again.world().states().pose[body].position - states.pose[body].position).norm(), 1e-3)
            << "a thousandth of a body, the quantum of the page";
  });
}

TEST_P(SavedScene, HasWhatWasDoneByHand) {
  const auto by_hand = [](auto& run) {
    run.remove(0);
    run.cut_obstacle(1);
  };
  save(columns(), 90, by_hand, []<int Dim>(const Scene<Dim>& saved, const Simulation<Dim>& run) {
    expect_bodies(saved, run);
    EXPECT_EQ(saved.world.obstacles.size(), 0U) << "one was removed by an event, one by hand";
    ASSERT_EQ(saved.events.size(), 1U) << "the one still to come";
    EXPECT_NEAR(*saved.events[0].time, 5.0 - run.time(), 1e-9);
  });
}

TEST_P(SavedScene, KeepsTheWallsOfAContainerThatWereNotCut) {
  const std::string text = fmt::format(
      "title = \"box\"\ndimension = {}\nshape.disc = {{kind = \"ball\", radius = 0.25}}\nrun = {{frames = 30}}\n"
      "[[obstacle]]\nkind = \"container\"\ninner_size = {}\nposition = {}\nfriction = 0.3\n[[body]]\nposition = {}\n",
      dimension(), dimension() == 2 ? "[4, 2]" : "[4, 4, 2]", at(1, 1), at(1, 3));
  const auto cut = [](auto& run) { run.cut_obstacle(0); };
  save(text, 3, cut, []<int Dim>(const Scene<Dim>& saved, const Simulation<Dim>& run) {
    const auto walls = std::get<Scene<Dim>>(scene(saved.toml)).world.obstacles;
    std::size_t next = 0;
    for (int k = 1; next < walls.size(); ++k, ++next) {
      EXPECT_LT((walls[next].pose.position - run.world().obstacle_pose(k).position).norm(), 1e-9);
      EXPECT_NEAR(walls[next].shape.volume, run.world().obstacle_shape(k).volume, 1e-9);
      EXPECT_EQ(walls[next].shape.material.friction, 0.3);
    }
    EXPECT_EQ(next, walls.size());
    EXPECT_GE(next, 1U);
  });
}

TEST_P(SavedScene, SaysWhatItDoesNotKeep) {
  save(columns(), 30, nothing, []<int Dim>(const Scene<Dim>& saved, const Simulation<Dim>&) {
    EXPECT_NE(saved.toml.find("# Not kept:"), std::string::npos);
    EXPECT_NE(saved.toml.find("still to come"), std::string::npos);
  });
}

}  // namespace
}  // namespace talus::saved_scene_test
