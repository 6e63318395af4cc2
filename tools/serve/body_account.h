#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "common/scene/scene.h"
#include "common/simulation/simulation.h"

namespace talus {

/// What is known of a body only where it is simulated, for the page: {"kind": "body", "body", "step", "supports":
/// [{"on": body or below 0 as in Contact, "name", "force" [N], where contacts are shown}], "readings": [{"name",
/// "value", "threshold", "unit", "effect"}] of the policy}. A body that is not in the world has no more than its
/// number.
template <int Dim>
nlohmann::ordered_json body_account(const Simulation<Dim>& simulation, const Scene<Dim>& scene,
                                    std::span<const ContactForce<Dim>> contacts, std::int64_t body);

}  // namespace talus
