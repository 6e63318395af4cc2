#pragma once
// A world without physics for tests of rules that see one moment: bodies stay where they are put.

#include "common/world/world.h"

namespace talus {

template <int Dim>
class StillWorld final : public World<Dim> {
 public:
  explicit StillWorld(const WorldDescription<Dim>& description) : World<Dim>(description) {}

  /// Without the checks of add() and set_velocity().
  void move(BodyIndex body, const Pose<Dim>& to) { this->writable_states().pose[body] = to; }
  void push(BodyIndex body, const Vec<Dim>& velocity, const Spin<Dim>& spin) {
    this->writable_states().velocity[body] = velocity;
    this->writable_states().spin[body] = spin;
  }

  std::vector<Contact<Dim>> touching;  // the contacts of each step
  mutable int gathers = 0;             // of them by the world

 private:
  Pose<Dim> engine_add(BodyIndex, const BodyDef<Dim>& def) override { return def.pose; }
  void engine_remove(std::span<const BodyIndex>) override {}
  void engine_move_obstacle(int, const Pose<Dim>&, const Vec<Dim>&, const Spin<Dim>&) override {}
  void engine_set_gravity(const Vec<Dim>&) override {}
  EngineTimes engine_step() override { return {}; }
  std::optional<BodyIndex> engine_read(BodyStates<Dim>&) override { return std::nullopt; }
  void engine_set_velocity(BodyIndex, const Vec<Dim>&, const Spin<Dim>&) override {}
  void engine_set_grip(BodyIndex, double) override {}
  void engine_freeze(std::span<const BodyIndex>) override {}
  void engine_thaw(std::span<const BodyIndex>) override {}
  void engine_query_box(const Box<Dim>& box, std::vector<BodyIndex>& found) const override {
    for (BodyIndex body = 0; body < this->states().size(); ++body) {
      if (this->states().removed[body] != 0) continue;
      if (box.intersects(this->bounds_of(body))) found.push_back(body);
    }
  }
  void engine_contacts(std::vector<Contact<Dim>>& contacts) const override {
    ++gathers;
    contacts = touching;
  }
  bool engine_awake(BodyIndex) const override { return true; }
};

}  // namespace talus
