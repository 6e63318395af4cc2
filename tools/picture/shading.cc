// The colours of solid things: paint, light and the lines around bodies.

#include <array>

#include "tools/picture/shaded_image.h"

namespace talus {

namespace {

constexpr double crease = 0.85;  // cosine of the angle between two faces of one body above which no line is drawn

}  // namespace

ShadedImage::Paint ShadedImage::paint_of(const Face& face, const PictureInput<3>& input) const {
  if (face.owner == ground_owner) {
    return {params_.paper, params_.paper};
  }
  if (is_obstacle(face)) {
    return {params_.obstacle, params_.obstacle_outline};
  }
  if (input.states.asleep[face.owner] != 0) {
    return {params_.asleep, params_.asleep_outline};
  }
  return {params_.awake[input.states.shape[face.owner] % params_.awake.size()], params_.awake_outline};
}

double ShadedImage::outline_strength(int x, int y) const {
  const std::int32_t here = buffer_.face(x, y);
  const Face& face = faces_[here];
  const std::array<std::array<int, 2>, 4> neighbours = {{{x + 1, y}, {x, y + 1}, {x - 1, y}, {x, y - 1}}};
  double strength = 0.0;
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    const auto [nx, ny] = neighbours[i];
    if (nx < 0 || ny < 0 || nx >= buffer_.width() || ny >= buffer_.height() || buffer_.face(nx, ny) == here) {
      continue;
    }
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
  const Paint& paint = paints_[number];
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
    if (y % 2 == 0) {
      skies.assign(skies.size(), {});
    }
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
      if (number != sun.face) {
        sun = {number, lighting.sun(point, normal)};
      }
      if (number != sky.face) {
        sky = {number, lighting.sky(point, normal)};
      }
      seen = shaded(sx, sy, sun.light + sky.light);
    }
    mean.red += share * seen.red;
    mean.green += share * seen.green;
    mean.blue += share * seen.blue;
  }
  return mean;
}

}  // namespace talus
