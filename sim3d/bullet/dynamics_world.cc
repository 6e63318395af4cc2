#include "sim3d/bullet/dynamics_world.h"

#include "common/world/stopwatch.h"

namespace talus::bullet {
namespace {

constexpr int meets_static = btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter;

}  // namespace

DynamicsWorld::DynamicsWorld(btCollisionDispatcher& dispatcher, btBroadphaseInterface& broadphase, PairCache& pairs,
                             btConstraintSolver& solver, btCollisionConfiguration& configuration,
                             const DebugOptions& debug)
    : btDiscreteDynamicsWorld(&dispatcher, &broadphase, &solver, &configuration),
      debug_(debug),
      near_pairs_(dispatcher, pairs, !debug.visit_separate_pairs) {}

std::span<btRigidBody* const> DynamicsWorld::bodies() const {
  if (m_nonStaticRigidBodies.size() == 0) return {};
  return {&m_nonStaticRigidBodies[0], static_cast<std::size_t>(m_nonStaticRigidBodies.size())};
}

void DynamicsWorld::set_bodies(std::span<btRigidBody* const> bodies) {
  m_collisionObjects.resize(statics_);
  m_nonStaticRigidBodies.resize(0);
  for (btRigidBody* body : bodies) {
    body->setWorldArrayIndex(m_collisionObjects.size());
    m_collisionObjects.push_back(body);
    m_nonStaticRigidBodies.push_back(body);
  }
}

void DynamicsWorld::add_static(btCollisionObject& object) {
  addCollisionObject(&object, btBroadphaseProxy::StaticFilter, meets_static);
  ++statics_;
}

void DynamicsWorld::restore_static(btCollisionObject& object) {
  btVector3 low;
  btVector3 high;
  object.getCollisionShape()->getAabb(object.getWorldTransform(), low, high);
  object.setBroadphaseHandle(getBroadphase()->createProxy(low, high, object.getCollisionShape()->getShapeType(),
                                                          &object, btBroadphaseProxy::StaticFilter, meets_static,
                                                          getDispatcher()));
}

void DynamicsWorld::performDiscreteCollisionDetection() {
  Stopwatch watch;
  find_pairs();
  if (contact_step_) contact_step_->drift();  // the boxes of the pairs hold the whole step
  find_contacts();
  collide_seconds_ = watch.lap();
}

void DynamicsWorld::detect_contacts() {
  find_pairs();
  find_contacts();
}

void DynamicsWorld::find_pairs() {
  updateAabbs();
  computeOverlappingPairs();
}

void DynamicsWorld::find_contacts() {
  if (debug_.bullet_compounds)
    getDispatcher()->dispatchAllCollisionPairs(getPairCache(), getDispatchInfo(), getDispatcher());
  else
    near_pairs_.collide(getDispatchInfo(), bodies(), *team_);
  after_collision_();
}

void DynamicsWorld::calculateSimulationIslands() {
  if (!contact_step_) btDiscreteDynamicsWorld::calculateSimulationIslands();
}

void DynamicsWorld::solveConstraints(btContactSolverInfo& info) {
  if (contact_step_)
    contact_step_->solve();
  else
    btDiscreteDynamicsWorld::solveConstraints(info);
}

void DynamicsWorld::integrateTransforms(btScalar time_step) {
  btDiscreteDynamicsWorld::integrateTransforms(time_step);
  if (contact_step_) contact_step_->finish();
}

}  // namespace talus::bullet
