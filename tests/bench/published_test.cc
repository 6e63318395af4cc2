// Published experiments: their file, fits and comparison, and all of their runs shortened.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "common/scene/diagnostics.h"
#include "tests/common/temporary_folder.h"
#include "tests/process/process.h"
#include "tools/bench/janssen.h"
#include "tools/bench/published_run.h"
#include "tools/bench/published_table.h"
#include "tools/run/backends.h"

namespace talus::published_test {
namespace {

namespace fs = std::filesystem;

const fs::path scenes = fs::path(TALUS_SOURCE_DIR) / "scenes" / "published";

/// The first three frames of each setting of an experiment on each engine give what the experiment measures.
void expect_values_of(const Experiment& experiment, const fs::path& folder) {
  const AnyScene scene = read_scene(experiment.scene);
  for (const std::string& engine : backends(scene.index() == 0 ? 2 : 3)) {
    for (const ExperimentRow& row : experiment.rows) {
      SCOPED_TRACE(experiment.name + ", " + row.name + ", " + engine);
      std::vector<std::string> settings = row.settings;
      settings.emplace_back("run.frames=3");
      const auto summary = published_run({experiment.scene, engine, "full", settings, 1}, folder);
      EXPECT_TRUE(summary.contains(nlohmann::json::json_pointer(experiment.value))) << experiment.value;
    }
  }
}

TEST(PublishedExperiments, EachRowRunsAndHasItsValueOnEachEngine) {
  const TemporaryFolder folder;
  const std::vector<Experiment> experiments = read_experiments(scenes / "experiments.toml");
  EXPECT_GE(experiments.size(), 16U);
  for (const Experiment& each : experiments) expect_values_of(each, folder.path());
}

TEST(PublishedExperiments, EachSceneBelongsToAnExperiment) {
  const std::vector<Experiment> experiments = read_experiments(scenes / "experiments.toml");
  for (const auto& entry : fs::directory_iterator(scenes)) {
    if (entry.path().extension() != ".toml" || entry.path().stem() == "experiments") continue;
    EXPECT_NE(std::ranges::find(experiments, entry.path().stem().string(), &Experiment::name), experiments.end())
        << entry.path();
  }
}

TEST(PublishedExperiments, AnArchStandsAboveAndFallsBelowTheLeastThicknessOnEachEngine) {
  const TemporaryFolder folder;
  const Outcome outcome = talus_command("bench published arch_2d --seeds 1 --out " + (folder / "out"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string page = contents(folder.path() / "out" / "published.md");
  for (const std::string& engine : backends(2)) {
    EXPECT_NE(page.find("| t/R = 0.103 | " + engine + " | 0 | 0 of 1 | 0 | yes | 0 of 1 | 0 | yes |"), page.npos)
        << page;
    EXPECT_NE(page.find("| t/R = 0.112 | " + engine + " | 1 | 1 of 1 | 0 | yes | 1 of 1 | 0 | yes |"), page.npos)
        << page;
  }
}

TEST(PublishedExperiments, RowsThatSetTheSameAreOneRunAndTheLoadsInAColumnFollowJanssensLaw) {
  const TemporaryFolder folder;
  const Outcome outcome =
      talus_command("bench published floor_load_2d --backend box2d --policy full --seeds 1 --out " + (folder / "out"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("[5/5] "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("9 runs, 0 failed"), std::string::npos) << outcome.out;
  const std::string page = contents(folder.path() / "out" / "published.md");
  const std::string row = "| saturation over the formula | box2d | 1 | ";
  ASSERT_NE(page.find(row), page.npos) << page;
  EXPECT_NEAR(std::stod(page.substr(page.find(row) + row.size())), 1.0, 0.3) << "seeds scatter by 0.15";
}

TEST(PublishedExperiments, AnUnknownNameAndAnOptionThatDoesNotApplyAreRefused) {
  const Outcome unknown = talus_command("bench published arc");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("published arc: must be one of"), std::string::npos) << unknown.err;
  const Outcome setting = talus_command("bench published --set run.frames=1");
  EXPECT_EQ(setting.exit_code, 2);
  EXPECT_NE(setting.err.find("must be left out"), std::string::npos) << setting.err;
}

TEST(PublishedExperiments, AllErrorsOfAFileComeAtOnceWithTheirPlaces) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "experiments.toml";
  std::ofstream(file)
      << "[[experiment]]\ntitle = \"t\"\nsource = \"s\"\nscene = \"none\"\nvalue = \"net\"\n"
         "fit = [{name = \"p\", kind = \"line\"}]\nrow = [{name = \"r\", published = [1, 2, 3], value = "
         "\"net\"}]\n";
  try {
    read_experiments(file);
    FAIL();
  } catch (const SceneErrors& errors) {
    const std::string text = errors.what();
    for (const char* part : {":4:9: experiment[0].scene = \"none\": must be the name of a scene beside this file",
                             ":6:28: experiment[0].fit[0].kind = \"line\": must be one of exponent, factor",
                             "experiment[0].row[0].published", "must be one number or two",
                             "experiment[0].row[0].value = \"net\": must be a JSON pointer"})
      EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  }
}

TEST(Fits, FindTheLawThatTheValuesFollow) {
  const std::vector<double> x = {1.0, 2.0, 4.0, 7.0};
  std::vector<double> power;
  for (const double each : x) power.push_back(3.0 * std::pow(each, 2.5));
  EXPECT_NEAR(fitted({.kind = "exponent"}, x, power), 2.5, 1e-9);
  EXPECT_NEAR(fitted({.kind = "factor", .power = 2.5}, x, power), 3.0, 1e-9);
}

TEST(Fits, HaveNoNumberWhereAValueIsMissing) {
  EXPECT_TRUE(std::isnan(fitted({.kind = "exponent"}, {1.0, 2.0}, {1.0, BenchNumbers::none})));
  EXPECT_TRUE(std::isnan(fitted({.kind = "exponent"}, {1.0, 2.0}, {1.0, 0.0})));
}

TEST(JanssensLaw, IsFoundInTheLoadsOfAColumnThatFollowsIt) {
  constexpr double saturation = 80.0, decay_length = 5.0, weight_per_metre = saturation / decay_length;
  std::vector<ColumnSlice> slices;
  for (double depth = 1.0; depth < 20.0; depth += 2.0) {
    const double load = saturation * (1.0 - std::exp(-depth / decay_length));
    slices.push_back({.depth = depth, .thickness = 2.0, .load = load, .carried = 2.0 * load / decay_length});
  }
  const JanssenLaw fit = fitted_law(slices);  // tries lengths that are 0.6 % apart
  EXPECT_NEAR(fit.saturation, saturation, 0.006 * saturation);
  EXPECT_NEAR(fit.decay_length, decay_length, 0.006 * decay_length);
  const JanssenLaw formula = law_by_formula(slices, weight_per_metre);
  EXPECT_NEAR(formula.saturation, saturation, 1e-9);
  EXPECT_NEAR(formula.decay_length, decay_length, 1e-9);
  EXPECT_TRUE(std::isnan(fitted_law(std::span(slices).first(2)).saturation));
}

TEST(Differences, CountFromTheEndOfAPublishedIntervalAndAgreeWithinTwoErrors) {
  const Published interval{.values = {2.0, 3.0}};
  EXPECT_EQ(difference({2.5, 0.1}, interval).value, 0.0);
  EXPECT_TRUE(difference({2.5, 0.1}, interval).agrees);
  EXPECT_NEAR(difference({3.3, 0.1}, interval).value, 0.3, 1e-12);
  EXPECT_FALSE(difference({3.3, 0.1}, interval).agrees);
  EXPECT_TRUE(difference({3.3, 0.1}, {.values = {2.0, 3.0}, .error = 0.2}).agrees);
  EXPECT_TRUE(std::isnan(difference({3.3, 0.1}, {}).value));
}

TEST(Differences, AShareOfFewRunsIsNeverCertain) {
  EXPECT_TRUE(difference(mean_of({1.0, 1.0, 1.0, 1.0}, true), {.values = {0.9}}).agrees);
  EXPECT_FALSE(difference(mean_of({1.0, 1.0, 1.0, 1.0}, true), {.values = {0.5}}).agrees);
}

}  // namespace
}  // namespace talus::published_test
