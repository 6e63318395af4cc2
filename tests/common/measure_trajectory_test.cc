#include <gtest/gtest.h>

#include "common/measure/compare.h"
#include "tests/common/made_up_run.h"

namespace talus::measure_trajectory_test {
namespace {

TEST(Trajectory, KeepsPosesAsTheEnginesHaveThemInSinglePrecision) {
  BodyStates<3> states = states_at<3>({{0.1F, -2.7F, 1e-6F}, {3.0, 4.0, 5.0}});
  states.pose[1].rotation = Rotation<3>(Eigen::AngleAxisd(0.7, Vec3::UnitY()));
  states.asleep[1] = 1;
  Trajectory<3> run(1.0 / 60, 2);
  run.append(states, 2);
  EXPECT_EQ(run.position(0, 0), states.pose[0].position);
  EXPECT_LT(run.rotation(0, 1).angularDistance(states.pose[1].rotation), 1e-6);  // single precision
  EXPECT_FALSE(run.asleep(0, 0));
  EXPECT_TRUE(run.asleep(0, 1));
  EXPECT_DOUBLE_EQ(run.frame_time(), 1.0 / 30);
  EXPECT_EQ(run.step(0), 2);
}

TEST(Trajectory, KnowsWhichBodiesAreNotYetOrNoLongerThere) {
  Trajectory<2> run(0.01);
  run.append(states_at<2>({{0, 0}}), 1);
  run.append(states_at<2>({{0, 0}, {1, 0}}), 2);
  BodyStates<2> removed = states_at<2>({{0, 0}, {1, 0}});
  removed.removed[0] = 1;
  run.append(removed, 3);
  EXPECT_TRUE(run.present(0, 0));
  EXPECT_FALSE(run.present(0, 1)) << "not yet emitted";
  EXPECT_TRUE(run.present(1, 1));
  EXPECT_FALSE(run.present(2, 0)) << "removed";
  EXPECT_TRUE(run.present(2, 1));
}

TEST(Trajectory, RefusesFramesThatDoNotFollow) {
  Trajectory<2> run(0.01, 2);
  run.append(states_at<2>({{0, 0}, {1, 0}}), 2);
  EXPECT_THROW(run.append(states_at<2>({{0, 0}, {1, 0}}), 3), std::invalid_argument);
  EXPECT_THROW(run.append(states_at<2>({{0, 0}}), 4), std::invalid_argument);
  EXPECT_THROW(Trajectory<2>(0.0), std::invalid_argument);
  EXPECT_THROW(Trajectory<2>(0.01, 0), std::invalid_argument);
}

TEST(Trajectory, TellsEqualBodiesFromThoseThatDifferInTheLastBit) {
  Trajectory<2> a(0.01);
  Trajectory<2> b(0.01);
  a.append(states_at<2>({{1, 0}, {2, 0}}), 1);
  b.append(states_at<2>({{1, 0}, {2.0 + 3e-7, 0}}), 1);  // one unit in the last place of a float near 2 is 2.4e-7
  EXPECT_TRUE(a.same(0, b, 0));
  EXPECT_FALSE(a.same(0, b, 1));
  EXPECT_TRUE(a.same(0, b, 2)) << "absent in both";
}

TEST(Trajectory, LeavesUnknownBodiesAndLostFramesOutOfAllMeasures) {
  Trajectory<2> whole(0.01);
  Trajectory<2> harmed(0.01);
  for (int step = 1; step <= 4; ++step) {
    const auto states = states_at<2>({{0.1 * step, 0}, {2, 0.2 * step}});
    whole.append(states, step);
    const std::vector<std::uint8_t> unknown = {0, 1};
    if (step == 2) {
      harmed.append_lost(step);
    } else {
      harmed.append(step == 3 ? states_at<2>({{0.3, 0}, {7, 7}}) : states, step,
                    step == 3 ? unknown : std::vector<std::uint8_t>{});
    }
  }
  EXPECT_TRUE(harmed.lost(1));
  EXPECT_EQ(harmed.bodies(1), 0);
  EXPECT_FALSE(harmed.present(1, 0));
  EXPECT_FALSE(harmed.present(2, 1));
  EXPECT_TRUE(harmed.present(3, 1));
  for (int frame = 0; frame < 4; ++frame)
    EXPECT_TRUE(whole.same(frame, harmed, 0) && harmed.same(frame, whole, 1)) << frame;
  EXPECT_EQ(average(motion_errors<2>(whole, harmed, std::vector{1.0}, 9.81)).ratio, 0.0);
}

TEST(Trajectory, FindsTheLastFrameThatTwoRunsKnow) {
  Trajectory<2> a(0.01);
  Trajectory<2> b(0.01);
  EXPECT_EQ(last_common_frame(a, b), -1);
  for (int step = 1; step <= 3; ++step) a.append(states_at<2>({{0, 0}}), step);
  b.append(states_at<2>({{0, 0}}), 1);
  b.append_lost(2);
  EXPECT_EQ(last_common_frame(a, b), 0);
}

}  // namespace
}  // namespace talus::measure_trajectory_test
