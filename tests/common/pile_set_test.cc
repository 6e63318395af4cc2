// Counting (section 3.2): incremental counts equal a recount, whatever the bodies do.

#include "common/pile/pile_set.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "tests/common/counted_bodies.h"

namespace talus::pile_set_test {
namespace {

constexpr TypicalBody body{.bounding_volume = 0.4, .extent = 1.4, .mass = 1.0};
constexpr double dt = 1.0 / 60.0;

/// Coordinates on a grid of 1/64 m: sums of these are exact, so translations and mirror images lose no bit.
double any_coordinate(int reach) { return *rc::gen::inRange(-reach * 64, reach * 64) / 64.0; }

template <int Dim>
Vec<Dim> any_position() {
  Vec<Dim> at;
  for (int axis = 0; axis < Dim - 1; ++axis) at[axis] = any_coordinate(4);
  at[Dim - 1] = std::abs(any_coordinate(4));
  return at;
}

template <int Dim>
PileSet<Dim> pile_at(const Vec<Dim>& centre) {
  PileParams<Dim> params;
  params.at = centre;
  return PileSet<Dim>({params}, body);
}

template <int Dim>
std::vector<int> counts(const PileSet<Dim>& piles) {
  std::vector<int> list;
  for (const Layer& layer : piles.piles().front().layers) list.push_back(layer.count);
  return list;
}

template <int Dim>
void expect_counts_kept_through_a_history() {
  Bodies<Dim> bodies;
  PileSet<Dim> piles = pile_at<Dim>(Vec<Dim>::Zero());
  for (int step = 0; step < 70; ++step) {  // past two looks at the drifting centre
    bodies.add(any_position<Dim>());
    const auto pick = static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(bodies.states.shape.size())));
    switch (*rc::gen::inRange(0, 4)) {
      case 0:
        if (bodies.states.asleep[pick] == 0) bodies.states.pose[pick].position = any_position<Dim>();
        break;
      case 1:
        bodies.states.asleep[pick] = bodies.states.asleep[pick] == 0 ? 1 : 0;
        piles.recount_body(bodies.states, static_cast<BodyIndex>(pick));
        break;
      case 2:
        bodies.states.removed[pick] = 1;
        piles.recount_body(bodies.states, static_cast<BodyIndex>(pick));
        break;
      default:
        break;
    }
    piles.update(bodies.states, bodies.awake(), dt);
    RC_ASSERT(piles.counts_match(bodies.states));
    RC_ASSERT(piles.piles().front().occupation_ratio() <= 0.5);
    for (const Layer& layer : piles.piles().front().layers) {
      RC_ASSERT(std::isfinite(layer.density()) && layer.density() >= 0.0);
      RC_ASSERT(layer.sleeping <= layer.count);
    }
  }
}

RC_GTEST_PROP(PileCounts, EqualARecountAfterAnyHistoryIn2D, ()) { expect_counts_kept_through_a_history<2>(); }
RC_GTEST_PROP(PileCounts, EqualARecountAfterAnyHistoryIn3D, ()) { expect_counts_kept_through_a_history<3>(); }

/// Counts of `positions` around `centre` after one update.
std::vector<int> counts_of(const std::vector<Vec3>& positions, const Vec3& centre) {
  Bodies<3> bodies;
  for (const Vec3& at : positions) bodies.add(at);
  PileSet<3> piles = pile_at<3>(centre);
  piles.update(bodies.states, bodies.awake(), dt);
  return counts(piles);
}

RC_GTEST_PROP(PileCounts, DoNotChangeUnderTranslationMirrorImageOrRenumbering, ()) {
  std::vector<Vec3> positions;
  const int count = *rc::gen::inRange(1, 60);
  for (int i = 0; i < count; ++i) positions.push_back(any_position<3>());
  const std::vector<int> expected = counts_of(positions, Vec3::Zero());

  const Vec3 shift(any_coordinate(1000), any_coordinate(1000), any_coordinate(100));
  std::vector<Vec3> moved = positions;
  for (Vec3& at : moved) at += shift;
  RC_ASSERT(counts_of(moved, shift) == expected);

  std::vector<Vec3> mirrored = positions;
  for (Vec3& at : mirrored) at.x() = -at.x();
  RC_ASSERT(counts_of(mirrored, Vec3::Zero()) == expected);

  std::reverse(positions.begin(), positions.end());
  RC_ASSERT(counts_of(positions, Vec3::Zero()) == expected);
}

TEST(PileGrowth, DoublesTheStructureAboveHalfOccupation) {
  Bodies<3> bodies;
  PileSet<3> piles = pile_at<3>(Vec3::Zero());  // room for 8
  for (int i = 0; i < 4; ++i) bodies.add(Vec3(0.0, 0.0, 0.1));
  piles.update(bodies.states, bodies.awake(), dt);
  EXPECT_DOUBLE_EQ(piles.piles().front().structure_size, 8.0);
  bodies.add(Vec3(0.0, 0.0, 0.1));
  piles.update(bodies.states, bodies.awake(), dt);
  EXPECT_DOUBLE_EQ(piles.piles().front().structure_size, 16.0);
}

TEST(PileCentre, DriftsTowardsTheMeanOfItsBodies) {
  Bodies<3> bodies;
  bodies.add(Vec3(0.5, 0.0, 0.1));
  PileParams<3> params;
  params.at = Vec3::Zero();
  params.drift_rate = 1.0;
  PileSet<3> piles({params}, body);
  for (int step = 0; step < 30; ++step) piles.update(bodies.states, bodies.awake(), dt);
  // After half a second the share 1 - exp(-0.5) of the way; positions count in steps of 1/65536 m.
  EXPECT_NEAR(piles.piles().front().centre.x(), 0.5 * (1.0 - std::exp(-0.5)), 1e-5);
  EXPECT_EQ(piles.piles().front().centre.z(), 0.0);
}

TEST(PileCentre, StaysWithoutADriftRate) {
  Bodies<2> bodies;
  bodies.add(Vec2(0.5, 0.1));
  PileParams<2> params;
  params.at = Vec2::Zero();
  params.drift_rate = 0.0;
  PileSet<2> piles({params}, body);
  for (int step = 0; step < 60; ++step) piles.update(bodies.states, bodies.awake(), dt);
  EXPECT_EQ(piles.piles().front().centre.x(), 0.0);
}

TEST(PileCentre, StaysWhileNoBodyIsAwake) {
  Bodies<2> bodies;
  bodies.add(Vec2(0.5, 0.1));
  PileParams<2> params;
  params.at = Vec2::Zero();
  PileSet<2> piles({params}, body);
  piles.update(bodies.states, bodies.awake(), dt);
  for (int step = 0; step < 60; ++step) piles.update(bodies.states, {}, dt);
  EXPECT_EQ(piles.piles().front().centre.x(), 0.0);
  EXPECT_TRUE(piles.counts_match(bodies.states));
}

TEST(UnlocatedPile, BeginsAtTheGivenPlaceAndCountsTheBodiesThere) {
  Bodies<3> bodies;
  bodies.add(Vec3(7.0, 1.0, 0.1));
  PileSet<3> piles({PileParams<3>{}}, body);
  EXPECT_TRUE(piles.has_unplaced());
  EXPECT_TRUE(piles.piles().empty());
  piles.place(Vec3(7.0, 1.0, 0.0), bodies.states);
  EXPECT_FALSE(piles.has_unplaced());
  EXPECT_EQ(counts(piles).front(), 1);
}

/// Two piles on the x axis, `distance` apart, with three bodies on each.
std::pair<PileSet<3>, Bodies<3>> two_piles(double distance, double merge_distance, std::array<bool, 2> held = {},
                                           double drift_rate = PileParams<3>{}.drift_rate) {
  Bodies<3> bodies;
  std::vector<PileParams<3>> params(2);
  for (int side = 0; side < 2; ++side) {
    const Vec3 centre(side * distance, 0.0, 0.0);
    params[side].at = centre;
    params[side].merge_distance = merge_distance;
    params[side].drift_rate = drift_rate;
    params[side].alpha = 0.5;
    params[side].control_slope = held[side];
    for (int i = 0; i < 3; ++i) bodies.add(centre + Vec3(0.0, 0.0, 0.1));
  }
  return {PileSet<3>(params, body), bodies};
}

TEST(PilesNearEachOther, MergeIntoOneAtTheirCommonMean) {
  auto [piles, bodies] = two_piles(1.0, 1.0);
  for (int step = 0; step < 90; ++step) piles.update(bodies.states, bodies.awake(), dt);
  EXPECT_EQ(piles.piles()[1].merged_into, 0);
  EXPECT_TRUE(piles.piles()[1].layers.empty());
  EXPECT_NEAR(piles.piles()[0].centre.x(), 0.5, 0.02 * body.extent);
  EXPECT_TRUE(piles.counts_match(bodies.states));
}

TEST(PilesNearEachOther, StayHeldToTheirSlopeAsOneAndAsTheyGrow) {
  auto [piles, bodies] = two_piles(1.0, 1.0, {true, true});
  for (int step = 0; step < 90; ++step) piles.update(bodies.states, bodies.awake(), dt);
  EXPECT_EQ(piles.piles()[1].merged_into, 0);
  EXPECT_TRUE(piles.piles()[0].slope_controlled);
  EXPECT_FALSE(piles.piles()[1].slope_controlled);
  const double room = piles.piles()[0].structure_size;
  for (int i = 0; i < 40; ++i) bodies.add(Vec3(0.5, 0.0, 0.1));
  piles.update(bodies.states, bodies.awake(), dt);
  EXPECT_GT(piles.piles()[0].structure_size, room);
  EXPECT_TRUE(piles.piles()[0].slope_controlled);
}

TEST(PilesNearEachOther, StayApartWhereOnlyOneIsHeldToItsSlope) {
  auto [piles, bodies] = two_piles(1.0, 1.0, {true, false});
  for (int step = 0; step < 90; ++step) piles.update(bodies.states, bodies.awake(), dt);
  EXPECT_EQ(piles.piles()[1].merged_into, -1);
}

TEST(PilesNearEachOther, StayApartUntilTheyWereNearTwice) {
  auto [piles, bodies] = two_piles(1.0, 1.0);
  for (int step = 0; step < 59; ++step) {  // a look every 30 steps
    piles.update(bodies.states, bodies.awake(), dt);
    EXPECT_EQ(piles.piles()[1].merged_into, -1);
  }
}

TEST(PilesNearEachOther, StayApartWhereTheyPassEachOtherTwice) {
  auto [piles, bodies] = two_piles(2.5, 2.0, {}, 100.0);
  for (const double place : {2.5, 3.2, 2.5}) {  // of the second: near, too far, and near again
    for (int number = 3; number < 6; ++number) bodies.states.pose[number].position.x() = place;
    for (int step = 0; step < 30; ++step) piles.update(bodies.states, bodies.awake(), dt);  // to the next look
    EXPECT_NEAR(piles.piles()[1].centre.x(), place, 0.1);
    EXPECT_EQ(piles.piles()[1].merged_into, -1);
  }
}

TEST(PilesNearEachOther, StayApartWhereMergingIsOff) {
  auto [piles, bodies] = two_piles(1.0, 0.0);
  for (int step = 0; step < 90; ++step) piles.update(bodies.states, bodies.awake(), dt);
  EXPECT_EQ(piles.piles()[1].merged_into, -1);
}

TEST(PilesThatOverlap, BothCountTheBodiesBetweenThem) {
  auto [piles, bodies] = two_piles(1.5, 1.0);
  bodies.add(Vec3(0.75, 0.0, 0.1));
  piles.update(bodies.states, bodies.awake(), dt);
  EXPECT_EQ(piles.layer_of(0, 6), 0);
  EXPECT_EQ(piles.layer_of(1, 6), 0);
}

TEST(PileSet, CountsABodyInFlightOnlyWhereThePileSaysSo) {
  for (const bool count_flying : {true, false}) {
    Bodies<2> bodies;
    PileParams<2> params;
    params.alpha = 0.7;
    params.at = Vec2::Zero();
    params.count_flying = count_flying;
    PileSet<2> piles({params}, body);
    bodies.add(Vec2(0.0, 0.3));
    bodies.add(Vec2(0.0, 0.5));
    ASSERT_EQ(piles.needs_contacts(), !count_flying);
    const std::vector<Contact<2>> contacts = {{.a = 1, .b = ground_index}};
    if (piles.needs_contacts()) piles.note_contacts(contacts, bodies.states);
    piles.update(bodies.states, bodies.awake(), dt);
    EXPECT_EQ(counts(piles).front(), count_flying ? 2 : 1);
    EXPECT_TRUE(piles.counts_match(bodies.states));
  }
}

TEST(PileSet, CountsBodiesInFlightAsAnotherPolicyDoesOnceItIsSwitched) {
  Bodies<2> bodies;
  PileParams<2> params;
  params.alpha = 0.7;
  params.at = Vec2::Zero();
  PileParams<2> with_its_own = params;
  with_its_own.count_flying = true;
  PileSet<2> piles({params, with_its_own}, body, false);
  bodies.add(Vec2(0.0, 0.3));
  piles.update(bodies.states, bodies.awake(), dt);
  EXPECT_EQ(counts(piles).front(), 0);
  piles.count_flying(true, bodies.states);
  EXPECT_EQ(counts(piles).front(), 1);
  EXPECT_FALSE(piles.needs_contacts());
  piles.count_flying(false, bodies.states);
  EXPECT_EQ(counts(piles).front(), 0);
  EXPECT_EQ(piles.piles()[1].layers.front().count, 1);
  EXPECT_TRUE(piles.needs_contacts());
}

TEST(PileSet, KeepsTheMeanPlaceOfBodiesFarFromTheOrigin) {
  Bodies<2> bodies;
  PileSet<2> piles = pile_at<2>(Vec2(50'000.0, 0.0));
  for (int i = 0; i < 3; ++i) bodies.add(Vec2(50'000.0 + 0.25 * i, 0.3));
  for (int step = 0; step < 200; ++step) piles.update(bodies.states, bodies.awake(), dt);
  EXPECT_EQ(counts(piles).front(), 3) << "the centre drifts to that of the bodies";
  EXPECT_NEAR(piles.piles().front().centre.x(), 50'000.25, 0.26);
}

// A body that is asleep from the start is not awake when another one first touches it.
TEST(PileSet, CountsASleepingBodyOnceAnotherOneTouchesIt) {
  Bodies<2> bodies;
  PileParams<2> params;
  params.alpha = 0.7;
  params.at = Vec2::Zero();
  params.count_flying = false;
  PileSet<2> piles({params}, body);
  bodies.add(Vec2(0.0, 0.3));
  bodies.add(Vec2(0.0, 0.5));
  bodies.states.asleep[0] = 1;
  piles.update(bodies.states, bodies.awake(), dt);
  EXPECT_EQ(counts(piles).front(), 0);
  piles.note_contacts(std::vector<Contact<2>>{{.a = 0, .b = 1}}, bodies.states);
  piles.update(bodies.states, bodies.awake(), dt);
  EXPECT_EQ(counts(piles).front(), 2);
  EXPECT_TRUE(piles.counts_match(bodies.states));
}

}  // namespace
}  // namespace talus::pile_set_test
