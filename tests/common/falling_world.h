#pragma once
// A world of free fall, solvable by hand: awake bodies fall by semi-implicit Euler until their centre is at height 0.5,
// where they stop. They do not see one another.

#include <stdexcept>

#include "common/world/world.h"

namespace talus {

template <int Dim>
class FallingWorld final : public World<Dim> {
 public:
  explicit FallingWorld(const WorldDescription<Dim>& description)
      : gravity_(description.gravity), dt_(description.dt) {}

  BodyIndex add(const BodyDef<Dim>& body) override {
    states_.shape.push_back(body.shape);
    states_.pose.push_back(body.pose);
    states_.velocity.push_back(body.velocity);
    states_.spin.push_back(body.spin);
    states_.asleep.push_back(0);
    states_.removed.push_back(0);
    list_awake();
    return states_.size() - 1;
  }
  void remove(BodyIndex body) override {
    states_.removed[static_cast<std::size_t>(body)] = 1;
    list_awake();
  }
  void step() override {
    for (const BodyIndex body : awake_) {
      const auto i = static_cast<std::size_t>(body);
      Vec<Dim>& place = states_.pose[i].position;
      states_.velocity[i][Dim - 1] -= gravity_ * dt_;
      place += dt_ * states_.velocity[i];
      if (place[Dim - 1] > 0.5) continue;
      place[Dim - 1] = 0.5;
      states_.velocity[i].setZero();
    }
  }
  void set_velocity(BodyIndex body, const Vec<Dim>& velocity, const Spin<Dim>& spin) override {
    states_.velocity[static_cast<std::size_t>(body)] = velocity;
    states_.spin[static_cast<std::size_t>(body)] = spin;
  }
  const BodyStates<Dim>& states() const override { return states_; }
  std::span<const BodyIndex> awake() const override { return awake_; }
  std::span<const Contact<Dim>> contacts() override { return {}; }
  void freeze(std::span<const BodyIndex> bodies) override { set_asleep(bodies, 1); }
  void thaw(std::span<const BodyIndex> bodies) override { set_asleep(bodies, 0); }
  void near(const Box<Dim>&, std::vector<BodyIndex>&) const override {
    throw std::logic_error("a falling world is asked for neighbours");
  }
  EngineTimes times() const override { return {}; }

 private:
  void set_asleep(std::span<const BodyIndex> bodies, std::uint8_t asleep) {
    for (const BodyIndex body : bodies) {
      const auto i = static_cast<std::size_t>(body);
      states_.asleep[i] = asleep;
      states_.velocity[i].setZero();
    }
    list_awake();
  }
  void list_awake() {
    awake_.clear();
    for (BodyIndex body = 0; body < states_.size(); ++body) {
      const auto i = static_cast<std::size_t>(body);
      if (states_.asleep[i] == 0 && states_.removed[i] == 0) awake_.push_back(body);
    }
  }

  double gravity_;
  double dt_;
  BodyStates<Dim> states_;
  std::vector<BodyIndex> awake_;
};

template <int Dim>
std::unique_ptr<World<Dim>> make_falling_world(const WorldDescription<Dim>& description) {
  return std::make_unique<FallingWorld<Dim>>(description);
}

}  // namespace talus
