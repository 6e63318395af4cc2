#pragma once
// The bodies that can be seen of very many.

#include <vector>

#include "tools/picture/picture.h"

namespace talus {

/// Those of `bodies` that are no deeper than two extents beneath the lowest surface around them, the surface being the
/// highest body in each column as wide as an extent. All of them, where they are few enough to draw each.
std::vector<BodyIndex> exposed(const PictureInput<3>& input, const std::vector<BodyIndex>& bodies);

}  // namespace talus
