#pragma once

#include <cstdint>

#include "common/world/body.h"

namespace talus {

/// FNV-1a over the bits of every body's pose and velocity, in body order: equal hashes mean equal runs.
template <int Dim>
std::uint64_t state_hash(const BodyStates<Dim>& states);

}  // namespace talus
