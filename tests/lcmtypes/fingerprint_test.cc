// A fingerprint follows from the names and types of all fields. It changes when a type changes, and then receivers and
// records of before no longer fit: raise talus_run::FORMAT, by which they are refused, and pin anew.

#include <gtest/gtest.h>

#include "lcmtypes/channels.h"

namespace talus::fingerprint_test {
namespace {

using talus_lcm::talus_bodies;
using talus_lcm::talus_contacts;
using talus_lcm::talus_event;
using talus_lcm::talus_instruments;
using talus_lcm::talus_obstacles;
using talus_lcm::talus_piles;
using talus_lcm::talus_run;
using talus_lcm::talus_scene;
using talus_lcm::talus_shapes;
using talus_lcm::talus_sleep;
using talus_lcm::talus_stats;

std::uint64_t fingerprint(std::int64_t hash) { return static_cast<std::uint64_t>(hash); }

TEST(Fingerprint, OfEachTypeIsPinned) {
  EXPECT_EQ(fingerprint(talus_run::getHash()), 0xD12C1566EEFAB08CU);
  EXPECT_EQ(fingerprint(talus_piles::getHash()), 0x9478FDAFE464F6D2U);
  EXPECT_EQ(fingerprint(talus_sleep::getHash()), 0x81A04516E02D7E80U);
  EXPECT_EQ(fingerprint(talus_stats::getHash()), 0x1152B025D1F1E02FU);
  EXPECT_EQ(fingerprint(talus_bodies::getHash()), 0xC6FA8471FD1162E7U);
  EXPECT_EQ(fingerprint(talus_shapes::getHash()), 0xAB1C584AF8545F4CU);
  EXPECT_EQ(fingerprint(talus_event::getHash()), 0x6F5F4E167CF5A516U);
  EXPECT_EQ(fingerprint(talus_obstacles::getHash()), 0x00D92F75D07931CFU);
  EXPECT_EQ(fingerprint(talus_instruments::getHash()), 0x29B2D368B10D1C0FU);
  EXPECT_EQ(fingerprint(talus_contacts::getHash()), 0x906F0411ACA0F398U);
}

}  // namespace
}  // namespace talus::fingerprint_test
