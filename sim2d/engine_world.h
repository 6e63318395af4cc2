#pragma once
// World<2> on Box2D.

#include <box2d/box2d.h>

#include <optional>
#include <vector>

#include "common/solver/ring_world.h"
#include "common/world/memory_reserve.h"
#include "sim2d/body_template.h"
#include "sim2d/contacts.h"
#include "sim2d/continuous.h"
#include "sim2d/conversions.h"
#include "sim2d/small_steps.h"
#include "sim2d/static_hosts.h"
#include "sim2d/warm_start.h"

namespace talus::box2d {

/// See make_box2d_world().
class EngineWorld final : public RingWorld<2> {
 public:
  explicit EngineWorld(const WorldDescription<2>& description);

  /// The engine's own world, for tests that count what is in it.
  const b2World& engine() const { return world_; }

 private:
  /// A body in Box2D: awake, or asleep by Box2D's own rule, a body of its own; frozen, fixtures of a shared host;
  /// removed, nothing.
  struct EngineBody {
    b2Body* body = nullptr;
    b2Fixture* frozen = nullptr;  // the first of them
  };

  Pose<2> engine_add(BodyIndex body, const BodyDef<2>& def) override;
  void engine_remove(std::span<const BodyIndex> bodies) override;
  EngineTimes engine_step() override;
  std::optional<BodyIndex> engine_read(BodyStates<2>& states) override;
  Pose<2> engine_place(BodyIndex body, const Pose<2>& pose) override;
  void engine_set_velocity(BodyIndex body, const Vec<2>& velocity, const Spin<2>& spin) override;
  void engine_freeze(std::span<const BodyIndex> bodies) override;
  void engine_thaw(std::span<const BodyIndex> bodies) override;
  void engine_query_box(const Box<2>& box, std::vector<BodyIndex>& found) const override;
  void engine_contacts(std::vector<Contact<2>>& contacts) const override;
  bool engine_awake(BodyIndex body) const override;
  void engine_move_obstacle(int number, const Pose<2>& to, const Vec<2>& velocity, const Spin<2>& spin) override;
  void engine_place_obstacle(int number, const Pose<2>& at) override;
  void engine_remove_obstacle(int number) override;
  void engine_restore_obstacle(int number) override;
  void engine_set_gravity(const Vec<2>& gravity) override { world_.SetGravity(to_engine(gravity)); }
  void engine_share_among(const std::shared_ptr<Team>& team) override {
    if (small_steps_) small_steps_->share_among(team);
  }

  EngineTimes box2d_step();
  EngineTimes small_step();
  double impulse_unit() const override { return 1.0; }
  bool idle() const;
  void keep_contacts(std::span<const BodyIndex> bodies);
  StepInput step_input() const { return {awake(), states(), templates_, obstacles_, belts(), pushes(), images()}; }
  void resume(BodyIndex body);
  void add_ground();
  b2Body* make_obstacle(int number);
  b2Body* create(BodyIndex index, int shape, const Pose<2>& pose, int sides);
  std::vector<b2Fixture*> fixtures_of(std::span<const BodyIndex> bodies) const;
  void create_thawed(std::span<const BodyIndex> bodies);
  /// Throws std::bad_alloc where Box2D could not get the memory for its next step.
  void check_memory() const;
  /// Empties Box2D's list of moved fixtures, which it searches from end to end whenever a fixture is removed.
  void find_new_contacts();

  EngineBody& at(BodyIndex body) { return bodies_[body]; }
  const EngineBody& at(BodyIndex body) const { return bodies_[body]; }
  const BodyTemplate& template_of(int shape) const { return templates_[shape]; }
  const BodyTemplate& template_of_body(BodyIndex body) const { return template_of(states().shape[body]); }

  std::vector<BodyTemplate> templates_;  // by shape
  b2World world_;
  MemoryReserve reserve_;
  StaticHosts hosts_;
  WarmStart warm_start_;
  ContinuousCollision continuous_;
  ContactListener listener_;
  std::optional<SmallSteps> small_steps_;  // instead of Box2D's solver
  std::vector<EngineBody> bodies_;
  std::vector<b2Body*> obstacles_;
  std::vector<b2Body*> stepped_;             // scratch
  std::vector<BodyIndex> moving_obstacles_;  // in the next step
  bool proxies_moved_ = false;               // since the last step
};

}  // namespace talus::box2d
