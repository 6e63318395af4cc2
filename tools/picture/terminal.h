#pragma once
// The pile as text, for a terminal without a desktop.

#include <string>
#include <vector>

#include "tools/picture/framing.h"
#include "tools/picture/picture.h"
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

/// How large the text may be, and whether the terminal shows colours: the caller can find out what it writes to and
/// whether the user allows any (isatty, NO_COLOR).
struct TerminalParams {
  int columns = 72;     // 48..400
  int rows = 24;        // 6..200, at most; a flat pile needs fewer
  bool colours = true;  // braille dots in ANSI colours; without, blocks in three shades
};

/// Lines, each ended by '\n': the bodies seen from the side (in 3D along the y axis), the ground, the densities of a
/// single pile's layers beside them, and a legend. Bodies far from all others are left out, as in draw_pile(). Throws
/// std::invalid_argument on bad parameters.
template <int Dim>
std::string terminal_picture(const PictureInput<Dim>& input, const TerminalParams& params = {});

}  // namespace talus
