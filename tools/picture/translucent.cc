// What one sees through: walls of containers and the layers of piles.

#include "tools/picture/layer_rim.h"
#include "tools/picture/layer_style.h"
#include "tools/picture/shaded_image.h"

namespace talus {

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
    if (nearness <= static_cast<double>(buffer_.nearness(x, y))) {
      return;
    }
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
        if (faces_eye(wall, projection_)) {
          blend(wall, colour);
        }
      }
      blend({high, Vec3::UnitZ(), 0, {}}, with_alpha(colour, 0.5 * colour.alpha));
    }
  }
}

}  // namespace talus
