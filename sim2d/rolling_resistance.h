#pragma once
// Rolling friction, which Box2D does not have.

#include <box2d/box2d.h>

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "common/world/body.h"
#include "common/world/world_description.h"

namespace talus::box2d {

/// Resists the turning of bodies against what they touch: one friction joint for each pair of bodies in contact, whose
/// largest torque is that of the normal impulse of the last step. Joints are solved with the contacts, so a disc on a
/// slope stands still. Without rolling friction in the scene there is none of this.
class RollingResistance final : public b2DestructionListener {
 public:
  RollingResistance(const WorldDescription<2>& description, b2World& world);
  RollingResistance(const RollingResistance&) = delete;
  RollingResistance& operator=(const RollingResistance&) = delete;
  ~RollingResistance() override = default;

  /// Before a step; `shapes`: of each body.
  void start_step(std::span<const int> shapes);

 private:
  struct Pair {
    b2FrictionJoint* joint = nullptr;
    b2Body* a = nullptr;
    b2Body* b = nullptr;
    float torque = 0.0F;  // the largest in this step [N m]
    bool sleeps = false;  // by the engine's own rule: Box2D would wake bodies that lose a joint
  };

  void note(b2Contact& contact, std::span<const int> shapes);
  void update(std::uint64_t key, Pair& pair);
  void SayGoodbye(b2Joint* joint) override;
  void SayGoodbye(b2Fixture* /*fixture*/) override {}

  b2World* world_;
  std::vector<double> arms_;  // by shape [m]; empty: no rolling friction
  double dt_;
  std::unordered_map<std::uint64_t, Pair> pairs_;  // looked up only: its order is that of addresses
  std::vector<std::uint64_t> keys_;                // of all pairs, in the order in which they first touched
};

}  // namespace talus::box2d
