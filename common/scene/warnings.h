#pragma once

#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace talus {

/// What is allowed in a scene but will probably not give what was meant, one line each: keys given under an old name,
/// parts that do not fill their mesh, spouts that cannot keep up, sizes and masses that the engines hold badly, shapes
/// too different for one pile's layers, a policy without a pile.
template <int Dim>
std::vector<std::string> warnings(const Scene<Dim>& scene);

}  // namespace talus
