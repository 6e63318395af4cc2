#pragma once
// A scene of a case under construction, and what is read from its run.

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "common/math/angle.h"
#include "common/shape/catalogue.h"
#include "common/simulation/simulation.h"
#include "tests/physics/physics_case.h"

namespace talus {

/// The point at x and height z; in 3D y is 0.
template <int Dim>
Vec<Dim> place(double x, double z) {
  Vec<Dim> point = Vec<Dim>::Zero();
  point[0] = x;
  point[Dim - 1] = z;
  return point;
}

/// Rotation in the x-z plane, counter-clockwise with x to the right and z up [rad].
template <int Dim>
Rotation<Dim> turned(double angle) {
  if constexpr (Dim == 2)
    return Rotation<2>(angle);
  else
    return Rotation<3>(Eigen::AngleAxisd(-angle, Vec3::UnitY()));
}

/// A spin in the x-z plane, counter-clockwise [rad/s].
template <int Dim>
Spin<Dim> spinning(double rate) {
  Spin<Dim> spin = Spin<Dim>::Zero();
  if constexpr (Dim == 2)
    spin[0] = rate;
  else
    spin[1] = -rate;
  return spin;
}

/// Sides of a box, in 3D `depth` along y [m].
template <int Dim>
Vec<Dim> sides(double width, double height, double depth) {
  if constexpr (Dim == 2)
    return Vec2(width, height);
  else
    return Vec3(width, depth, height);
}

/// A run of a stage. It has an observer, so that the watchdog works.
template <int Dim>
class StageRun {
 public:
  StageRun(const Scene<Dim>& scene, const std::string& backend);

  /// Steps until `time` [s]; `each` is called after each step.
  void until(double time, const std::function<void()>& each = {});

  Simulation<Dim>& simulation() { return simulation_; }
  const World<Dim>& world() const { return simulation_.world(); }
  const BodyStates<Dim>& states() const { return world().states(); }
  const Vec<Dim>& at(BodyIndex body) const { return states().pose[body].position; }
  double time() const { return simulation_.time(); }
  /// Kinds of warnings but `overlap` and `passed`: cases measure the depth of overlap themselves.
  int warnings() const {
    return static_cast<int>(std::ranges::count_if(simulation_.warnings(), [](const Warning& warning) {
      return warning.kind != WarningKind::overlap && warning.kind != WarningKind::passed;
    }));
  }
  /// Sleeping bodies without a chain of contacts to the ground or an obstacle.
  int floating() const;
  /// Depth of the deepest overlap of two bodies, or of a body and what is fixed [m].
  double penetration() const;
  /// Kinetic and potential energy of all bodies that are not removed [J].
  double energy() const;

 private:
  /// Only its presence matters.
  struct Watcher : Observer<Dim> {
    void on_frame(const Frame<Dim>& /*frame*/) override {}
  };

  WorldDescription<Dim> description_;
  std::unique_ptr<Watcher> watcher_ = std::make_unique<Watcher>();
  Simulation<Dim> simulation_;
};

/// A scene for a cell: gravity 9.81 m/s^2, the ground at height 0, default settings, one pile at the origin, and a run
/// as long as it is stepped.
template <int Dim>
struct Stage {
  explicit Stage(const PhysicsCell& cell, const Material& ground = {});

  /// A kind of body. Returns its number.
  int shape(std::vector<Piece<Dim>> pieces, const Material& material = {});
  int box(double width, double height, double depth, const Material& material = {}) {
    return shape(box_pieces<Dim>(sides<Dim>(width, height, depth)), material);
  }
  int cube(double side, const Material& material = {}) { return box(side, side, side, material); }
  int ball(double radius, const Material& material = {}) { return shape(ball_pieces<Dim>(radius), material); }

  /// A body with its centre of mass at a place. Returns its number, which holds as long as there are no sources.
  BodyIndex body(int shape, const Vec<Dim>& centre, double angle = 0.0, const Vec<Dim>& velocity = Vec<Dim>::Zero(),
                 const Spin<Dim>& spin = Spin<Dim>::Zero());

  /// A fixed box with its centre at a place. Returns its number.
  int fixed_box(const Vec<Dim>& size, const Vec<Dim>& centre, double angle = 0.0, const Material& material = {});

  /// Obstacles `first` to the last move as one.
  void move(int first, const Motion<Dim>& motion);

  /// Steps a second.
  void rate(double steps_per_second) { scene.world.dt = 1.0 / steps_per_second; }

  /// Throws std::logic_error where the scene lies outside of the engine's window: that is no case.
  StageRun<Dim> run() const;

  std::string backend;
  Scene<Dim> scene;
};

/// Largest distance of a body from where it was, over the bodies not removed [m].
template <int Dim>
double largest_shift(const BodyStates<Dim>& now, const BodyStates<Dim>& before);
/// The same without the change of height [m].
template <int Dim>
double largest_sideways_shift(const BodyStates<Dim>& now, const BodyStates<Dim>& before);
/// Mean distance [m].
template <int Dim>
double mean_shift(const BodyStates<Dim>& now, const BodyStates<Dim>& before);

}  // namespace talus
