// Settings, sizes, places and speeds at the edge of what a scene may have.

#include <fmt/format.h>

#include <algorithm>

#include "tools/run/backends.h"
#include "tools/stress/stage.h"

namespace talus {
namespace {

/// A column of rectangles, each turned a little against the one below where space allows.
template <int Dim>
void add_column(Stage<Dim>& stage, int shape, int count, double size, double x) {
  for (int i = 0; i < count; ++i) stage.body(shape, place<Dim>(x, size * (0.5 + i)));
}

/// Two hundred dropped L shapes would take minutes at 240 steps a second: 60 boxes do.
struct PourAtRate {
  double rate = 60.0;
  template <int Dim>
  std::vector<double> operator()(const StressCell& cell) const {
    Stage<Dim> stage(cell);
    stage.rate(rate);
    stage.box(1.0, 0.5, 0.5);
    stage.scene.sources = {{.count = 60,
                            .rate = 6.0,
                            .position = place<Dim>(0.0, 10.0),
                            .spread = place<Dim>(1.0, 0.0),
                            .velocity = place<Dim>(0.0, -8.0)}};
    StressRun<Dim> run = stage.run();
    double deepest = 0.0;
    int step = 0;
    const int between = std::max(1, static_cast<int>(rate / 10.0));
    run.until(16.0, [&] {
      if (++step % between == 0) deepest = std::max(deepest, run.penetration());
    });
    return {run.penetration(), deepest, static_cast<double>(run.warnings()), static_cast<double>(run.floating())};
  }
};

struct Iterations {
  int iterations = 10;
  template <int Dim>
  std::vector<double> operator()(const StressCell& cell) const {
    Stage<Dim> stage(cell);
    stage.scene.world.solver.velocity_iterations = iterations;
    add_column<Dim>(stage, stage.cube(1.0), 10, 1.0, 0.0);
    StressRun<Dim> run = stage.run();
    run.until(10.0);
    double sideways = 0.0;
    for (BodyIndex i = 0; i < 10; ++i) sideways = std::max(sideways, horizontal<Dim>(run.at(i)).norm());
    return {sideways, std::max(0.0, 9.5 - height<Dim>(run.at(9)))};
  }
};

/// Three cubes of a size on each other, over a time that grows with the square root of the size.
struct Size {
  double side = 1.0;
  template <int Dim>
  std::vector<double> operator()(const StressCell& cell) const {
    Stage<Dim> stage(cell);
    add_column<Dim>(stage, stage.cube(side), 3, side, 0.0);
    StressRun<Dim> run = stage.run();
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
  Vec<Dim> fall(const StressCell& cell, double at) const {
    Stage<Dim> stage(cell);
    stage.body(stage.shape(l_pieces<Dim>(LParams{})), place<Dim>(at, 2.0), 0.5);
    StressRun<Dim> run = stage.run();
    run.until(6.0);
    return run.at(0) - place<Dim>(at, 0.0);
  }
  template <int Dim>
  std::vector<double> operator()(const StressCell& cell) const {
    return {(fall<Dim>(cell, 0.0) - fall<Dim>(cell, x)).norm()};
  }
};

/// Balls of radius 0.1 m fly against a wall of 0.1 m, each from another phase of its step.
struct ThinWall {
  double speed = 100.0;
  double length = 40.0;  // of the wall [m]
  template <int Dim>
  std::vector<double> operator()(const StressCell& cell) const {
    constexpr int balls = 60;
    Stage<Dim> stage(cell);
    stage.scene.world.gravity = 0.0;
    stage.scene.world.ground.present = false;
    stage.fixed_box(sides<Dim>(0.1, length, 4.0), place<Dim>(0.0, 0.0));
    const int ball = stage.ball(0.1);
    for (int i = 0; i < balls; ++i)
      stage.body(ball, place<Dim>(-2.0 - speed / 60.0 * i / balls, 0.6 * (i - 0.5 * balls)), 0.0,
                 place<Dim>(speed, 0.0));
    StressRun<Dim> run = stage.run();
    run.until(0.5);
    int through = 0;
    for (BodyIndex i = 0; i < balls; ++i) through += run.at(i)[0] > 0.0 ? 1 : 0;
    return {static_cast<double>(through)};
  }
};

/// Cubes of 1 m that begin half inside of each other.
struct Overlap {
  template <int Dim>
  std::vector<double> operator()(const StressCell& cell) const {
    Stage<Dim> stage(cell);
    const int cube = stage.cube(1.0);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) stage.body(cube, place<Dim>(0.5 * i, 0.5 + 0.5 * j));
    StressRun<Dim> run = stage.run();
    double fastest = 0.0;
    run.until(5.0, [&] {
      for (const BodyIndex body : run.world().awake()) fastest = std::max(fastest, run.states().velocity[body].norm());
    });
    return {fastest, run.penetration()};
  }
};

/// A stack left alone for a long time.
struct LongRest {
  double seconds = 10'000.0;
  template <int Dim>
  std::vector<double> operator()(const StressCell& cell) const {
    Stage<Dim> stage(cell);
    add_column<Dim>(stage, stage.cube(1.0), 3, 1.0, 0.0);
    StressRun<Dim> run = stage.run();
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
  std::vector<double> operator()(const StressCell& cell) const {
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

constexpr std::string_view coarse =
    "in steps this long Bullet's bodies sink deep into each other and the ground; talus check warns below 60";
constexpr std::string_view few_iterations =
    "Bullet's friction starts from zero in each step, so with few iterations a tower creeps; 20 hold this one";
constexpr std::string_view creeping =
    "Bullet's friction starts from zero in each step, so what is awake creeps for ever";

StressCase rate_case(double rate) {
  return measured(
      {.group = "extremes",
       .name = fmt::format("rate-{:g}", rate),
       .setup = fmt::format("60 boxes poured at {:g} steps a second, 6 s of rest", rate),
       .gates = {{"deepest overlap at the end", "m", 0.0, 0.025, "rigid bodies; a twentieth of a box's thickness"},
                 {"deepest overlap on the way", "m", 0.0, 18.0 / rate,
                  "the way of one step at the speed of arrival, 16 m/s, and a tenth more"},
                 {"kinds of warnings", "", 0.0, 0.0, "nothing sinks, escapes or gains energy"},
                 {"floating sleepers", "", 0.0, 0.0, "what sleeps lies on something"}},
       .policies = StressPolicies::all,
       .quick = rate == 60.0,
       .may_be_refused = rate < 30.0,
       .known = {{"bullet", "", coarse}, {"bullet-planar", "", coarse}}},
      PourAtRate{rate});
}

StressCase iterations_case(int iterations) {
  return measured({.group = "extremes",
                   .name = fmt::format("iterations-{}", iterations),
                   .setup = fmt::format("ten cubes on each other with {} iterations, 10 s", iterations),
                   .gates = {{"largest shift sideways", "m", 0.0, 0.05, "stands by statics"},
                             {"sinking of the top", "m", 0.0, 0.02, "rigid bodies"}},
                   .known = {{"bullet", "", few_iterations}, {"bullet-planar", "", few_iterations}}},
                  Iterations{iterations});
}

StressCase size_case(double side) {
  return measured(
      {.group = "extremes",
       .name = fmt::format("size-{:g}", side),
       .setup = fmt::format("three cubes of {:g} m on each other", side),
       .gates = {{"height of the third off, over its side", "", 0.0, 0.02, "rigid bodies; the same at any size"},
                 {"shift sideways over its side", "", 0.0, 0.02, "stands by statics"}},
       .quick = side == 1.0,
       .may_be_refused = side < 0.05,
       .known = {{"box2d", "", "Box2D holds polygons 0.01 to 0.015 m apart whatever their size"},
                 {"", "", "Bullet's margin of 0.04 m is as large as the cubes"}}},
      Size{side});
}

StressCase far_case(double x) {
  return measured({.group = "extremes",
                   .name = fmt::format("far-{:g}", x),
                   .setup = fmt::format("an L falls {:g} m from the origin", x),
                   .gates = {{"difference of its place from that at the origin", "m", 0.0, 0.05,
                              "space is alike everywhere; single precision resolves a millimetre at 10 km"}},
                   .quick = x <= 100.0,
                   .may_be_refused = x > 1e4},
                  FarAway{x});
}

StressCase wall_case(double speed) {
  return measured({.group = "extremes",
                   .name = fmt::format("wall-{:g}", speed),
                   .setup = fmt::format("60 balls of 0.2 m at {:g} m/s against a wall of 0.1 m", speed),
                   .gates = {{"balls behind the wall", "", 0.0, 0.0, "continuous collision lets none through"}},
                   .quick = speed <= 100.0,
                   .may_be_refused = speed > 100.0},
                  ThinWall{speed});
}

StressCase long_wall_case(double length) {
  return measured(
      {.group = "extremes",
       .name = fmt::format("wall-length-{:g}", length),
       .setup = fmt::format("60 balls of 0.2 m at 10 m/s against a wall of 0.1 m that is {:g} m long", length),
       .gates = {{"balls behind the wall", "", 0.0, 0.0, "continuous collision lets none through"}},
       .known = {{"bullet", "",
                  "Bullet's distances to a box lose precision with the box's longest side: from some 1,000 "
                  "thicknesses on it misses contacts"}}},
      ThinWall{10.0, length});
}

}  // namespace

std::vector<StressCase> extreme_cases() {
  std::vector<StressCase> cases;
  for (const double rate : {15.0, 30.0, 40.0, 50.0, 60.0, 120.0, 240.0}) cases.push_back(rate_case(rate));
  for (const int iterations : {4, 5, 6, 8, 10, 20, 50, 100}) cases.push_back(iterations_case(iterations));
  for (const double side : {0.001, 0.01, 0.02, 0.03, 0.05, 0.1, 0.2, 0.5, 1.0, 5.0, 20.0, 100.0, 1000.0})
    cases.push_back(size_case(side));
  for (const double x : {100.0, 1e3, 9e3, 1e5, 1e6}) cases.push_back(far_case(x));
  for (const double speed : {10.0, 100.0, 119.0, 400.0, 1000.0}) cases.push_back(wall_case(speed));
  for (const double length : {40.0, 100.0, 150.0, 200.0, 400.0, 1000.0}) cases.push_back(long_wall_case(length));
  cases.push_back(measured({.group = "extremes",
                            .name = "overlap",
                            .setup = "sixteen cubes that begin half inside of each other, 5 s",
                            .gates = {{"fastest body", "m/s", 0.0, 15.0,
                                       "the overlap is worth a fall of a metre or two; more is an explosion"},
                                      {"deepest overlap at the end", "m", 0.0, 0.05, "rigid bodies"}},
                            .quick = true},
                           Overlap{}));
  cases.push_back(measured({.group = "extremes",
                            .name = "rest-10000-s",
                            .setup = "three cubes on each other for 10,000 s",
                            .gates = {{"largest shift", "m", 0.0, 0.02, "at rest by statics"},
                                      {"kinds of warnings", "", 0.0, 0.0, "nothing sinks, escapes or gains energy"}},
                            .policies = StressPolicies::all,
                            .known = {{"bullet", "", creeping}, {"bullet-planar", "", creeping}}},
                           LongRest{}));
  for (const int times : {1000, 1'000'000}) {
    cases.push_back(
        measured({.group = "extremes",
                  .name = fmt::format("freeze-thaw-{}", times),
                  .setup = fmt::format("the upper of two cubes is frozen and thawed {} times", times),
                  .gates = {{"largest shift", "m", 0.0, 0.01, "a freeze and a thaw move nothing"}},
                  .quick = times == 1000,
                  .known = {{"", "",
                             "a thawed body begins without the last step's impulses: in Bullet two thaws in "
                             "ten steps add up to a micrometre a step"}}},
                 FreezeThaw{times}));
  }
  return cases;
}

}  // namespace talus
