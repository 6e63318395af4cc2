// What part of the world is shown, and that all of it is.

#include "tools/picture/framing.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/picture/sample.h"
#include "tools/picture/page.h"

namespace talus::framing_test {
namespace {

using Place = std::array<int, 3>;

template <int Dim>
Sample<Dim> sample_at(const std::vector<Place>& places) {
  Sample<Dim> sample;
  for (const Place& place : places) {
    Vec<Dim> position;
    for (int axis = 0; axis < Dim; ++axis) position[axis] = 0.01 * place[axis];
    sample.add(position, false);
  }
  return sample;
}

template <int Dim>
void check_all_inside(const std::vector<Place>& places) {
  const Sample<Dim> sample = sample_at<Dim>(places);
  const PictureParams params;
  const PictureInput<Dim> input = sample.input();
  const Framing<Dim> framing = framing_of(input);
  const Page page({}, params);
  const Layout<Dim> layout = lay_out(framing, page, params);
  RC_ASSERT(framing.drawn.size() + framing.outside.size() == places.size());
  RC_ASSERT(places.empty() || !framing.drawn.empty());
  RC_ASSERT(layout.height <= params.height);
  Box<2> scene(Vec2(params.margin, page.header()), Vec2(params.width - params.margin, layout.height - page.footer()));
  // A pixel of leeway: the page's height is rounded up to whole pixels.
  scene.min() -= Vec2::Constant(1.0);
  scene.max() += Vec2::Constant(1.0);
  for (const BodyIndex body : framing.drawn) {
    const Box<Dim> bounds = bounds_at(sample.shapes[0], sample.states.pose[body]);
    for (int corner = 0; corner < (1 << Dim); ++corner) {
      const auto which = static_cast<typename Box<Dim>::CornerType>(corner);
      RC_ASSERT(scene.contains(layout.projection.on_page(bounds.corner(which))));
    }
  }
}

RC_GTEST_PROP(Framing, HoldsEveryBodyThatIsNotToldOutsideIn2D, (const std::vector<Place>& places)) {
  check_all_inside<2>(places);
}

RC_GTEST_PROP(Framing, HoldsEveryBodyThatIsNotToldOutsideIn3D, (const std::vector<Place>& places)) {
  check_all_inside<3>(places);
}

TEST(Framing, LeavesOutAStrayThatIsFarFromAllOthers) {
  Sample<3> sample;
  sample.add_rows(3);
  sample.add({500.0, 0.0, 0.0}, false);
  const Framing<3> framing = framing_of(sample.input());
  EXPECT_EQ(framing.drawn.size(), 12U);
  EXPECT_EQ(framing.outside, std::vector<BodyIndex>{12});
  EXPECT_LT(framing.box.diagonal().norm(), 20.0);
}

TEST(Framing, HoldsTheFewThatCameThroughAGate) {
  Sample<2> sample;
  sample.add_rows(50);
  for (int i = 0; i < 10; ++i) sample.add({i - 5.0, -40.0 - 8.0 * i}, false);
  const Framing<2> framing = framing_of(sample.input());
  EXPECT_EQ(framing.drawn.size(), 210U);
  EXPECT_TRUE(framing.outside.empty());
  EXPECT_LT(framing.box.min().y(), -112.0);
}

TEST(Framing, DoesNotCountRemovedBodies) {
  Sample<2> sample;
  sample.add_rows(2);
  sample.states.removed[5] = 1;
  const Framing<2> framing = framing_of(sample.input());
  EXPECT_EQ(framing.drawn.size(), 7U);
  EXPECT_TRUE(framing.outside.empty());
}

TEST(Framing, HoldsPilesWithoutBodies) {
  Sample<2> sample;
  sample.add_pile(100.0);
  const Framing<2> framing = framing_of(sample.input());
  EXPECT_DOUBLE_EQ(framing.box.sizes().x(), 2.0 * sample.piles[0].radius);
  EXPECT_DOUBLE_EQ(framing.box.sizes().y(), sample.piles[0].height);
}

TEST(Framing, IsNotSetByAnObstacleMuchLargerThanThePile) {
  Sample<2> sample;
  sample.add_rows(2);
  const Box<2> alone = framing_of(sample.input()).box;
  sample.obstacles.push_back({make_shape<2>("slab", box_pieces<2>({1000.0, 1.0}), Material{}), {}});
  EXPECT_TRUE(framing_of(sample.input()).box.isApprox(alone));
}

}  // namespace
}  // namespace talus::framing_test
