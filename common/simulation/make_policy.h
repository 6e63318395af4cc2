#pragma once

#include <memory>

#include "common/policy/sleep_policy.h"
#include "common/scene/scene.h"

namespace talus {

/// The policy that the scene names. Throws std::invalid_argument for an unknown name.
template <int Dim>
std::unique_ptr<SleepPolicy<Dim>> make_policy(const Scene<Dim>& scene);

}  // namespace talus
