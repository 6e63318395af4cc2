#include "tools/picture/body_colours.h"

#include <gtest/gtest.h>

#include <cmath>

namespace talus::body_colours_test {
namespace {

double brightness(const Colour& colour) { return colour.red + colour.green + colour.blue; }

TEST(BodyColours, OfKindsNameThoseThatOccur) {
  const BodyColours colours =
      colours_of_kinds(std::vector<int>{2, 0, 2, -1}, std::vector<std::string>{"box", "ball", "ring"}, "no kind");
  ASSERT_EQ(colours.awake.size(), 4U);
  EXPECT_EQ(colours.awake[0].red, colours.awake[2].red);
  EXPECT_NE(colours.awake[0].red, colours.awake[1].red);
  ASSERT_EQ(colours.legend.size(), 3U);
  EXPECT_EQ(colours.legend[0].text, "box");
  EXPECT_EQ(colours.legend[1].text, "ring");
  EXPECT_EQ(colours.legend[2].text, "no kind");
}

TEST(BodyColours, OfValuesGoFromBlueToRedAndStayThereBeyondTheScale) {
  const BodyColours colours =
      colours_of_values(std::vector<double>{0.0, 5.0, 10.0, 30.0, std::nan("")}, 0.0, 10.0, "speed", "no value");
  EXPECT_GT(colours.awake[0].blue, colours.awake[0].red);
  EXPECT_NEAR(colours.awake[1].blue, colours.awake[1].red, 1e-12) << "grey in the middle";
  EXPECT_GT(colours.awake[2].red, colours.awake[2].blue);
  EXPECT_EQ(colours.awake[3].red, colours.awake[2].red);
  ASSERT_EQ(colours.legend.size(), 2U);
  EXPECT_EQ(colours.legend[0].text, "speed");
  EXPECT_EQ(colours.legend[1].text, "no value");
}

TEST(BodyColours, OfSleepingBodiesAreDarker) {
  const PictureParams params;
  const Colour colour = {0.9, 0.5, 0.1};
  EXPECT_LT(brightness(body_paint(params, 0, "", true, &colour).fill), 0.6 * brightness(colour));
  EXPECT_EQ(body_paint(params, 0, "", false, &colour).fill.red, colour.red);
  EXPECT_EQ(body_paint(params, 0, "", true, nullptr).fill.red, params.asleep.red);
}

}  // namespace
}  // namespace talus::body_colours_test
