// Tests that other simulators publish, rebuilt from their numbers.

#include <algorithm>
#include <random>

#include "common/math/random.h"
#include "common/measure/support.h"
#include "tools/run/backends.h"
#include "tools/stress/stage.h"

namespace talus {
namespace {

constexpr double small = 0.1;  // radius of SimBenchmark's balls [m]
constexpr double ten_kilogram = 10.0 / (4.0 / 3.0 * std::numbers::pi * small * small * small);  // as a density

/// SimBenchmark's balls of 10 kg in a lattice, `apart` from each other, the lowest at height `low`; ground and balls
/// without friction.
Stage<3> simbenchmark(const StressCell& cell, int across, int layers, double apart, double low, double restitution,
                      double jitter) {
  const Material material{.density = ten_kilogram, .friction = 0.0, .restitution = restitution};
  Stage<3> stage(cell, material);
  stage.rate(1000.0);
  stage.scene.world.solver.restitution_threshold = 0.01;
  const int ball = stage.ball(small, material);
  std::mt19937_64 random(1);
  for (int layer = 0; layer < layers; ++layer)
    for (int i = 0; i < across; ++i)
      for (int j = 0; j < across; ++j)
        stage.body(ball, Vec3(apart * (i - 0.5 * (across - 1)), apart * (j - 0.5 * (across - 1)), low + apart * layer) +
                             uniform_within<3>(Vec3::Constant(jitter), random));
  return stage;
}

/// Root of the mean squared error of the energy over the run, as a share of the energy at the start.
std::vector<double> energy_error(const Stage<3>& stage, double seconds) {
  StressRun<3> run = stage.run();
  run.until(0.001);
  const double start = run.energy();
  double sum = 0.0;
  int steps = 0;
  run.until(seconds, [&] {
    const double error = run.energy() / start - 1.0;
    sum += error * error;
    ++steps;
  });
  return {std::sqrt(sum / steps)};
}

std::vector<double> bouncing(const StressCell& cell) {
  return energy_error(simbenchmark(cell, 7, 1, 0.5, small + 5.0, 1.0, 0.0), 20.0);
}

std::vector<double> elastic_666(const StressCell& cell) {
  return energy_error(simbenchmark(cell, 6, 6, 0.21, 1.101, 1.0, 1e-3), 5.0);
}

/// Root of the mean squared depth of overlap of touching pairs, sampled ten times a second.
std::vector<double> hard_666(const StressCell& cell) {
  StressRun<3> run = simbenchmark(cell, 6, 6, 0.21, 0.101, 0.0, 1e-3).run();
  const WorldDescription<3> description = simbenchmark(cell, 6, 6, 0.21, 0.101, 0.0, 1e-3).scene.world;
  double sum = 0.0;
  int pairs = 0;
  for (int sample = 1; sample <= 50; ++sample) {
    run.until(0.1 * sample);
    for (const Touch& touch : touching_pairs(description, run.states(), 0.0)) {
      sum += touch.distance * touch.distance;
      ++pairs;
    }
  }
  return {pairs == 0 ? 0.0 : std::sqrt(sum / pairs) / small};
}

/// SimBenchmark's rolling test. 25 balls of 1 kg lie on a box of 10 kg, which 150 N push diagonally over the ground for
/// 4 s: error of the final velocity of the box and of the balls, as shares. Coefficients of pairs: ground and box 0.4,
/// box and ball 0.8. The sizes of box and balls are ours.
std::vector<double> rolling(const StressCell& cell) {
  constexpr double push = 150.0;  // [N]
  constexpr double box_mass = 10.0;
  constexpr double balls = 25.0;
  constexpr double seconds = 4.0;
  const Vec3 size(20.0, 20.0, 1.0);
  Stage<3> stage(cell, {.friction = 0.2});
  stage.rate(1000.0);
  stage.scene.world.solver.velocity_iterations = 100;
  const int box = stage.shape(box_pieces<3>(size), {.density = box_mass / size.prod(), .friction = 0.8});
  const int ball = stage.ball(0.5, {.density = 1.0 / (std::numbers::pi / 6.0), .friction = 0.8});
  const auto world = make_world<3>(cell.backend, stage.scene.world);
  world->add({box, {Vec3(0.0, 0.0, 0.5), Rotation<3>::Identity()}, Vec3::Zero(), Spin<3>::Zero()});
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      world->add({ball, {Vec3(2.0 * i, 2.0 * j, 1.5), Rotation<3>::Identity()}, Vec3::Zero(), Spin<3>::Zero()});
  const Vec3 along = Vec3(1.0, 1.0, 0.0).normalized();
  const double dt = stage.scene.world.dt;
  const BodyStates<3>& states = world->states();
  for (double time = 0.0; time < seconds - 0.5 * dt; time += dt) {
    world->set_velocity(0, states.velocity[0] + push / box_mass * dt * along, states.spin[0]);
    world->step();
  }
  // A ball that rolls without slip takes 2/7 of the box's acceleration, and 2/7 of its mass times that from the box.
  const double g = stage.scene.world.gravity;
  const double of_box = (push - 0.4 * (box_mass + balls) * g) / (box_mass + balls * 2.0 / 7.0) * seconds;
  const Vec3 of_ball = 2.0 / 7.0 * of_box * along;
  double worst = 0.0;
  for (BodyIndex i = 1; i < states.size(); ++i) worst = std::max(worst, (states.velocity[i] - of_ball).norm());
  return {(states.velocity[0] - of_box * along).norm() / of_box, worst / of_ball.norm()};
}

/// A stack of three cubes at rest, frozen for a second and woken: largest difference of a contact's force from the
/// weight above it in the first step and in the next tenth of a second, over the weight of a cube.
struct WakingForces {
  template <int Dim>
  std::vector<double> operator()(const StressCell& cell) const {
    Stage<Dim> stage(cell);
    const int cube = stage.cube(1.0);
    const auto world = make_world<Dim>(cell.backend, stage.scene.world);
    world->record_contacts(true);
    const std::vector<BodyIndex> all = {0, 1, 2};
    for (const BodyIndex body : all)
      world->add({cube, {place<Dim>(0.0, 0.5 + body), turned<Dim>(0.0)}, Vec<Dim>::Zero(), Spin<Dim>::Zero()});
    const double dt = stage.scene.world.dt;
    const double weight = world->shape_of(0).mass * stage.scene.world.gravity;
    for (int step = 0; step < 300; ++step) world->step();
    world->freeze(all);
    for (int step = 0; step < 60; ++step) world->step();
    world->thaw(all);
    world->step();
    const double first = force_error(*world, dt) / weight;
    double later = 0.0;
    for (int step = 0; step < 6; ++step) {
      world->step();
      later = std::max(later, force_error(*world, dt) / weight);
    }
    return {first, later};
  }

  /// Of the contact below each body of the stack [N].
  template <int Dim>
  static double force_error(const World<Dim>& world, double dt) {
    std::vector<double> below(world.states().size(), 0.0);
    for (const Contact<Dim>& contact : world.contacts())
      below[std::max(contact.a, contact.b)] += contact.normal_impulse / dt;
    double largest = 0.0;
    for (BodyIndex body = 0; body < std::ssize(below); ++body) {
      const auto above = static_cast<double>(std::ssize(below) - body);
      largest = std::max(largest, std::abs(below[body] - above * world.shape_of(body).mass * 9.81));
    }
    return largest;
  }
};

/// Jolt's MaxBodies with fewer bodies: touching cubes of 1 m fall freely with 4 iterations and no ground. Largest
/// difference of a cube's velocity from that of free fall, over it.
std::vector<double> free_lattice(const StressCell& cell) {
  constexpr int across = 15;
  constexpr double seconds = 1.0;
  Stage<3> stage(cell);
  stage.scene.world.ground.present = false;
  stage.scene.world.solver.velocity_iterations = 4;
  const int cube = stage.cube(1.0);
  for (int x = 0; x < across; ++x)
    for (int y = 0; y < across; ++y)
      for (int z = 0; z < across; ++z) stage.body(cube, Vec3(x, y, z));
  StressRun<3> run = stage.run();
  run.until(seconds);
  const Vec3 fallen(0.0, 0.0, -stage.scene.world.gravity * seconds);
  double worst = 0.0;
  for (const Vec3& velocity : run.states().velocity) worst = std::max(worst, (velocity - fallen).norm());
  return {worst / fallen.norm()};
}

/// Jolt's Pyramid: 1,240 cubes of 2 m in 15 layers, at the start half a metre apart one above the other, and 20 s. The
/// largest shift sideways over a cube's side, and how many cubes are no longer in their layer.
std::vector<double> falling_pyramid(const StressCell& cell) {
  constexpr int high = 15;
  constexpr double side = 2.0;
  constexpr double gap = 0.5;
  Stage<3> stage(cell);
  const int cube = stage.cube(side);
  std::vector<int> layers;
  for (int layer = 0; layer < high; ++layer) {
    const double shift = layer % 2 == 0 ? 0.0 : 0.5 * side;
    for (int i = layer / 2; i < high - (layer + 1) / 2; ++i)
      for (int j = layer / 2; j < high - (layer + 1) / 2; ++j) {
        stage.body(cube, Vec3(side * i + shift - high, side * j + shift - high, 0.5 * side + (side + gap) * layer));
        layers.push_back(layer);
      }
  }
  StressRun<3> run = stage.run();
  run.until(stage.scene.world.dt);  // the first step places the bodies
  const BodyStates<3> before = run.states();
  run.until(20.0);
  int out = 0;
  for (BodyIndex body = 0; body < run.states().size(); ++body)
    out += std::abs(run.at(body)[2] - side * (layers[body] + 0.5)) > 0.25 * side ? 1 : 0;
  return {largest_sideways_shift(run.states(), before) / side, static_cast<double>(out)};
}

}  // namespace

std::vector<StressCase> peer_cases() {
  const std::string_view conserved = "conserved at restitution 1; SimBenchmark plots it over the time step";
  std::vector<StressCase> cases;
  const auto add = [&](std::string name, std::string setup, std::vector<StressGate> gates,
                       std::vector<double> (*measure)(const StressCell&)) {
    StressCase each{.group = "peers", .name = std::move(name), .setup = std::move(setup), .gates = std::move(gates)};
    each.in_space = measure;
    cases.push_back(std::move(each));
  };
  add("simbenchmark-bouncing", "SimBenchmark: 49 balls of 0.1 m fall 5 m, restitution 1, 20 s at 1,000 steps a second",
      {{"error of the energy, share", "", 0.0, 0.05, conserved}}, bouncing);
  add("simbenchmark-elastic-666",
      "SimBenchmark: 216 balls of 0.1 m in a lattice fall 1 m, restitution 1, 5 s at 1,000 steps a second",
      {{"error of the energy, share", "", 0.0, 0.05, conserved}}, elastic_666);
  add("simbenchmark-666", "SimBenchmark: 216 balls of 0.1 m in a lattice collapse, no friction, 5 s",
      {{"overlap of pairs over the radius", "", 0.0, 0.01, "rigid bodies; a hundredth of the radius"}}, hard_666);
  add("simbenchmark-rolling", "SimBenchmark: 25 balls on a box that 150 N push diagonally, 4 s at 1,000 steps a second",
      {{"error of the box's velocity, share", "", 0.0, 0.02, "closed form; the friction cone is round"},
       {"error of the balls' velocity, share", "", 0.0, 0.02, "closed form: they roll without slip"}},
      rolling);
  add("jolt-max-bodies", "Jolt's MaxBodies with 3,375 cubes: a lattice of touching cubes falls freely for 1 s",
      {{"largest error of a velocity, share", "", 0.0, 0.01, "touching bodies in free fall do not act on each other"}},
      free_lattice);
  add("jolt-pyramid", "Jolt's Pyramid: 15 layers of 1,240 cubes of 2 m fall half a metre onto each other, 20 s",
      {{"largest shift sideways over a side", "", 0.0, 0.1,
        "they fall straight down; half a side is where a cube tips"},
       {"cubes that left their layer", "", 0.0, 0.5, "it stands"}},
      falling_pyramid);
  cases.back().known = {
      {"bullet", "",
       "Bullet's friction starts from zero in each step, so the pyramid creeps; 0.02 sides with 50 iterations and "
       "world.solver.warm_friction"}};
  cases.push_back(measured(
      {.group = "peers",
       .name = "waking-forces",
       .setup = "a stack of three cubes at rest is frozen for a second and woken, as in the sleep tests of DART",
       .gates = {{"error of a force in the first step", "weights", 0.0, 0.1, "waking brings back the weight above"},
                 {"error of a force in 0.1 s", "weights", 0.0, 0.1, "the weight above"}}},
      WakingForces{}));
  return cases;
}

}  // namespace talus
