#include "tools/picture/canvas.h"

#include <cmath>

namespace talus {

void set_colour(cairo_t* canvas, const Colour& colour) {
  cairo_set_source_rgba(canvas, colour.red, colour.green, colour.blue, colour.alpha);
}

Colour with_alpha(Colour colour, double alpha) {
  colour.alpha = alpha;
  return colour;
}

Colour mix(const Colour& from, const Colour& to, double share) {
  return {std::lerp(from.red, to.red, share), std::lerp(from.green, to.green, share),
          std::lerp(from.blue, to.blue, share), std::lerp(from.alpha, to.alpha, share)};
}

void trace_line(cairo_t* canvas, std::span<const Vec2> points) {
  cairo_new_sub_path(canvas);
  for (const Vec2& point : points) {
    cairo_line_to(canvas, point.x(), point.y());
  }
}

void trace_polygon(cairo_t* canvas, std::span<const Vec2> corners) {
  trace_line(canvas, corners);
  cairo_close_path(canvas);
}

namespace {

void select_font(cairo_t* canvas, const TextStyle& style) {
  cairo_select_font_face(canvas, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(canvas, style.size);
}

}  // namespace

double text_width(cairo_t* canvas, const std::string& text, const TextStyle& style) {
  select_font(canvas, style);
  cairo_text_extents_t extents;
  cairo_text_extents(canvas, text.c_str(), &extents);
  return extents.x_advance;
}

void draw_text(cairo_t* canvas, const Vec2& at, const std::string& text, const TextStyle& style) {
  const double left = at.x() - style.anchor * text_width(canvas, text, style);
  if (style.halo > 0.0) {
    cairo_move_to(canvas, left, at.y());
    cairo_text_path(canvas, text.c_str());
    cairo_set_source_rgba(canvas, 1.0, 1.0, 1.0, 0.85);
    cairo_set_line_width(canvas, 2.0 * style.halo);
    cairo_set_line_join(canvas, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(canvas);
  }
  set_colour(canvas, style.colour);
  cairo_move_to(canvas, left, at.y());
  cairo_show_text(canvas, text.c_str());
}

}  // namespace talus
