// A pile whose slope is not given.

#include "common/pile/angle_of_repose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/pile/pile_set.h"
#include "tests/common/counted_bodies.h"

namespace talus::angle_of_repose_test {
namespace {

constexpr TypicalBody brick{.bounding_volume = 0.4, .extent = 1.4, .mass = 1.0};
constexpr double dt = 1.0 / 60.0;

/// Bodies evenly over a cone or wedge of that slope, in columns on both sides of the axis.
template <int Dim>
Bodies<Dim> heap(double slope, int rings) {
  constexpr double radius = 6.0;
  Bodies<Dim> bodies;
  for (int ring = 0; ring < rings; ++ring) {
    const double at = radius * (ring + 0.5) / rings;
    const double top = (radius - at) * std::tan(slope);
    // As many in a column as its share of the volume.
    const int column = std::max(1, static_cast<int>(std::lround(40.0 * top * (Dim == 3 ? at / radius : 1.0))));
    for (int i = 0; i < column; ++i) {
      Vec<Dim> place = Vec<Dim>::Zero();
      place[0] = i % 2 == 0 ? at : -at;
      place[Dim - 1] = top * (i + 0.5) / column;
      bodies.add(place);
    }
  }
  return bodies;
}

template <int Dim>
void expect_angle_of_repose_found() {
  for (const double slope : {0.3, 0.6, 0.9}) {
    const Bodies<Dim> bodies = heap<Dim>(slope, 60);
    PileParams<Dim> params;
    params.at = Vec<Dim>::Zero();
    PileSet<Dim> piles({params}, brick);
    std::vector<Contact<Dim>> contacts;
    for (const BodyIndex each : bodies.awake()) contacts.push_back({.a = each});
    ASSERT_TRUE(piles.needs_contacts()) << "bodies in flight are no part of the slope";
    piles.note_contacts(contacts, bodies.states);
    for (int step = 0; step < 90; ++step) piles.update(bodies.states, bodies.awake(), dt);
    // Sums over columns are exact to about a part in 60, and turns below a degree are not worth a new structure.
    EXPECT_NEAR(piles.piles().front().alpha, slope, 0.03);
    EXPECT_TRUE(piles.counts_match(bodies.states));
  }
}

TEST(PileWithoutASlope, TakesThatOfItsBodies) {
  expect_angle_of_repose_found<2>();
  expect_angle_of_repose_found<3>();
}

TEST(PileWithASlope, KeepsIt) {
  const Bodies<2> bodies = heap<2>(0.9, 60);
  PileParams<2> params;
  params.at = Vec2::Zero();
  params.alpha = 0.4;
  PileSet<2> piles({params}, brick);
  for (int step = 0; step < 90; ++step) piles.update(bodies.states, bodies.awake(), dt);
  EXPECT_EQ(piles.piles().front().alpha, 0.4);
}

}  // namespace
}  // namespace talus::angle_of_repose_test
