#pragma once
// Cairo with colours and text in our terms. Coordinates are pixels, x to the right and y down.

#include <cairo.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "common/math/vector.h"
#include "tools/picture/picture_params.h"

namespace talus {

/// Style of a line of text. `anchor`: the share of its width that lies left of the given point.
struct TextStyle {
  double size = 23.0;  // [px]
  Colour colour;
  double anchor = 0.0;
  bool bold = false;
  double halo = 0.0;  // [px] width of a white rim, for text on top of a drawing
};

void set_colour(cairo_t* canvas, const Colour& colour);
Colour with_alpha(Colour colour, double alpha);
/// `share` 0: all of `from`; 1: all of `to`.
Colour mix(const Colour& from, const Colour& to, double share);

/// Adds a closed polygon, or an open line, to the path.
void trace_polygon(cairo_t* canvas, std::span<const Vec2> corners);
void trace_line(cairo_t* canvas, std::span<const Vec2> points);

/// Lines are dashed from here to the next cairo_restore().
void begin_dashes(cairo_t* canvas);

double text_width(cairo_t* canvas, const std::string& text, const TextStyle& style);
/// One line of text whose base line starts at `at`.
void draw_text(cairo_t* canvas, const Vec2& at, const std::string& text, const TextStyle& style);

/// What draws a page on whatever surface lies beneath.
using Painter = std::function<void(cairo_t*)>;

/// The page as the bytes of a file, the same for the same drawing. Throws std::runtime_error with Cairo's reason.
std::string svg_bytes(int width, int height, const Painter& paint);
std::string png_bytes(int width, int height, const Painter& paint);

/// The page as pixels row by row, 0x??RRGGBB each.
std::vector<std::uint32_t> pixels_of(int width, int height, const Painter& paint);

/// Text broken between words into lines of at most `width` [px], and at each '\n'. A longer word stays whole.
std::vector<std::string> wrapped(const std::string& text, double width, const TextStyle& style);

}  // namespace talus
