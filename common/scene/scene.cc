#include "common/scene/scene.h"

#include <cmath>

namespace talus {

template <int Dim>
std::int64_t Scene<Dim>::steps_per_frame() const {
  return std::llround(1.0 / (run.frame_rate * world.dt));
}

template struct Scene<2>;
template struct Scene<3>;

}  // namespace talus
