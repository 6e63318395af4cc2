#include "common/policy/gravity_change.h"

#include <gtest/gtest.h>

namespace talus::gravity_change_test {
namespace {

// A body of 1 m falls by half of its extent in sqrt(D/g), half a second at 4 m/s^2. Less than 0.01 m/s^2 counts as
// that, so without weight the time is 10 s.
TEST(GravityChange, KeepsBodiesAwakeForTwiceTheTimeInWhichTheyFallByHalfTheirExtent) {
  GravityChange<2> change(Vec2(0.0, -9.81), 1.0);
  EXPECT_FALSE(change.keeps_awake(0.0)) << "nothing has changed";
  EXPECT_TRUE(change.wakes(Vec2(0.0, -4.0)));
  change.note_wake(Vec2(0.0, -4.0), 10.0);
  EXPECT_FALSE(change.wakes(Vec2(0.0, -4.0)));
  EXPECT_TRUE(change.keeps_awake(10.99));
  EXPECT_FALSE(change.keeps_awake(11.01));
  change.note_wake(Vec2::Zero(), 20.0);
  EXPECT_TRUE(change.keeps_awake(39.9));
  EXPECT_FALSE(change.keeps_awake(40.1));
}

}  // namespace
}  // namespace talus::gravity_change_test
