#pragma once
// A world of free fall, solvable by hand: awake bodies fall by semi-implicit Euler until their centre is at height 0.5,
// where they stop. They do not collide.

#include <memory>

#include "common/world/world.h"

namespace talus {

template <int Dim>
class FallingWorld final : public World<Dim> {
 public:
  explicit FallingWorld(const WorldDescription<Dim>& description) : World<Dim>(description) {}

  /// Without the checks of add().
  void move(BodyIndex body, const Pose<Dim>& to) { this->writable_states().pose[body] = to; }

 private:
  Pose<Dim> engine_add(BodyIndex, const BodyDef<Dim>& def) override { return def.pose; }
  void engine_remove(std::span<const BodyIndex>) override {}
  EngineTimes engine_step() override { return {}; }
  std::optional<BodyIndex> engine_read(BodyStates<Dim>& states) override {
    for (const BodyIndex body : this->awake()) {
      Vec<Dim>& position = states.pose[body].position;
      states.velocity[body][Dim - 1] -= this->description().gravity * this->description().dt;
      position += this->description().dt * states.velocity[body];
      if (position[Dim - 1] > 0.5) continue;
      position[Dim - 1] = 0.5;
      states.velocity[body].setZero();
    }
    return std::nullopt;
  }
  void engine_set_velocity(BodyIndex, const Vec<Dim>&, const Spin<Dim>&) override {}
  void engine_freeze(std::span<const BodyIndex>) override {}
  void engine_thaw(std::span<const BodyIndex>) override {}
  void engine_query_box(const Box<Dim>& box, std::vector<BodyIndex>& out) const override {
    for (BodyIndex body = 0; body < this->states().size(); ++body)
      if (this->states().removed[body] == 0 && this->bounds_of(body).intersects(box)) out.push_back(body);
  }
  void engine_contacts(std::vector<Contact<Dim>>&) const override {}
  bool engine_awake(BodyIndex) const override { return true; }
};

template <int Dim>
std::unique_ptr<World<Dim>> make_falling_world(const WorldDescription<Dim>& description) {
  return std::make_unique<FallingWorld<Dim>>(description);
}

}  // namespace talus
