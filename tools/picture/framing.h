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
  std::vector<BodyIndex> outside;  // ascending: too far from the others to be drawn
};

/// Bodies lie outside where they are further from the middle half of all bodies, on any axis, than Tukey's fence of 1.5
/// times that half's width and two bodies more, and outside of every pile's layers too. (A fixed share of the bodies
/// would fail with a handful of them.) Fewer than five are all shown. Obstacles are part of the framing unless they are
/// much larger than all else.
template <int Dim>
Framing<Dim> framing_of(const PictureInput<Dim>& input);

}  // namespace talus
