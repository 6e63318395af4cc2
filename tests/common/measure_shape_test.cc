#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/math/random.h"
#include "common/measure/shape_statistics.h"

namespace talus::measure_shape_test {
namespace {

constexpr double foot = 10.0;
const double slope = std::tan(25.0 * std::numbers::pi / 180.0);

/// Small cubes whose tops lie on a cone or wedge of 25 degrees and radius 10, filled densely from `scatter` below it.
template <int Dim>
std::vector<PlacedBody<Dim>> heap(double scatter = 0.0) {
  std::mt19937_64 random(1);
  std::vector<PlacedBody<Dim>> bodies;
  constexpr double size = 0.1;
  const int side = static_cast<int>(foot / size);
  const auto add = [&](const Vec<Dim>& base) {
    const double surface = slope * (foot - horizontal<Dim>(base).norm());
    for (double z = size / 2; z < surface; z += size) {
      PlacedBody<Dim> body;
      body.centre = base;
      const double top = std::min(z + size / 2, surface) - scatter * uniform(random);
      body.centre[Dim - 1] = top - size / 2;
      const Vec<Dim> half = Vec<Dim>::Constant(size / 2);
      body.bounds = Box<Dim>(body.centre - half, body.centre + half);
      body.volume = std::pow(size, Dim);
      body.mass = 2.0;
      bodies.push_back(body);
    }
  };
  for (int i = -side; i < side; ++i) {
    const double x = (i + 0.5) * size;
    if constexpr (Dim == 2)
      add(Vec2(x, 0.0));
    else
      for (int j = -side; j < side; ++j) add(Vec3(x, (j + 0.5) * size, 0.0));
  }
  return bodies;
}

struct Flat {
  static constexpr int dim = 2;
};
struct Space {
  static constexpr int dim = 3;
};
template <typename T>
class ShapeStatisticsOfAHeap : public testing::Test {};
using Dimensions = testing::Types<Flat, Space>;
TYPED_TEST_SUITE(ShapeStatisticsOfAHeap, Dimensions);

TYPED_TEST(ShapeStatisticsOfAHeap, FindTheAngleItWasBuiltWith) {
  constexpr int dim = TypeParam::dim;
  const auto bodies = heap<dim>();
  ProfileGrid<dim> grid;
  grid.bin_width = 0.4;
  const auto statistics = shape_statistics<dim>(bodies, grid);
  // Cubes of 0.1 m make steps of up to 0.05 m on a flank of 10 m: 0.3 degrees.
  EXPECT_NEAR(statistics.repose.angle * 180 / std::numbers::pi, 25.0, 0.3);
  EXPECT_LT(statistics.repose.standard_error * 180 / std::numbers::pi, 0.2);
  EXPECT_NEAR(statistics.repose.apex, slope * foot, 0.1);
  EXPECT_NEAR(statistics.repose.foot, foot, 0.2);
  EXPECT_NEAR(statistics.peak, slope * foot, 0.1);
}

TYPED_TEST(ShapeStatisticsOfAHeap, FindRadiiAndCentreOfMassOfConeAndWedge) {
  constexpr int dim = TypeParam::dim;
  const auto bodies = heap<dim>();
  const auto statistics = shape_statistics<dim>(bodies, ProfileGrid<dim>{});
  // Centre of mass: a quarter (cone) or a third (wedge) of the height.
  EXPECT_NEAR(statistics.centre_height, slope * foot / (dim + 1), 0.05);
  // Share of the volume within radius r = s R: wedge 2 s - s^2, cone 3 s^2 - 2 s^3; both solved for 0.5 and 0.95.
  EXPECT_NEAR(statistics.r50, foot * (dim == 2 ? 0.2929 : 0.5), 0.1);
  EXPECT_NEAR(statistics.r95, foot * (dim == 2 ? 0.7764 : 0.8647), 0.1);
}

TYPED_TEST(ShapeStatisticsOfAHeap, DifferFromTheHeapLiftedByAStepByThatStep) {
  constexpr int dim = TypeParam::dim;
  auto bodies = heap<dim>();
  ProfileGrid<dim> grid;
  grid.bins = 20;
  const auto before = height_profile<dim>(bodies, grid);
  EXPECT_EQ(profile_difference(before, before), 0.0);
  for (auto& body : bodies) body.bounds.translate(Vec<dim>(0.25 * Vec<dim>::Unit(dim - 1)));
  // Cells at the foot's rim are only partly covered.
  EXPECT_NEAR(profile_difference(before, height_profile<dim>(bodies, grid)), 0.25, 0.01);
}

TEST(HeightProfile, KnowsLeftFromRightIn2D) {
  PlacedBody<2> body;
  body.bounds = Box<2>(Vec2(-1.0, 0.0), Vec2(-0.5, 2.0));
  ProfileGrid<2> grid;
  grid.bins = 4;
  const auto profile = height_profile<2>(std::vector{body}, grid);
  ASSERT_EQ(profile.size(), 8U);
  for (std::size_t bin = 0; bin < 8; ++bin) EXPECT_DOUBLE_EQ(profile[bin].height, bin == 2 ? 2.0 : 0.0) << bin;
  EXPECT_DOUBLE_EQ(profile[2].at, -0.75);
}

TEST(HeightProfile, MeasuresFromItsOwnCentreAndBase) {
  PlacedBody<3> body;
  body.bounds = Box<3>(Vec3(9, 19, 5), Vec3(11, 21, 6));
  ProfileGrid<3> grid;
  grid.centre = Vec2(10, 20);
  grid.base = 4.0;
  grid.bins = 4;
  const auto profile = height_profile<3>(std::vector{body}, grid);
  EXPECT_DOUBLE_EQ(profile[0].height, 2.0);
  EXPECT_DOUBLE_EQ(profile[3].height, 0.0);
  EXPECT_THROW(profile_difference(profile, std::vector<ProfileBin>(3)), std::invalid_argument);
}

TEST(AngleOfRepose, GivesTheFitsStandardError) {
  // Three bins of one column each at 1, 2, 3 with heights off the line 4 - r by 0.1, -0.2, 0.1: no change of slope, sum
  // of squared residuals 0.06, one degree of freedom, sum of squared distances from the mean radius 2.
  std::vector<ProfileBin> profile(3);
  for (std::size_t i = 0; i < 3; ++i) {
    const double r = static_cast<double>(i) + 1.0;
    profile[i] = {r, 4.0 - r + (i == 1 ? -0.2 : 0.1), 1};
  }
  const AngleOfRepose fit = angle_of_repose(profile, 4.0);
  EXPECT_EQ(fit.bins, 3);
  EXPECT_NEAR(fit.angle, std::numbers::pi / 4, 1e-12);
  EXPECT_NEAR(fit.standard_error, std::sqrt(0.06 / 2) / 2, 1e-12);
  EXPECT_NEAR(fit.apex, 4.0, 1e-12);
  EXPECT_NEAR(fit.foot, 4.0, 1e-12);
  EXPECT_EQ(angle_of_repose(profile, 1.5).angle, 0.0) << "too few bins";
}

}  // namespace
}  // namespace talus::measure_shape_test
