// The 2D scene: a scale drawing of vectors.

#include <array>
#include <memory>

#include "common/shape/surface.h"
#include "tools/picture/force_chains.h"
#include "tools/picture/layers.h"
#include "tools/picture/periodic_sides.h"
#include "tools/picture/scene_painter.h"

namespace talus {
namespace {

constexpr std::size_t most_vectors = 20000;  // bodies; of more, the SVG would take half a kilobyte each
constexpr int image_scale = 2;               // pixels of the image in one of the page

struct FlatScene {
  const PictureInput<2>& input;
  const Framing<2>& framing;
  const Projection<2>& projection;
  const PictureParams& params;
  int width;
  std::shared_ptr<cairo_surface_t> many_bodies;  // an image of them; none: drawn as vectors

  std::vector<Vec2> on_page(const std::vector<Vec2>& points) const {
    std::vector<Vec2> page;
    for (const Vec2& point : points) page.push_back(projection.on_page(point));
    return page;
  }

  void paint(cairo_t* canvas) const {
    if (input.ground.present) paint_ground(canvas);
    for (const Obstacle<2>& obstacle : input.obstacles)
      paint_pieces(canvas, outlines(obstacle.shape, 96), obstacle.pose, params.obstacle, params.obstacle_outline, 1.5);
    // More beneath the bodies than over them: tinted, they still keep their colours.
    paint_layers(canvas, 0.65);
    if (many_bodies != nullptr)
      paint_image(canvas);
    else
      paint_bodies(canvas);
    paint_layers(canvas, 0.35);
    paint_layer_lines(canvas);
    paint_chains(canvas, input, projection, params);
    if (input.ground.present) paint_ground_line(canvas);
    paint_sides(canvas);
    paint_densities(canvas);
  }

  double ground_on_page() const { return projection.on_page(Vec2(0.0, input.ground.height)).y(); }

  /// The ground, fading into the page.
  void paint_ground(cairo_t* canvas) const {
    const double top = ground_on_page();
    const double depth = 2.2 * params.font_size;
    cairo_pattern_t* fade = cairo_pattern_create_linear(0.0, top, 0.0, top + depth);
    const Colour& colour = params.ground;
    cairo_pattern_add_color_stop_rgba(fade, 0.0, colour.red, colour.green, colour.blue, 0.28);
    cairo_pattern_add_color_stop_rgba(fade, 1.0, colour.red, colour.green, colour.blue, 0.0);
    cairo_set_source(canvas, fade);
    cairo_rectangle(canvas, 0.0, top, width, depth);
    cairo_fill(canvas);
    cairo_pattern_destroy(fade);
  }

  void paint_ground_line(cairo_t* canvas) const {
    trace_line(canvas, std::array{Vec2(0.0, ground_on_page()), Vec2(width, ground_on_page())});
    set_colour(canvas, params.ground);
    cairo_set_line_width(canvas, 2.0);
    cairo_stroke(canvas);
  }

  void paint_sides(cairo_t* canvas) const {
    begin_dashes(canvas);
    for (const std::vector<Vec2>& side : outlines_of(input.sides, framing.box)) trace_line(canvas, on_page(side));
    set_colour(canvas, params.ground);
    cairo_set_line_width(canvas, 1.4);
    cairo_stroke(canvas);
    cairo_restore(canvas);
  }

  void paint_image(cairo_t* canvas) const {
    cairo_save(canvas);
    cairo_scale(canvas, 1.0 / image_scale, 1.0 / image_scale);
    cairo_set_source_surface(canvas, many_bodies.get(), 0.0, 0.0);
    cairo_paint(canvas);
    cairo_restore(canvas);
  }

  /// Lines first, then all pieces on top of them: no line is left where two pieces of a body meet.
  void paint_pieces(cairo_t* canvas, const std::vector<Loop<2>>& loops, const Pose<2>& pose, const Colour& fill,
                    const Colour& outline, double line) const {
    for (const Loop<2>& loop : loops) {
      std::vector<Vec2> corners;
      for (const Vec2& corner : loop) corners.push_back(projection.on_page(pose * corner));
      trace_polygon(canvas, corners);
    }
    if (line > 0.0) {
      set_colour(canvas, outline);
      cairo_set_line_width(canvas, 2.0 * line);
      cairo_set_line_join(canvas, CAIRO_LINE_JOIN_ROUND);
      cairo_stroke_preserve(canvas);
    }
    set_colour(canvas, fill);
    cairo_fill(canvas);
  }

  void paint_bodies(cairo_t* canvas) const {
    std::vector<std::vector<Loop<2>>> shapes;
    double extent = 0.0;
    for (const Shape<2>& shape : input.shapes) {
      shapes.push_back(outlines(shape, framing.drawn.size() > 2000 ? 16 : 40));
      extent = std::max(extent, shape.extent);
    }
    const double size = extent * projection.scale;
    const double line = many_bodies != nullptr && size < 2.0 ? 0.0 : std::clamp(0.03 * size, 0.15, 1.2);
    for (const BodyIndex body : framing.drawn) {
      const int shape = input.states.shape[body];
      const BodyPaint paint = body_paint(params, shape, input.shapes[shape].colour, input.states.asleep[body] != 0);
      paint_pieces(canvas, shapes[shape], input.states.pose[body], paint.fill, paint.outline, line);
    }
  }

  void trace(cairo_t* canvas, const Pile<2>& pile, const Layer& layer) const {
    const std::vector<Vec2> low = layer_rim(pile, layer, layer.bottom);
    const std::vector<Vec2> high = layer_rim(pile, layer, layer.top);
    trace_polygon(canvas, on_page({low[0], low[1], high[1], high[0]}));
  }

  void paint_layers(cairo_t* canvas, double share) const {
    for (const Pile<2>& pile : input.piles) {
      for (const Layer& layer : pile.layers) {
        trace(canvas, pile, layer);
        set_colour(canvas, with_alpha(params.layer, share * layer_opacity(layer)));
        cairo_fill(canvas);
      }
    }
  }

  void paint_layer_lines(cairo_t* canvas) const {
    for (const Pile<2>& pile : input.piles)
      for (const Layer& layer : pile.layers) trace(canvas, pile, layer);
    set_colour(canvas, with_alpha(params.layer, 0.8));
    cairo_set_line_width(canvas, 1.4);
    cairo_stroke(canvas);
  }

  void paint_densities(cairo_t* canvas) const {
    DensityLabels labels(params);
    for (const Pile<2>& pile : input.piles) {
      for (const Layer& layer : pile.layers) {
        const Vec2 right = layer_rim(pile, layer, 0.5 * (layer.bottom + layer.top))[1];
        labels.draw(canvas, projection.on_page(right), layer);
      }
    }
  }
};

}  // namespace

Painter scene_painter(const PictureInput<2>& input, const Framing<2>& framing, const Projection<2>& projection,
                      const PictureParams& params, int width, int height) {
  FlatScene scene{input, framing, projection, params, width, nullptr};
  if (framing.drawn.size() > most_vectors) {
    scene.many_bodies = {cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image_scale * width, image_scale * height),
                         cairo_surface_destroy};
    const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> canvas(cairo_create(scene.many_bodies.get()),
                                                                    cairo_destroy);
    cairo_scale(canvas.get(), image_scale, image_scale);
    scene.paint_bodies(canvas.get());
  }
  return [scene](cairo_t* canvas) { scene.paint(canvas); };
}

}  // namespace talus
