// Bullet held in the x-z plane.

#include <gtest/gtest.h>

#include "sim3d/engine_world.h"
#include "tests/sim3d/heap.h"

namespace talus::planar_test {
namespace {

void pour(World<2>& world, int count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> turn(-3.0, 3.0);
  for (int i = 0; i < count; ++i) {
    BodyDef<2> body;
    body.pose.rotation = Rotation<2>(turn(random));
    body.pose.position = {1.7 * (i % 4), 1.5 + 1.7 * (i / 4)};
    world.add(body);
  }
}

TEST(PlanarBody, NeverLeavesThePlaneNorTiltsOutOfIt) {
  const auto world = make_bullet_planar_world(l_world<2>());
  pour(*world, 40);
  const bullet::Engine& engine = dynamic_cast<const bullet::EngineWorld<2>&>(*world).engine();
  for (int step = 0; step < 600; ++step) {
    world->step();
    for (int i = 0; i < engine.world.getNonStaticRigidBodies().size(); ++i) {
      const btRigidBody& body = *engine.world.getNonStaticRigidBodies()[i];
      ASSERT_EQ(body.getWorldTransform().getOrigin().y(), 0.0F);
      ASSERT_EQ(body.getLinearVelocity().y(), 0.0F);
      ASSERT_EQ(body.getAngularVelocity().x(), 0.0F);
      ASSERT_EQ(body.getAngularVelocity().z(), 0.0F);
      ASSERT_EQ(body.getWorldTransform().getBasis().getColumn(1), btVector3(0, 1, 0));
    }
  }
}

// A box on its lower right corner falls to the right, which is clockwise. Of the mirror image, to the left.
TEST(PlanarBody, TopplesToTheSideItLeansTo) {
  WorldDescription<2> description;
  description.shapes = {make_shape<2>("plank", box_pieces<2>({0.2, 2.0}), Material{})};
  for (const double lean : {-0.3, 0.3}) {
    const auto world = make_bullet_planar_world(description);
    BodyDef<2> body;
    body.pose.position = {0, 1.1};
    body.pose.rotation = Rotation<2>(lean);
    world->add(body);
    run(*world, 240);
    EXPECT_GT(world->states().pose[0].rotation.angle() / lean, 4.0);
  }
}

}  // namespace
}  // namespace talus::planar_test
