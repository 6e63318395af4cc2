#pragma once
// World<Dim> on Bullet.

#include <memory>
#include <vector>

#include "common/solver/ring_world.h"
#include "sim3d/body_swap.h"
#include "sim3d/body_template.h"
#include "sim3d/contacts.h"
#include "sim3d/engine.h"
#include "sim3d/small_steps.h"

namespace talus::bullet {

/// See make_bullet_world() and make_bullet_planar_world().
template <int Dim>
class EngineWorld final : public RingWorld<Dim> {
 public:
  explicit EngineWorld(const WorldDescription<Dim>& description);
  EngineWorld(const EngineWorld&) = delete;
  EngineWorld& operator=(const EngineWorld&) = delete;
  ~EngineWorld() override;

  /// The engine's own objects, for tests that count what is in it.
  const Engine& engine() const { return engine_; }

 private:
  using RingWorld<Dim>::ring_;

  Pose<Dim> engine_add(BodyIndex body, const BodyDef<Dim>& def) override;
  void engine_remove(std::span<const BodyIndex> bodies) override;
  EngineTimes engine_step() override;
  std::optional<BodyIndex> engine_read(BodyStates<Dim>& states) override;
  Pose<Dim> engine_place(BodyIndex body, const Pose<Dim>& pose) override;
  void engine_set_velocity(BodyIndex body, const Vec<Dim>& velocity, const Spin<Dim>& spin) override;
  void engine_freeze(std::span<const BodyIndex> bodies) override;
  void engine_thaw(std::span<const BodyIndex> bodies) override;
  void engine_query_box(const Box<Dim>& box, std::vector<BodyIndex>& found) const override;
  void engine_move_obstacle(int number, const Pose<Dim>& to, const Vec<Dim>& velocity, const Spin<Dim>& spin) override;
  void engine_place_obstacle(int number, const Pose<Dim>& at) override;
  void engine_remove_obstacle(int number) override;
  void engine_restore_obstacle(int number) override;
  void engine_set_gravity(const Vec<Dim>& gravity) override;
  void engine_contacts(std::vector<Contact<Dim>>& contacts) const override;
  bool engine_awake(BodyIndex body) const override { return at(body)->isActive(); }
  void engine_share_among(const std::shared_ptr<Team>& team) override {
    engine_.world.share_among(team);
    if (small_steps_) small_steps_->share_among(team);
  }

  void use_small_steps();
  typename SmallSteps<Dim>::Actions actions();
  double impulse_unit() const override { return 1.0 / mass_scale_; }
  bool idle() const;
  void keep_contacts(std::span<const BodyIndex> bodies);
  void renew_kept_points();
  void resume(BodyIndex body, const btVector3& velocity, const btVector3& spin);
  void add_ground();
  void add_obstacles();
  void update_lists();
  void list_frozen();
  void find_strayed() const;

  const std::unique_ptr<btCollisionObject>& at(BodyIndex body) const { return objects_[body]; }
  std::unique_ptr<btCollisionObject>& at(BodyIndex body) { return objects_[body]; }
  /// Null if the body is frozen.
  btRigidBody* rigid_body(BodyIndex body) const { return btRigidBody::upcast(at(body).get()); }
  btCollisionObject& obstacle(int number) const { return *statics_[number + (ground_ != nullptr ? 1 : 0)]; }
  const BodyTemplate& template_of(int shape) const { return templates_[shape]; }
  const BodyTemplate& template_of_body(BodyIndex body) const { return template_of(this->states().shape[body]); }

  double mass_scale_;
  std::vector<BodyTemplate> templates_;  // by shape
  std::vector<BodyTemplate> obstacles_;
  std::unique_ptr<btCollisionShape> ground_;
  std::vector<std::unique_ptr<btCollisionObject>> statics_;  // the ground if there is one, then the obstacles
  std::vector<std::unique_ptr<btCollisionObject>> objects_;  // by body; null once removed
  MeetingOfImages meeting_;
  Engine engine_;
  BodySwap swap_{engine_};
  std::unique_ptr<SmallSteps<Dim>> small_steps_;  // null: Bullet's own solver
  std::vector<WarmStart::Renewed> renewed_;       // scratch
  Contacts<Dim> contacts_{mass_scale_, small_steps_ != nullptr};
  std::vector<BodyIndex> listed_;               // bodies in Bullet's lists, ascending: all but the frozen
  std::vector<btRigidBody*> rigid_;             // the same
  std::vector<btRigidBody*> moving_obstacles_;  // in the next step
  BodyIndex detected_ = 0;                      // number of bodies that collision detection has seen
  mutable std::vector<BodyIndex> strayed_;      // see find_strayed()
  mutable bool strayed_known_ = true;
};

}  // namespace talus::bullet
