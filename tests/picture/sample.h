#pragma once
// Small worlds to draw, and ways to look at what was drawn.

#include <cairo.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/shape/catalogue.h"
#include "tools/picture/picture.h"

namespace talus {

/// Bodies of one shape, placed one by one.
template <int Dim>
struct Sample {
  std::vector<Shape<Dim>> shapes = {make_shape<Dim>("L", l_pieces<Dim>({}), Material{})};
  BodyStates<Dim> states;
  std::vector<Pile<Dim>> piles;
  std::vector<Obstacle<Dim>> obstacles;

  void add(const Vec<Dim>& position, bool asleep) {
    states.shape.push_back(0);
    states.pose.push_back({position, identity_rotation<Dim>()});
    states.velocity.push_back(Vec<Dim>::Zero());
    states.spin.push_back(Spin<Dim>::Zero());
    states.asleep.push_back(asleep ? 1 : 0);
    states.removed.push_back(0);
  }

  /// Rows of four bodies, in turn asleep and awake.
  void add_rows(int rows) {
    for (int i = 0; i < 4 * rows; ++i) {
      const int row = i / 4;
      Vec<Dim> position = Vec<Dim>::Zero();
      position[0] = 1.5 * (i % 4);
      position[Dim - 1] = 0.7 + 1.5 * row;
      add(position, i % 2 == 0);
    }
  }

  void add_pile(double structure_size) {
    piles.push_back(make_pile<Dim>(Vec<Dim>::Zero(), 0.785, structure_size,
                                   {shapes[0].bounding_volume, shapes[0].extent, shapes[0].mass}));
  }

  PictureInput<Dim> input() const { return {shapes, states, piles, obstacles, Ground{}, "A title", "A caption"}; }
};

/// A picture read back from its file.
class PngImage {
 public:
  explicit PngImage(const std::filesystem::path& png)
      : surface_(cairo_image_surface_create_from_png(png.c_str()), cairo_surface_destroy) {
    if (cairo_surface_status(surface_.get()) != CAIRO_STATUS_SUCCESS)
      throw std::runtime_error("no PNG: " + png.string());
    cairo_surface_flush(surface_.get());
  }
  int width() const { return cairo_image_surface_get_width(surface_.get()); }
  int height() const { return cairo_image_surface_get_height(surface_.get()); }
  Colour at(const Vec2& point) const {
    const unsigned char* row = cairo_image_surface_get_data(surface_.get()) +
                               static_cast<std::ptrdiff_t>(point.y()) * cairo_image_surface_get_stride(surface_.get());
    const std::uint32_t pixel = reinterpret_cast<const std::uint32_t*>(row)[static_cast<std::ptrdiff_t>(point.x())];
    return {(pixel >> 16U & 255U) / 255.0, (pixel >> 8U & 255U) / 255.0, (pixel & 255U) / 255.0, 1.0};
  }

 private:
  std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface_;
};

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace talus
