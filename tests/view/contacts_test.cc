// Contacts and their forces as a page of `talus view SCENE` is sent them, on every engine.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "common/scene/read_scene.h"
#include "tests/view/engine_list.h"
#include "tools/serve/shown_run.h"

namespace talus::contacts_test {
namespace {

/// A point as a page reads it, with the coordinate along the height last.
struct Read {
  std::uint64_t a = 0;
  std::int64_t b = 0;
  bool kept = false;
  std::vector<double> point, normal_force, friction_force;
};

std::vector<Read> read(const std::string& text, int dimension) {
  std::vector<Read> points;
  const auto message = nlohmann::json::parse(text);
  for (const auto& row : message["contacts"]) {
    Read& point = points.emplace_back();
    point.a = row[0];
    point.b = row[1];
    point.kept = row[2] == 1;
    std::size_t at = 3;
    for (std::vector<double>* vector : {&point.point, &point.normal_force, &point.friction_force})
      for (int axis = 0; axis < dimension; ++axis) vector->push_back(row[at++]);
    EXPECT_EQ(row.size(), at);
  }
  return points;
}

/// Two unit cubes, one on the other, under a policy; under `full` nothing but the page reads contacts.
std::string two_cubes(int dimension, const std::string& policy) {
  const std::string size = dimension == 2 ? "[1, 1]" : "[1, 1, 1]";
  const std::string zeros = dimension == 2 ? "0" : "0, 0";
  return fmt::format(
      "title = \"two cubes\"\ndimension = {}\nshape.cube = {{kind = \"box\", size = {}, density = 1000}}\n"
      "policy = {{kind = \"{}\"}}\nworld = {{gravity = 10}}\nrun = {{frames = 900}}\n"
      "[[body]]\nshape = \"cube\"\nposition = [{}, 0.5]\n[[body]]\nshape = \"cube\"\nposition = [{}, 1.5]\n{}",
      dimension, size, policy, zeros, zeros, policy == "full" ? "" : "[[pile]]\n");
}

class ShownContacts : public ::testing::TestWithParam<EngineChoice> {
 protected:
  int dimension() const { return GetParam().first; }
  std::unique_ptr<ShownRun> run(const std::string& policy) const {
    return show_run(parse_scene(two_cubes(dimension(), policy), "two.toml", {}), GetParam().second, "two.toml", true);
  }
  std::vector<Read> contacts_of(ShownRun& run) const { return read(run.frame().contacts, dimension()); }
};

INSTANTIATE_TEST_SUITE_P(Engines, ShownContacts, ::testing::ValuesIn(all_engines()), name_of_engine);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ShownContacts);  // in a build without engines

TEST_P(ShownContacts, ForcesOnARestingBodyCarryItsWeight) {
  const auto shown = run("full");
  shown->show_contacts(true);
  for (int step = 0; step < 180; ++step) shown->step();
  const int up = dimension() - 1;
  double on_upper = 0.0;
  double from_ground = 0.0;
  for (const Read& point : contacts_of(*shown)) {
    const double force = point.normal_force[up] + point.friction_force[up];
    if (point.b == ground_index) from_ground += force;
    if (point.a == 1) on_upper += force;
    if (point.b == 1) on_upper -= force;
    EXPECT_FALSE(point.kept);
    EXPECT_NEAR(point.point[up], point.b == ground_index ? 0.0 : 1.0, 0.05) << "m";
  }
  // 1000 kg each at 10 m/s^2. A solver of ten iterations leaves forces within 2 % of their balance.
  EXPECT_NEAR(on_upper, 1e4, 200.0);
  EXPECT_NEAR(from_ground, 2e4, 400.0);
}

TEST_P(ShownContacts, OfSleepingBodiesAreThoseOfTheLastStepBefore) {
  const auto shown = run("adaptive");
  shown->show_contacts(true);
  for (int step = 0; step < 900; ++step) shown->step();
  double from_ground = 0.0;
  const std::vector<Read> points = contacts_of(*shown);
  for (const Read& point : points) {
    EXPECT_TRUE(point.kept);
    if (point.b == ground_index) from_ground += point.normal_force[dimension() - 1];
  }
  EXPECT_NEAR(from_ground, 2e4, 400.0);
  EXPECT_EQ(shown->remove(1), "");
  for (const Read& point : contacts_of(*shown)) EXPECT_EQ(point.b, ground_index) << "a removed body touches nothing";
  for (int step = 0; step < 2; ++step) shown->step();
  from_ground = 0.0;
  for (const Read& point : contacts_of(*shown)) {
    EXPECT_FALSE(point.kept) << "the lower body woke";
    from_ground += point.normal_force[dimension() - 1];
  }
  // Two steps after the load has gone, the forces of the solver are still on their way.
  EXPECT_NEAR(from_ground, 1e4, 5e3);
}

TEST_P(ShownContacts, AreNeitherComputedNorSentWhileOff) {
  const auto shown = run("full");
  for (int step = 0; step < 60; ++step) shown->step();
  EXPECT_EQ(shown->frame().contacts, "");
  shown->show_contacts(true);
  EXPECT_TRUE(contacts_of(*shown).empty()) << "policy full has no steps record them";
  shown->step();
  EXPECT_FALSE(contacts_of(*shown).empty());
  shown->show_contacts(false);
  EXPECT_EQ(shown->frame().contacts, "");
}

}  // namespace
}  // namespace talus::contacts_test
