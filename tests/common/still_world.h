#pragma once
// A world without physics for tests of rules that look at one moment: bodies stay where they are put.

#include "common/world/world.h"

namespace talus {

template <int Dim>
class StillWorld final : public World<Dim> {
 public:
  explicit StillWorld(const WorldDescription<Dim>& description) : shapes_(description.shapes) {}

  BodyIndex add(const BodyDef<Dim>& body) override {
    states_.shape.push_back(body.shape);
    states_.pose.push_back(body.pose);
    states_.velocity.push_back(body.velocity);
    states_.spin.push_back(body.spin);
    states_.asleep.push_back(0);
    states_.removed.push_back(0);
    awake_.push_back(states_.size() - 1);
    return states_.size() - 1;
  }
  void remove(BodyIndex body) override {
    states_.removed[static_cast<std::size_t>(body)] = 1;
    std::erase(awake_, body);
  }
  void step() override {}
  void set_velocity(BodyIndex body, const Vec<Dim>& velocity, const Spin<Dim>& spin) override {
    states_.velocity[static_cast<std::size_t>(body)] = velocity;
    states_.spin[static_cast<std::size_t>(body)] = spin;
  }
  const BodyStates<Dim>& states() const override { return states_; }
  std::span<const BodyIndex> awake() const override { return awake_; }
  std::span<const Contact<Dim>> contacts() override { return touching; }
  void freeze(std::span<const BodyIndex> bodies) override { set_asleep(bodies, 1); }
  void thaw(std::span<const BodyIndex> bodies) override { set_asleep(bodies, 0); }
  void near(const Box<Dim>& box, std::vector<BodyIndex>& found) const override {
    for (BodyIndex body = 0; body < states_.size(); ++body) {
      const auto i = static_cast<std::size_t>(body);
      const Box<Dim> bounds = bounds_at(shapes_[static_cast<std::size_t>(states_.shape[i])], states_.pose[i]);
      if (states_.removed[i] == 0 && box.intersects(bounds)) found.push_back(body);
    }
  }
  EngineTimes times() const override { return {}; }

  void move(BodyIndex body, const Pose<Dim>& to) { states_.pose[static_cast<std::size_t>(body)] = to; }

  std::vector<Contact<Dim>> touching;  // the contacts of each step

 private:
  void set_asleep(std::span<const BodyIndex> bodies, std::uint8_t asleep) {
    for (const BodyIndex body : bodies) states_.asleep[static_cast<std::size_t>(body)] = asleep;
    awake_.clear();
    for (BodyIndex body = 0; body < states_.size(); ++body) {
      const auto i = static_cast<std::size_t>(body);
      if (states_.asleep[i] == 0 && states_.removed[i] == 0) awake_.push_back(body);
    }
  }

  std::vector<Shape<Dim>> shapes_;
  BodyStates<Dim> states_;
  std::vector<BodyIndex> awake_;
};

}  // namespace talus
