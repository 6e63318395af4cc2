#include "tools/picture/shaded_image.h"

#include <memory>

namespace talus {

namespace {

Projection<3> finer(Projection<3> projection, int samples) {
  projection.scale *= samples;
  projection.shift *= samples;
  return projection;
}

/// How wide the lines around bodies may be for their size in the picture, in [0, 1].
double outline_limit(const PictureInput<3>& input, const Projection<3>& projection) {
  double extent = 0.0;
  for (const Shape<3>& shape : input.shapes) {
    extent = std::max(extent, shape.extent);
  }
  return std::clamp((extent * projection.pixels_per_metre() - 4.0) / 30.0, 0.15, 1.0);
}

}  // namespace

ShadedImage::ShadedImage(const PictureInput<3>& input, const Framing<3>& framing, const Projection<3>& projection,
                         const PictureParams& params, int width, int height)
    : params_(params),
      width_(width),
      height_(height),
      projection_(finer(projection, params.samples)),
      outline_limit_(outline_limit(input, projection)),
      buffer_(width * params.samples, height * params.samples),
      pixels_(static_cast<std::size_t>(width) * height) {
  std::vector<Face> all = faces_of(input, framing);
  std::vector<Face> casting;
  std::ranges::copy_if(all, std::back_inserter(casting), is_body);
  enter(std::move(all));
  std::ranges::copy_if(faces_, std::back_inserter(casting), is_obstacle);
  for (const Face& face : faces_) {
    paints_.push_back(paint_of(face, input));
  }
  shade(Lighting(casting, framing.box, projection_));
  for (const Face& face : glass_) {
    blend(face, with_alpha(params_.obstacle, 0.22));
  }
  blend_layers(input.piles);
}

void ShadedImage::enter(std::vector<Face> faces) {
  for (Face& face : faces) {
    if (!faces_eye(face, projection_)) {
      continue;
    }
    if (is_obstacle(face) && hides_bodies(face)) {
      glass_.push_back(std::move(face));
    } else {
      faces_.push_back(std::move(face));
      buffer_.add(faces_.back(), static_cast<std::int32_t>(faces_.size()) - 1, projection_);
    }
  }
}

bool ShadedImage::hidden(const Vec3& point) const {
  // A little leeway: a line on a face must be visible.
  const Vec3 seen = projection_.project(point + 0.004 * projection_.distance * projection_.towards_eye(point));
  const int x = static_cast<int>(std::floor(seen.x()));
  const int y = static_cast<int>(std::floor(seen.y()));
  if (x < 0 || y < 0 || x >= buffer_.width() || y >= buffer_.height()) {
    return false;
  }
  return static_cast<double>(buffer_.nearness(x, y)) > seen.z();
}

void ShadedImage::paint(cairo_t* canvas) const {
  const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_, height_), cairo_surface_destroy);
  unsigned char* bytes = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  const auto level = [](double value) {
    return static_cast<std::uint32_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
  };
  for (int y = 0; y < height_; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(bytes + static_cast<std::ptrdiff_t>(y) * stride);
    for (int x = 0; x < width_; ++x) {
      const Pixel& seen = pixels_[index(x, y)];
      row[x] = level(seen.red) << 16U | level(seen.green) << 8U | level(seen.blue);
    }
  }
  cairo_surface_mark_dirty(surface.get());
  cairo_set_source_surface(canvas, surface.get(), 0.0, 0.0);
  cairo_paint(canvas);
}

}  // namespace talus
