// The work of moving obstacles against closed forms, on every engine.

#include "common/simulation/energy_ledger.h"

#include <functional>

#include "tests/backends/backend.h"

namespace talus::energy_ledger_on_engines_test {
namespace {

template <typename Backend>
class LedgerOnEngine : public BackendTest<Backend> {
 protected:
  static constexpr int dim = Backend::dim;
  using V = Vec<dim>;

  /// A cube of shape 0 and a box that moves.
  struct Stage {
    Stage(const V& cube, const V& box_size, const V& box, double friction) : start(box) {
      description.obstacles.push_back(
          {make_shape<dim>("box", box_pieces<dim>(box_size), {.friction = friction}), {.position = box}, true});
      world = Backend::make(description);
      ledger = std::make_unique<EnergyLedger<dim>>(description);
      world->record_contacts(true);
      world->add(BackendTest<Backend>::at(cube));
    }
    /// The work on the cube over so many seconds [J]; `shift` of the box from its place at a time.
    double work(double seconds, const std::function<V(double)>& shift) {
      double sum = 0.0;
      for (int step = 1; step <= std::lround(seconds / description.dt); ++step) {
        world->move_obstacle(0, {.position = start + shift(step * description.dt)});
        ledger->start_step(*world);
        world->step();
        ledger->end_step(*world);
        sum += ledger->work();
      }
      return sum;
    }
    double weight() const { return description.gravity * description.shapes[0].mass; }

    WorldDescription<dim> description = BackendTest<Backend>::description();
    std::unique_ptr<EnergyLedger<dim>> ledger;
    V start;
    std::unique_ptr<World<dim>> world;
  };

  static V place(double x, double height) { return x * V::UnitX() + up<dim>(height); }
  static V size(double x, double height) {
    V size = V::Constant(4.0);
    size[0] = x;
    size[dim - 1] = height;
    return size;
  }
};

TYPED_TEST_SUITE(LedgerOnEngine, Backends, BackendName);

TYPED_TEST(LedgerOnEngine, ALiftDoesTheWorkThatTheBodyGains) {
  using T = TestFixture;
  constexpr double rise = 2.0;  // [m]
  constexpr double time = 4.0;  // [s]
  typename T::Stage stage(T::place(0.0, 1.75), T::size(4.0, 0.5), T::place(0.0, 1.0), 0.5);
  const auto lift = [](double at) { return up<T::dim>(rise * 0.5 * (1.0 - std::cos(std::numbers::pi * at / time))); };
  stage.work(1.0, [](double) { return up<T::dim>(0.0); });
  const double before = T::height_of(*stage.world, 0);
  const double work = stage.work(time, lift);
  const double gained = T::height_of(*stage.world, 0) - before;
  EXPECT_NEAR(gained, rise, 0.02) << "contacts settle within the engine's slop";
  // A step's impulse acts at its end and the motion is that of the whole step: some thousandths.
  EXPECT_NEAR(work, stage.weight() * gained, 0.02 * stage.weight() * rise);
  EXPECT_LT(stage.ledger->rise(), 0.02 * stage.weight() * rise) << "the lift gave it, not the engine";
}

TYPED_TEST(LedgerOnEngine, APlatformThatSinksTakesTheWorkBack) {
  using T = TestFixture;
  constexpr double time = 4.0;  // [s]
  typename T::Stage stage(T::place(0.0, 4.75), T::size(4.0, 0.5), T::place(0.0, 4.0), 0.5);
  const auto sink = [](double at) { return up<T::dim>(-1.0 * (1.0 - std::cos(std::numbers::pi * at / time))); };
  stage.work(1.0, [](double) { return up<T::dim>(0.0); });
  EXPECT_NEAR(stage.work(time, sink), -2.0 * stage.weight(), 0.04 * stage.weight());
}

TYPED_TEST(LedgerOnEngine, APusherDoesTheWorkOfFriction) {
  using T = TestFixture;
  constexpr double speed = 0.5;     // [m/s]
  constexpr double friction = 0.5;  // of cube and ground
  typename T::Stage stage(T::place(0.0, 0.5), T::size(1.0, 0.8), T::place(-1.03, 0.5), 0.0);
  const auto push = [](double at) { return T::place(speed * at, 0.0); };
  stage.work(1.0, push);  // until it touches and the cube moves evenly
  const double work = stage.work(2.0, [&](double at) { return push(1.0 + at); });
  EXPECT_NEAR(work, friction * stage.weight() * speed * 2.0, 0.05 * friction * stage.weight() * speed * 2.0);
}

TYPED_TEST(LedgerOnEngine, ASmoothFloorThatSlidesAwayDoesNoWork) {
  using T = TestFixture;
  typename T::Stage stage(T::place(0.0, 1.75), T::size(12.0, 0.5), T::place(0.0, 1.0), 0.0);
  stage.work(1.0, [](double) { return up<T::dim>(0.0); });
  EXPECT_NEAR(stage.work(2.0, [](double at) { return T::place(0.5 * at, 0.0); }), 0.0, 0.01 * stage.weight());
}

}  // namespace
}  // namespace talus::energy_ledger_on_engines_test
