// Freezing and waking under load.

#include <fmt/format.h>

#include <algorithm>

#include "tests/physics/stage.h"

namespace talus {
namespace {

/// Boxes poured onto one spot, the last after `count` / 6 seconds.
template <int Dim>
Source<Dim> pour(int count, double x) {
  return {.count = count,
          .rate = 6.0,
          .position = place<Dim>(x, 10.0),
          .spread = place<Dim>(1.0, 0.0),
          .velocity = place<Dim>(0.0, -8.0)};
}

/// A wall of cubes in columns a little apart, asleep from the start where the policy lets them.
template <int Dim>
void add_wall(Stage<Dim>& stage, int shape, int columns, int rows, double x, bool asleep) {
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < columns; ++i) {
      const BodyIndex body = stage.body(shape, place<Dim>(x + 1.02 * (i - 0.5 * (columns - 1)), 0.5 + row));
      stage.scene.bodies[body].asleep = asleep;
    }
  }
}

const PhysicsGate no_warning = {"kinds of warnings", "", 0.0, 0.0, "nothing sinks, escapes or gains energy"};
const PhysicsGate none_floats = {"floating sleepers", "", 0.0, 0.0, "what sleeps lies on something"};

/// The lowest row of a sleeping wall is taken away, or every second body of it.
struct SupportPulled {
  int every = 1;
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    constexpr int columns = 6;
    constexpr int rows = 5;
    Stage<Dim> stage(cell);
    add_wall<Dim>(stage, stage.cube(1.0), columns, rows, 0.0, true);
    StageRun<Dim> run = stage.run();
    run.until(3.0);
    const BodyStates<Dim> before = run.states();
    for (int i = 0; i < columns; i += every) run.simulation().remove(i);
    run.until(8.0);
    int hanging = 0;  // of the columns whose lowest body is gone
    for (int i = 0; i < columns; i += every)
      for (int row = 1; row < rows; ++row) {
        const BodyIndex body = row * columns + i;
        hanging += height<Dim>(before.pose[body].position - run.at(body)) < 0.5 ? 1 : 0;
      }
    return {double(hanging), double(run.floating()), double(run.warnings())};
  }
};

/// Boxes at rest in a bin whose floor slides away.
struct Trapdoor {
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    Stage<Dim> stage(cell);
    const int box = stage.box(0.6, 0.6, 0.6);
    for (const double side : {-1.0, 1.0}) stage.fixed_box(sides<Dim>(0.5, 8.0, 6.0), place<Dim>(2.75 * side, 9.0));
    if constexpr (Dim == 3)
      for (const double side : {-1.0, 1.0}) stage.fixed_box(Vec3(6.0, 0.5, 8.0), Vec3(0.0, 1.25 * side, 9.0));
    const int floor = stage.fixed_box(sides<Dim>(6.0, 0.5, 6.0), place<Dim>(0.0, 4.75));
    Motion<Dim> slide;
    slide.times = {6.0, 7.0};
    slide.shifts = {Vec<Dim>::Zero(), place<Dim>(9.0, 0.0)};
    stage.move(floor, slide);
    for (int row = 0; row < 6; ++row)
      for (int i = 0; i < 6; ++i) stage.body(box, place<Dim>(0.75 * (i - 2.5) + 0.05 * (row % 2), 5.4 + 0.7 * row));
    StageRun<Dim> run = stage.run();
    run.until(14.0);
    int above = 0;
    for (BodyIndex body = 0; body < run.states().size(); ++body) above += height<Dim>(run.at(body)) > 4.9 ? 1 : 0;
    return {double(above), double(run.floating())};
  }
};

/// A heavy ball flies into a sleeping wall: bodies it moves, against the same without sleep.
struct HeavyBall {
  template <int Dim>
  double moved(const PhysicsCell& cell) const {
    Stage<Dim> stage(cell);
    const int cube = stage.cube(1.0);
    const int ball = stage.ball(0.8, {.density = 5000.0});
    add_wall<Dim>(stage, cube, 4, 5, 0.0, true);
    stage.body(ball, place<Dim>(-20.0, 2.5), 0.0, place<Dim>(50.0, 2.0));
    StageRun<Dim> run = stage.run();
    const BodyStates<Dim> before = [&] {
      run.until(1.0 / 60.0);
      return run.states();
    }();
    run.until(6.0);
    double sum = 0.0;
    for (BodyIndex body = 0; body < 20; ++body)
      sum += std::min(1.0, (run.at(body) - before.pose[body].position).norm());
    return sum;
  }
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    const double full = moved<Dim>({cell.backend, "full", cell.solver});
    return {moved<Dim>(cell) - full};
  }
};

/// A heap is woken as a whole every two seconds.
struct WokenAgain {
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    Stage<Dim> stage(cell);
    const int box = stage.box(1.0, 0.5, 0.5);
    stage.scene.sources = {pour<Dim>(40, 0.0)};
    const double extent = stage.scene.world.shapes[box].extent;
    StageRun<Dim> run = stage.run();
    run.until(18.0);
    const BodyStates<Dim> before = run.states();
    const int warnings = run.warnings();  // an impact of the pour may press a box into the ground for a moment
    for (int i = 0; i < 10; ++i) {
      run.simulation().thaw_all();
      run.until(20.0 + 2.0 * i);
    }
    return {mean_shift(run.states(), before) / extent, double(run.floating()), double(run.warnings() - warnings)};
  }
};

/// A pour at extreme parameters of the pile or of the paper's policy.
struct PourWith {
  double alpha_deg = 30.0;
  double tau = 0.5;
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    Stage<Dim> stage(cell);
    stage.box(1.0, 0.5, 0.5);
    stage.scene.piles.front().alpha = in_radians(alpha_deg);
    stage.scene.policy.paper.tau = tau;
    stage.scene.sources = {pour<Dim>(50, 0.0)};
    StageRun<Dim> run = stage.run();
    run.until(14.0);
    return {double(run.floating()), double(run.warnings())};
  }
};

/// Two heaps that grow into each other.
struct Merging {
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    Stage<Dim> stage(cell);
    stage.box(1.0, 0.5, 0.5);
    stage.scene.piles.resize(2);
    stage.scene.sources = {pour<Dim>(50, -2.5), pour<Dim>(50, 2.5)};
    StageRun<Dim> run = stage.run();
    run.until(16.0);
    return {double(run.floating()), double(run.warnings())};
  }
};

/// A bin is filled, rests, is shaken and rests again.
struct Shaken {
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    Stage<Dim> stage(cell);
    stage.scene.world.ground.height = -5.0;
    const int box = stage.box(0.6, 0.6, 0.6);
    const int first = stage.fixed_box(sides<Dim>(5.0, 0.5, 5.0), place<Dim>(0.0, -0.25));
    for (const double side : {-1.0, 1.0}) {
      stage.fixed_box(sides<Dim>(0.5, 8.0, 5.0), place<Dim>(2.25 * side, 4.0));
      if constexpr (Dim == 3) stage.fixed_box(Vec3(5.0, 0.5, 8.0), Vec3(0.0, 1.25 * side, 4.0));
    }
    Motion<Dim> shake;
    shake.amplitude = place<Dim>(0.1, 0.05);
    shake.frequency = 3.0;
    shake.start = 5.0;
    shake.end = 9.0;
    stage.move(first, shake);
    for (int row = 0; row < 5; ++row)
      for (int i = 0; i < 5; ++i) stage.body(box, place<Dim>(0.75 * (i - 2) + 0.05 * (row % 2), 0.4 + 0.7 * row));
    StageRun<Dim> run = stage.run();
    run.until(13.0);
    int out = 0;
    for (BodyIndex body = 0; body < run.states().size(); ++body)
      out += height<Dim>(run.at(body)) < 0.0 || std::abs(run.at(body)[0]) > 2.5 ? 1 : 0;
    return {double(out), double(run.floating()), run.penetration()};
  }
};

/// A box at rest, asleep where the policy lets it, on a platform that begins to move back and forth, slowly enough for
/// friction to carry the box.
struct Platform {
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    Stage<Dim> stage(cell);
    const int platform = stage.fixed_box(sides<Dim>(6.0, 0.5, 4.0), place<Dim>(0.0, 2.0));
    Motion<Dim> motion;
    motion.amplitude = place<Dim>(1.0, 0.0);
    motion.frequency = 0.05;
    motion.start = 5.0;
    motion.end = 25.0;
    stage.move(platform, motion);
    stage.body(stage.cube(1.0), place<Dim>(0.0, 2.75));
    StageRun<Dim> run = stage.run();
    double slip = 0.0;
    run.until(28.0,
              [&] { slip = std::max(slip, std::abs(run.at(0)[0] - run.world().obstacle_pose(platform).position[0])); });
    return {slip};
  }
};

/// Eight L shapes fall, alone and with ten that sleep far away: largest difference of a place.
struct FarSleepers {
  template <int Dim>
  BodyStates<Dim> settle(const PhysicsCell& cell, bool others) const {
    Stage<Dim> stage(cell);
    stage.scene.policy.adaptive.tolerance = 0.0;  // else the far bodies are woken and checked
    const int l = stage.shape(l_pieces<Dim>(LParams{}));
    for (int i = 0; i < 8; ++i) stage.body(l, place<Dim>(0.3 * (i % 3), 0.7 + 1.3 * i), 0.4 * i);
    if (others)
      for (int i = 0; i < 10; ++i) stage.scene.bodies[stage.body(l, place<Dim>(500.0 + 2.0 * i, 0.5))].asleep = true;
    StageRun<Dim> run = stage.run();
    run.until(8.0);
    return run.states();
  }
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    const BodyStates<Dim> alone = settle<Dim>(cell, false);
    return {largest_shift(settle<Dim>(cell, true), alone)};
  }
};

/// A turned L falls on the ground, and its mirror image.
struct Mirrored {
  template <int Dim>
  Vec<Dim> fall(const PhysicsCell& cell, double side) const {
    Stage<Dim> stage(cell);
    const std::vector<Vec2> corners = {{0.0, 0.0}, {0.9 * side, 0.1}, {0.7 * side, 0.8}, {0.1 * side, 0.6}};
    stage.body(stage.shape(polygon_pieces<Dim>(corners, 0.6)), place<Dim>(0.0, 2.0), 0.3 * side, Vec<Dim>::Zero(),
               spinning<Dim>(2.0 * side));
    StageRun<Dim> run = stage.run();
    run.until(3.0);
    return run.at(0);
  }
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    const Vec<Dim> right = fall<Dim>(cell, 1.0);
    Vec<Dim> left = fall<Dim>(cell, -1.0);
    left[0] = -left[0];
    const double along = Dim == 2 ? 0.0 : std::max(std::abs(right[Dim - 2]), std::abs(left[Dim - 2]));
    return {std::hypot(right[0] - left[0], right[Dim - 1] - left[Dim - 1]), along};
  }
};

/// Two stacks with their bodies numbered from below and from above.
struct Renumbered {
  template <int Dim>
  double top(const PhysicsCell& cell, bool from_above) const {
    constexpr int boxes = 5;
    Stage<Dim> stage(cell);
    const int cube = stage.cube(1.0);
    for (int i = 0; i < boxes; ++i) stage.body(cube, place<Dim>(0.0, 0.5 + (from_above ? boxes - 1 - i : i)));
    StageRun<Dim> run = stage.run();
    run.until(8.0);
    return height<Dim>(run.at(from_above ? 0 : boxes - 1));
  }
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    return {std::abs(top<Dim>(cell, true) - top<Dim>(cell, false))};
  }
};

/// A fall and a slide at twice the size, over a time longer by the square root of two.
struct Scaled {
  template <int Dim>
  double way(const PhysicsCell& cell, double scale) const {
    Stage<Dim> stage(cell);
    stage.rate(120.0 / std::sqrt(scale));
    stage.body(stage.cube(scale), place<Dim>(0.0, 0.5 * scale), 0.0, place<Dim>(4.0 * std::sqrt(scale), 0.0));
    StageRun<Dim> run = stage.run();
    run.until(3.0 * std::sqrt(scale));
    return run.at(0)[0];
  }
  template <int Dim>
  std::vector<double> operator()(const PhysicsCell& cell) const {
    return {way<Dim>(cell, 2.0) / way<Dim>(cell, 1.0)};
  }
};

PhysicsCase sleeping(std::string name, std::string setup, std::vector<PhysicsGate> gates) {
  return {.group = "sleeping",
          .name = std::move(name),
          .setup = std::move(setup),
          .gates = std::move(gates),
          .policies = every_policy};
}

/// Pours of 50 boxes.
void add_pours(std::vector<PhysicsCase>& cases) {
  const auto add = [&](std::string name, std::string setup, const PourWith& params) {
    PhysicsCase each = sleeping(std::move(name), std::move(setup), {none_floats, no_warning});
    each.policies = {"paper"};
    if (params.tau == PourWith{}.tau) each.policies.emplace_back("adaptive");  // adaptive has no tau
    cases.push_back(measured(each, params));
  };
  for (const double alpha : {1.0, 89.0})
    add(fmt::format("alpha-{:g}", alpha), fmt::format("50 boxes poured onto a pile of {:g} degrees", alpha),
        {.alpha_deg = alpha});
  for (const double tau : {0.1, 0.99})
    add(fmt::format("tau-{:g}", tau), fmt::format("50 boxes poured, tau {:g}", tau), {.tau = tau});
  cases.push_back(measured(sleeping("merging", "two heaps of 50 boxes grow into each other", {none_floats, no_warning}),
                           Merging{}));
}

/// The same case twice, in a form that must change nothing.
void add_metamorphic_cases(std::vector<PhysicsCase>& cases) {
  PhysicsCase far = sleeping("far-sleepers", "eight L shapes fall, with and without ten that sleep 500 m away",
                             {{"largest difference of a place", "m", 0.0, 0.0, "what sleeps far away changes no bit"}});
  // Under adaptive, and with small steps on Box2D, they change the form of the engine's tree of boxes, and with it the
  // order of contacts.
  far.policies = {"paper"};
  far.except = {{"box2d", ""}};
  cases.push_back(measured(far, FarSleepers{}));
  PhysicsCase mirrored =
      sleeping("mirrored", "a spinning polygon falls, and its mirror image",
               {{"difference of the places in the plane", "m", 0.0, 0.01, "space has no left and right"},
                {"way out of the plane", "m", 0.0, 0.01, "the motion has no part along y"}});
  // It solves the contact points of an edge one after the other, so that the edge gets a turn.
  mirrored.except = {{"bullet", ""}};
  cases.push_back(measured(mirrored, Mirrored{}));
  cases.push_back(measured(sleeping("renumbered", "five cubes on each other, numbered from below and from above",
                                    {{"difference of the top's height", "m", 0.0, 0.005, "numbers have no weight"}}),
                           Renumbered{}));
  cases.push_back(measured(sleeping("scaled", "a cube slides on the ground, and one of twice the size",
                                    {{"ratio of the ways", "", 2.0, 0.05, "Froude: lengths and ways scale alike"}}),
                           Scaled{}));
}

void add_lost_support_cases(std::vector<PhysicsCase>& cases) {
  const PhysicsGate none_hangs = {"bodies that did not fall", "", 0.0, 0.0, "nothing carries them"};
  for (const int every : {1, 2}) {
    PhysicsCase pulled = sleeping(every == 1 ? "row-pulled" : "bodies-pulled",
                                  fmt::format("{} of the lowest row of a sleeping wall of 6 by 5 cubes is removed",
                                              every == 1 ? "all" : "every second cube"),
                                  {none_hangs, none_floats, no_warning});
    // The paper's policy wakes sleepers by an avalanche or a fast body alone.
    pulled.except = {{"bullet", "paper"}};
    cases.push_back(measured(pulled, SupportPulled{every}));
  }
  cases.push_back(
      measured(sleeping("trapdoor", "36 boxes at rest in a bin whose floor slides away", {none_hangs, none_floats}),
               Trapdoor{}));
}

}  // namespace

std::vector<PhysicsCase> sleeping_cases() {
  std::vector<PhysicsCase> cases;
  add_lost_support_cases(cases);
  PhysicsCase heavy = sleeping("heavy-ball", "a ball of ten cubes' mass at 50 m/s into a sleeping wall of 4 by 5",
                               {{"ways of the cubes, up to 1 m each, less those without sleep", "m", 0.0, 3.0,
                                 "a sleeping wall is no rock; three cubes of twenty for chaos"}});
  std::erase(heavy.policies, "full");  // what the others are compared with
  cases.push_back(measured(heavy, HeavyBall{}));
  cases.push_back(
      measured(sleeping("woken-again", "a heap of 40 boxes at rest is woken as a whole ten times",
                        {{"mean shift over D", "", 0.0, 0.05, "at rest; as the tolerance of stability checks"},
                         none_floats,
                         no_warning}),
               WokenAgain{}));
  cases.push_back(measured(sleeping("shaken", "25 boxes at rest in a bin that is shaken for 4 s",
                                    {{"boxes outside", "", 0.0, 0.0, "the bin is closed at its sides and floor"},
                                     none_floats,
                                     {"deepest overlap at the end", "m", 0.0, 0.03, "a twentieth of a box"}}),
                           Shaken{}));
  cases.push_back(
      measured(sleeping("platform", "a cube at rest on a platform that begins to move back and forth",
                        {{"slip", "m", 0.0, 0.05, "starts at 0.3 m/s, then 0.1 m/s^2, which friction gives"}}),
               Platform{}));
  add_metamorphic_cases(cases);
  add_pours(cases);
  return cases;
}

}  // namespace talus
