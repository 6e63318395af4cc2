#include "tools/picture/canvas.h"

#include <cairo-svg.h>

#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>

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
  for (const Vec2& point : points) cairo_line_to(canvas, point.x(), point.y());
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

void begin_dashes(cairo_t* canvas) {
  constexpr double dash = 7.0;  // [px]
  cairo_save(canvas);
  cairo_set_dash(canvas, &dash, 1, 0.0);
}

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

std::vector<std::string> wrapped(const std::string& text, double width, const TextStyle& style) {
  // A surface to measure on; nothing is drawn.
  const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(
      cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1), cairo_surface_destroy);
  const std::unique_ptr<cairo_t, void (*)(cairo_t*)> canvas(cairo_create(surface.get()), cairo_destroy);
  std::vector<std::string> lines;
  std::istringstream paragraphs(text);
  for (std::string paragraph; std::getline(paragraphs, paragraph);) {
    std::string line;
    std::istringstream words(paragraph);
    for (std::string word; words >> word;) {
      const std::string longer = line.empty() ? word : line + " " + word;
      if (!line.empty() && text_width(canvas.get(), longer, style) > width) {
        lines.push_back(line);
        line = word;
      } else {
        line = longer;
      }
    }
    lines.push_back(line);
  }
  return lines;
}

namespace {

struct Release {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* canvas) const { cairo_destroy(canvas); }
};
using Surface = std::unique_ptr<cairo_surface_t, Release>;
using Canvas = std::unique_ptr<cairo_t, Release>;

void require(cairo_status_t status, const char* doing) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(std::string(doing) + ": " + cairo_status_to_string(status));
}

void paint_on(const Surface& surface, const Painter& paint) {
  const Canvas canvas(cairo_create(surface.get()));
  // Without hinting, text has the same width in the SVG, in the PNG and at every zoom.
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(canvas.get(), options);
  cairo_font_options_destroy(options);
  paint(canvas.get());
  require(cairo_status(canvas.get()), "drawing a picture");
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

/// Cairo numbers surfaces and images by all that the process has made so far, so the same drawing would differ from one
/// call to the next: counts them from 0 again.
std::string renumbered(const std::string& svg, const std::string& prefix, std::map<std::string, std::size_t>& numbers) {
  std::string result;
  std::size_t copied = 0;
  for (std::size_t at = svg.find(prefix); at != std::string::npos; at = svg.find(prefix, copied)) {
    const std::size_t digits = at + prefix.size();
    const std::size_t end = svg.find_first_not_of("0123456789", digits);
    const auto entry = numbers.try_emplace(svg.substr(digits, end - digits), numbers.size()).first;
    result.append(svg, copied, digits - copied);
    result += std::to_string(entry->second);
    copied = end;
  }
  return result.append(svg, copied);
}

}  // namespace

std::string png_bytes(int width, int height, const Painter& paint) {
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  paint_on(surface, paint);
  std::string bytes;
  require(cairo_surface_write_to_png_stream(surface.get(), append, &bytes), "writing a PNG");
  return bytes;
}

std::vector<std::uint32_t> pixels_of(int width, int height, const Painter& paint) {
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  paint_on(surface, paint);
  cairo_surface_flush(surface.get());
  const unsigned char* data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  std::vector<std::uint32_t> pixels(static_cast<std::size_t>(width) * height);
  for (int row = 0; row < height; ++row) {
    std::memcpy(pixels.data() + static_cast<std::ptrdiff_t>(row) * width,
                data + static_cast<std::ptrdiff_t>(row) * stride, static_cast<std::size_t>(width) * 4);
  }
  return pixels;
}

std::string svg_bytes(int width, int height, const Painter& paint) {
  std::string bytes;
  {
    const Surface surface(cairo_svg_surface_create_for_stream(append, &bytes, width, height));
    cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
    paint_on(surface, paint);
    cairo_surface_finish(surface.get());
    require(cairo_surface_status(surface.get()), "writing an SVG");
  }
  std::map<std::string, std::size_t> surfaces;
  std::map<std::string, std::size_t> images;
  bytes = renumbered(bytes, "\"surface", surfaces);
  bytes = renumbered(bytes, "\"image", images);
  return renumbered(bytes, "\"#image", images);
}

}  // namespace talus
