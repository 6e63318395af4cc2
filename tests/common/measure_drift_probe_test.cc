// The drift of a pile, foreseen from its beginning.

#include <gtest/gtest.h>

#include <cmath>

#include "common/measure/drift_probe.h"
#include "common/measure/wake_test.h"
#include "common/shape/catalogue.h"
#include "tests/common/falling_world.h"
#include "tests/common/made_up_run.h"

namespace talus::measure_drift_probe_test {
namespace {

WorldDescription<3> cube_world() {
  WorldDescription<3> description;
  description.gravity = 10.0;
  description.dt = 1.0 / 128;
  description.shapes = {make_shape<3>("cube", box_pieces<3>(Vec3::Ones()), Material{})};
  return description;
}

/// Bodies that hang at these heights above the place where they come to rest [m].
BodyStates<3> hanging(const std::vector<double>& heights) {
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < heights.size(); ++i)
    places.emplace_back(3.0 * static_cast<double>(i), 0.0, 0.5 + heights[i]);
  return states_at<3>(places);
}

// sqrt(D/g) of a cube of 1 m.
const DriftProbeParams params{.unit = std::sqrt(std::sqrt(3.0) / 10.0), .duration = 5.0, .body_steps = 1e6, .stop = {}};

using Mask = std::vector<std::uint8_t>;

TEST(DriftProbe, EndsOnceTheMotionHasDiedOutWithTheWakeTestsResult) {
  const BodyStates<3> states = hanging({0.0, 0.2});
  const DriftProbe probe = probe_drift<3>(make_falling_world<3>, cube_world(), states, Mask{1, 1}, params);
  const WakeTest test = wake_test<3>(make_falling_world<3>, cube_world(), states);
  EXPECT_EQ(probe.bodies, 2);
  EXPECT_DOUBLE_EQ(probe.least, test.mean);
  EXPECT_DOUBLE_EQ(probe.most, test.mean);
  EXPECT_LT(probe.seconds, 1.0) << "the wake test takes 5 s, the fall 0.2 s";
}

TEST(DriftProbe, CountsTheGivenBodiesAlone) {
  const DriftProbe probe = probe_drift<3>(make_falling_world<3>, cube_world(), hanging({0.0, 0.2}), Mask{1, 0}, params);
  EXPECT_EQ(probe.bodies, 1);
  EXPECT_EQ(probe.expected(), 0.0);
  EXPECT_LT(probe.seconds, 3.5 * 0.4 * params.unit) << "no longer than the shortest probe";
}

// After 5 units of 0.42 s a free fall has gone 22 m and goes on.
TEST(DriftProbe, OfAMotionThatGoesOnLastsFiveUnitsAndTellsABoundAboveWhatItHasSeen) {
  const DriftProbe probe = probe_drift<3>(make_falling_world<3>, cube_world(), hanging({1000.0}), Mask{1}, params);
  EXPECT_NEAR(probe.seconds, 5.0 * params.unit, 0.4 * params.unit);
  EXPECT_NEAR(probe.least, 5.0 * probe.seconds * probe.seconds, 0.05 * probe.least) << "g t^2 / 2";
  EXPECT_GT(probe.most, 2.0 * probe.least);
}

TEST(DriftProbe, HasNoResultWhereItMayTakeFewerStepsThanTheShortestNeeds) {
  DriftProbeParams poor = params;
  poor.body_steps = 2.0 * 50.0;  // of two bodies 50 steps each; the shortest takes 3 times 21
  EXPECT_EQ(probe_drift<3>(make_falling_world<3>, cube_world(), hanging({0.2, 0.2}), Mask{1, 1}, poor).bodies, 0);
  poor.body_steps = 2.0 * 70.0;
  EXPECT_EQ(probe_drift<3>(make_falling_world<3>, cube_world(), hanging({0.2, 0.2}), Mask{1, 1}, poor).bodies, 2);
}

TEST(DriftProbe, HasNoResultWithoutBodiesAndWhenStopped) {
  EXPECT_EQ(probe_drift<3>(make_falling_world<3>, cube_world(), hanging({0.2}), Mask{0}, params).bodies, 0);
  DriftProbeParams stopped = params;
  int steps = 0;
  stopped.stop = [&] { return ++steps > 5; };
  EXPECT_EQ(probe_drift<3>(make_falling_world<3>, cube_world(), hanging({0.2}), Mask{1}, stopped).bodies, 0);
  EXPECT_EQ(steps, 6);
}

}  // namespace
}  // namespace talus::measure_drift_probe_test
