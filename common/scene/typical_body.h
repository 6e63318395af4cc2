#pragma once

#include <vector>

#include "common/pile/pile.h"
#include "common/scene/scene.h"

namespace talus {

/// Of each shape of the scene, how many of its bodies are placed or will be dropped; 0 of a shape so rare, less than
/// one for fifty of the most frequent shape, that no pile is made of it, as what is thrown into a pile. Without
/// sources: one of each.
template <int Dim>
std::vector<double> bodies_of_piles(const Scene<Dim>& scene);

/// What the bodies of the scene's piles are taken to be like: v_obj and mass are means over bodies_of_piles(), D is the
/// largest among them.
template <int Dim>
TypicalBody typical_body(const Scene<Dim>& scene);

}  // namespace talus
