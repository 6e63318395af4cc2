#include "tools/serve/body_account.h"

#include <fmt/format.h>

#include "common/measure/supports_of.h"

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

template <int Dim>
std::string name_of(const Scene<Dim>& scene, BodyIndex support) {
  if (support >= 0) return fmt::format("body {}", support);
  if (support == ground_index) return "the ground";
  const std::string& name = scene.world.obstacles[first_obstacle - support].shape.name;
  return name.empty() ? "an obstacle" : "obstacle " + name;
}

/// Upward force of one on the other [N]; 0 where they do not touch.
template <int Dim>
double lift(std::span<const ContactForce<Dim>> contacts, BodyIndex body, BodyIndex support) {
  double sum = 0.0;
  for (const ContactForce<Dim>& contact : contacts) {
    const double up = contact.normal_force[Dim - 1] + contact.friction_force[Dim - 1];
    if (contact.a == body && contact.b == support) sum += up;
    if (contact.b == body && contact.a == support) sum -= up;
  }
  return sum;
}

Json json_of(const Reading& reading) {
  Json json = {{"name", reading.name}, {"value", reading.value}, {"unit", reading.unit}, {"effect", reading.effect}};
  if (reading.threshold) json["threshold"] = *reading.threshold;
  return json;
}

}  // namespace

template <int Dim>
Json body_account(const Simulation<Dim>& simulation, const Scene<Dim>& scene,
                  std::span<const ContactForce<Dim>> contacts, std::int64_t body) {
  const Frame<Dim> frame = simulation.frame();
  const BodyStates<Dim>& states = frame.world.states();
  Json account = {{"kind", "body"}, {"body", body}, {"step", frame.step}};
  if (body < 0 || body >= states.size() || states.removed[body] != 0) return account;
  const auto index = static_cast<BodyIndex>(body);
  account["supports"] = Json::array();
  for (const BodyIndex support : supports_of(frame.world, fixed_supports(scene), index)) {
    Json json = {{"on", support}, {"name", name_of(scene, support)}};
    if (const double force = lift(contacts, index, support); force != 0.0) json["force"] = force;
    account["supports"].push_back(json);
  }
  account["readings"] = Json::array();
  for (const Reading& reading : frame.policy->readings(frame, index)) account["readings"].push_back(json_of(reading));
  return account;
}

template Json body_account(const Simulation<2>&, const Scene<2>&, std::span<const ContactForce<2>>, std::int64_t);
template Json body_account(const Simulation<3>&, const Scene<3>&, std::span<const ContactForce<3>>, std::int64_t);

}  // namespace talus
