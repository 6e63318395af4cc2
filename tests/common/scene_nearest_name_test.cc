#include <gtest/gtest.h>

#include <vector>

#include "common/text/nearest_name.h"

namespace talus::scene_nearest_name_test {
namespace {

TEST(EditDistance, CountsChangedAddedMissingAndSwappedLetters) {
  EXPECT_EQ(edit_distance("rate", "rate"), 0);
  EXPECT_EQ(edit_distance("rate", "rote"), 1);
  EXPECT_EQ(edit_distance("rate", "rates"), 1);
  EXPECT_EQ(edit_distance("rate", "rat"), 1);
  EXPECT_EQ(edit_distance("rate", "raet"), 1);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("", "rate"), 4);
}

TEST(EditDistance, TakesUpperAndLowerCaseForOne) { EXPECT_EQ(edit_distance("L", "l"), 0); }

TEST(NearestName, IsTheOneWithFewestSlips) {
  const std::vector<std::string> known = {"spread", "speed", "velocity"};
  EXPECT_EQ(nearest_name("sped", known), "speed");
  EXPECT_EQ(nearest_name("velocty", known), "velocity");
}

TEST(NearestName, MayBePartOfTheOther) {
  const std::vector<std::string> known = {"gravity", "velocity_iterations", "tau"};
  EXPECT_EQ(nearest_name("iterations", known), "velocity_iterations");
  EXPECT_EQ(nearest_name("tau_score", known), "tau");
}

TEST(NearestName, IsNoneIfNothingIsNear) {
  const std::vector<std::string> known = {"gravity", "tau"};
  EXPECT_EQ(nearest_name("colour", known), "");
  EXPECT_EQ(nearest_name("", known), "");
  EXPECT_EQ(nearest_name(std::string(1'000'000, 'x'), known), "");
}

}  // namespace
}  // namespace talus::scene_nearest_name_test
