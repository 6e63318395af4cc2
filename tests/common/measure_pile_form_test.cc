// Slope and packing where they mean something, and a reason where they do not.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/measure/pile_form.h"
#include "common/shape/catalogue.h"
#include "common/world/container.h"

namespace talus::measure_pile_form_test {
namespace {

struct Plane {
  static constexpr int dim = 2;
};
struct Space {
  static constexpr int dim = 3;
};

template <typename T>
class PileForm : public testing::Test {
 protected:
  static constexpr int dim = T::dim;
  using V = Vec<dim>;
  using Bodies = std::vector<PlacedBody<dim>>;

  static void add(Bodies& bodies, const V& centre, double size, double volume) {
    const V half = V::Constant(0.5 * size);
    bodies.push_back({centre, Box<dim>(centre - half, centre + half), volume, 1000.0 * volume});
  }

  /// `wide` bodies a horizontal axis and `high` layers at this spacing, in the middle of the plane; the lowest touch
  /// the ground.
  static Bodies lattice(int wide, int high, double spacing, double size, double volume) {
    Bodies bodies;
    for (int i = 0; i < wide; ++i)
      for (int j = 0; j < (dim == 3 ? wide : 1); ++j)
        for (int k = 0; k < high; ++k) {
          V centre = V::Constant((j + 0.5 - 0.5 * wide) * spacing);
          centre[0] = (i + 0.5 - 0.5 * wide) * spacing;
          centre[dim - 1] = 0.5 * size + k * spacing;
          add(bodies, centre, size, volume);
        }
    return bodies;
  }

  /// Small boxes beneath a surface.
  template <typename Surface>
  static Bodies filled(double reach, double size, const Surface& surface) {
    Bodies bodies;
    const int side = static_cast<int>(reach / size);
    const int deep = dim == 3 ? side : 1;
    for (int i = -side; i < side; ++i)
      for (int j = dim == 3 ? -deep : 0; j < deep; ++j) {
        V centre = V::Constant((j + 0.5) * size);
        centre[0] = (i + 0.5) * size;
        for (centre[dim - 1] = 0.5 * size; centre[dim - 1] < surface(horizontal<dim>(centre)); centre[dim - 1] += size)
          add(bodies, centre, size, std::pow(size, dim));
      }
    return bodies;
  }

  static WorldDescription<dim> bin(double width, double wall = 0.3) {
    V inner = V::Constant(width);
    inner[dim - 1] = 20.0;
    WorldDescription<dim> world;
    world.obstacles = container_walls<dim>({.inner_size = inner, .wall = wall}, {}, {});
    return world;
  }

  static talus::PileForm form(const Bodies& bodies, const WorldDescription<dim>& world, double extent) {
    const ProfileGrid<dim> grid = grid_around<dim>(bodies, 0.0, extent);
    return pile_form<dim>(bodies, shape_statistics<dim>(bodies, grid), grid, world, extent);
  }
};

using Dimensions = testing::Types<Plane, Space>;
TYPED_TEST_SUITE(PileForm, Dimensions);

TYPED_TEST(PileForm, GivesBallsOnALatticeInABinTheirPackingAndNoSlope) {
  using T = TestFixture;
  const double share = T::dim == 2 ? std::numbers::pi / 4.0 : std::numbers::pi / 6.0;
  const auto form = T::form(T::lattice(8, 9, 1.0, 1.0, share), T::bin(8.0), 1.0);
  ASSERT_TRUE(form.packing.value) << form.packing.why_not;
  // The cells by which the area is counted are 1 / 400 of the width.
  EXPECT_NEAR(*form.packing.value, share, 0.01 * share);
  EXPECT_FALSE(form.slope.value);
  EXPECT_NE(form.slope.why_not.find("obstacles hold"), std::string::npos) << form.slope.why_not;
}

TYPED_TEST(PileForm, CountsTheGapsBetweenCubes) {
  using T = TestFixture;
  constexpr double size = 0.7;
  constexpr double spacing = 0.75;
  const auto form = T::form(T::lattice(8, 10, spacing, size, std::pow(size, T::dim)), T::bin(8 * spacing), 1.0);
  // From the outer faces of the outer cubes: 8 cubes take 7 spacings and a size.
  const double by_hand = std::pow(8 * size / (7 * spacing + size), T::dim - 1) * 10 * size / (9 * spacing + size);
  ASSERT_TRUE(form.packing.value) << form.packing.why_not;
  EXPECT_NEAR(*form.packing.value, by_hand, 0.01 * by_hand);
}

TYPED_TEST(PileForm, IsAboveOneWhereBodiesOverlap) {
  using T = TestFixture;
  const auto form = T::form(T::lattice(16, 18, 0.5, 1.0, 1.0), T::bin(8.5), 1.0);
  const double by_hand = std::pow(16 / 8.5, T::dim - 1) * 18 / 9.5;
  ASSERT_TRUE(form.packing.value) << form.packing.why_not;
  EXPECT_NEAR(*form.packing.value, by_hand, 0.02 * by_hand);
}

TYPED_TEST(PileForm, GivesAHeapItsSlopeAndItsPacking) {
  using T = TestFixture;
  const auto heap = T::filled(5.0, 0.2, [](const auto& at) { return (5.0 - at.norm()) * std::tan(0.4); });
  const auto form = T::form(heap, {}, 0.3);
  ASSERT_TRUE(form.slope.value) << form.slope.why_not;
  EXPECT_NEAR(form.slope.value->angle, 0.4, 0.03) << "the cubes make steps of up to 0.2 m";
  EXPECT_NEAR(*form.packing.value, 1.0, 0.1);
}

TYPED_TEST(PileForm, GivesAWedgeAgainstAWallNeither) {
  using T = TestFixture;
  auto world = T::bin(10.0);
  const auto wedge = T::filled(5.0, 0.25, [](const auto& at) { return 0.6 * (5.0 + at[0]); });
  const auto form = T::form(wedge, world, 0.35);
  EXPECT_FALSE(form.slope.value);
  EXPECT_FALSE(form.packing.value) << "a wedge is no bed with a level surface";
}

TYPED_TEST(PileForm, GivesTwoHeapsNoCommonSlope) {
  using T = TestFixture;
  const auto heaps = T::filled(9.0, 0.3, [](const auto& at) { return 2.5 - 0.7 * std::abs(at.norm() - 5.0); });
  const auto form = T::form(heaps, {}, 0.4);
  EXPECT_FALSE(form.slope.value);
  EXPECT_EQ(form.slope.why_not, "the surface does not fall from its middle outwards, as that of one heap does");
  EXPECT_EQ(form.packing.why_not, form.slope.why_not);
}

TYPED_TEST(PileForm, GivesALayerOnTheGroundNeither) {
  using T = TestFixture;
  const auto form = T::form(T::lattice(20, 1, 1.0, 1.0, 1.0), {}, 1.0);
  EXPECT_EQ(form.slope.why_not, "the heap is lower than two bodies");
  EXPECT_FALSE(form.packing.value);
}

TYPED_TEST(PileForm, GivesFewBodiesNeither) {
  using T = TestFixture;
  const auto form = T::form(T::lattice(1, 1, 1.0, 1.0, 1.0), {}, 1.0);
  EXPECT_EQ(form.slope.why_not, "1 body lies still, fewer than 16");
  EXPECT_EQ(form.packing.why_not, "1 body lies still, fewer than 16");
}

TYPED_TEST(PileForm, GivesNothingWhereGravityIsTilted) {
  using T = TestFixture;
  const auto heap = T::filled(5.0, 0.2, [](const auto& at) { return (5.0 - at.norm()) * std::tan(0.4); });
  WorldDescription<T::dim> world;
  world.down[0] = 0.1;
  world.down.normalize();
  EXPECT_EQ(T::form(heap, world, 0.3).slope.why_not, "gravity is not vertical");
}

// A slab beneath a heap carries it and holds nothing.
TYPED_TEST(PileForm, TakesAHeapOnASlabForOne) {
  using T = TestFixture;
  const auto heap = T::filled(5.0, 0.2, [](const auto& at) { return (5.0 - at.norm()) * std::tan(0.4); });
  Vec<T::dim> slab = Vec<T::dim>::Constant(12.0);
  slab[T::dim - 1] = 1.0;
  WorldDescription<T::dim> world;
  world.obstacles.push_back(
      {make_shape<T::dim>("slab", box_pieces<T::dim>(slab), {}), {.position = -0.5 * Vec<T::dim>::Unit(T::dim - 1)}});
  EXPECT_TRUE(T::form(heap, world, 0.3).slope.value);
}

}  // namespace
}  // namespace talus::measure_pile_form_test
