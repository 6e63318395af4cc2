#pragma once
// Which boxes hang in the air.

#include <vector>

#include "common/shape/catalogue.h"
#include "common/shape/convex_distance.h"

namespace talus::test {

template <int Dim>
ConvexPiece<Dim> box_at(const Vec<Dim>& size, const Pose<Dim>& pose) {
  return convex_pieces_at(make_shape<Dim>("box", box_pieces<Dim>(size), {}), pose).front();
}

/// Of each box, whether a chain of bodies leads from one of the fixed bodies to it, each within `gap` [m] of the next.
template <int Dim>
std::vector<bool> held(const std::vector<ConvexPiece<Dim>>& boxes, std::vector<ConvexPiece<Dim>> reached, double gap) {
  std::vector<bool> found(boxes.size(), false);
  while (!reached.empty()) {
    const ConvexPiece<Dim> from = reached.back();
    reached.pop_back();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (found[i] || signed_distance<Dim>(from, boxes[i], 2.0 * gap) > gap) continue;
      found[i] = true;
      reached.push_back(boxes[i]);
    }
  }
  return found;
}

}  // namespace talus::test
