// Settings, sizes, places and speeds at the edge of the window in which results hold.

#include <fmt/format.h>

#include <algorithm>

#include "tests/physics/stage.h"
#include "tools/run/backends.h"

namespace talus {
namespace {

/// Cubes on each other.
template <int Dim>
void add_column(Stage<Dim>& stage, int shape, int count, double size, double x) {
  for (int i = 0; i < count; ++i) stage.body(shape, place<Dim>(x, size * (0.5 + i)));
}

/// Sixty boxes are poured.
struct PourAtRate {
  double rate = 60.0;
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    Stage<Dim> stage(cell);
    stage.rate(rate);
    stage.box(1.0, 0.5, 0.5);
    stage.scene.sources = {{.count = 60,
                            .rate = 6.0,
                            .position = place<Dim>(0.0, 10.0),
                            .spread = place<Dim>(1.0, 0.0),
                            .velocity = place<Dim>(0.0, -8.0)}};
    StageRun<Dim> run = stage.run();
    double deepest = 0.0;
    int step = 0;
    const int between = std::max(1, static_cast<int>(rate / 10.0));
    run.until(16.0, [&] {
      if (++step % between == 0) deepest = std::max(deepest, run.penetration());
    });
    return {run.penetration(), deepest, static_cast<double>(run.warnings()), static_cast<double>(run.floating())};
  }
};

/// Three cubes of a size on each other, over a time that grows with the square root of the size.
struct Size {
  double side = 1.0;
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    Stage<Dim> stage(cell);
    add_column<Dim>(stage, stage.cube(side), 3, side, 0.0);
    StageRun<Dim> run = stage.run();
    run.until(5.0 * std::max(1.0, std::sqrt(side)));
    double sideways = 0.0;
    for (BodyIndex i = 0; i < 3; ++i) sideways = std::max(sideways, horizontal<Dim>(run.at(i)).norm());
    return {std::abs(height<Dim>(run.at(2)) / side - 2.5), sideways / side};
  }
};

/// A turned L falls on the ground at the origin and far from it.
struct FarAway {
  double x = 1e3;
  template <int Dim>
  Vec<Dim> fall(const PhysicsCell& cell, double at) const {
    Stage<Dim> stage(cell);
    stage.body(stage.shape(l_pieces<Dim>(LParams{})), place<Dim>(at, 2.0), 0.5);
    StageRun<Dim> run = stage.run();
    run.until(6.0);
    return run.at(0) - place<Dim>(at, 0.0);
  }
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    return {(fall<Dim>(cell, 0.0) - fall<Dim>(cell, x)).norm()};
  }
};

/// Balls of radius 0.1 m fly against a wall of 0.1 m, each from another phase of its step.
struct ThinWall {
  double speed = 100.0;
  double length = 40.0;  // of the wall [m]
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    constexpr int balls = 60;
    Stage<Dim> stage(cell);
    stage.scene.world.gravity = 0.0;
    stage.scene.world.ground.present = false;
    stage.fixed_box(sides<Dim>(0.1, length, 4.0), place<Dim>(0.0, 0.0));
    const int ball = stage.ball(0.1);
    for (int i = 0; i < balls; ++i)
      stage.body(ball, place<Dim>(-2.0 - speed / 60.0 * i / balls, 0.6 * (i - 0.5 * balls)), 0.0,
                 place<Dim>(speed, 0.0));
    StageRun<Dim> run = stage.run();
    run.until(0.5);
    int through = 0;
    for (BodyIndex i = 0; i < balls; ++i) through += run.at(i)[0] > 0.0 ? 1 : 0;
    return {static_cast<double>(through)};
  }
};

/// Cubes of 1 m that begin half inside of each other.
struct Overlap {
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    Stage<Dim> stage(cell);
    const int cube = stage.cube(1.0);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) stage.body(cube, place<Dim>(0.5 * i, 0.5 + 0.5 * j));
    StageRun<Dim> run = stage.run();
    double fastest = 0.0;
    run.until(5.0, [&] {
      for (const BodyIndex body : run.world().awake()) fastest = std::max(fastest, run.states().velocity[body].norm());
    });
    return {fastest, run.penetration()};
  }
};

/// A stack left alone for a long time.
struct LongRest {
  double seconds = 1'000.0;
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    Stage<Dim> stage(cell);
    add_column<Dim>(stage, stage.cube(1.0), 3, 1.0, 0.0);
    StageRun<Dim> run = stage.run();
    run.until(2.0);
    const BodyStates<Dim> settled = run.states();
    run.until(seconds);
    return {largest_shift(run.states(), settled), static_cast<double>(run.warnings())};
  }
};

/// The upper of two cubes is frozen and thawed again and again, with a step in between now and then.
struct FreezeThaw {
  int times = 1000;
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    Stage<Dim> stage(cell);
    const int cube = stage.cube(1.0);
    const auto world = make_world<Dim>(cell.backend, stage.scene.world);
    for (int i = 0; i < 2; ++i) {
      BodyDef<Dim> body;
      body.shape = cube;
      body.pose.position = place<Dim>(0.0, 0.5 + i);
      world->add(body);
    }
    for (int i = 0; i < 120; ++i) world->step();
    const BodyStates<Dim> settled = world->states();
    const std::vector<BodyIndex> upper = {1};
    for (int i = 0; i < times; ++i) {
      world->freeze(upper);
      if (i % 10 == 0) world->step();
      world->thaw(upper);
      if (i % 10 == 5) world->step();
    }
    for (int i = 0; i < 120; ++i) world->step();
    return {largest_shift(world->states(), settled)};
  }
};

PhysicsCase rate_case(double rate, std::vector<PhysicsCell> except) {
  return measured({.group = "window",
                   .name = fmt::format("rate-{:g}", rate),
                   .setup = fmt::format("60 boxes poured at {:g} steps a second, 6 s of rest", rate),
                   .gates = {{"deepest overlap at the end", "m", 0.0, 0.03, "rigid bodies; 6 % of a box's thickness"},
                             {"deepest overlap on the way", "m", 0.0, 18.0 / rate,
                              "the way of one step at the speed of arrival, 16 m/s, and a tenth more"},
                             {"kinds of warnings", "", 0.0, 0.0, "nothing sinks, escapes or gains energy"},
                             {"floating sleepers", "", 0.0, 0.0, "what sleeps lies on something"}},
                   .policies = every_policy,
                   .except = std::move(except)},
                  PourAtRate{rate});
}

PhysicsCase size_case(double side) {
  return measured({.group = "window",
                   .name = fmt::format("size-{:g}", side),
                   .setup = fmt::format("three cubes of {:g} m on each other", side),
                   .gates = {{"height of the third off, over its side", "", 0.0, 0.05 / side + 0.02,
                              "rigid bodies; engines hold each 0.015 m apart, whatever its size"},
                             {"shift sideways over its side", "", 0.0, 0.03, "stands by statics"}}},
                  Size{side});
}

PhysicsCase far_case(double x) {
  return measured({.group = "window",
                   .name = fmt::format("far-{:g}", x),
                   .setup = fmt::format("an L falls {:g} m from the origin", x),
                   .gates = {{"difference of its place from that at the origin", "m", 0.0, 0.05,
                              "space is alike everywhere; single precision resolves a millimetre at 10 km"}}},
                  FarAway{x});
}

PhysicsCase wall_case(double speed, double length) {
  return measured(
      {.group = "window",
       .name = fmt::format("wall-{:g}-{:g}", length, speed),
       .setup = fmt::format("60 balls of 0.2 m at {:g} m/s against a wall of 0.1 m that is {:g} m long", speed, length),
       .gates = {{"balls behind the wall", "", 0.0, 0.0, "continuous collision lets none through"}}},
      ThinWall{speed, length});
}

}  // namespace

std::vector<PhysicsCase> window_edge_cases() {
  std::vector<PhysicsCase> cases;
  // The fewest steps a second differ from engine to engine.
  cases.push_back(rate_case(30.0, {{"bullet-planar", ""}, {"bullet", ""}}));
  cases.push_back(rate_case(40.0, {{"bullet", ""}}));
  cases.push_back(rate_case(50.0, {}));
  for (const double side : {0.1, 1.0, 100.0}) cases.push_back(size_case(side));
  for (const double x : {100.0, 9e3}) cases.push_back(far_case(x));
  cases.push_back(wall_case(100.0, 40.0));
  cases.push_back(wall_case(10.0, 100.0));
  cases.push_back(measured({.group = "window",
                            .name = "overlap",
                            .setup = "sixteen cubes that begin half inside of each other, 5 s",
                            .gates = {{"fastest body", "m/s", 0.0, 15.0,
                                       "the overlap is worth a fall of a metre or two; more is an explosion"},
                                      {"deepest overlap at the end", "m", 0.0, 0.05, "rigid bodies"}}},
                           Overlap{}));
  cases.push_back(measured({.group = "window",
                            .name = "long-rest",
                            .setup = "three cubes on each other for 1,000 s",
                            .gates = {{"largest shift", "m", 0.0, 0.02, "at rest by statics"},
                                      {"kinds of warnings", "", 0.0, 0.0, "nothing sinks, escapes or gains energy"}},
                            .policies = sleeping_policies},
                           LongRest{}));
  cases.push_back(measured({.group = "window",
                            .name = "freeze-thaw",
                            .setup = "the upper of two cubes is frozen and thawed 1,000 times",
                            .gates = {{"largest shift", "m", 0.0, 0.01, "a freeze and a thaw move nothing"}}},
                           FreezeThaw{}));
  return cases;
}

}  // namespace talus
