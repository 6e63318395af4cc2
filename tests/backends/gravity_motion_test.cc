// Gravity that changes by plan, on every engine.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "common/scene/read_scene.h"
#include "common/simulation/simulation.h"
#include "tests/backends/backend.h"

namespace talus::gravity_motion_test {
namespace {

constexpr double friction = 0.5;
constexpr double degree = std::numbers::pi / 180.0;
const double friction_angle = std::atan(friction) / degree;  // 26.6 degrees
constexpr double tilt_speed = 5.0;                           // [degrees/s]

/// A flat box on the ground; gravity turns to +x by so many degrees a second from the first second on.
template <int Dim>
Scene<Dim> tilting(const std::string& policy, double speed = tilt_speed) {
  const bool flat = Dim == 2;
  const std::string text = fmt::format(
      "title = \"Tilt\"\ndimension = {}\npolicy.kind = \"{}\"\nground.friction = {}\n"
      "shape.box = {{kind = \"box\", size = {}, friction = {}}}\nrun = {{frames = 9000}}\npile = [{{alpha_deg = 30}}]\n"
      "body = [{{position = {}}}]\nworld.gravity_motion = {{kind = \"turn\", speed_deg = {}, start = 1{}}}\n",
      Dim, policy, friction, flat ? "[2, 0.4]" : "[2, 1, 0.4]", friction, flat ? "[0, 0.21]" : "[0, 0, 0.21]", speed,
      flat ? "" : ", axis = [0, -1, 0]");
  return std::get<Scene<Dim>>(parse_scene(text, "text"));
}

/// How far the box slides from the friction angle to this angle [degrees], by the equation of motion.
double slide_to(double angle) {
  double speed = 0.0;
  double way = 0.0;
  constexpr double dt = 1e-4;
  for (double time = 0.0; friction_angle + tilt_speed * time < angle; time += dt) {
    const double tilt = (friction_angle + tilt_speed * time) * degree;
    speed += 9.81 * (std::sin(tilt) - friction * std::cos(tilt)) * dt;
    way += speed * dt;
  }
  return way;
}

template <typename Backend>
class GravityMotion : public ::testing::Test {
 protected:
  static constexpr int dimension = Backend::dim;
  /// Where the box is, in x, once gravity is tilted by this angle [degrees].
  static double place_at(Simulation<dimension>& simulation, double angle) {
    while (simulation.time() < 1.0 + angle / tilt_speed - 1e-9) simulation.step();
    return simulation.world().states().pose[0].position.x();
  }
};

TYPED_TEST_SUITE(GravityMotion, Backends, BackendName);

TYPED_TEST(GravityMotion, LetsABoxSlideOnceTheTiltPassesTheFrictionAngle) {
  for (const char* policy : {"full", "adaptive", "paper", "engine"}) {
    if (!has_policy<TypeParam>(policy)) continue;
    SCOPED_TRACE(policy);
    auto simulation = simulation_on<TypeParam>(tilting<TypeParam::dim>(policy));
    EXPECT_NEAR(TestFixture::place_at(simulation, friction_angle - 1.0), 0.0, 0.01);
    const double way = slide_to(friction_angle + 5.0);
    EXPECT_NEAR(TestFixture::place_at(simulation, friction_angle + 5.0), way, 0.1 * way);
  }
}

TYPED_TEST(GravityMotion, LetsASleeperSlideWhereTheTiltIsSlow) {
  constexpr double slow = 0.5;  // [degrees/s]
  auto simulation = simulation_on<TypeParam>(tilting<TypeParam::dim>("adaptive", slow));
  const auto run_to = [&](double angle) {
    while (simulation.time() < 1.0 + angle / slow) simulation.step();
    return simulation.world().states().pose[0].position.x();
  };
  EXPECT_NEAR(run_to(friction_angle - 0.5), 0.0, 0.02);
  EXPECT_GT(run_to(friction_angle + 2.0), 0.2);
}

/// A tilt of 2.8 degrees wakes all at each of 0.57 degrees, and a check may follow in the new gravity.
TYPED_TEST(GravityMotion, WakesSleepersOnlyNowAndThen) {
  auto simulation = simulation_on<TypeParam>(tilting<TypeParam::dim>("adaptive", 0.2));
  int asleep = 0;
  int steps = 0;
  int woken = 0;
  bool slept = false;
  while (simulation.time() < 15.0) {
    simulation.step();
    const bool sleeps = simulation.world().awake().empty();
    woken += slept && !sleeps ? 1 : 0;
    asleep += sleeps ? 1 : 0;
    ++steps;
    slept = sleeps;
  }
  EXPECT_GT(asleep, steps / 2);
  EXPECT_GE(woken, 3);
  EXPECT_LE(woken, 10);
}

TYPED_TEST(GravityMotion, GivesTheSameBitsEachTime) {
  auto one = simulation_on<TypeParam>(tilting<TypeParam::dim>("adaptive"));
  auto other = simulation_on<TypeParam>(tilting<TypeParam::dim>("adaptive"));
  EXPECT_EQ(TestFixture::place_at(one, 35.0), TestFixture::place_at(other, 35.0));
}

}  // namespace
}  // namespace talus::gravity_motion_test
