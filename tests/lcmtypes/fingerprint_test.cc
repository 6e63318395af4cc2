// A fingerprint follows from the names and types of all fields. It changes when a type changes, and then receivers and
// records of before no longer fit: make a new version (talus_run_v2) instead, or, before anybody has used it, pin anew.

#include <gtest/gtest.h>

#include "lcmtypes/channels.h"

namespace talus::fingerprint_test {
namespace {

using talus_lcm::talus_bodies_v1;
using talus_lcm::talus_event_v1;
using talus_lcm::talus_event_v2;
using talus_lcm::talus_obstacles_v1;
using talus_lcm::talus_piles_v1;
using talus_lcm::talus_piles_v2;
using talus_lcm::talus_run_v1;
using talus_lcm::talus_scene_v1;
using talus_lcm::talus_shapes_v1;
using talus_lcm::talus_sleep_v1;
using talus_lcm::talus_stats_v1;
using talus_lcm::talus_stats_v2;

std::uint64_t fingerprint(std::int64_t hash) { return static_cast<std::uint64_t>(hash); }

TEST(Fingerprint, OfEachTypeIsPinned) {
  EXPECT_EQ(fingerprint(talus_run_v1::getHash()), 0x96F65A489D62D600U);
  EXPECT_EQ(fingerprint(talus_piles_v1::getHash()), 0x955F09EC62238F61U);
  EXPECT_EQ(fingerprint(talus_piles_v2::getHash()), 0x9478FDAFE464F6D2U);
  EXPECT_EQ(fingerprint(talus_sleep_v1::getHash()), 0x81A04516E02D7E80U);
  EXPECT_EQ(fingerprint(talus_stats_v1::getHash()), 0xEA33F2068323C799U);
  EXPECT_EQ(fingerprint(talus_stats_v2::getHash()), 0xC80DBD6204EA8130U);
  EXPECT_EQ(fingerprint(talus_bodies_v1::getHash()), 0xC6FA8471FD1162E7U);
  EXPECT_EQ(fingerprint(talus_shapes_v1::getHash()), 0x081800A341BF37D4U);
  EXPECT_EQ(fingerprint(talus_event_v1::getHash()), 0x87134A84EDEA7967U);
  EXPECT_EQ(fingerprint(talus_event_v2::getHash()), 0x08CAFE02AB0A6093U);
  EXPECT_EQ(fingerprint(talus_obstacles_v1::getHash()), 0x00D92F75D07931CFU);
}

}  // namespace
}  // namespace talus::fingerprint_test
