#pragma once
// World<2> on Box2D.

#include <box2d/box2d.h>

#include <optional>
#include <vector>

#include "common/world/errors.h"
#include "common/world/memory_reserve.h"
#include "common/world/world.h"
#include "sim2d/contacts.h"
#include "sim2d/freezer.h"
#include "sim2d/shapes.h"
#include "sim2d/states.h"
#include "sim2d/warm_start.h"

namespace talus::box2d {

/// See make_box2d_world().
class EngineWorld final : public World<2> {
 public:
  explicit EngineWorld(const WorldDescription<2>& description);

  BodyIndex add(const BodyDef<2>& body) override;
  void remove(BodyIndex body) override;
  void step() override;
  void set_velocity(BodyIndex body, const Vec<2>& velocity, const Spin<2>& spin) override;
  const BodyStates<2>& states() const override { return states_; }
  std::span<const BodyIndex> awake() const override { return awake_; }
  std::span<const Contact<2>> contacts() override;
  void freeze(std::span<const BodyIndex> bodies) override;
  void thaw(std::span<const BodyIndex> bodies) override;
  void near(const Box<2>& box, std::vector<BodyIndex>& found) const override;
  EngineTimes times() const override { return times_; }
  SpeedLimits speed_limits() const override {
    return {fastest_speed<2>(description_.dt), fastest_spin(description_.dt)};
  }

  /// The engine's own world, for tests that count what is in it.
  const b2World& engine() const { return world_; }

 private:
  /// What every body of one shape has in common.
  struct Blueprint {
    std::vector<EngineShape> shapes;
    b2FixtureDef material;
    b2MassData mass;
  };
  void add_fixed_bodies();
  b2Body* create(BodyIndex index, const Vec<2>& velocity, const Spin<2>& spin);
  void check_index(BodyIndex body) const;
  /// Throws std::bad_alloc where Box2D could not get the memory for its next step.
  void check_memory() const;
  void check_speed(const Vec<2>& velocity, const Spin<2>& spin) const;
  const Blueprint& blueprint_of(BodyIndex body) const;
  std::vector<BodyIndex> chosen(std::span<const BodyIndex> bodies, bool asleep) const;
  void note_engine_sleep();
  /// Empties the engine's list of moved fixtures, which it searches from end to end whenever a fixture goes.
  void look_for_contacts();
  void gather_contacts();

  WorldDescription<2> description_;
  std::vector<Blueprint> blueprints_;
  b2World world_;
  MemoryReserve reserve_;
  Freezer freezer_;
  WarmStart warm_start_;
  ContactListener listener_;
  std::vector<EngineBody> bodies_;
  BodyStates<2> states_;
  std::vector<BodyIndex> awake_;
  std::vector<Contact<2>> contacts_;
  bool proxies_moved_ = false;      // since the last step
  bool contacts_wanted_ = false;    // from the first call of contacts() on
  bool contacts_gathered_ = false;  // for the last step
  EngineTimes times_;
  std::int64_t steps_ = 0;
  std::optional<NonFiniteState> failure_;
};

}  // namespace talus::box2d
