#include <gtest/gtest.h>

#include "common/scene/typical_body.h"
#include "common/shape/catalogue.h"

namespace talus::scene_typical_body_test {
namespace {

Scene<3> scene_of(int small, int large) {
  Scene<3> scene;
  scene.world.shapes = {make_shape<3>("small", box_pieces<3>(Vec3::Constant(1.0)), {.density = 1.0}),
                        make_shape<3>("large", box_pieces<3>(Vec3::Constant(2.0)), {.density = 1.0})};
  scene.sources = {{.shapes = {0}, .count = small}, {.shapes = {1}, .count = large}};
  return scene;
}

TEST(TypicalBody, HasTheMeanVolumeAndMassAndTheLargestExtent) {
  const TypicalBody body = typical_body(scene_of(30, 10));
  EXPECT_NEAR(body.bounding_volume, (3.0 * 1.0 + 8.0) / 4.0, 1e-12);
  EXPECT_NEAR(body.mass, (3.0 * 1.0 + 8.0) / 4.0, 1e-12);
  EXPECT_NEAR(body.extent, 2.0 * std::sqrt(3.0), 1e-12);
}

TEST(TypicalBody, IsNotMadeOfWhatIsThrownIntoThePile) {
  const TypicalBody body = typical_body(scene_of(100, 1));
  EXPECT_NEAR(body.mass, 1.0, 1e-12);
  EXPECT_NEAR(body.extent, std::sqrt(3.0), 1e-12);
}

TEST(TypicalBody, IsTheMeanOfShapesWhereNothingDropsThem) {
  Scene<3> scene = scene_of(1, 1);
  scene.sources.clear();
  EXPECT_NEAR(typical_body(scene).mass, 4.5, 1e-12);
}

}  // namespace
}  // namespace talus::scene_typical_body_test
