// One sense of turning and one range of angles, whatever the engine counts.

#include "common/math/angle.h"
#include "common/measure/trajectory.h"
#include "common/policy/rest/rest_criterion.h"
#include "tests/backends/backend.h"

namespace talus::rotation_test {
namespace {

template <typename Backend>
class Turning : public BackendTest<Backend> {
 protected:
  /// A ball in free space that turns about the axis towards the viewer of the x-z plane, counter-clockwise.
  static std::unique_ptr<World<Backend::dim>> spinning(double spin) {
    auto description = BackendTest<Backend>::description();
    description.gravity = 0.0;
    auto world = Backend::make(description);
    BodyDef<Backend::dim> ball = BackendTest<Backend>::at(up<Backend::dim>(50.0), 1);
    if constexpr (Backend::dim == 2)
      ball.spin[0] = spin;
    else
      ball.spin = -spin * Vec3::UnitY();
    world->add(ball);
    return world;
  }
};

TYPED_TEST_SUITE(Turning, Backends, BackendName);

// A body that rests with an angle near half a turn jumps by a whole one in an engine that counts none.
TYPED_TEST(Turning, PastHalfATurnIsNoJump) {
  constexpr int dim = TypeParam::dim;
  const auto world = TestFixture::spinning(3.0);
  double largest = 0.0;
  for (int step = 0; step < 120; ++step) {
    const Pose<dim> before = world->states().pose[0];
    world->step();
    largest = std::max(largest, max_displacement(before, world->states().pose[0], 1.0));
  }
  EXPECT_NEAR(largest, 3.0 / 60.0, 0.001);
}

template <typename Backend>
class TurningInThePlane : public Turning<Backend> {};
TYPED_TEST_SUITE(TurningInThePlane, PlanarBackends, BackendName);

TYPED_TEST(TurningInThePlane, IsRecordedAsAnAngleOfAtMostHalfATurn) {
  const auto world = TestFixture::spinning(3.0);
  Trajectory<2> run(1.0 / 60.0, 60);
  for (int second = 1; second <= 8; ++second) {
    TestFixture::run(*world, 1.0);
    run.append(world->states(), 60 * second);
    const double angle = run.rotation(second - 1, 0).angle();
    EXPECT_NEAR(angle, wrapped(3.0 * second), 0.01) << second;
    EXPECT_EQ(angle, static_cast<float>(wrapped_angle(world->states().pose[0].rotation))) << second;
  }
}

}  // namespace
}  // namespace talus::rotation_test
