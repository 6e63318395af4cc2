#include "common/scene/container.h"

#include "common/shape/catalogue.h"

namespace talus {

template <int Dim>
std::vector<Obstacle<Dim>> container_walls(const ContainerParams<Dim>& params, const Pose<Dim>& pose,
                                           const Material& material) {
  std::vector<Obstacle<Dim>> walls;
  const auto add = [&](const Vec<Dim>& size, const Vec<Dim>& middle) {
    walls.push_back({make_shape<Dim>("wall", box_pieces<Dim>(size), material), {pose * middle, pose.rotation}});
  };
  constexpr int up = Dim - 1;
  const Vec<Dim>& inner = params.inner_size;
  for (int axis = 0; axis < up; ++axis) {
    Vec<Dim> size = inner;
    size[axis] = params.wall;
    if (axis > 0) {
      size[0] += 2.0 * params.wall;  // the later walls reach over the corners
    }
    Vec<Dim> middle = Vec<Dim>::Unit(axis) * (inner[axis] + params.wall) / 2.0;
    middle[up] = inner[up] / 2.0;
    add(size, middle);
    middle[axis] = -middle[axis];
    add(size, middle);
  }
  if (params.floor) {
    Vec<Dim> size = inner + Vec<Dim>::Constant(2.0 * params.wall);
    size[up] = params.wall;
    add(size, Vec<Dim>::Unit(up) * (-params.wall / 2.0));
  }
  return walls;
}

template std::vector<Obstacle<2>> container_walls(const ContainerParams<2>&, const Pose<2>&, const Material&);
template std::vector<Obstacle<3>> container_walls(const ContainerParams<3>&, const Pose<3>&, const Material&);

}  // namespace talus
