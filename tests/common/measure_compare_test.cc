#include <gtest/gtest.h>

#include "common/measure/compare.h"
#include "common/shape/catalogue.h"
#include "tests/common/made_up_run.h"

namespace talus::measure_compare_test {
namespace {

const std::vector<Shape<2>> discs = {make_shape<2>("disc", ball_pieces<2>(0.5), Material{})};

/// Ten discs in a row that move to the right by `speed` a frame from frame 3 on, lifted by `lift`.
Trajectory<2> row(double speed, double lift = 0.0) {
  return made_up_run<2>(8, 0.1, [=](int frame) {
    std::vector<Vec2> places;
    for (int i = 0; i < 10; ++i) places.emplace_back(i - 4.5 + speed * std::max(frame - 3, 0), 0.5 + lift);
    return places;
  });
}

TEST(RunComparison, OfEqualRunsFindsNothing) {
  const RunComparison<2> result = compare_runs<2>(row(0.1), row(0.1), discs, 9.81, {});
  EXPECT_FALSE(result.first_difference.has_value());
  EXPECT_EQ(result.frames, 8);
  EXPECT_EQ(result.motion_mean.absolute, 0.0);
  EXPECT_EQ(result.profile_rms, 0.0);
  EXPECT_EQ(result.z.wasserstein, 0.0);
}

TEST(RunComparison, NamesTheFirstFrameStepAndBodyThatDiffer) {
  const RunComparison<2> result = compare_runs<2>(row(0.0), row(0.2), discs, 9.81, {});
  ASSERT_TRUE(result.first_difference.has_value());
  EXPECT_EQ(result.first_difference->step, 5);
  EXPECT_EQ(result.first_difference->body, 0);
  const double extent = discs[0].extent;
  EXPECT_NEAR(result.position_mean.back(), 4 * 0.2 / extent, 1e-6);
  EXPECT_NEAR(result.position_max, 4 * 0.2 / extent, 1e-6);
}

TEST(RunComparison, MeasuresShapeInUnitsOfD) {
  const RunComparison<2> result = compare_runs<2>(row(0.0), row(0.0, 0.3), discs, 9.81, {});
  EXPECT_NEAR(result.profile_rms, 0.3 / discs[0].extent, 1e-6);
  EXPECT_NEAR(result.z.wasserstein, 0.3, 1e-6);
  EXPECT_NEAR(result.shape_b.peak - result.shape_a.peak, 0.3, 1e-6);
  EXPECT_EQ(result.r.wasserstein, 0.0);
}

TEST(RunComparison, SeesABodyThatOnlyOneRunHas) {
  const auto with = made_up_run<2>(2, 0.1, [](int) { return std::vector<Vec2>{{0, 0}, {1, 0}}; });
  const auto without = made_up_run<2>(2, 0.1, [](int) { return std::vector<Vec2>{{0, 0}}; });
  ASSERT_TRUE(first_difference(with, without).has_value());
  EXPECT_EQ(first_difference(with, without)->body, 1);
}

TEST(RunComparison, RefusesRunsThatCannotBeCompared) {
  EXPECT_THROW(compare_runs<2>(row(0.0), Trajectory<2>(0.1), discs, 9.81, {}), std::invalid_argument);
}

}  // namespace
}  // namespace talus::measure_compare_test
