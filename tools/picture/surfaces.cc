// Pages as bytes of an SVG or PNG file.

#include <cairo-svg.h>

#include <cstring>
#include <map>
#include <memory>
#include <stdexcept>

#include "tools/picture/canvas.h"

namespace talus {

namespace {

struct Release {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* canvas) const { cairo_destroy(canvas); }
};
using Surface = std::unique_ptr<cairo_surface_t, Release>;
using Canvas = std::unique_ptr<cairo_t, Release>;

void require(cairo_status_t status, const char* doing) {
  if (status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(std::string(doing) + ": " + cairo_status_to_string(status));
  }
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
