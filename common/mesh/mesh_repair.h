#pragma once
// Makes a mesh fit to compute with, or reports why it is not.

#include "common/mesh/mesh.h"

namespace talus {

/// Mends what is harmless: merges corners closer than about a millionth of the mesh's length, drops triangles that are
/// then without area or there twice, drops corners that no triangle uses, and turns every connected part so that its
/// outside is outside. Overlapping parts count twice; hollows become solid.
/// Throws std::invalid_argument with count and place where the surface is not closed, where more than two triangles
/// meet in an edge, where it has but one side (a Moebius strip), and where it encloses no volume.
Mesh repaired(const Mesh& mesh);

}  // namespace talus
