#include <gtest/gtest.h>

#include <numbers>

#include "common/shape/catalogue.h"

namespace talus::shape_ring_test {
namespace {

using std::numbers::pi;

// A sum of n triangles with the circle's radius as two sides: what the regular polygon has instead of the disc's pi
// r^2.
double polygon_area(int corners, double radius) {
  return corners / 2.0 * std::sin(2.0 * pi / corners) * radius * radius;
}

TEST(RingShape, InThePlaneIsOneRegularPolygonLessAnother) {
  for (const int parts : {3, 8, 31}) {
    const RingParams params = {.outer_radius = 1.5, .inner_radius = 0.5, .parts = parts};
    const Shape<2> ring = make_shape("o", ring_pieces<2>(params), {});
    EXPECT_EQ(ring.pieces.size(), static_cast<std::size_t>(parts));
    EXPECT_NEAR(ring.volume, polygon_area(parts, 1.5) - polygon_area(parts, 0.5), 1e-12);
    EXPECT_LT(ring.reference.norm(), 1e-12);
  }
}

TEST(RingShape, HasTheSameBoundsInThePlaneAndAcrossTheHoleInSpace) {
  const Shape<2> flat = make_shape("o", ring_pieces<2>({}), {});
  const Shape<3> tube = make_shape("o", ring_pieces<3>({}), {});
  EXPECT_NEAR(flat.bounds.sizes().x(), 2.0, 1e-12);
  EXPECT_NEAR(flat.bounding_volume, 4.0, 1e-12);
  EXPECT_NEAR(tube.bounds.sizes().x(), 2.0, 1e-12);
  EXPECT_NEAR(tube.bounds.sizes().y(), 0.4, 1e-12);
  EXPECT_NEAR(tube.bounding_volume, 4.0 * 0.4, 1e-12);
}

// Pappus: area of the section times the way of its centre, which goes straight across each part. A regular polygon of m
// sides around a circle of radius a has the area m a^2 tan(pi / m).
TEST(RingShape, InSpaceHasTheVolumeOfPappus) {
  for (const int corners : {4, 6, 8}) {
    const RingParams params = {.outer_radius = 1.2, .inner_radius = 0.8, .parts = 10, .section_corners = corners};
    const Shape<3> ring = make_shape("o", ring_pieces<3>(params), {});
    const double section = corners * 0.2 * 0.2 * std::tan(pi / corners);
    EXPECT_NEAR(ring.volume, 10.0 * std::sin(2.0 * pi / 10.0) * 1.0 * section, 1e-12);
  }
}

TEST(RingShape, IsAsDeepAsAsked) {
  for (const int corners : {4, 6, 8}) {
    const Shape<3> ring = make_shape("o", ring_pieces<3>({.section_corners = corners, .depth = 0.3}), {});
    EXPECT_NEAR(ring.bounds.sizes().y(), 0.3, 1e-12);
    EXPECT_NEAR(ring.bounds.sizes().x(), 2.0, 1e-12);
  }
}

// With many parts a flat ring's inertia goes to m (r1^2 + r2^2) / 2 about its axis; the polygon's error is of order
// (2 pi / parts)^2.
TEST(RingShape, ApproachesTheRoundRingsInertia) {
  const Shape<2> ring = make_shape("o", ring_pieces<2>({.parts = 64}), {});
  const double round = ring.mass * (1.0 + 0.36) / 2.0;
  EXPECT_NEAR(ring.inertia(0, 0) / round, 1.0, 2.0 * pi / 64 * 2.0 * pi / 64);
}

TEST(RingShape, RefusesParametersThatMakeNoRing) {
  EXPECT_THROW(ring_pieces<2>({.inner_radius = 0.0}), std::invalid_argument);
  EXPECT_THROW(ring_pieces<2>({.inner_radius = 1.0}), std::invalid_argument);
  EXPECT_THROW(ring_pieces<3>({.outer_radius = NAN}), std::invalid_argument);
  EXPECT_THROW(ring_pieces<3>({.parts = 2}), std::invalid_argument);
  EXPECT_THROW(ring_pieces<3>({.section_corners = 5}), std::invalid_argument);
  EXPECT_THROW(ring_pieces<3>({.depth = -0.1}), std::invalid_argument);
}

}  // namespace
}  // namespace talus::shape_ring_test
