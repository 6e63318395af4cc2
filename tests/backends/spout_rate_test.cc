#include "common/scene/spout_rate.h"

#include "common/simulation/emitter.h"
#include "tests/backends/backend.h"

namespace talus::spout_rate_test {
namespace {

template <typename Backend>
class SpoutRate : public BackendTest<Backend> {
 protected:
  using Test = BackendTest<Backend>;
  static constexpr int dim = Backend::dim;

  // Bodies per second that a spout without any limit of its own drops into the void.
  static double rate(const Source<dim>& source, const WorldDescription<dim>& description, int count) {
    Scene<dim> scene;
    scene.world = description;
    scene.sources = {source};
    scene.sources[0].count = count;
    scene.sources[0].rate = 1e6;
    const auto world = Backend::make(scene.world);
    Emitter<dim> emitter(scene);
    int steps = 0;
    for (emitter.emit(*world, 0.0); !emitter.finished(); emitter.emit(*world, steps * scene.world.dt)) {
      world->step();
      ++steps;
    }
    return (count - 1) / (steps * scene.world.dt);
  }

  static WorldDescription<dim> void_world() {
    WorldDescription<dim> world = Test::description();
    world.ground.present = false;
    return world;
  }
};

TYPED_TEST_SUITE(SpoutRate, SmallStepsBackends, BackendName);

// A ball's bounding box is the one around its bounding sphere, so nothing is left to be conservative about. The two
// bodies' boxes may touch after a whole number of steps or miss it by rounding: one step of the 25.
TYPED_TEST(SpoutRate, OfBallsFromRestIsTheOneThatIsFoundByRunning) {
  const auto world = TestFixture::void_world();
  const Source<TestFixture::dim> source{.shapes = {1}};
  const double found = this->rate(source, world, 20);
  EXPECT_NEAR(1.0 / found, clearing_time(source, world), 1.01 * world.dt);
}

TYPED_TEST(SpoutRate, OfTumblingLsInASpreadIsReached) {
  const auto world = TestFixture::void_world();
  Source<TestFixture::dim> source{.shapes = {2}};
  source.spread.setConstant(0.2);
  source.velocity[TestFixture::dim - 1] = -5.0;
  source.velocity_spread.setConstant(1.0);
  source.spin_spread = 3.0;
  EXPECT_GE(this->rate(source, world, 40), 1.0 / clearing_time(source, world));
}

}  // namespace
}  // namespace talus::spout_rate_test
