// The 3D scene: a shaded image with lines and text on top of it.

#include <memory>

#include "tools/picture/force_chains.h"
#include "tools/picture/layers.h"
#include "tools/picture/page.h"
#include "tools/picture/periodic_sides.h"
#include "tools/picture/scene_painter.h"
#include "tools/picture/shaded_image.h"

namespace talus {
namespace {

struct SolidScene {
  const PictureInput<3>& input;
  const Framing<3>& framing;
  Projection<3> projection;
  const PictureParams& params;
  ShadedImage image;

  void paint(cairo_t* canvas) const {
    image.paint(canvas);
    if (input.ground.present) paint_grid(canvas);
    for (const Face& face : image.glass()) paint_line(canvas, closed(face.corners), params.obstacle_outline, 1.2);
    begin_dashes(canvas);
    for (const std::vector<Vec3>& side : outlines_of(input.sides, framing.box))
      paint_line(canvas, side, params.ground, 1.4);
    cairo_restore(canvas);
    for (const Pile<3>& pile : input.piles) {
      for (const Layer& layer : pile.layers)
        for (const double z : {layer.bottom, layer.top})
          paint_line(canvas, closed(layer_rim(pile, layer, z)), params.layer, 1.4);
    }
    paint_chains(canvas, input, projection, params);
    paint_densities(canvas);
  }

  static std::vector<Vec3> closed(std::vector<Vec3> points) {
    points.push_back(points.front());
    return points;
  }

  /// A line in space: full where it is seen, faint where a body hides it.
  void paint_line(cairo_t* canvas, const std::vector<Vec3>& points, const Colour& colour, double line_width) const {
    std::vector<Vec2> run;
    bool hidden = image.hidden(points.front());
    const auto finish = [&] {
      trace_line(canvas, run);
      set_colour(canvas, with_alpha(colour, (hidden ? 0.22 : 0.85) * colour.alpha));
      cairo_set_line_width(canvas, line_width);
      cairo_stroke(canvas);
    };
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const double length = (projection.on_page(points[i + 1]) - projection.on_page(points[i])).norm();
      const int steps = std::clamp(static_cast<int>(length / 2.0), 1, 2000);
      for (int step = 0; step <= steps; ++step) {
        const Vec3 point = points[i] + (points[i + 1] - points[i]) * step / steps;
        run.push_back(projection.on_page(point));
        if (image.hidden(point) != hidden) {
          finish();
          run = {run.back()};
          hidden = !hidden;
        }
      }
    }
    finish();
  }

  /// Squares on the ground, as wide as the scale bar is long, fading away from the middle.
  void paint_grid(cairo_t* canvas) const {
    const double step = nice_length(params.width / 6.0 / projection.pixels_per_metre());
    const int lines = static_cast<int>(std::ceil(0.75 * framing.box.diagonal().norm() / step)) + 1;
    Vec3 middle = (framing.box.center() / step).array().round() * step;
    middle.z() = input.ground.height;
    for (int i = -lines; i <= lines; ++i) {
      for (int k = -lines; k < lines; ++k) {
        const double away = Vec2(i, k + 0.5).norm() / lines;
        const Colour colour = with_alpha(params.ground, 0.28 * std::clamp(1.0 - away, 0.0, 1.0));
        if (colour.alpha > 0.0) {
          paint_seen(canvas, middle + step * Vec3(i, k, 0.0), middle + step * Vec3(i, k + 1, 0.0), colour);
          paint_seen(canvas, middle + step * Vec3(k, i, 0.0), middle + step * Vec3(k + 1, i, 0.0), colour);
        }
      }
    }
  }

  /// The seen parts of a straight line.
  void paint_seen(cairo_t* canvas, const Vec3& from, const Vec3& to, const Colour& colour) const {
    if (projection.depth(from) < projection.near_limit() || projection.depth(to) < projection.near_limit()) return;
    const double length = (projection.on_page(to) - projection.on_page(from)).norm();
    const int steps = std::clamp(static_cast<int>(length / 2.0), 1, 2000);
    std::vector<Vec2> run;
    for (int step = 0; step <= steps; ++step) {
      const Vec3 point = from + (to - from) * step / steps;
      const bool seen = !image.hidden(point);
      if (seen) run.push_back(projection.on_page(point));
      if (!seen || step == steps) {
        trace_line(canvas, run);
        run.clear();
      }
    }
    set_colour(canvas, colour);
    cairo_set_line_width(canvas, 1.0);
    cairo_stroke(canvas);
  }

  void paint_densities(cairo_t* canvas) const {
    DensityLabels labels(params);
    for (const Pile<3>& pile : input.piles) {
      for (const Layer& layer : pile.layers) {
        Vec2 rightmost(0.0, 0.0);
        for (const Vec3& point : layer_rim(pile, layer, 0.5 * (layer.bottom + layer.top))) {
          const Vec2 seen = projection.on_page(point);
          rightmost = seen.x() > rightmost.x() ? seen : rightmost;
        }
        labels.draw(canvas, rightmost, layer);
      }
    }
  }
};

}  // namespace

Painter scene_painter(const PictureInput<3>& input, const Framing<3>& framing, const Projection<3>& projection,
                      const PictureParams& params, int width, int height) {
  const auto scene = std::make_shared<SolidScene>(
      SolidScene{input, framing, projection, params, ShadedImage(input, framing, projection, params, width, height)});
  return [scene](cairo_t* canvas) { scene->paint(canvas); };
}

}  // namespace talus
