// Structures that stand by the laws of statics.

#include <fmt/format.h>

#include <algorithm>

#include "tests/physics/stage.h"

namespace talus {
namespace {

/// Structures are watched from when their contacts have settled on.
constexpr double settled_at = 2.0;  // [s]
constexpr double watched_until = 10.0;

/// Runs the structure; the largest sideways shift over the whole run, the largest sinking of a body once settled, and
/// the number of sleepers that hang in the air.
template <int Dim>
std::vector<double> watch(const Stage<Dim>& stage) {
  StageRun<Dim> run = stage.run();
  run.until(1.0 / 60.0);  // the first step adds the bodies
  const BodyStates<Dim> first = run.states();
  run.until(settled_at);
  const BodyStates<Dim> settled = run.states();
  run.until(watched_until);
  double sinking = 0.0;
  for (BodyIndex i = 0; i < settled.size(); ++i)
    sinking = std::max(sinking, std::abs(height<Dim>(run.at(i) - settled.pose[i].position)));
  return {largest_sideways_shift(run.states(), first), sinking, static_cast<double>(run.floating())};
}

std::vector<PhysicsGate> standing_gates(double sideways, double sinking) {
  return {{"largest shift sideways", "m", 0.0, sideways, "stands by statics"},
          {"largest change of height after 2 s", "m", 0.0, sinking, "at rest by statics"},
          {"floating sleepers", "", 0.0, 0.0, "what sleeps lies on something"}};
}

struct Stack {
  int boxes = 10;
  int iterations = 10;
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    Stage<Dim> stage(cell);
    stage.scene.world.solver.velocity_iterations = iterations;
    const int cube = stage.cube(1.0);
    for (int i = 0; i < boxes; ++i) stage.body(cube, place<Dim>(0.0, 0.5 + i));
    return watch(stage);
  }
};

struct Pyramid {
  int base = 10;
  int iterations = 10;
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    Stage<Dim> stage(cell);
    const int cube = stage.cube(1.0);
    for (int row = 0; row < base; ++row)
      for (int i = 0; i < base - row; ++i) stage.body(cube, place<Dim>(1.05 * (i - 0.5 * (base - row - 1)), 0.5 + row));
    stage.scene.world.solver.velocity_iterations = iterations;
    return watch(stage);
  }
};

/// Stones of equal angle in half a circle.
struct Arch {
  int iterations = 10;
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    constexpr int stones = 10;
    constexpr double inner = 3.0;
    constexpr double outer = 4.0;
    const double half = in_radians(90.0 / stones);
    const std::vector<Vec2> corners = {{-inner * std::sin(half), inner * std::cos(half)},
                                       {inner * std::sin(half), inner * std::cos(half)},
                                       {outer * std::sin(half), outer * std::cos(half)},
                                       {-outer * std::sin(half), outer * std::cos(half)}};
    Stage<Dim> stage(cell, {.friction = 0.8});
    const int stone = stage.shape(polygon_pieces<Dim>(corners, 1.0), {.friction = 0.8});
    const double radius = stage.scene.world.shapes[stone].reference.norm();  // from the circle's middle to the centre
    for (int i = 0; i < stones; ++i) {
      const double angle = (2 * i - stones + 1) * half;
      stage.body(stone, place<Dim>(-radius * std::sin(angle), radius * std::cos(angle)), angle);
    }
    stage.scene.world.solver.velocity_iterations = iterations;
    return watch(stage);
  }
};

/// Two pairs of cards that lean on each other, a card across them, and a third pair on it.
struct CardHouse {
  int iterations = 10;
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    constexpr double apex = 1.732;   // height of a pair whose cards stand at 60 degrees
    constexpr double thick = 0.115;  // of a card, measured along x at its foot
    constexpr double roof = 0.1;
    const Material paper{.friction = 0.6};
    const std::vector<Vec2> left = {{-1.0, 0.0}, {-1.0 + thick, 0.0}, {0.0, apex * (1.0 - thick)}, {0.0, apex}};
    const std::vector<Vec2> right = {{1.0 - thick, 0.0}, {1.0, 0.0}, {0.0, apex}, {0.0, apex * (1.0 - thick)}};
    Stage<Dim> stage(cell, paper);
    const int cards[] = {stage.shape(polygon_pieces<Dim>(left, 1.0), paper),
                         stage.shape(polygon_pieces<Dim>(right, 1.0), paper)};
    const int plank = stage.box(4.4, roof, 1.0, paper);
    const auto add_pair = [&](double x, double z) {
      for (const int card : cards) stage.body(card, place<Dim>(x, z) - stage.scene.world.shapes[card].reference);
    };
    add_pair(-1.2, 0.0);
    add_pair(1.2, 0.0);
    stage.body(plank, place<Dim>(0.0, apex + 0.5 * roof));
    add_pair(0.0, apex + roof);
    stage.scene.world.solver.velocity_iterations = iterations;
    return watch(stage);
  }
};

/// A row of dominoes, the first tilted so far that it falls; the others have stood for a while, the far ones asleep.
struct Dominoes {
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    constexpr int dominoes = 30;
    constexpr double tall = 2.0;
    constexpr double thick = 0.3;
    constexpr double apart = 1.0;
    Stage<Dim> stage(cell);
    const int domino = stage.box(thick, tall, 1.0);
    const double tilt = in_radians(12.0);
    const Vec<Dim> corner = place<Dim>(0.5 * thick, 0.0);
    stage.body(domino, corner + turned<Dim>(-tilt) * place<Dim>(-0.5 * thick, 0.5 * tall), -tilt);
    for (int i = 1; i < dominoes; ++i) stage.body(domino, place<Dim>(i * apart, 0.5 * tall));
    StageRun<Dim> run = stage.run();
    std::vector<double> fell(dominoes, 0.0);
    run.until(15.0, [&] {
      for (int i = 0; i < dominoes; ++i) {
        const Vec<Dim> axis = run.states().pose[i].rotation * Vec<Dim>::Unit(Dim - 1);
        if (fell[i] == 0.0 && height<Dim>(axis) < std::cos(in_radians(20.0))) fell[i] = run.time();
      }
    });
    const auto standing = std::ranges::count(fell, 0.0);
    return {static_cast<double>(standing), standing > 0 ? std::nan("") : (fell[19] - fell[10]) / (fell[28] - fell[19])};
  }
};

/// A cube on another that is lighter, of less density or of less size.
struct HeavyOnLight {
  double ratio = 10.0;
  int iterations = 10;
  bool larger = false;
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    Stage<Dim> stage(cell);
    const int light = stage.cube(1.0);
    const double side = larger ? std::pow(ratio, 1.0 / Dim) : 1.0;
    const int heavy = stage.cube(side, {.density = larger ? 1000.0 : 1000.0 * ratio});
    stage.scene.world.solver.velocity_iterations = iterations;
    stage.body(light, place<Dim>(0.0, 0.5));
    stage.body(heavy, place<Dim>(0.0, 1.0 + 0.5 * side));
    StageRun<Dim> run = stage.run();
    run.until(watched_until);
    return {std::max(0.0, 1.0 + 0.5 * side - height<Dim>(run.at(1)))};
  }
};

/// A wedge in a notch of its own angle, with a load ten times its weight on it.
struct Wedge {
  int iterations = 10;
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    const double half = in_radians(15.0);
    constexpr double top = 2.0;  // height of the wedge [m]
    const Vec<Dim> along = place<Dim>(std::sin(half), std::cos(half));
    const Vec<Dim> outwards = place<Dim>(std::cos(half), -std::sin(half));
    Stage<Dim> stage(cell);
    for (const double side : {-1.0, 1.0}) {
      Vec<Dim> centre = 2.0 * along + 0.5 * outwards;
      centre[0] *= side;
      centre[Dim - 1] += 1.0;
      stage.fixed_box(sides<Dim>(1.0, 4.0, 3.0), centre, -side * half);
    }
    const double wide = top * std::tan(half);
    const std::vector<Vec2> corners = {{0.0, 0.0}, {wide, top}, {-wide, top}};
    const int wedge = stage.shape(polygon_pieces<Dim>(corners, 1.0));
    const double area = wide * top;
    const int load = stage.box(0.8 * wide, 1.0, 1.0, {.density = 10.0 * 1000.0 * area / (0.8 * wide)});
    stage.body(wedge, place<Dim>(0.0, 1.0) - stage.scene.world.shapes[wedge].reference);
    stage.body(load, place<Dim>(0.0, 1.0 + top + 0.5));
    stage.scene.world.solver.velocity_iterations = iterations;
    return watch(stage);
  }
};

PhysicsCase stack(int boxes, int iterations, std::vector<std::string_view> policies) {
  std::vector<PhysicsGate> gates = standing_gates(0.05, 0.02);
  if (boxes >= 20) {
    gates[0] = {"largest shift sideways", "m", 0.0, 0.25, "stands: half of what overturns the top cube"};
    gates[1] = {"largest change of height after 2 s", "m", 0.0, 0.002 * boxes,
                "at rest by statics; Box2D pushes each cube apart by 2 mm in the time until it sleeps"};
  }
  return measured({.group = "standing",
                   .name = fmt::format("stack-{}", boxes),
                   .setup = fmt::format("{} cubes of 1 m on each other, {} iterations, 10 s", boxes, iterations),
                   .gates = std::move(gates),
                   .policies = std::move(policies)},
                  Stack{boxes, iterations});
}

PhysicsCase heavy_on_light(double ratio, int iterations, bool larger) {
  return measured(
      {.group = "standing",
       .name = fmt::format("{}-on-{}-{:g}", larger ? "large" : "heavy", larger ? "small" : "light", ratio),
       .setup = fmt::format("a cube of {:g} times the mass on another{}, {} iterations, 10 s", ratio,
                            larger ? " of the same matter" : "", iterations),
       .gates = {{"sinking of the upper cube", "m", 0.0, 0.015, "the lower one is rigid; its contacts are springs"}},
       .policies = every_policy},
      HeavyOnLight{ratio, iterations, larger});
}

PhysicsCase structure(std::string name, const std::string& setup, double sideways,
                      std::vector<std::string_view> policies) {
  return {.group = "standing",
          .name = std::move(name),
          .setup = setup + ", 50 iterations, 10 s",
          .gates = standing_gates(sideways, 0.02),
          .policies = std::move(policies)};
}

}  // namespace

std::vector<PhysicsCase> standing_cases() {
  std::vector<PhysicsCase> cases;
  cases.push_back(stack(5, 10, every_policy));
  // What is awake creeps on Bullet and moves apart on Box2D: higher ones must stand asleep.
  cases.push_back(stack(20, 10, {"adaptive"}));
  cases.push_back(stack(40, 50, {"adaptive"}));
  cases.push_back(measured(
      structure("pyramid", "a pyramid of cubes with gaps of 0.05 m, ten in the lowest row", 0.05, sleeping_policies),
      Pyramid{10, 50}));
  cases.push_back(
      measured(structure("arch", "ten stones in half a circle, friction 0.8", 0.1, every_policy), Arch{50}));
  cases.push_back(measured(
      structure("card-house", "three pairs of cards at 60 degrees and a plank, friction 0.6", 0.1, every_policy),
      CardHouse{50}));
  cases.push_back(measured(
      structure("wedge", "a wedge of 30 degrees in a notch, ten times its weight on it", 0.02, sleeping_policies),
      Wedge{50}));
  cases.push_back(measured(
      {.group = "standing",
       .name = "dominoes",
       .setup = "thirty dominoes of 2 m, 1 m apart, the first tilted by 12 degrees",
       .gates = {{"dominoes left standing", "", 0.0, 0.0, "each topples the next one"},
                 {"time of dominoes 10 to 19 over that of 19 to 28", "", 1.0, 0.05, "the wave reaches a steady speed"}},
       .policies = every_policy},
      Dominoes{}));
  for (const double ratio : {10.0, 20.0}) cases.push_back(heavy_on_light(ratio, 10, false));
  for (const double ratio : {50.0, 100.0}) cases.push_back(heavy_on_light(ratio, 50, false));
  cases.push_back(heavy_on_light(20.0, 10, true));
  return cases;
}

}  // namespace talus
