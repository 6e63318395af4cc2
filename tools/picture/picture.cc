#include "tools/picture/picture.h"

#include "common/text/file.h"
#include "tools/picture/canvas.h"
#include "tools/picture/layers.h"
#include "tools/picture/page.h"
#include "tools/picture/periodic_sides.h"
#include "tools/picture/scene_painter.h"

namespace talus {
namespace {

constexpr int most_layers = 32;  // of a pile

}  // namespace

template <int Dim>
double draw_pile(const std::filesystem::path& svg, const std::filesystem::path& png, const PictureInput<Dim>& input,
                 const PictureParams& params) {
  check(params);
  std::vector<Pile<Dim>> piles;
  for (const Pile<Dim>& pile : input.piles) piles.push_back(with_coarse_layers(pile, most_layers));
  PictureInput<Dim> drawn = with_images(input);
  drawn.piles = piles;
  const Framing<Dim> framing = framing_of(drawn);
  const Page page(page_content(input, framing.box, params), params);
  const Layout<Dim> layout = lay_out(framing, page, params);
  const Painter scene = scene_painter(drawn, framing, layout.projection, params, params.width, layout.height);
  const Painter paint = [&](cairo_t* canvas) {
    page.draw_background(canvas);
    scene(canvas);
    page.draw(canvas, layout.height, layout.projection.pixels_per_metre());
  };
  write_file(svg, svg_bytes(params.width, layout.height, paint));
  write_file(png, png_bytes(params.width, layout.height, paint));
  return layout.projection.pixels_per_metre();
}

template double draw_pile<2>(const std::filesystem::path&, const std::filesystem::path&, const PictureInput<2>&,
                             const PictureParams&);
template double draw_pile<3>(const std::filesystem::path&, const std::filesystem::path&, const PictureInput<3>&,
                             const PictureParams&);

}  // namespace talus
