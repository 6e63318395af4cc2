#include "sim3d/engine.h"

namespace talus::bullet {

Engine::Engine(const btVector3& gravity, const SolverParams& params, const DebugOptions& debug)
    : dispatcher(&configuration),
      broadphase(&pairs),
      world(dispatcher, broadphase, pairs, solver, configuration, debug) {
  if (!debug.bullet_compounds)
    dispatcher.registerCollisionCreateFunc(COMPOUND_SHAPE_PROXYTYPE, COMPOUND_SHAPE_PROXYTYPE, &compound_pairs);
  if (!debug.collide_in_flight) {
    dispatcher.registerCollisionCreateFunc(COMPOUND_SHAPE_PROXYTYPE, STATIC_PLANE_PROXYTYPE, &ground_pairs);
    dispatcher.registerCollisionCreateFunc(STATIC_PLANE_PROXYTYPE, COMPOUND_SHAPE_PROXYTYPE, &swapped_ground_pairs);
  }
  world.setGravity(gravity);
  // Static bodies do not move: without this, Bullet refreshes their bounding boxes in every step.
  world.setForceUpdateAllAabbs(false);
  btContactSolverInfo& info = world.getSolverInfo();
  info.m_numIterations = params.velocity_iterations;
  info.m_restitutionVelocityThreshold = static_cast<btScalar>(params.restitution_threshold);
  if (params.friction_directions == 2) info.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
}

void Engine::keep_points_of_spheres() {
  dispatcher.registerCollisionCreateFunc(
      SPHERE_SHAPE_PROXYTYPE, SPHERE_SHAPE_PROXYTYPE,
      configuration.getCollisionAlgorithmCreateFunc(CONVEX_HULL_SHAPE_PROXYTYPE, CONVEX_HULL_SHAPE_PROXYTYPE));
}

void Engine::find_points_on_ground() {
  constexpr int points = 4;
  configuration.setPlaneConvexMultipointIterations(points, points);
}

}  // namespace talus::bullet
