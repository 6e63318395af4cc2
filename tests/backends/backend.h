#pragma once
// The engines of this build as types, so that one suite runs on each of them.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "common/math/angle.h"
#include "common/policy/observer.h"
#include "common/shape/catalogue.h"
#include "common/simulation/make_policy.h"
#include "common/simulation/simulation.h"
#include "common/world/world.h"
#include "docs/examples/toy_engine.h"
#ifdef TALUS_BOX2D
#include "sim2d/make_world.h"
#endif
#ifdef TALUS_BULLET
#include "sim3d/make_world.h"
#endif

namespace talus {

#ifdef TALUS_BOX2D
struct Box2d {
  static constexpr int dim = 2;
  static constexpr bool small_steps = true;
  static constexpr const char* name = "box2d";
  static constexpr const char* own_solver_name = "box2d_own_solver";
  static auto make(const WorldDescription<2>& description) { return make_box2d_world(description); }
};
#endif
#ifdef TALUS_BULLET
struct Bullet {
  static constexpr int dim = 3;
  static constexpr bool small_steps = true;
  static constexpr const char* name = "bullet";
  static constexpr const char* own_solver_name = "bullet_own_solver";
  static auto make(const WorldDescription<3>& description) { return make_bullet_world(description); }
};
struct BulletPlanar {
  static constexpr int dim = 2;
  static constexpr bool small_steps = true;
  static constexpr const char* name = "bullet_planar";
  static constexpr const char* own_solver_name = "bullet_planar_own_solver";
  static auto make(const WorldDescription<2>& description) { return make_bullet_planar_world(description); }
};
#endif

/// An engine with its own solver in the place of the one of common/solver/.
template <typename Engine>
struct OwnSolver {
  static constexpr int dim = Engine::dim;
  static constexpr bool small_steps = false;
  static constexpr const char* name = Engine::own_solver_name;
  static auto make(WorldDescription<dim> description) {
    description.solver.kind = engine_solver;
    return Engine::make(description);
  }
};

#if defined(TALUS_BOX2D) && defined(TALUS_BULLET) && defined(__SANITIZE_ADDRESS__)
// The others run the same code but for the packages' own, and would take three times as long to compile and run.
using Backends = ::testing::Types<Box2d, Bullet>;
using PlanarBackends = ::testing::Types<Box2d>;
using BulletBackends = ::testing::Types<Bullet>;
using SmallStepsBackends = Backends;
#elif defined(TALUS_BOX2D) && defined(TALUS_BULLET)
using Backends =
    ::testing::Types<Box2d, Bullet, BulletPlanar, OwnSolver<Box2d>, OwnSolver<Bullet>, OwnSolver<BulletPlanar>>;
using PlanarBackends = ::testing::Types<Box2d, BulletPlanar, OwnSolver<Box2d>, OwnSolver<BulletPlanar>>;
using BulletBackends = ::testing::Types<Bullet, BulletPlanar, OwnSolver<Bullet>, OwnSolver<BulletPlanar>>;
using SmallStepsBackends = ::testing::Types<Box2d, Bullet, BulletPlanar>;
#elif defined(TALUS_BOX2D)
using Backends = ::testing::Types<Box2d, OwnSolver<Box2d>>;
using PlanarBackends = Backends;
using SmallStepsBackends = ::testing::Types<Box2d>;
#else
using Backends = ::testing::Types<Bullet, BulletPlanar, OwnSolver<Bullet>, OwnSolver<BulletPlanar>>;
using PlanarBackends = ::testing::Types<BulletPlanar, OwnSolver<BulletPlanar>>;
using BulletBackends = Backends;
using SmallStepsBackends = ::testing::Types<Bullet, BulletPlanar>;
#endif

template <typename Backend>
constexpr bool has_small_steps = Backend::small_steps;

/// Whether it can run a policy: only an engine's own solver has the engine's sleep.
template <typename Backend>
bool has_policy(std::string_view policy) {
  return policy != "engine" || !has_small_steps<Backend>;
}

/// A run of the scene on a backend. With an engine's own solver no sleeping body feels forces.
template <typename Backend>
Simulation<Backend::dim> simulation_on(Scene<Backend::dim> scene) {
  if (!has_small_steps<Backend>) {
    scene.world.solver.kind = engine_solver;
    scene.policy.adaptive.rings = 0;
  }
  return Simulation<Backend::dim>(scene, Backend::make(scene.world), make_policy(scene));
}

/// With an observer a simulation looks for faults, see Simulation::warnings().
template <int Dim>
struct Watcher final : Observer<Dim> {
  void on_frame(const Frame<Dim>& /*frame*/) override {}
};

template <int Dim>
void run_until(Simulation<Dim>& simulation, double time) {
  while (simulation.time() < time - 1e-9) simulation.step();
}

/// A vector as a scene file has it; in 3D y is 0.
template <int Dim>
std::string vector_text(double x, double z) {
  return Dim == 2 ? fmt::format("[{}, {}]", x, z) : fmt::format("[{}, 0, {}]", x, z);
}

/// How often in a step a backend adds gravity to the velocity.
template <typename Backend>
constexpr int falls_in_a_step = has_small_steps<Backend> ? SolverParams{}.sub_steps : 1;

/// The example of docs/extending.md. Its bodies do not collide, so it runs in the suites on the interface alone.
struct Toy {
  static constexpr int dim = 3;
  static constexpr bool small_steps = false;
  static constexpr const char* name = "toy";
  static auto make(const WorldDescription<3>& description) { return make_toy_world(description); }
};

/// Adds a backend to a list of types.
template <typename List, typename Backend>
struct WithBackend;
template <typename... Listed, typename Backend>
struct WithBackend<::testing::Types<Listed...>, Backend> {
  using type = ::testing::Types<Listed..., Backend>;
};
using BackendsAndToy = WithBackend<Backends, Toy>::type;

struct BackendName {
  template <typename Backend>
  static std::string GetName(int) {
    return Backend::name;
  }
};

template <int Dim>
Vec<Dim> up(double height) {
  return height * Vec<Dim>::Unit(Dim - 1);
}

/// Rotation by which the x axis comes to point upwards by `angle` [rad].
template <int Dim>
Rotation<Dim> tilted(double angle) {
  if constexpr (Dim == 2)
    return Rotation<2>(angle);
  else
    return Rotation<3>(Eigen::AngleAxisd(-angle, Vec3::UnitY()));
}

/// Fixture: a world of unit cubes (shape 0), balls of diameter 1 (shape 1) and L's (shape 2) over the ground.
template <typename Backend>
class BackendTest : public ::testing::Test {
 protected:
  static constexpr int dimension = Backend::dim;
  using V = Vec<dimension>;

  static WorldDescription<dimension> description(const Material& material = {.friction = 0.5, .restitution = 0.0}) {
    WorldDescription<dimension> world;
    world.gravity = 10.0;
    world.ground.material = material;
    world.shapes.push_back(make_shape<dimension>("cube", box_pieces<dimension>(V::Ones()), material));
    world.shapes.push_back(make_shape<dimension>("ball", ball_pieces<dimension>(0.5), material));
    world.shapes.push_back(make_shape<dimension>("L", l_pieces<dimension>(LParams{}), material));
    return world;
  }

  static BodyDef<dimension> at(const V& position, int shape = 0, const V& velocity = V::Zero()) {
    BodyDef<dimension> body;
    body.shape = shape;
    body.pose.position = position;
    body.velocity = velocity;
    return body;
  }

  static void run(World<dimension>& world, double seconds) {
    const int steps = static_cast<int>(seconds * 60.0 + 0.5);
    for (int i = 0; i < steps; ++i) world.step();
  }

  static const Pose<dimension>& pose(const World<dimension>& world, BodyIndex body) {
    return world.states().pose[body];
  }
  static double height_of(const World<dimension>& world, BodyIndex body) {
    return height<dimension>(pose(world, body).position);
  }
  static double speed(const World<dimension>& world, BodyIndex body) { return world.states().velocity[body].norm(); }
  static bool asleep(const World<dimension>& world, BodyIndex body) { return world.states().asleep[body] != 0; }
  static void freeze(World<dimension>& world, BodyIndex body) { world.freeze(std::vector<BodyIndex>{body}); }
  static void thaw(World<dimension>& world, BodyIndex body) { world.thaw(std::vector<BodyIndex>{body}); }
};

}  // namespace talus
