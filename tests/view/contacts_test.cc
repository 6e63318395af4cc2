// Contacts and their forces as a page of `talus view SCENE` and a record are told them, on every engine.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <optional>
#include <sstream>

#include "common/scene/read_scene.h"
#include "lcmtypes/contacts_message.h"
#include "lcmtypes/log_reader.h"
#include "lcmtypes/wire.h"
#include "tests/view/engine_list.h"
#include "tools/serve/shown_run.h"

namespace talus::contacts_test {
namespace {

/// Those of the last step among the messages of a frame, with the coordinate along the height last; nothing where
/// the frame has none.
std::optional<std::vector<ContactForce<3>>> read(const std::string& block) {
  LogReader log(std::make_unique<std::istringstream>(block));
  std::optional<std::vector<ContactForce<3>>> contacts;
  for (LogEvent event; log.next(event);) {
    talus_lcm::talus_contacts message;
    if (event.channel != name_of(Channel::contacts)) continue;
    EXPECT_EQ(decode(event.data, message), "");
    append_contacts(message, contacts.emplace());
  }
  return contacts;
}

/// Two unit cubes, one on the other, under a policy; under `full` nothing but the page reads contacts.
std::string two_cubes(int dimension, const std::string& policy, int rings) {
  const std::string size = dimension == 2 ? "[1, 1]" : "[1, 1, 1]";
  const std::string zeros = dimension == 2 ? "0" : "0, 0";
  return fmt::format(
      "title = \"two cubes\"\ndimension = {}\nshape.cube = {{kind = \"box\", size = {}, density = 1000}}\n"
      "policy = {{kind = \"{}\", adaptive = {{rings = {}}}}}\nworld = {{gravity = 10}}\nrun = {{frames = 900}}\n"
      "[[body]]\nshape = \"cube\"\nposition = [{}, 0.5]\n[[body]]\nshape = \"cube\"\nposition = [{}, 1.5]\n{}",
      dimension, size, policy, rings, zeros, zeros, policy == "full" ? "" : "[[pile]]\n");
}

class ShownContacts : public ::testing::TestWithParam<EngineChoice> {
 protected:
  int dimension() const { return GetParam().first; }
  std::unique_ptr<ShownRun> run(const std::string& policy, int rings = 0) const {
    const AnyScene scene = parse_scene(two_cubes(dimension(), policy, rings), "two.toml", {});
    return show_run(scene, GetParam().second, "two.toml", true);
  }
  static std::vector<ContactForce<3>> contacts_of(ShownRun& run) { return read(run.frame().block).value(); }
};

INSTANTIATE_TEST_SUITE_P(Engines, ShownContacts, ::testing::ValuesIn(all_engines()), name_of_engine);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ShownContacts);  // in a build without engines

TEST_P(ShownContacts, ForcesOnARestingBodyCarryItsWeight) {
  const auto shown = run("full");
  shown->show_contacts(true);
  for (int step = 0; step < 180; ++step) shown->step();
  double on_upper = 0.0;
  double from_ground = 0.0;
  for (const ContactForce<3>& point : contacts_of(*shown)) {
    const double force = point.normal_force.z() + point.friction_force.z();
    if (point.b == ground_index) from_ground += force;
    if (point.a == 1) on_upper += force;
    if (point.b == 1) on_upper -= force;
    EXPECT_FALSE(point.kept);
    EXPECT_NEAR(point.point.z(), point.b == ground_index ? 0.0 : 1.0, 0.05) << "m";
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
  const std::vector<ContactForce<3>> points = contacts_of(*shown);
  for (const ContactForce<3>& point : points) {
    EXPECT_TRUE(point.kept);
    if (point.b == ground_index) from_ground += point.normal_force.z();
  }
  EXPECT_NEAR(from_ground, 2e4, 400.0);
  EXPECT_EQ(shown->remove(1), "");
  for (const ContactForce<3>& point : contacts_of(*shown))
    EXPECT_EQ(point.b, ground_index) << "a removed body touches nothing";
  for (int step = 0; step < 2; ++step) shown->step();
  from_ground = 0.0;
  for (const ContactForce<3>& point : contacts_of(*shown)) {
    EXPECT_FALSE(point.kept) << "the lower body woke";
    from_ground += point.normal_force.z();
  }
  // Two steps after the load has gone, the forces of the solver are still on their way.
  EXPECT_NEAR(from_ground, 1e4, 5e3);
}

TEST_P(ShownContacts, OfSleepingBodiesWithRingsAreThoseThatTheSolverKeeps) {
  const auto shown = run("adaptive", 2);
  shown->show_contacts(true);
  for (int step = 0; step < 900; ++step) shown->step();
  const auto ground_force = [&] {
    double force = 0.0;
    for (const ContactForce<3>& point : contacts_of(*shown))
      if (point.b == ground_index) force += point.normal_force.z();
    return force;
  };
  double on_upper = 0.0;
  for (const ContactForce<3>& point : contacts_of(*shown)) {
    EXPECT_TRUE(point.kept);
    if (point.a == 1) on_upper += point.normal_force.z();
    if (point.b == 1) on_upper -= point.normal_force.z();
  }
  EXPECT_NEAR(on_upper, 1e4, 200.0) << "each point once";
  EXPECT_NEAR(ground_force(), 2e4, 400.0);
  std::vector<double> above(dimension(), 0.0);
  above.back() = 2.6;
  EXPECT_EQ(shown->add("cube", above), "");
  for (int step = 0; step < 600; ++step) shown->step();
  // A load that comes later reaches the ground through sleeping bodies within some per cent; kept forces stay at 2e4.
  EXPECT_NEAR(ground_force(), 3e4, 1.5e3) << "a third cube came to rest on the two";
}

TEST_P(ShownContacts, AreNeitherComputedNorSentWhileOff) {
  const auto shown = run("full");
  for (int step = 0; step < 60; ++step) shown->step();
  EXPECT_FALSE(read(shown->frame().block));
  shown->show_contacts(true);
  EXPECT_TRUE(contacts_of(*shown).empty()) << "policy full has no steps record them";
  shown->step();
  EXPECT_FALSE(contacts_of(*shown).empty());
  shown->show_contacts(false);
  EXPECT_FALSE(read(shown->frame().block));
}

}  // namespace
}  // namespace talus::contacts_test
