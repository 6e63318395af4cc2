#pragma once
// The Bullet objects that one world consists of.

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <btBulletDynamicsCommon.h>

#include "common/world/world_description.h"
#include "sim3d/bodies.h"
#include "sim3d/bullet/compound_pair.h"
#include "sim3d/bullet/dynamics_world.h"
#include "sim3d/bullet/ground_pair.h"
#include "sim3d/bullet/pairs.h"

namespace talus::bullet {

/// Members are destroyed in reverse order: the world lets go of its proxies and pairs before these go.
struct Engine {
  Engine(const btVector3& gravity, const SolverParams& params, const DebugOptions& debug);

  /// Bullet's own detection for two spheres forgets their point, and the impulse in it, in each step.
  void keep_points_of_spheres();
  /// All points of a body on the ground at once. Bullet finds one a step, and a box that slides out of its old ones is
  /// without support.
  void find_points_on_ground();

  btDefaultCollisionConfiguration configuration;
  CompoundPair::Maker compound_pairs;
  GroundPair::Maker ground_pairs{false};
  GroundPair::Maker swapped_ground_pairs{true};
  btCollisionDispatcher dispatcher;
  PairCache pairs;
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  DynamicsWorld world;
  RigidBodyMaker rigid_bodies;
};

}  // namespace talus::bullet
