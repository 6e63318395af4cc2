#include "common/text/base64.h"

#include <gtest/gtest.h>

namespace talus::base64_test {
namespace {

TEST(Base64, OfTheVectorsOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(Base64, OfBytesThatAreNoText) { EXPECT_EQ(base64("\xff\xfe\xfb\xef"), "//777w=="); }

}  // namespace
}  // namespace talus::base64_test
