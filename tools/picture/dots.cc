#include "tools/picture/dots.h"

#include "common/shape/surface.h"
#include "tools/picture/z_buffer.h"

namespace talus {

namespace {

Dot dot_of(const BodyStates<2>& states, std::size_t body) {
  return states.asleep[body] != 0 ? Dot::asleep : Dot::awake;
}
Dot dot_of(const BodyStates<3>& states, std::size_t body) {
  return states.asleep[body] != 0 ? Dot::asleep : Dot::awake;
}

void fill_pieces(Dots& dots, const Shape<2>& shape, const Pose<2>& pose, const Projection<2>& projection, Dot dot) {
  for (const Loop<2>& loop : outlines(shape, 16)) {
    std::vector<Vec3> corners;
    for (const Vec2& corner : loop) {
      const Vec2 seen = projection.on_page(pose * corner);
      corners.emplace_back(seen.x(), seen.y(), 0.0);
    }
    scan_convex(corners, dots.width, dots.height, [&](int x, int y, double) {
      Dot& here = dots.at(x, y);
      here = dot == Dot::obstacle && here != Dot::empty ? here : dot;
    });
  }
}

void fill(Dots& dots, const PictureInput<2>& input, const Framing<2>& framing, const Projection<2>& projection) {
  for (const BodyIndex body : framing.drawn) {
    const Shape<2>& shape = input.shapes[input.states.shape[body]];
    fill_pieces(dots, shape, input.states.pose[body], projection, dot_of(input.states, body));
  }
  for (const Obstacle<2>& obstacle : input.obstacles) {
    fill_pieces(dots, obstacle.shape, obstacle.pose, projection, Dot::obstacle);
  }
}

void fill(Dots& dots, const PictureInput<3>& input, const Framing<3>& framing, const Projection<3>& projection) {
  const std::vector<Face> faces = faces_of(input, framing);
  for (const bool bodies : {true, false}) {
    ZBuffer buffer(dots.width, dots.height);
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (faces[i].owner != ground_owner && (faces[i].owner >= 0) == bodies) {
        buffer.add(faces[i], static_cast<std::int32_t>(i), projection);
      }
    }
    for (int y = 0; y < dots.height; ++y) {
      for (int x = 0; x < dots.width; ++x) {
        const std::int32_t face = buffer.face(x, y);
        if (face != ZBuffer::nothing && dots.at(x, y) == Dot::empty) {
          const std::int32_t owner = faces[face].owner;
          dots.at(x, y) = bodies ? dot_of(input.states, owner) : Dot::obstacle;
        }
      }
    }
  }
}

}  // namespace

template <>
Projection<2> side_view(const Framing<2>&) {
  return {};
}

template <>
Projection<3> side_view(const Framing<3>& framing) {
  return Projection<3>::looking_along(-Vec3::UnitY(), framing.box.center(), 0.0);
}

template <int Dim>
Dots dots_of(const PictureInput<Dim>& input, const Framing<Dim>& framing, const Projection<Dim>& projection, int width,
             int height) {
  Dots dots{width, height, {}};
  dots.dots.resize(static_cast<std::size_t>(width) * height, Dot::empty);
  fill(dots, input, framing, projection);
  for (const BodyIndex body : framing.drawn) {
    const Vec2 seen = projection.on_page(input.states.pose[body].position);
    const int x = std::clamp(static_cast<int>(seen.x()), 0, width - 1);
    const int y = std::clamp(static_cast<int>(seen.y()), 0, height - 1);
    if (dots.at(x, y) == Dot::empty) {
      dots.at(x, y) = dot_of(input.states, body);
    }
  }
  return dots;
}

template Dots dots_of(const PictureInput<2>&, const Framing<2>&, const Projection<2>&, int, int);
template Dots dots_of(const PictureInput<3>&, const Framing<3>&, const Projection<3>&, int, int);

}  // namespace talus
