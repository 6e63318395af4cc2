#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numbers>

#include "common/shape/catalogue.h"
#include "common/shape/polygon.h"
#include "common/shape/polygon_partition.h"
#include "tests/common/shape_generators.h"

namespace talus::shape_partition_test {
namespace {

using std::numbers::pi;

double total_area(const std::vector<std::vector<Vec2>>& pieces) {
  double sum = 0.0;
  for (const std::vector<Vec2>& piece : pieces) sum += signed_area(piece);
  return sum;
}

int pieces_holding(const std::vector<std::vector<Vec2>>& pieces, const Vec2& point) {
  int count = 0;
  for (const std::vector<Vec2>& piece : pieces) {
    bool inside = true;
    for (std::size_t i = 0; i < piece.size(); ++i)
      inside = inside && cross(piece[i], piece[(i + 1) % piece.size()], point) > 0.0;
    count += inside ? 1 : 0;
  }
  return count;
}

// By the number of edges that a ray to the right crosses.
bool inside(const std::vector<Vec2>& corners, const Vec2& point) {
  bool odd = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2& a = corners[i];
    const Vec2& b = corners[(i + 1) % corners.size()];
    if ((a.y() > point.y()) != (b.y() > point.y()))
      odd ^= point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
  }
  return odd;
}

const std::vector<Vec2> l_corners = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.3}, {0.3, 0.3}, {0.3, 1.0}, {0.0, 1.0}};

TEST(Partition, OfAnLIsTwoQuadsWithItsAreaNotItsHulls) {
  const auto pieces = convex_partition(l_corners);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces[0].size(), 4u);
  EXPECT_EQ(pieces[1].size(), 4u);
  EXPECT_NEAR(total_area(pieces), 0.51, 1e-15);  // the hull has 0.755
}

TEST(Partition, LeavesAConvexPolygonWholeUnlessItHasTooManyCorners) {
  const auto regular = [](int count) {
    std::vector<Vec2> corners;
    for (int i = 0; i < count; ++i) corners.push_back({std::cos(2.0 * pi * i / count), std::sin(2.0 * pi * i / count)});
    return corners;
  };
  EXPECT_EQ(convex_partition(regular(3)).size(), 1u);
  EXPECT_EQ(convex_partition(regular(8)).size(), 1u);
  // 20 corners cut along diagonals: p pieces have 20 + 2 (p - 1) corners between them, so 8 a piece take at least 3.
  EXPECT_GE(convex_partition(regular(20)).size(), 3u);
  EXPECT_LE(convex_partition(regular(20)).size(), 6u);
}

TEST(Partition, TakesCornersEitherWayRoundAndLeavesOutThoseOnAStraightEdge) {
  std::vector<Vec2> corners = l_corners;
  corners.insert(corners.begin() + 1, {{0.2, 0.0}, {0.7, 0.0}});
  std::reverse(corners.begin(), corners.end());
  const auto pieces = convex_partition(corners);
  EXPECT_EQ(pieces.size(), 2u);
  EXPECT_NEAR(total_area(pieces), 0.51, 1e-15);
}

TEST(Partition, CutsACombWithManyCornersOnOneLine) {
  std::vector<Vec2> comb = {{0.0, 0.0}, {21.0, 0.0}};
  for (int tooth = 10; tooth >= 0; --tooth) {
    const double x = 2.0 * tooth;
    comb.insert(comb.end(), {{x + 1.0, 3.0}, {x, 3.0}});
    if (tooth > 0) comb.insert(comb.end(), {{x, 1.0}, {x - 1.0, 1.0}});
  }
  const auto pieces = convex_partition(comb);
  EXPECT_NEAR(total_area(pieces), 21.0 + 11.0 * 2.0, 1e-12);
  EXPECT_LE(pieces.size(), 31u);  // 20 reflex corners and a limit of 8 corners leave at least 11
}

TEST(Partition, RefusesWhatIsNoSimplePolygon) {
  const auto refuse = [](const std::vector<Vec2>& corners, const std::string& part) {
    try {
      convex_partition(corners);
      ADD_FAILURE() << part << " was accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  refuse({{0.0, 0.0}, {1.0, 0.0}}, "size = 2");
  refuse({{0.0, 0.0}, {1.0, 1.0}, {1.0, 0.0}, {0.0, 1.0}}, "must not touch");              // a bow tie
  refuse({{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {1.0, 0.0}, {0.0, 1.0}}, "must not touch");  // a corner on an edge
  refuse({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {1.0, 1.0}, {0.0, 1.0}}, "corners[2]");      // one twice
  refuse({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}, {0.0, 0.0}}, "corners[4]");      // closed by hand
  refuse({{0.0, 0.0}, {2.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}, "without width");               // a spike
  refuse({{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}}, "without width");                           // a line
  refuse({{0.0, 0.0}, {1.0, 0.0}, {NAN, 1.0}}, "must be finite");
  refuse({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1e-8}, {0.0, 1e-8}}, "thinner");
}

std::vector<Vec2> random_star() {
  const int count = *rc::gen::inRange(3, 60);
  std::vector<Vec2> corners;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * pi * (i + test::random_number(-0.3, 0.3)) / count;
    const double radius = test::random_number(0.2, 1.0);
    corners.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return corners;
}

RC_GTEST_PROP(Partition, CoversAStarShapedPolygonOnceWithStrictlyConvexPieces, ()) {
  const std::vector<Vec2> corners = random_star();
  RC_PRE(signed_area(corners) > 0.0);  // three corners may leave the centre outside
  const auto pieces = convex_partition(corners);
  // Corners that stand out of a straight edge by less than `flatness` of the polygon's size are left out, each with a
  // triangle of area.
  const double left_out =
      0.5 * flatness * 8.0 * static_cast<double>(corners.size());  // the star's size is below sqrt(8)
  RC_ASSERT(std::abs(total_area(pieces) - signed_area(corners)) < left_out);
  RC_ASSERT(pieces.size() <= corners.size() - 2);
  for (const std::vector<Vec2>& piece : pieces) {
    RC_ASSERT(piece.size() >= 3u && piece.size() <= most_corners);
    RC_ASSERT(!non_convex_corner(piece).has_value());
  }
  const Vec2 point = test::random_point<2>(1.0) + Vec2(1.23e-5, 4.56e-5);  // off any edge that the grid may hit
  RC_ASSERT(pieces_holding(pieces, point) == (inside(corners, point) ? 1 : 0));
}

TEST(PolygonPieces, InSpaceAreThoseInThePlaneDrawnOutAlongY) {
  const Shape<2> flat = make_shape("l", polygon_pieces<2>(l_corners), {.density = 1.0});
  const Shape<3> solid = make_shape("l", polygon_pieces<3>(l_corners, 0.5), {.density = 1.0});
  const Shape<2> boxes = make_shape("l", l_pieces<2>({.thickness = 0.3}), {.density = 1.0});
  EXPECT_NEAR(flat.inertia(0, 0), boxes.inertia(0, 0), 1e-14);
  EXPECT_LT((flat.reference - boxes.reference).norm(), 1e-14);
  EXPECT_NEAR(solid.volume, 0.5 * 0.51, 1e-14);
  EXPECT_NEAR(solid.inertia(1, 1), 0.5 * flat.inertia(0, 0), 1e-14);
  EXPECT_THROW(polygon_pieces<3>(l_corners, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace talus::shape_partition_test
