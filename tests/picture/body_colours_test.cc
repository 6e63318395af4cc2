#include "tools/picture/body_colours.h"

#include <gtest/gtest.h>

namespace talus::body_colours_test {
namespace {

double brightness(const Colour& colour) { return colour.red + colour.green + colour.blue; }

TEST(BodyColours, OfSleepingBodiesAreDarker) {
  const PictureParams params;
  const Colour colour = colour_of("#e5801a");
  EXPECT_LT(brightness(body_paint(params, 0, "#e5801a", true).fill), 0.6 * brightness(colour));
  EXPECT_EQ(body_paint(params, 0, "#e5801a", false).fill.red, colour.red);
  EXPECT_EQ(body_paint(params, 0, "", true).fill.red, params.asleep.red);
}

}  // namespace
}  // namespace talus::body_colours_test
