#include "tools/picture/film.h"

#include "tools/picture/page.h"
#include "tools/picture/periodic_sides.h"
#include "tools/picture/scene_painter.h"

namespace talus {
namespace {

/// All bodies present, since none is left out for being far from the others.
template <int Dim>
std::vector<BodyIndex> present_in(const BodyStates<Dim>& states) {
  std::vector<BodyIndex> present;
  for (BodyIndex body = 0; body < states.size(); ++body)
    if (states.removed[body] == 0) present.push_back(body);
  return present;
}

}  // namespace

template <int Dim>
struct FilmFrames<Dim>::Setting {
  PictureParams params;
  Framing<Dim> framing;
  Layout<Dim> layout;
};

template <int Dim>
FilmFrames<Dim>::FilmFrames(const PictureInput<Dim>& framed, const PictureParams& params) {
  check(params);
  const Framing<Dim> framing = framing_of(with_images(framed));
  setting_ = std::make_unique<Setting>(
      Setting{params, framing, lay_out(framing, Page(page_content(framed, framing.box, params), params), params)});
}

template <int Dim>
FilmFrames<Dim>::~FilmFrames() = default;

template <int Dim>
FilmImage FilmFrames<Dim>::draw(const PictureInput<Dim>& input) const {
  const PictureParams& params = setting_->params;
  const int height = setting_->layout.height;
  Framing<Dim> framing = setting_->framing;
  const PictureInput<Dim> drawn = with_images(input);
  framing.drawn = present_in(drawn.states);
  const Page page(page_content(input, framing.box, params), params);
  const Painter scene = scene_painter(drawn, framing, setting_->layout.projection, params, params.width, height);
  const Painter paint = [&](cairo_t* canvas) {
    page.draw_background(canvas);
    cairo_save(canvas);
    cairo_rectangle(canvas, 0.0, page.header(), params.width, height - page.header() - page.footer());
    cairo_clip(canvas);
    scene(canvas);
    cairo_restore(canvas);
    page.draw(canvas, height, setting_->layout.projection.pixels_per_metre());
  };
  FilmImage image{params.width, height, pixels_of(params.width, height, paint)};
  for (std::uint32_t& pixel : image.pixels) pixel |= 0xFF000000U;
  return image;
}

template class FilmFrames<2>;
template class FilmFrames<3>;

}  // namespace talus
