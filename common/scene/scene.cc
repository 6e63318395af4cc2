#include "common/scene/scene.h"

#include <cmath>

namespace talus {

template <int Dim>
int Source<Dim>::due_by(double time) const {
  int due = 0;  // a bisection of its own: clang 14 cannot compile the views of libstdc++ 12
  for (int not_due = count; due < not_due;) {
    const int middle = due + (not_due - due) / 2;
    if (due_time(middle) <= time)
      due = middle + 1;
    else
      not_due = middle;
  }
  return due;
}

template <int Dim>
std::int64_t Scene<Dim>::steps_per_frame() const {
  return std::llround(1.0 / (run.frame_rate * world.dt));
}

template <int Dim>
std::int64_t Scene<Dim>::bodies_planned() const {
  auto planned = static_cast<std::int64_t>(bodies.size());
  for (const Source<Dim>& source : sources) planned += source.count;
  return planned;
}

template <int Dim>
Vec<Dim> Scene<Dim>::gravity_at(double time) const {
  if (!gravity_motion) return world.gravity_vector();
  return gravity_motion->turn_at(time) * (world.gravity_vector() + gravity_motion->shift_at(time));
}

template struct Source<2>;
template struct Source<3>;
template struct Scene<2>;
template struct Scene<3>;

}  // namespace talus
