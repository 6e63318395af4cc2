#include "tools/picture/layout.h"

#include <cmath>

namespace talus {

namespace {

constexpr double least_height = 0.42;  // of the page, in its width
constexpr double eye_distance = 2.6;   // in diagonals of what is seen: a mild perspective
constexpr double label_room = 2.0;     // beside the scene, in font sizes

void aim(Projection<2>&, const Framing<2>&, const PictureParams&) {}

void aim(Projection<3>& projection, const Framing<3>& framing, const PictureParams& params) {
  const Vec3 towards_eye(std::cos(params.azimuth) * std::cos(params.elevation),
                         std::sin(params.azimuth) * std::cos(params.elevation), std::sin(params.elevation));
  projection =
      Projection<3>::looking_along(towards_eye, framing.box.center(), eye_distance * framing.box.diagonal().norm());
}

}  // namespace

template <int Dim>
Layout<Dim> lay_out(const Framing<Dim>& framing, const Page& page, const PictureParams& params) {
  Layout<Dim> layout;
  aim(layout.projection, framing, params);
  const double side = params.margin + label_room * params.font_size;
  const double bottom = std::max(page.header() + 1.0, params.height - page.footer());
  Box<2> area(Vec2(side, page.header()), Vec2(params.width - side, bottom));
  const Vec2 size = fit<Dim>(layout.projection, framing.points, area);
  const double room = std::max(size.y(), least_height * params.width - page.header() - page.footer());
  area.max().y() = std::min(bottom, page.header() + room);
  fit<Dim>(layout.projection, framing.points, area);
  layout.height = static_cast<int>(std::ceil(area.max().y() + page.footer()));
  return layout;
}

template Layout<2> lay_out(const Framing<2>&, const Page&, const PictureParams&);
template Layout<3> lay_out(const Framing<3>&, const Page&, const PictureParams&);

}  // namespace talus
