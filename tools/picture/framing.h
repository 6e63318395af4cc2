#pragma once
// What part of the world a picture shows.

#include <vector>

#include "tools/picture/picture.h"

namespace talus {

/// The part of the world to show, and the bodies in it.
template <int Dim>
struct Framing {
  Box<Dim> box;                    // around all that is to be seen [m]; never empty
  std::vector<Vec<Dim>> points;    // the picture must hold these [m]: corners of bodies' boxes, rims of layers
  std::vector<BodyIndex> drawn;    // ascending
  std::vector<BodyIndex> outside;  // ascending: beyond a gap that is wider than all that is seen
};

/// Shown is what lies within Tukey's fence, 1.5 times the width of the middle half of all bodies and two bodies more to
/// each side, or within a pile's layers; then all others from the nearest on, each of which is no further from what is
/// seen than that is large. Bodies beyond such a gap lie outside: one that was shot away would make a dot of all
/// others. Obstacles are part of the framing unless they are much larger than all else; periodic sides always are.
template <int Dim>
Framing<Dim> framing_of(const PictureInput<Dim>& input);

}  // namespace talus
