#pragma once
// World<Dim> on Bullet.

#include <memory>
#include <optional>
#include <vector>

#include "common/world/errors.h"
#include "common/world/world.h"
#include "sim3d/contacts.h"
#include "sim3d/engine.h"
#include "sim3d/freezer.h"
#include "sim3d/shapes.h"

namespace talus::bullet {

template <int Dim>
class EngineWorld final : public World<Dim> {
 public:
  explicit EngineWorld(const WorldDescription<Dim>& description);
  EngineWorld(const EngineWorld&) = delete;
  EngineWorld& operator=(const EngineWorld&) = delete;
  ~EngineWorld() override;

  BodyIndex add(const BodyDef<Dim>& body) override;
  void remove(BodyIndex body) override;
  void step() override;
  void set_velocity(BodyIndex body, const Vec<Dim>& velocity, const Spin<Dim>& spin) override;
  const BodyStates<Dim>& states() const override { return states_; }
  std::span<const BodyIndex> awake() const override { return awake_; }
  std::span<const Contact<Dim>> contacts() override { return contacts_.get(engine_); }
  void freeze(std::span<const BodyIndex> bodies) override;
  void thaw(std::span<const BodyIndex> bodies) override;
  void near(const Box<Dim>& box, std::vector<BodyIndex>& found) const override;
  EngineTimes times() const override { return times_; }

  /// What stands behind the seam, for tests that count Bullet's objects.
  const Engine& engine() const { return engine_; }

 private:
  void add_ground();
  void add_obstacles();
  void rest();
  void read_states();
  void relist();
  void list_sleepers();
  void find_strayed() const;
  std::size_t known(BodyIndex body) const;
  btRigidBody* rigid_body(std::size_t i) const { return btRigidBody::upcast(objects_[i].get()); }  // null if frozen
  const EngineShape& shape_of(std::size_t i) const { return shapes_[static_cast<std::size_t>(states_.shape[i])]; }

  WorldDescription<Dim> description_;
  double mass_scale_;
  std::vector<EngineShape> shapes_;
  std::vector<EngineShape> obstacle_shapes_;
  std::unique_ptr<btCollisionShape> ground_shape_;
  std::vector<std::unique_ptr<btCollisionObject>> statics_;  // ground and obstacles
  std::vector<std::unique_ptr<btCollisionObject>> objects_;  // by body; null once removed
  Engine engine_;
  Freezer freezer_{engine_};
  Contacts<Dim> contacts_{mass_scale_};
  BodyStates<Dim> states_;
  std::vector<BodyIndex> listed_;           // bodies in Bullet's lists, ascending: all but the frozen
  std::vector<btRigidBody*> rigid_;         // the same
  std::vector<BodyIndex> awake_;            // those of them that Bullet's own sleeping has not stopped
  mutable std::vector<BodyIndex> strayed_;  // see find_strayed()
  mutable bool strayed_known_ = true;
  EngineTimes times_;
  std::int64_t step_ = 0;
  std::optional<NonFiniteState> failure_;  // the world goes no further
};

}  // namespace talus::bullet
