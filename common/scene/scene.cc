#include "common/scene/scene.h"

#include <cmath>
#include <ranges>

namespace talus {

template <int Dim>
int Source<Dim>::due_by(double time) const {
  const auto numbers = std::views::iota(0, count);
  const auto next = std::ranges::partition_point(numbers, [&](int number) { return due_time(number) <= time; });
  return static_cast<int>(next - numbers.begin());
}

template <int Dim>
std::int64_t Scene<Dim>::steps_per_frame() const {
  return std::llround(1.0 / (run.frame_rate * world.dt));
}

template struct Source<2>;
template struct Source<3>;
template struct Scene<2>;
template struct Scene<3>;

}  // namespace talus
