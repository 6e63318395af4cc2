#pragma once
// The side view of a scene as a grid of dots.

#include <vector>

#include "tools/picture/framing.h"
#include "tools/picture/projection.h"

namespace talus {

enum class Dot : std::uint8_t { empty, awake, asleep, obstacle };

/// Square dots, each showing one thing. Row 0 is on top.
struct Dots {
  int width = 0;
  int height = 0;
  std::vector<Dot> dots;

  Dot& at(int x, int y) { return dots[index(x, y)]; }
  Dot at(int x, int y) const { return dots[index(x, y)]; }
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
};

/// From the world seen from the side to dots: 2D as it is, 3D along the y axis.
template <int Dim>
Projection<Dim> side_view(const Framing<Dim>& framing);

/// The framed bodies and, where no body is, the obstacles. Each body has at least the dot of its centre.
template <int Dim>
Dots dots_of(const PictureInput<Dim>& input, const Framing<Dim>& framing, const Projection<Dim>& projection, int width,
             int height);

}  // namespace talus
