#pragma once
// Piles of hundreds of layers made fit for a picture.

#include "common/pile/pile.h"

namespace talus {

/// The same pile cut into `most` layers or fewer, each made of as many neighbours: thinner ones would be nothing but
/// lines. `most` > 0.
template <int Dim>
Pile<Dim> with_coarse_layers(Pile<Dim> pile, int most);

}  // namespace talus
