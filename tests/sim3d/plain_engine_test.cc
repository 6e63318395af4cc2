// A world in which no body is ever frozen against Bullet used by hand.

#include <btBulletDynamicsCommon.h>
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "sim3d/conversions.h"
#include "sim3d/engine_world.h"
#include "tests/sim3d/heap.h"

namespace talus::plain_engine_test {
namespace {

constexpr int bodies = 60;
constexpr int columns = 3;

/// The scene as one would write it without talus; only the L's numbers and its principal axes are ours.
class PlainHeap {
 public:
  explicit PlainHeap(const WorldDescription<3>& description)
      : shape_(bullet::make_body_template(description.shapes[0])) {
    world_.setGravity(btVector3(0, 0, -9.81F));
    world_.setForceUpdateAllAabbs(false);
    world_.getSolverInfo().m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
    world_.getSolverInfo().m_restitutionVelocityThreshold = 0.5F;
    ground_.setFriction(std::sqrt(0.5F));
    world_.addRigidBody(&ground_);
    std::mt19937 random(1);
    for (int i = 0; i < bodies; ++i) add(l_in_stack(i, columns, random), description.engine_sleep);
  }
  ~PlainHeap() {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
    world_.removeRigidBody(&ground_);
  }

  void step() { world_.stepSimulation(static_cast<btScalar>(1.0 / 60.0), 0); }

  /// As talus states them.
  BodyStates<3> states() const {
    BodyStates<3> states;
    for (const auto& body : bodies_) {
      states.pose.push_back(bullet::from_bullet<3>(body->getWorldTransform(), shape_.frame_inverse));
      states.velocity.push_back(bullet::from_bullet<3>(body->getLinearVelocity()));
      states.spin.push_back(bullet::from_bullet<3>(body->getAngularVelocity()));
    }
    return states;
  }

 private:
  void add(const BodyDef<3>& def, bool may_sleep) {
    btRigidBody::btRigidBodyConstructionInfo info(shape_.mass, nullptr, shape_.whole, shape_.inertia);
    info.m_startWorldTransform = bullet::to_bullet(def.pose, shape_.frame);
    auto body = std::make_unique<btRigidBody>(info);
    body->setFriction(std::sqrt(0.5F));
    if (!may_sleep) body->setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(body.get());
    bodies_.push_back(std::move(body));
  }

  bullet::BodyTemplate shape_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  btStaticPlaneShape plane_{btVector3(0, 0, 1), 0};
  btRigidBody ground_{0, nullptr, &plane_};
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

template <class Values>
bool same_bits(const Values& a, const Values& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

bool same_bits(const BodyStates<3>& a, const BodyStates<3>& b) {
  for (std::size_t i = 0; i < a.pose.size(); ++i)  // one by one: a Pose has gaps between its members
    if (a.pose[i].position != b.pose[i].position || a.pose[i].rotation.coeffs() != b.pose[i].rotation.coeffs())
      return false;
  return same_bits(a.velocity, b.velocity) && same_bits(a.spin, b.spin);
}

class NothingFrozen : public testing::TestWithParam<bool> {};

TEST_P(NothingFrozen, MovesBitForBitAsBulletByHand) {
  WorldDescription<3> description = l_world<3>();
  description.solver.kind = engine_solver;
  description.engine_sleep = GetParam();
  const auto world = make_bullet_world(description);
  add_stack(*world, bodies, columns);
  PlainHeap plain(description);
  for (int step = 0; step < 600; ++step) {
    world->step();
    plain.step();
    ASSERT_TRUE(same_bits(world->states(), plain.states())) << "step " << step;
  }
}

TEST_P(NothingFrozen, IsNotChangedByContactsOrQueries) {
  WorldDescription<3> description = l_world<3>();
  description.solver.kind = engine_solver;
  description.engine_sleep = GetParam();
  const auto observed = make_bullet_world(description);
  const auto alone = make_bullet_world(description);
  observed->record_contacts(true);
  add_stack(*observed, bodies, columns);
  add_stack(*alone, bodies, columns);
  std::vector<BodyIndex> found;
  for (int step = 0; step < 300; ++step) {
    observed->step();
    alone->step();
    observed->query_box(Box<3>(Vec3(0, 0, 0), Vec3(2, 2, 2)), found);
  }
  EXPECT_TRUE(same_bits(observed->states(), alone->states()));
}

INSTANTIATE_TEST_SUITE_P(EngineSleep, NothingFrozen, testing::Bool());

}  // namespace
}  // namespace talus::plain_engine_test
