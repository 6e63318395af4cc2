#pragma once
// The 3D scene as an image.

#include <vector>

#include "tools/picture/canvas.h"
#include "tools/picture/lighting.h"

namespace talus {

/// Bodies, obstacles and layers on white ground, with light and shadow.
class ShadedImage {
 public:
  /// `projection` in coordinates of a page of width x height [px].
  ShadedImage(const PictureInput<3>& input, const Framing<3>& framing, const Projection<3>& projection,
              const PictureParams& params, int width, int height);

  void paint(cairo_t* canvas) const;

  /// Whether a point of the world is hidden behind a body or a solid obstacle.
  bool hidden(const Vec3& point) const;

  /// Faces of obstacles that would hide bodies and are drawn as glass: walls of a container towards the eye.
  const std::vector<Face>& glass() const { return glass_; }

 private:
  struct Pixel {
    double red = 0.0;
    double green = 0.0;
    double blue = 0.0;
  };
  struct LitFace {
    std::int32_t face = ZBuffer::nothing;
    double light = 0.0;
  };
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width_ + x; }
  Pixel& pixel(int x, int y) { return pixels_[index(x, y)]; }
  BodyPaint paint_of(const Face& face, const PictureInput<3>& input) const;
  void enter(std::vector<Face> faces);
  bool hides_bodies(const Face& face) const;
  void shade(const Lighting& lighting);
  Pixel mean_of_samples(int x, int y, const Lighting& lighting, LitFace& sky) const;
  Pixel shaded(int x, int y, double light) const;
  double outline_strength(int x, int y) const;
  void blend(const Face& face, const Colour& colour);
  void blend_layers(std::span<const Pile<3>> piles);

  PictureParams params_;
  int width_;
  int height_;
  Projection<3> projection_;  // in subpixels, `params_.samples` of them on each axis of a pixel
  double outline_limit_;      // share of an outline that is drawn; bodies of a few pixels would be all outline
  std::vector<Face> faces_;   // towards the eye, solid
  std::vector<Face> glass_;
  std::vector<BodyPaint> paints_;  // of faces_
  ZBuffer buffer_;
  std::vector<Pixel> pixels_;
};

}  // namespace talus
