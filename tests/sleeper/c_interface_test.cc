#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/sleeper/pile_sleeper.h"
#include "talus/talus.h"

namespace talus::test {
namespace {

class CInterface : public ::testing::TestWithParam<int> {
 protected:
  CInterface() {
    const talus_options options = talus_default_options(GetParam());
    EXPECT_EQ(talus_create(&options, &sleeper), TALUS_OK) << talus_message();
  }
  ~CInterface() override { talus_destroy(sleeper); }

  talus_handle add_box() {
    talus_body body{};
    body.size = sizeof body;
    const double size[3] = {1.0, 0.5, 0.5};
    EXPECT_EQ(talus_box(sleeper, 2.0, size, &body), TALUS_OK) << talus_message();
    if (GetParam() == 3) body.rotation[3] = 1.0;
    talus_handle added = 0;
    EXPECT_EQ(talus_add(sleeper, &body, &added), TALUS_OK) << talus_message();
    return added;
  }
  /// A step in which the body lies on what never moves, which carries its weight.
  int lie(talus_handle body) {
    constexpr double dt = 1.0 / 60.0;
    const int up = GetParam() - 1;
    talus_state state{};
    if (GetParam() == 3) state.rotation[3] = 1.0;
    talus_contact contact{};
    contact.a = body;
    contact.normal[up] = 1.0;
    contact.normal_impulse = 2.0 * 9.81 * dt;
    const talus_step step = {sizeof step, dt, 1, &body, &state, 1, &contact};
    return talus_after_step(sleeper, &step, &changes);
  }

  talus_sleeper* sleeper = nullptr;
  talus_changes changes = {sizeof(talus_changes), 0, nullptr, 0, nullptr, 0, nullptr};
};

TEST_P(CInterface, PutsABodyToSleepThatLiesStill) {
  const talus_handle body = add_box();
  int steps = 0;
  while (changes.freeze_count == 0 && steps < 100) {
    ASSERT_EQ(lie(body), TALUS_OK) << talus_message();
    ++steps;
  }
  ASSERT_EQ(changes.freeze_count, 1U);
  EXPECT_EQ(changes.freeze[0].body, body);
  EXPECT_STREQ(talus_cause_name(changes.freeze[0].cause), "rest");
  for (const int none : {-1, 9, 256, 257}) EXPECT_STREQ(talus_cause_name(none), "unknown") << none;
  int asleep = 0;
  EXPECT_EQ(talus_asleep(sleeper, body, &asleep), TALUS_OK);
  EXPECT_EQ(asleep, 1);
  const talus_handle* followed = nullptr;
  std::size_t count = 1;
  EXPECT_EQ(talus_followed(sleeper, &followed, &count), TALUS_OK);
  EXPECT_EQ(count, 0U);
  EXPECT_EQ(talus_wake(sleeper, body, &changes), TALUS_OK);
  ASSERT_EQ(changes.thaw_count, 1U);
  EXPECT_EQ(changes.thaw[0].body, body);
}

TEST_P(CInterface, PutsToSleepAgainWhatSleptInASnapshot) {
  const talus_handle body = add_box();
  for (int i = 0; i < 100 && changes.freeze_count == 0; ++i) ASSERT_EQ(lie(body), TALUS_OK) << talus_message();
  const talus_saved* all = nullptr;
  std::size_t count = 0;
  ASSERT_EQ(talus_snapshot(sleeper, &all, &count), TALUS_OK);
  ASSERT_EQ(count, 1U);
  const talus_saved saved = all[0];
  EXPECT_EQ(saved.body, body);
  EXPECT_EQ(saved.asleep, 1);
  ASSERT_EQ(talus_wake(sleeper, body, &changes), TALUS_OK);
  talus_state state{};
  if (GetParam() == 3) state.rotation[3] = 1.0;
  ASSERT_EQ(talus_restore(sleeper, &saved, &state, 1, &changes), TALUS_OK) << talus_message();
  ASSERT_EQ(changes.freeze_count, 1U);
  EXPECT_EQ(changes.freeze[0].body, body);
  int asleep = 0;
  EXPECT_EQ(talus_asleep(sleeper, body, &asleep), TALUS_OK);
  EXPECT_EQ(asleep, 1);
  EXPECT_EQ(talus_restore(sleeper, nullptr, nullptr, 1, &changes), TALUS_BAD_VALUE);
}

TEST_P(CInterface, RefusesAHandleOfARemovedBodyAndSaysWhy) {
  const talus_handle body = add_box();
  EXPECT_EQ(talus_remove(sleeper, body, &changes), TALUS_OK);
  EXPECT_NE(add_box(), body);
  EXPECT_EQ(talus_wake(sleeper, body, &changes), TALUS_BAD_VALUE);
  EXPECT_NE(std::string(talus_message()).find("must be the handle of a body that is there"), std::string::npos);
}

TEST_P(CInterface, RefusesNullAndStructsOfAnotherSize) {
  EXPECT_EQ(talus_create(nullptr, &sleeper), TALUS_BAD_VALUE);
  EXPECT_EQ(talus_wake_all(nullptr, &changes), TALUS_BAD_VALUE);
  changes.size = 4;
  EXPECT_EQ(talus_wake_all(sleeper, &changes), TALUS_BAD_VALUE);
  EXPECT_NE(std::string(talus_message()).find("changes.size"), std::string::npos);
  talus_body body{};
  talus_handle added = 0;
  EXPECT_EQ(talus_add(sleeper, &body, &added), TALUS_BAD_VALUE);
}

/// The convex hull of a box has the inertia of the box, wherever its corners lie.
TEST_P(CInterface, FindsTheInertiaOfAConvexBody) {
  talus_body box{};
  box.size = sizeof box;
  talus_body hull = box;
  const double size[3] = {1.0, 2.0, 3.0};
  ASSERT_EQ(talus_box(sleeper, 2.0, size, &box), TALUS_OK);
  std::vector<double> corners;
  for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
    for (int z = 0; z < (GetParam() == 2 ? 1 : 2); ++z) {
      corners.insert(corners.end(), {5.0 + x, 5.0 + 2.0 * y});
      if (GetParam() == 3) corners.push_back(5.0 + 3.0 * z);
    }
  ASSERT_EQ(talus_convex(sleeper, 2.0, corners.data(), corners.size() / GetParam(), &hull), TALUS_OK)
      << talus_message();
  EXPECT_NEAR(hull.centre[0], 5.5, 1e-12);
  EXPECT_NEAR(hull.centre[1], 6.0, 1e-12);
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(hull.inertia[i], box.inertia[i], 1e-12);
  for (int i = 0; i < GetParam(); ++i) EXPECT_NEAR(hull.low[i], box.low[i], 1e-12);
}

/// A box of 1 m in a flight of 4 m within a step, through another one that stays where it is.
TEST_P(CInterface, ReportsABodyThatGetsThroughAnother) {
  struct Seen {
    int warnings = 0;
    std::string kind;
    talus_handle body = 0;
    double value = 0.0;
  } seen;
  const talus_report report = [](const talus_warning* warning, void* context) {
    auto& to = *static_cast<Seen*>(context);
    to = {to.warnings + 1, warning->kind, warning->body, warning->value};
    EXPECT_NE(std::string(warning->text).find("step 2"), std::string::npos) << warning->text;
  };
  ASSERT_EQ(talus_watch(sleeper, report, &seen), TALUS_OK) << talus_message();
  const talus_handle bodies[] = {add_box(), add_box()};
  talus_state states[2] = {};
  for (talus_state& state : states) state.rotation[3] = GetParam() == 3 ? 1.0 : 0.0;
  for (const double x : {-2.0, 2.0}) {
    states[1].position[0] = x;
    const talus_step step = {sizeof step, 0.1, 2, bodies, states, 0, nullptr};
    if (x == -2.0)
      ASSERT_EQ(talus_moved(sleeper, bodies[1], states[1].position, states[1].rotation, &changes), TALUS_OK);
    ASSERT_EQ(talus_after_step(sleeper, &step, &changes), TALUS_OK) << talus_message();
  }
  EXPECT_EQ(seen.warnings, 1);
  EXPECT_EQ(seen.kind, "passed");
  EXPECT_EQ(seen.body, bodies[1]);
  EXPECT_NEAR(seen.value, 4.0, 1e-12);
}

TEST_P(CInterface, NamesTheBodyOfANumber) {
  const talus_handle bodies[] = {add_box(), add_box()};
  talus_handle named = 0;
  for (int number = 0; number < 2; ++number) {
    ASSERT_EQ(talus_handle_of(sleeper, number, &named), TALUS_OK) << talus_message();
    EXPECT_EQ(named, bodies[number]);
  }
  ASSERT_EQ(talus_remove(sleeper, bodies[1], &changes), TALUS_OK);
  for (const int none : {-1, 1, 2}) EXPECT_EQ(talus_handle_of(sleeper, none, &named), TALUS_BAD_VALUE) << none;
  EXPECT_NE(std::string(talus_message()).find("body = 2: must be the number of a body that is there"),
            std::string::npos);
  const talus_handle later = add_box();
  ASSERT_EQ(talus_handle_of(sleeper, 1, &named), TALUS_OK);
  EXPECT_EQ(named, later);
}

/// What a body far away gives in its first step.
TEST_P(CInterface, TellsOfAnExceptionOfAReportThatIsNone) {
  ASSERT_EQ(talus_watch(
                sleeper, [](const talus_warning*, void*) { throw 1; }, nullptr),
            TALUS_OK);
  const talus_handle body = add_box();
  talus_state state{};
  state.position[0] = 1e9;
  if (GetParam() == 3) state.rotation[3] = 1.0;
  const talus_step step = {sizeof step, 0.1, 1, &body, &state, 0, nullptr};
  ASSERT_EQ(talus_after_step(sleeper, &step, &changes), TALUS_OK) << talus_message();
  EXPECT_EQ(talus_after_step(sleeper, &step, &changes), TALUS_FAILED);
  EXPECT_STREQ(talus_message(), "unknown exception");
}

TEST_P(CInterface, TakesNoStrongerGravityThanAScene) {
  for (const double most : {1e3, 1e200, static_cast<double>(NAN), 1e30, 1001.0}) {
    const double gravity[3] = {0.0, -most, 0.0};
    EXPECT_EQ(talus_set_gravity(sleeper, gravity, &changes), most == 1e3 ? TALUS_OK : TALUS_BAD_VALUE) << most;
  }
  EXPECT_NE(std::string(talus_message()).find("gravity = 1001: must be at least 0 and at most 1000"),
            std::string::npos);
}

TEST_P(CInterface, RefusesObserversThatCannotWork) {
  EXPECT_EQ(talus_watch(sleeper, nullptr, nullptr), TALUS_BAD_VALUE);
  EXPECT_EQ(talus_record(sleeper, nullptr, nullptr), TALUS_BAD_VALUE);
  EXPECT_EQ(talus_record(sleeper, "/no/such/folder/a.lcm", nullptr), TALUS_FAILED);
  talus_label label{};
  label.size = sizeof label;
  label.dt = -1.0;
  EXPECT_EQ(talus_record(sleeper, "a.lcm", &label), TALUS_BAD_VALUE);
  EXPECT_NE(std::string(talus_message()).find("dt"), std::string::npos);
  const talus_piece nothing{};
  EXPECT_EQ(talus_show(sleeper, 0, &nothing, 1), TALUS_BAD_VALUE);
  EXPECT_EQ(talus_end_observers(sleeper), TALUS_OK);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, CInterface, ::testing::Values(2, 3));

}  // namespace
}  // namespace talus::test
