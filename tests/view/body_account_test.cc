// What a click on a body of `talus view SCENE` tells of it, on every engine.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "common/scene/read_scene.h"
#include "tests/view/engine_list.h"
#include "tools/serve/shown_run.h"

namespace talus::body_account_test {
namespace {

using Json = nlohmann::ordered_json;

class BodyAccount : public ::testing::TestWithParam<EngineChoice> {
 protected:
  /// A unit cube on another one, which stands on a box, beside a cube that touches their sides only.
  std::unique_ptr<ShownRun> tower(const std::string& policy) const {
    const auto [dimension, engine] = GetParam();
    const bool flat = dimension == 2;
    std::string text = fmt::format(
        "title = \"tower\"\ndimension = {}\nshape.cube = {{kind = \"box\", size = {}, density = 1000}}\n"
        "policy = {{kind = \"{}\"}}\nworld = {{gravity = 10}}\nrun = {{frames = 900}}\n[[pile]]\n"
        "[[obstacle]]\nname = \"plinth\"\nkind = \"box\"\nsize = {}\nposition = {}\n",
        dimension, flat ? "[1, 1]" : "[1, 1, 1]", policy, flat ? "[4, 1]" : "[4, 4, 1]",
        flat ? "[0, 0.5]" : "[0, 0, 0.5]");
    for (const auto& [x, z] : {std::pair{0.0, 1.5}, {-0.3, 2.5}, {1.0, 1.5}})
      text += fmt::format("[[body]]\nshape = \"cube\"\nposition = {}\n",
                          flat ? fmt::format("[{}, {}]", x, z) : fmt::format("[{}, 0, {}]", x, z));
    return show_run(parse_scene(text, "tower.toml", {}), engine, "tower.toml", true);
  }
};

INSTANTIATE_TEST_SUITE_P(Engines, BodyAccount, ::testing::ValuesIn(all_engines()), name_of_engine);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(BodyAccount);  // in a build without engines

std::vector<int> supports(const ShownRun& run, int body) {
  std::vector<int> on;
  const Json account = Json::parse(run.account(body));
  for (const Json& support : account["supports"]) on.push_back(support["on"]);
  return on;
}

/// Of the policy, by name; null where it has none.
Json reading(const ShownRun& run, int body, const std::string& name) {
  const Json account = Json::parse(run.account(body));
  for (const Json& each : account["readings"])
    if (each["name"] == name) return each;
  return {};
}

TEST_P(BodyAccount, NamesWhatABodyRestsOnAsleepOrAwake) {
  for (const char* policy : {"full", "adaptive"}) {
    const auto run = tower(policy);
    for (int step = 0; step < 600; ++step) run->step();
    EXPECT_EQ(supports(*run, 0), std::vector<int>{first_obstacle}) << policy << ": the plinth, not the cube beside it";
    EXPECT_EQ(supports(*run, 1), std::vector<int>{0}) << policy;
    EXPECT_EQ(supports(*run, 2), std::vector<int>{first_obstacle}) << policy;
  }
}

TEST_P(BodyAccount, HasTheForceOfASupportOnceContactsAreShown) {
  const auto run = tower("full");
  run->show_contacts(true);
  for (int step = 0; step < 240; ++step) run->step();
  const Json upper = Json::parse(run->account(1))["supports"];
  ASSERT_EQ(upper.size(), 1U);
  EXPECT_NEAR(upper[0]["force"].get<double>(), 1e4, 300.0) << "weight of 1000 kg at 10 m/s^2; what the solver leaves";
}

TEST_P(BodyAccount, HasWhatThePolicyHasAndNoMore) {
  const auto full = tower("full");
  const auto paper = tower("paper");
  const auto adaptive = tower("adaptive");
  for (const auto* run : {&full, &paper, &adaptive})
    for (int step = 0; step < 2; ++step) (*run)->step();
  EXPECT_TRUE(Json::parse(full->account(0))["readings"].empty());
  const Json density = reading(*paper, 0, "density of its layer");
  ASSERT_FALSE(density.is_null());
  EXPECT_EQ(density["threshold"], 0.8);
  EXPECT_TRUE(reading(*paper, 0, "at rest for").is_null());
  const Json rest = reading(*adaptive, 0, "at rest for");
  ASSERT_FALSE(rest.is_null());
  EXPECT_GT(rest["threshold"].get<double>(), 0.0);
  EXPECT_LE(rest["value"].get<double>(), 2.0 / 60.0 + 1e-9);
  for (int step = 0; step < 600; ++step) adaptive->step();
  EXPECT_TRUE(reading(*adaptive, 0, "at rest for").is_null()) << "asleep";
}

TEST_P(BodyAccount, OfABodyThatIsNotThereHasItsNumberOnly) {
  const auto run = tower("full");
  run->step();
  EXPECT_EQ(run->remove(1), "");
  for (const std::int64_t body : {std::int64_t{1}, std::int64_t{3}, std::int64_t{-1}, std::int64_t{1} << 40})
    EXPECT_FALSE(Json::parse(run->account(body)).contains("supports"));
}

}  // namespace
}  // namespace talus::body_account_test
