#pragma once
// The pile as text, for a terminal without a desktop.

#include <string>

#include "tools/picture/picture.h"

namespace talus {

/// How large the text may be, and whether the terminal shows colours: the caller can find out what it writes to and
/// whether the user wants any (isatty, NO_COLOR).
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
