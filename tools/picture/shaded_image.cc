#include "tools/picture/shaded_image.h"

#include <array>
#include <memory>

#include "tools/picture/layers.h"

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
  for (const Shape<3>& shape : input.shapes) extent = std::max(extent, shape.extent);
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
  for (const Face& face : faces_) paints_.push_back(paint_of(face, input));
  shade(Lighting(casting, framing.box, projection_));
  for (const Face& face : glass_) blend(face, with_alpha(params_.obstacle, 0.22));
  blend_layers(input.piles);
}

void ShadedImage::enter(std::vector<Face> faces) {
  for (Face& face : faces) {
    if (!faces_eye(face, projection_)) continue;
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
  if (x < 0 || y < 0 || x >= buffer_.width() || y >= buffer_.height()) return false;
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

namespace {

constexpr double crease = 0.85;  // cosine of the angle between two faces of one body above which no line is drawn

}  // namespace

BodyPaint ShadedImage::paint_of(const Face& face, const PictureInput<3>& input) const {
  if (face.owner == ground_owner) return {params_.paper, params_.paper};
  if (is_obstacle(face)) return {params_.obstacle, params_.obstacle_outline};
  const int shape = input.states.shape[face.owner];
  return body_paint(params_, shape, input.shapes[shape].colour, input.states.asleep[face.owner] != 0);
}

double ShadedImage::outline_strength(int x, int y) const {
  const std::int32_t here = buffer_.face(x, y);
  const Face& face = faces_[here];
  const std::array<std::array<int, 2>, 4> neighbours = {{{x + 1, y}, {x, y + 1}, {x - 1, y}, {x, y - 1}}};
  double strength = 0.0;
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    const auto [nx, ny] = neighbours[i];
    if (nx < 0 || ny < 0 || nx >= buffer_.width() || ny >= buffer_.height() || buffer_.face(nx, ny) == here) continue;
    const std::int32_t there = buffer_.face(nx, ny);
    const bool same_body = there >= 0 && faces_[there].owner == face.owner;
    if (!same_body) {
      // The line belongs to the nearer of two bodies.
      strength = buffer_.nearness(nx, ny) <= buffer_.nearness(x, y) ? 1.0 : strength;
    } else if (i < 2 && faces_[there].normal.dot(face.normal) < crease) {
      strength = std::max(strength, 0.7);
    }
  }
  return strength * outline_limit_;
}

ShadedImage::Pixel ShadedImage::shaded(int x, int y, double light) const {
  const std::int32_t number = buffer_.face(x, y);
  const BodyPaint& paint = paints_[number];
  const bool ground = faces_[number].owner == ground_owner;
  const double line = ground ? 0.0 : outline_strength(x, y);
  const Colour colour = mix(paint.fill, paint.outline, line);
  // Lines keep some of their colour in the dark, or black bodies would melt into one another.
  const double solid = 0.2 + 0.85 * light;
  const double strength = ground ? std::min(1.0, 0.35 + 0.65 * light) : std::lerp(solid, 0.5 + 0.5 * solid, line);
  return {colour.red * strength, colour.green * strength, colour.blue * strength};
}

void ShadedImage::shade(const Lighting& lighting) {
  std::vector<LitFace> skies(width_);
  for (int y = 0; y < height_; ++y) {
    if (y % 2 == 0) skies.assign(skies.size(), {});
    for (int x = 0; x < width_; ++x) {
      // Squares of two by two pixels share the sky's light where they show one face.
      pixel(x, y) = mean_of_samples(x, y, lighting, skies[x / 2]);
    }
  }
}

ShadedImage::Pixel ShadedImage::mean_of_samples(int x, int y, const Lighting& lighting, LitFace& sky) const {
  const int samples = params_.samples;
  const double share = 1.0 / (samples * samples);
  LitFace sun;
  Pixel mean;
  for (int sample = 0; sample < samples * samples; ++sample) {
    const int sx = x * samples + sample % samples;
    const int sy = y * samples + sample / samples;
    const std::int32_t number = buffer_.face(sx, sy);
    Pixel seen = {params_.paper.red, params_.paper.green, params_.paper.blue};
    if (number != ZBuffer::nothing) {
      const Vec3 point = projection_.unproject({sx + 0.5, sy + 0.5, static_cast<double>(buffer_.nearness(sx, sy))});
      const Vec3 normal = faces_[number].normal_at(point);
      if (number != sun.face) sun = {number, lighting.sun(point, normal)};
      if (number != sky.face) sky = {number, lighting.sky(point, normal)};
      seen = shaded(sx, sy, sun.light + sky.light);
    }
    mean.red += share * seen.red;
    mean.green += share * seen.green;
    mean.blue += share * seen.blue;
  }
  return mean;
}

bool ShadedImage::hides_bodies(const Face& face) const {
  std::int64_t covered = 0;
  std::int64_t bodies = 0;
  scan_convex(projected(face, projection_), buffer_.width(), buffer_.height(), [&](int x, int y, double nearness) {
    ++covered;
    bodies += buffer_.face(x, y) >= 0 && is_body(faces_[buffer_.face(x, y)]) &&
                      nearness > static_cast<double>(buffer_.nearness(x, y))
                  ? 1
                  : 0;
  });
  return bodies > covered / 50;
}

void ShadedImage::blend(const Face& face, const Colour& colour) {
  const int samples = params_.samples;
  const double alpha = colour.alpha / (samples * samples);
  scan_convex(projected(face, projection_), buffer_.width(), buffer_.height(), [&](int x, int y, double nearness) {
    if (nearness <= static_cast<double>(buffer_.nearness(x, y))) return;
    Pixel& seen = pixel(x / samples, y / samples);
    seen.red += alpha * (colour.red - seen.red);
    seen.green += alpha * (colour.green - seen.green);
    seen.blue += alpha * (colour.blue - seen.blue);
  });
}

void ShadedImage::blend_layers(std::span<const Pile<3>> piles) {
  for (const Pile<3>& pile : piles) {
    for (std::size_t i = 0; i < pile.layers.size(); ++i) {
      const Layer& layer = pile.layers[i];
      const Colour colour = with_alpha(params_.layer, 0.6 * layer_opacity(layer));
      const std::vector<Vec3> low = layer_rim(pile, layer, layer.bottom);
      const std::vector<Vec3> high = layer_rim(pile, layer, layer.top);
      for (std::size_t k = 0; k < low.size(); ++k) {
        const std::size_t next = (k + 1) % low.size();
        const Face wall = {{low[k], low[next], high[next], high[k]}, (low[next] - low[k]).cross(Vec3::UnitZ()), 0, {}};
        if (faces_eye(wall, projection_)) blend(wall, colour);
      }
      blend({high, Vec3::UnitZ(), 0, {}}, with_alpha(colour, 0.5 * colour.alpha));
    }
  }
}

}  // namespace talus
