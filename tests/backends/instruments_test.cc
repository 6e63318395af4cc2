// Gates, regions and loads of a scene, on every engine.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "common/measure/gate_counter.h"
#include "common/measure/load_meter.h"
#include "common/measure/region_meter.h"
#include "common/scene/read_scene.h"
#include "common/simulation/simulation.h"
#include "tests/backends/backend.h"

namespace talus::instruments_test {
namespace {

constexpr double dt = 1.0 / 60.0;
constexpr double slope = 0.2;  // [rad], well below that of friction 0.5

template <typename Backend>
class InstrumentTest : public BackendTest<Backend> {
 protected:
  using BackendTest<Backend>::dimension;

  static Vec<dimension> point(double across, double height) {
    Vec<dimension> at = up<dimension>(height);
    at[0] = across;
    return at;
  }

  /// A gate across x = 0, from the ground to a height of 10 m and 2 m wide; forward is along x.
  static GateCounter<dimension> gate_across() {
    GateParams<dimension> gate{.name = "gate"};
    if constexpr (dimension == 2)
      gate.corners = {{0.0, 0.0}, {0.0, 10.0}};
    else
      gate.corners = {{0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, -1.0, 10.0}};
    return GateCounter<dimension>(gate, 1.0);
  }

  static Scene<dimension> scene_of(const WorldDescription<dimension>& world) {
    Scene<dimension> scene;
    scene.world = world;
    scene.obstacle_names = {{.name = "plate", .first = 0, .count = 1}};
    return scene;
  }

  /// A world with a plate that slopes by 0.2 rad; the middle of its upper side is 2 m above x = 10.
  static WorldDescription<dimension> with_plate(double width = 4.0) {
    WorldDescription<dimension> world = BackendTest<Backend>::description();
    Vec<dimension> size = Vec<dimension>::Constant(4.0);
    size[0] = width;
    size[dimension - 1] = 0.5;
    world.obstacles.push_back({make_shape<dimension>("plate", box_pieces<dimension>(size), {}), {}});
    world.obstacles.back().pose.rotation = tilted<dimension>(slope);
    world.obstacles.back().pose.position =
        point(10.0, 2.0) - world.obstacles.back().pose.rotation * up<dimension>(0.25);
    return world;
  }
  /// A cube that lies on the plate, so far along the slope from its middle, or on other cubes there.
  static BodyDef<dimension> on_plate(double along, int cubes_below = 0) {
    BodyDef<dimension> body = BackendTest<Backend>::at(point(10.0, 2.0));
    body.pose.rotation = tilted<dimension>(slope);
    body.pose.position += body.pose.rotation * point(along, 0.5 + cubes_below);
    return body;
  }

  static double force_up(const LoadMeter<dimension>& load) { return load.frame().mean[dimension - 1]; }
  static double torque_in_plane(const LoadMeter<dimension>& load) { return load.frame().mean[dimension == 2 ? 2 : 4]; }

  /// Of one box on the ground and an equal one on the plate, which rest.
  static void expect_weights(const LoadMeter<dimension>& ground, const LoadMeter<dimension>& plate,
                             const World<dimension>& world, BodyIndex on_plate) {
    const double weight = 10.0 * world.shape_of(on_plate).mass;
    EXPECT_NEAR(force_up(ground), -weight, 0.01 * weight);
    EXPECT_NEAR(force_up(plate), -weight, 0.01 * weight);
    // In 2D counter-clockwise with x to the right, in 3D about y, which points the other way.
    const double arm = InstrumentTest::pose(world, on_plate).position[0] - 10.0;
    EXPECT_NEAR(torque_in_plane(plate), (dimension == 2 ? -arm : arm) * weight, 0.01 * weight);
    EXPECT_NEAR(plate.frame().mean[0], 0.0, 0.01 * weight) << "friction and pressure together are vertical";
  }
};

TYPED_TEST_SUITE(InstrumentTest, Backends, BackendName);

TYPED_TEST(InstrumentTest, EachBodyThatPassesAGateIsCountedOnceAtItsTimeAndOnceMoreWhenItBouncesBack) {
  constexpr int dim = TypeParam::dim;
  auto description = TestFixture::description({.friction = 0.0, .restitution = 1.0});
  description.gravity = 0.0;
  Vec<dim> size = Vec<dim>::Constant(20.0);
  size[0] = 2.0;
  description.obstacles.push_back(
      {make_shape<dim>("wall", box_pieces<dim>(size), {.friction = 0.0, .restitution = 1.0}), {}});
  description.obstacles.back().pose.position = TestFixture::point(5.0, 10.5);
  auto world = TypeParam::make(description);
  GateCounter<dim> gate = TestFixture::gate_across();
  constexpr double speed = 5.0;
  constexpr int bodies = 6;
  for (int i = 0; i < bodies; ++i)
    world->add(TestFixture::at(TestFixture::point(-1.0 - 0.7 * i, 1.0 + 1.5 * i), 1, speed * Vec<dim>::Unit(0)));
  world->add(TestFixture::at(TestFixture::point(-1.0, 12.0), 1, speed * Vec<dim>::Unit(0)));  // above the gate
  double time = 0.0;
  const auto run_to = [&](double end) {
    while (time < end - 1e-9) {
      world->step();
      time += dt;
      gate.update(*world, time, dt);
    }
  };
  run_to(1.1);  // the last is there at 0.9 s; the first comes back at 1.2 s
  EXPECT_EQ(gate.forward(), bodies);
  EXPECT_EQ(gate.backward(), 0);
  EXPECT_NEAR(gate.first().value(), 1.0 / speed, 1e-4) << "single precision";
  EXPECT_NEAR(gate.last().value(), (1.0 + 0.7 * (bodies - 1)) / speed, 1e-4);
  EXPECT_NEAR(gate.rate().value(), speed / 0.7, 0.01);
  run_to(4.0);
  EXPECT_EQ(gate.forward(), bodies);
  EXPECT_EQ(gate.backward(), bodies);
  EXPECT_TRUE(gate.jams().empty()) << "no gravity";
}

TYPED_TEST(InstrumentTest, AWakingBodyIsCountedAndSleepingOnesAreNot) {
  constexpr int dim = TypeParam::dim;
  auto description = TestFixture::description();
  description.gravity = 0.0;
  auto world = TypeParam::make(description);
  GateCounter<dim> gate = TestFixture::gate_across();
  for (const double height : {2.0, 5.0})
    world->add(TestFixture::at(TestFixture::point(-0.5, height), 1, Vec<dim>::Unit(0)));
  const auto run = [&](int steps, double from) {
    for (int i = 1; i <= steps; ++i) {
      world->step();
      gate.update(*world, from + i * dt, dt);
    }
  };
  run(15, 0.0);
  TestFixture::freeze(*world, 0);
  run(60, 0.25);
  EXPECT_EQ(gate.forward(), 1);
  TestFixture::thaw(*world, 0);
  world->set_velocity(0, Vec<dim>::Unit(0), Spin<dim>::Zero());
  run(60, 1.25);
  EXPECT_EQ(gate.forward(), 2);
}

TYPED_TEST(InstrumentTest, ABoxAtRestPutsItsWeightOnWhatCarriesItWithItsTorque) {
  constexpr int dim = TypeParam::dim;
  const WorldDescription<dim> description = TestFixture::with_plate();
  const Scene<dim> scene = TestFixture::scene_of(description);
  auto world = TypeParam::make(description);
  world->record_contacts(true);
  world->add(TestFixture::at(TestFixture::point(0.0, 0.5)));
  const BodyIndex on_plate = world->add(TestFixture::on_plate(0.5));
  LoadMeter<dim> ground(scene, {.name = "ground", .on_ground = true});
  LoadMeter<dim> plate(scene, {.name = "plate", .obstacles = {0}, .about = TestFixture::point(10.0, 2.0)});
  for (int i = 0; i < 240; ++i) {
    world->step();
    ground.update(*world);
    plate.update(*world);
    if (i == 119)
      for (auto* load : {&ground, &plate}) load->end_frame();
  }
  for (auto* load : {&ground, &plate}) load->end_frame();
  TestFixture::expect_weights(ground, plate, *world, on_plate);
  EXPECT_TRUE(plate.whole().known);
  EXPECT_EQ(plate.whole().steps, 240);
  EXPECT_LE(plate.whole().least[dim - 1], plate.frame().least[dim - 1]);
}

TYPED_TEST(InstrumentTest, AProfileHasTheForcesByTheHeightOfTheirContacts) {
  constexpr int dim = TypeParam::dim;
  const WorldDescription<dim> description = TestFixture::with_plate();
  const Scene<dim> scene = TestFixture::scene_of(description);
  auto world = TypeParam::make(description);
  world->record_contacts(true);
  world->add(TestFixture::at(TestFixture::point(0.0, 0.5)));
  world->add(TestFixture::on_plate(0.5));
  LoadMeter<dim> all(scene, {.name = "all", .on_ground = true, .obstacles = {0}, .heights = {-1.0, 0.5, 1.0, 5.0}});
  LoadMeter<dim> ground(scene, {.name = "ground", .on_ground = true});
  LoadMeter<dim> plate(scene, {.name = "plate", .obstacles = {0}});
  for (int i = 0; i < 240; ++i) {
    world->step();
    for (auto* load : {&all, &ground, &plate}) load->update(*world);
  }
  for (auto* load : {&all, &ground, &plate}) load->end_frame();
  ASSERT_EQ(all.profile().size(), 3U);
  EXPECT_NEAR((all.profile()[0] - ground.frame().mean.template head<dim>()).norm(), 0.0, 1e-6);
  EXPECT_EQ(all.profile()[1].norm(), 0.0);
  EXPECT_NEAR((all.profile()[2] - plate.frame().mean.template head<dim>()).norm(), 0.0, 1e-6);
  EXPECT_GT(ground.frame().mean.norm(), 0.0);
}

TYPED_TEST(InstrumentTest, TheEnginesOwnSolverKnowsNoForcesOfSleepingBodiesAndTheLoadSaysSo) {
  constexpr int dim = TypeParam::dim;
  auto world = TypeParam::make(TestFixture::with_plate());  // without a ring small_steps keeps none either
  LoadMeter<dim> load(TestFixture::scene_of(TestFixture::with_plate()), {.name = "ground", .on_ground = true});
  world->record_contacts(true);
  world->add(TestFixture::at(TestFixture::point(0.0, 0.5)));
  world->step();
  load.update(*world);
  load.end_frame();
  EXPECT_TRUE(load.frame().known);
  EXPECT_EQ(load.reason(), "");
  TestFixture::freeze(*world, 0);
  world->step();
  load.update(*world);
  load.end_frame();
  EXPECT_FALSE(load.frame().known);
  EXPECT_FALSE(load.whole().known);
  EXPECT_NE(load.reason().find("small_steps"), std::string::npos);
}

TYPED_TEST(InstrumentTest, ARegionHasTheEnergyAndSpeedOfTheBodyInIt) {
  constexpr int dim = TypeParam::dim;
  auto description = TestFixture::description();
  description.gravity = 0.0;
  auto world = TypeParam::make(description);
  world->add(TestFixture::at(TestFixture::point(0.0, 5.0), 0, 3.0 * Vec<dim>::Unit(0)));
  world->add(TestFixture::at(TestFixture::point(0.0, 15.0), 0, 2.0 * Vec<dim>::Unit(0)));
  world->step();
  RegionMeter<dim> layer(RegionParams<dim>{.name = "layer", .layer = {4.0, 6.0}}, 1.0);
  const RegionReading reading = layer.read(*world, 0.0);
  EXPECT_EQ(reading.bodies, 1);
  EXPECT_NEAR(reading.kinetic_energy, 4.5 * world->shape_of(0).mass, 1e-3) << "single precision";
  EXPECT_NEAR(reading.mean_speed, 3.0, 1e-6);
  EXPECT_DOUBLE_EQ(reading.solid_volume, 1.0);
  EXPECT_FALSE(reading.packing);
}

TYPED_TEST(InstrumentTest, ARegionHasTheSlopeOfThePlateThatItsBodiesLieOnAwakeOrAsleep) {
  constexpr int dim = TypeParam::dim;
  auto world = TypeParam::make(TestFixture::with_plate(18.0));
  world->record_contacts(true);
  std::vector<BodyIndex> cubes;
  for (int i = 0; i < 16; ++i) {
    for (int row = 0; row < (dim == 2 ? 1 : 3); ++row) {
      BodyDef<dim> cube = TestFixture::on_plate(1.1 * i - 8.25);
      if constexpr (dim == 3) cube.pose.position[1] = 1.1 * (row - 1);
      cubes.push_back(world->add(cube));
    }
  }
  world->add(TestFixture::at(TestFixture::point(10.0, 40.0)));  // falls
  RegionMeter<dim> meter(RegionParams<dim>{.name = "all", .layer = {0.0, 50.0}}, std::sqrt(dim));
  for (const bool asleep : {false, true}) {
    if (asleep) world->freeze(cubes);
    for (int i = 0; i < 30; ++i) world->step();
    meter.note_contacts(*world);
    const Applicable<SurfacePlane> surface = meter.read(*world, 0.0).surface;
    ASSERT_TRUE(surface.value) << surface.why_not;
    // Bounding boxes reach over the cubes by some 0.1 m on each side, so the gaps between them are not even.
    EXPECT_NEAR(surface.value->angle, slope, 0.01);
    EXPECT_LT(surface.value->standard_error, 0.01);
  }
}

/// With sleeping bodies that keep their forces.
template <typename Backend>
class SleepingLoad : public InstrumentTest<Backend> {};
TYPED_TEST_SUITE(SleepingLoad, SmallStepsBackends, BackendName);

TYPED_TEST(SleepingLoad, IsTheWeightOfABoxThatSleepsAndOfOneThatRestsOnIt) {
  constexpr int dim = TypeParam::dim;
  const WorldDescription<dim> description = TestFixture::with_plate();
  const Scene<dim> scene = TestFixture::scene_of(description);
  auto world = TypeParam::make(description);
  world->set_ring(SleepRing{});
  world->record_contacts(true);
  world->add(TestFixture::at(TestFixture::point(0.0, 0.5)));
  const BodyIndex on_plate = world->add(TestFixture::on_plate(0.5));
  LoadMeter<dim> ground(scene, {.name = "ground", .on_ground = true});
  LoadMeter<dim> plate(scene, {.name = "plate", .obstacles = {0}, .about = TestFixture::point(10.0, 2.0)});
  const auto run = [&](double seconds) {
    for (int i = 0; i < std::lround(seconds / dt); ++i) {
      world->step();
      ground.update(*world);
      plate.update(*world);
    }
    ground.end_frame();
    plate.end_frame();
  };
  run(2.0);
  world->freeze(std::vector<BodyIndex>{0, 1});
  run(1.0);
  ASSERT_TRUE(world->awake().empty());
  TestFixture::expect_weights(ground, plate, *world, on_plate);
  const double weight = 10.0 * world->shape_of(0).mass;
  EXPECT_TRUE(plate.frame().known);
  world->add(TestFixture::on_plate(0.5, 1));
  run(2.0);
  run(1.0);
  ASSERT_TRUE(TestFixture::asleep(*world, 1));
  EXPECT_NEAR(TestFixture::force_up(plate), -2.0 * weight, 0.02 * weight) << "one awake on one asleep";
  EXPECT_NEAR(TestFixture::force_up(ground), -weight, 0.01 * weight);
}

/// Sums the loads of a simulation over a frame.
template <int Dim>
class LoadObserver final : public Observer<Dim> {
 public:
  explicit LoadObserver(const Scene<Dim>& scene) {
    for (const LoadParams<Dim>& load : scene.instruments.loads) loads.emplace_back(scene, load);
  }
  bool needs_contacts() const override { return true; }
  void on_motion(const World<Dim>& world, double /*time*/) override {
    for (LoadMeter<Dim>& load : loads) load.update(world);
  }
  void on_frame(const Frame<Dim>& frame) override {
    if (frame.step % 2 == 0)
      for (LoadMeter<Dim>& load : loads) load.end_frame();
  }

  std::vector<LoadMeter<Dim>> loads;
};

/// Of a heap in a bin at rest: the force on the ground, on the walls and on both over its weight.
template <typename Backend>
std::array<double, 3> carried_in_a_bin(const std::string& policy) {
  constexpr int dim = Backend::dim;
  const std::string text = fmt::format(
      "title = \"A bin\"\ndimension = {}\nworld.solver.kind = \"small_steps\"\npolicy.adaptive.rings = 2\npolicy.kind "
      "= \"{}\"\n"
      "shape.cube = {{kind = \"box\", size = {}}}\nrun = {{frames = 1800, until = \"rest\"}}\npile = [{{alpha_deg = "
      "30}}]\nsource = [{{count = 40, rate = 8, position = {}, velocity = {}}}]\n"
      "obstacle = [{{name = \"bin\", kind = \"container\", inner_size = {}, wall = 1}}]\n"
      "load = [{{name = \"below\", on = \"ground\"}}, {{name = \"walls\", on = \"bin\"}}, {{name = \"all\", on "
      "= [\"ground\", \"bin\"]}}]\n",
      dim, policy, dim == 2 ? "[1, 0.6]" : "[1, 1, 0.6]", dim == 2 ? "[0, 12]" : "[0, 0, 12]",
      dim == 2 ? "[0, -8]" : "[0, 0, -8]", dim == 2 ? "[4, 10]" : "[2.5, 2.5, 10]");
  const auto scene = std::get<Scene<dim>>(parse_scene(text, "text"));
  auto simulation = simulation_on<Backend>(scene);
  LoadObserver<dim> observer(scene);
  simulation.add_observer(observer);
  while (!simulation.finished()) simulation.step();
  EXPECT_TRUE(simulation.at_rest());
  const double weight = 40.0 * scene.world.shapes[0].mass * scene.world.gravity;
  std::array<double, 3> carried{};
  for (std::size_t i = 0; i < 3; ++i) carried[i] = -observer.loads[i].frame().mean[dim - 1] / weight;
  return carried;
}

TYPED_TEST(SleepingLoad, OfAHeapAtRestIsItsWeightOnGroundAndWallsTogether) {
  const auto awake = carried_in_a_bin<TypeParam>("full");
  EXPECT_NEAR(awake[2], 1.0, 0.01);
  EXPECT_NEAR(awake[0] + awake[1], awake[2], 1e-6);
  // Once all sleep, a body is solved again if the forces on it changed by more than a hundredth of its weight.
  const auto asleep = carried_in_a_bin<TypeParam>("adaptive");
  EXPECT_NEAR(asleep[2], 1.0, 0.01);
  EXPECT_NEAR(asleep[0] + asleep[1], asleep[2], 1e-6);
}

}  // namespace
}  // namespace talus::instruments_test
