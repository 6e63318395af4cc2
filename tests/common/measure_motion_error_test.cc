#include <gtest/gtest.h>

#include <cmath>

#include "common/measure/divergence.h"
#include "common/measure/motion_error.h"
#include "tests/common/made_up_run.h"

namespace talus::measure_motion_error_test {
namespace {

const std::vector<double> one_metre = {1.0};
constexpr double frame_time = 0.125;
constexpr double gravity = 8.0;  // m0 = 8 / 64 = 0.125 m, exact in binary

/// Two bodies: the first moves by `step` along x each frame, the second stands still.
Trajectory<2> mover(double step, int frames = 5) {
  return made_up_run<2>(frames, frame_time, [&](int frame) {
    return std::vector<Vec2>{{step * frame, 0.0}, {10.0, 0.0}};
  });
}

TEST(MotionError, IsZeroForEqualRuns) {
  for (const MotionError& error : motion_errors<2>(mover(0.5), mover(0.5), one_metre, gravity)) {
    EXPECT_EQ(error.bodies, 2);
    EXPECT_EQ(error.left_out, 0.5) << "the body at rest";
    EXPECT_EQ(error.relative, 0.0);
    EXPECT_EQ(error.absolute, 0.0);
    EXPECT_EQ(error.ratio, 0.0);
    EXPECT_EQ(error.symmetric, 0.0);
  }
}

TEST(MotionError, FollowsSection424AndItsVariants) {
  const auto errors = motion_errors<2>(mover(0.5), mover(0.25), one_metre, gravity);
  ASSERT_EQ(errors.size(), 4U);
  const MotionError& error = errors[2];
  EXPECT_DOUBLE_EQ(error.relative, 0.25 / 0.5) << "over the one body that moves";
  EXPECT_DOUBLE_EQ(error.absolute, 0.25 / 2 / 0.125) << "over both bodies, in units of m0";
  EXPECT_DOUBLE_EQ(error.floored, 0.5 * (0.25 / 0.5));
  EXPECT_DOUBLE_EQ(error.ratio, 0.25 / (0.5 + 2 * 0.125));
  EXPECT_DOUBLE_EQ(error.symmetric, 0.25 / (0.5 + 0.25 + 2 * 0.125));
}

TEST(MotionError, IsZeroBetweenABodyThatCrossesAPeriodicSideAndOneThatMovesAlikeInTheMiddle) {
  const Periodic<2> sides{.low = {0.0, 0.0}, .period = {4.0, 0.0}};
  const auto run_from = [&](double start) {
    return made_up_run<2>(
        5, frame_time,
        [&](int frame) {
          return std::vector<Vec2>{sides.inside({start + 0.5 * frame, 0.0})};
        },
        sides);
  };
  const std::vector<double> apart = position_differences(run_from(3.0), run_from(1.5));
  for (const double distance : apart) EXPECT_DOUBLE_EQ(distance, 1.5);
  for (const MotionError& error : motion_errors<2>(run_from(3.0), run_from(1.5), one_metre, gravity))
    EXPECT_DOUBLE_EQ(error.absolute, 0.0);
}

TEST(MotionError, OfAFrozenBodyIsExactlyOneInThePapersForm) {
  EXPECT_DOUBLE_EQ(average(motion_errors<2>(mover(0.5), mover(0.0), one_metre, gravity)).relative, 1.0);
}

TEST(MotionError, LeavesTheRelativeFormUndefinedWhereNothingMoves) {
  const MotionError mean = average(motion_errors<2>(mover(0.0), mover(0.5), one_metre, gravity));
  EXPECT_TRUE(std::isnan(mean.relative));
  EXPECT_DOUBLE_EQ(mean.left_out, 1.0);
  EXPECT_DOUBLE_EQ(mean.floored, 0.5 * (0.5 / 0.125)) << "floored by one frame of free fall";
}

TEST(MotionError, LooksOnlyAtBodiesPresentInBothRuns) {
  const Trajectory<2> alone = made_up_run<2>(5, frame_time, [](int frame) {
    return std::vector<Vec2>{{0.5 * frame, 0}};
  });
  for (const MotionError& error : motion_errors<2>(mover(0.5), alone, one_metre, gravity)) EXPECT_EQ(error.bodies, 1);
}

TEST(MotionError, MeasuresTurningByExtentTimesAngle) {
  const auto spinning = [](double turn) {
    Trajectory<3> run(frame_time);
    for (int frame = 0; frame < 3; ++frame) {
      BodyStates<3> states = states_at<3>({{0, 0, 0}});
      states.pose[0].rotation = Rotation<3>(Eigen::AngleAxisd(turn * frame, Vec3::UnitZ()));
      run.append(states, frame);
    }
    return run;
  };
  const std::vector<double> extents = {2.0};
  const auto errors = motion_errors<3>(spinning(0.3), spinning(0.1), extents, gravity);
  EXPECT_NEAR(errors[1].turning, 2.0 * 0.2 / (2.0 * 0.3 + 0.125), 1e-5);  // single precision
}

TEST(MotionError, AveragesOverTheFramesThatHaveBodies) {
  std::vector<MotionError> errors(4);
  for (std::size_t j = 0; j < errors.size(); ++j) {
    errors[j].bodies = j == 0 ? 0 : 1;
    errors[j].ratio = static_cast<double>(j);
  }
  EXPECT_DOUBLE_EQ(average(errors).ratio, 2.0) << "the frame without bodies does not count";
}

TEST(MotionError, RefusesRunsOfDifferentFrames) {
  EXPECT_THROW(motion_errors<2>(mover(0.5), Trajectory<2>(0.5), one_metre, gravity), std::invalid_argument);
}

TEST(Divergence, MeasuresPlacesFrameByFrame) {
  const std::vector<double> apart = position_differences(mover(0.5), mover(0.25));
  ASSERT_EQ(apart.size(), 5U);
  EXPECT_DOUBLE_EQ(apart[4], 0.5);  // (1 m + 0 m) / 2 after four frames
}

}  // namespace
}  // namespace talus::measure_motion_error_test
