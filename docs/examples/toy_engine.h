#pragma once
// The smallest engine behind the interface World, as an example of docs/extending.md: spheres that fall on the ground
// plane, slide on it without friction and pass through each other. Each shape becomes the sphere that its lowest point
// gives.

#include <talus/simulation.h>

#include <memory>
#include <vector>

namespace talus {

class ToyWorld final : public World<3> {
 public:
  explicit ToyWorld(const WorldDescription<3>& description) : World<3>(description) {
    for (const Shape<3>& shape : description.shapes) radius_.push_back(-bounds_at(shape, {}).min().z());
  }

 private:
  /// A body as this engine stores it.
  struct Sphere {
    Vec3 centre = Vec3::Zero();    // [m]
    Vec3 velocity = Vec3::Zero();  // [m/s]
    Spin<3> spin = Spin<3>::Zero();
    Rotation<3> rotation = Rotation<3>::Identity();
    double radius = 0.0;          // [m]
    double approach_speed = 0.0;  // [m/s] at which it met the ground in the last step
    bool frozen = false;
  };

  // The life of a body. Its index is the number of bodies before it.
  Pose<3> engine_add(BodyIndex, const BodyDef<3>& def) override {
    spheres_.push_back({.centre = def.pose.position,
                        .velocity = def.velocity,
                        .spin = def.spin,
                        .rotation = def.pose.rotation,
                        .radius = radius_[def.shape]});
    return def.pose;
  }
  void engine_remove(std::span<const BodyIndex>) override {}  // not in awake() any more, so no step moves them
  void engine_set_velocity(BodyIndex body, const Vec3& velocity, const Spin<3>& spin) override {
    at(body).velocity = velocity;
    at(body).spin = spin;
  }
  void engine_freeze(std::span<const BodyIndex> bodies) override { set_frozen(bodies, true); }
  void engine_thaw(std::span<const BodyIndex> bodies) override { set_frozen(bodies, false); }
  bool engine_awake(BodyIndex body) const override { return !at(body).frozen; }  // there is no sleeping rule of its own

  // A step: semi-implicit Euler over the awake bodies.
  EngineTimes engine_step() override {
    for (const BodyIndex body : awake()) move(at(body));
    return {};
  }
  void move(Sphere& sphere) const {
    const double dt = description().dt;
    sphere.velocity.z() -= description().gravity * dt;
    sphere.centre += dt * sphere.velocity;
    sphere.approach_speed = 0.0;
    const double lowest = description().ground.height + sphere.radius;
    if (!description().ground.present || sphere.centre.z() > lowest) return;
    sphere.centre.z() = lowest;
    sphere.approach_speed = -sphere.velocity.z();
    sphere.velocity.z() = 0.0;
  }

  // The result of a step.
  std::optional<BodyIndex> engine_read(BodyStates<3>& states) override {
    for (const BodyIndex body : awake())
      if (!at(body).centre.allFinite() || !at(body).velocity.allFinite()) return body;
    for (const BodyIndex body : awake()) {
      states.pose[body] = {at(body).centre, at(body).rotation};
      states.velocity[body] = at(body).velocity;
      states.spin[body] = at(body).spin;
    }
    return std::nullopt;
  }
  void engine_contacts(std::vector<Contact<3>>& contacts) const override {
    for (const BodyIndex body : awake()) {
      const Sphere& sphere = at(body);
      if (sphere.approach_speed == 0.0) continue;
      contacts.push_back({.a = body,
                          .b = ground_index,
                          .point = sphere.centre - sphere.radius * Vec3::UnitZ(),
                          .normal = Vec3::UnitZ(),
                          .normal_impulse = shape_of(body).mass * sphere.approach_speed,
                          .approach_speed = sphere.approach_speed});
    }
  }
  void engine_query_box(const Box<3>& box, std::vector<BodyIndex>& found) const override {
    for (BodyIndex body = 0; body < states().size(); ++body)
      if (states().removed[body] == 0 && box.intersects(bounds_of(body))) found.push_back(body);
  }

  void set_frozen(std::span<const BodyIndex> bodies, bool frozen) {
    for (const BodyIndex body : bodies) {
      at(body).velocity.setZero();
      at(body).spin.setZero();
      at(body).frozen = frozen;
    }
  }
  Sphere& at(BodyIndex body) { return spheres_[body]; }
  const Sphere& at(BodyIndex body) const { return spheres_[body]; }

  std::vector<double> radius_;   // by shape [m]
  std::vector<Sphere> spheres_;  // by body
};

/// Throws std::invalid_argument on a bad description.
inline std::unique_ptr<World<3>> make_toy_world(const WorldDescription<3>& description) {
  return std::make_unique<ToyWorld>(description);
}

}  // namespace talus
