// Mass, axes and size of bodies as Bullet has them.

#include "sim3d/body_template.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "tests/sim3d/heap.h"

namespace talus::engine_shape_test {
namespace {

WorldDescription<3> alone(const Shape<3>& shape) {
  WorldDescription<3> description;
  description.gravity = 0.0;
  description.ground.present = false;
  description.shapes = {shape};
  return description;
}

Shape<3> l_shape() { return make_shape<3>("L", l_pieces<3>({}), Material{}); }

// The L's longest axis lies askew in its own axes, so this fails where a body is kept in other axes than its principal
// ones: about those, and only those, a free body keeps its spin.
TEST(BodyTemplate, SpinsFreelyAboutItsPrincipalAxes) {
  const Shape<3> shape = l_shape();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(shape.inertia);
  std::mt19937 random(1);
  for (int axis = 0; axis < 3; ++axis) {
    const auto world = make_bullet_world(alone(shape));
    BodyDef<3> body;
    body.pose.rotation = random_turn(random);
    body.spin = body.pose.rotation * Vec3(principal.eigenvectors().col(axis) * 3.0);
    world->add(body);
    run(*world, 120);
    // One part in ten thousand: single precision, 120 steps. Off the axis the spin would turn by about a radian.
    EXPECT_LT((world->states().spin[0] - body.spin).norm(), 3e-4) << "axis " << axis;
  }
}

TEST(BodyTemplate, HasTheExactInertia) {
  const Shape<3> shape = l_shape();
  const bullet::BodyTemplate made = bullet::make_body_template(shape);
  const Eigen::Vector3d about_axes(made.inertia.x(), made.inertia.y(), made.inertia.z());
  const Eigen::Matrix3d axes = made.frame.toRotationMatrix();
  const Eigen::Matrix3d inertia = axes * about_axes.asDiagonal() * axes.transpose();
  EXPECT_LT((inertia - shape.inertia).cwiseAbs().maxCoeff(), 1e-6 * shape.inertia.trace());
  EXPECT_FLOAT_EQ(made.mass, static_cast<float>(shape.mass));
}

TEST(BodyTemplate, OfOnePieceIsNoCompound) {
  const Vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  for (const std::vector<Piece<3>>& pieces :
       {box_pieces<3>({1, 2, 3}), ball_pieces<3>(0.5), capsule_pieces<3>(2.0, 0.3), hull_pieces<3>(corners)}) {
    const bullet::BodyTemplate made = bullet::make_body_template(make_shape<3>("one", pieces, Material{}));
    EXPECT_FALSE(made.whole->isCompound());
  }
}

/// Height of the centre of a body that fell 1 cm onto the ground and came to rest.
template <int Dim, class MakeWorld>
double resting_height(const Shape<Dim>& shape, double centre, MakeWorld make_world) {
  WorldDescription<Dim> description;
  description.shapes = {shape};
  const auto world = make_world(description);
  BodyDef<Dim> body;
  body.pose.position[Dim - 1] = centre + 0.01;
  world->add(body);
  run(*world, 240);
  return height<Dim>(world->states().pose[0].position);
}

// Two millimetres: a body rests where Bullet's split impulse stops pushing, and a hull on a skin of 1 mm.
TEST(BodyTemplate, RestsAtItsHeight) {
  const std::vector<Vec3> cube = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                                  {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
  const auto rests = [](const std::vector<Piece<3>>& pieces, double centre) {
    EXPECT_NEAR(resting_height<3>(make_shape<3>("s", pieces, Material{}), centre, make_bullet_world), centre, 2e-3);
  };
  rests(box_pieces<3>({1, 1, 1}), 0.5);
  rests(box_pieces<3>({0.1, 0.1, 0.1}), 0.05);
  rests(ball_pieces<3>(0.5), 0.5);
  rests(capsule_pieces<3>(2.0, 0.3), 0.3);
  rests(hull_pieces<3>(cube), 0.5);
}

TEST(BodyTemplate, RestsAtItsHeightInThePlane) {
  const std::vector<Vec2> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto rests = [](const std::vector<Piece<2>>& pieces, double centre) {
    EXPECT_NEAR(resting_height<2>(make_shape<2>("s", pieces, Material{}), centre, make_bullet_planar_world), centre,
                2e-3);
  };
  rests(box_pieces<2>({1, 1}), 0.5);
  rests(ball_pieces<2>(0.5), 0.5);
  rests(capsule_pieces<2>(2.0, 0.3), 0.3);
  rests(hull_pieces<2>(square), 0.5);
}

// Stacks show what single bodies hide: gaps and overlaps between two bodies of one kind add up.
TEST(BodyTemplate, StacksToItsHeight) {
  const std::vector<Vec3> cube = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                                  {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
  for (const std::vector<Piece<3>>& pieces : {box_pieces<3>({1, 1, 1}), hull_pieces<3>(cube)}) {
    WorldDescription<3> description;
    description.shapes = {make_shape<3>("s", pieces, Material{})};
    const auto world = make_bullet_world(description);
    for (int level = 0; level < 5; ++level) {
      BodyDef<3> body;
      body.pose.position = {0, 0, 0.501 + 1.002 * level};
      world->add(body);
    }
    run(*world, 240);
    // The same two millimetres for each of the five.
    EXPECT_NEAR(world->states().pose[4].position.z(), 4.5, 0.01);
  }
}

}  // namespace
}  // namespace talus::engine_shape_test
