#include "tools/record/film_colours.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/text/printable.h"

namespace talus {
namespace {

/// Per body, the last event up to a frame; nullptr where there was none.
template <int Dim>
std::vector<const SleepEvent*> last_events(const RecordedRun<Dim>& run, int frame) {
  std::vector<const SleepEvent*> last(run.frames.bodies(frame), nullptr);
  for (const SleepEvent& event : run.events)
    if (event.step <= run.frames.step(frame) && event.body < std::ssize(last)) last[event.body] = &event;
  return last;
}

template <int Dim>
BodyColours by_shape(const RecordedRun<Dim>& run, int frame) {
  std::vector<std::string> names;
  for (const Shape<Dim>& shape : run.scene.world.shapes) names.push_back(printable(shape.name));
  std::vector<int> kind;
  for (BodyIndex body = 0; body < run.frames.bodies(frame); ++body) kind.push_back(run.frames.shape(body));
  return colours_of_kinds(kind, names);
}

template <int Dim>
BodyColours by_size(const RecordedRun<Dim>& run, int frame) {
  const std::vector<Shape<Dim>>& shapes = run.scene.world.shapes;
  const auto [least, greatest] = std::minmax_element(shapes.begin(), shapes.end(),
                                                     [](const auto& a, const auto& b) { return a.extent < b.extent; });
  std::vector<double> extents;
  for (BodyIndex body = 0; body < run.frames.bodies(frame); ++body)
    extents.push_back(shapes[run.frames.shape(body)].extent);
  const double range = std::max(greatest->extent - least->extent, 1e-9);
  return colours_of_values(extents, least->extent, least->extent + range,
                           fmt::format("extent, {:.3g} to {:.3g} m", least->extent, greatest->extent));
}

/// From the frame before: a record has no velocities. The scale ends at the speed after a fall of two extents.
template <int Dim>
BodyColours by_speed(const RecordedRun<Dim>& run, int frame) {
  double extent = 0.0;
  for (const Shape<Dim>& shape : run.scene.world.shapes) extent = std::max(extent, shape.extent);
  const double fast = 2.0 * std::sqrt(std::abs(run.scene.world.gravity) * extent);
  std::vector<double> speeds;
  for (BodyIndex body = 0; body < run.frames.bodies(frame); ++body) {
    const bool moved = frame > 0 && run.frames.present(frame, body) && run.frames.present(frame - 1, body);
    const Vec<Dim> way = moved ? Vec<Dim>(run.frames.position(frame, body) - run.frames.position(frame - 1, body))
                               : Vec<Dim>(Vec<Dim>::Zero());
    speeds.push_back(way.norm() / run.frames.frame_time());
  }
  return colours_of_values(speeds, 0.0, std::max(fast, 1e-9), fmt::format("speed, 0 to {:.3g} m/s or more", fast));
}

template <int Dim>
BodyColours by_layer(const RecordedRun<Dim>& run, int frame) {
  std::vector<int> layers;
  int top = 0;
  for (const SleepEvent* event : last_events(run, frame)) {
    layers.push_back(event == nullptr ? -1 : event->layer);
    top = std::max(top, layers.back());
  }
  std::vector<std::string> names;
  for (int layer = 0; layer <= top; ++layer) names.push_back(fmt::format("layer {}", layer));
  return colours_of_kinds(layers, names);
}

template <int Dim>
BodyColours by_cause(const RecordedRun<Dim>& run, int frame) {
  std::vector<std::string> names;
  for (int cause = 0; cause <= static_cast<int>(SleepCause::check); ++cause)
    names.emplace_back(to_string(static_cast<SleepCause>(cause)));
  std::vector<int> causes;
  for (const SleepEvent* event : last_events(run, frame))
    causes.push_back(event == nullptr ? -1 : static_cast<int>(event->cause));
  return colours_of_kinds(causes, names);
}

template <int Dim>
BodyColours by_age(const RecordedRun<Dim>& run, int frame) {
  const double end = run.frames.frame_time() * run.frames.frames();
  std::vector<double> ages;
  for (const SleepEvent* event : last_events(run, frame)) {
    const std::int64_t steps = event == nullptr ? 0 : run.frames.step(frame) - event->step;
    ages.push_back(event == nullptr ? std::nan("") : static_cast<double>(steps) * run.frames.step_time());
  }
  return colours_of_values(ages, 0.0, end, fmt::format("since it slept or woke, 0 to {:.3g} s", end));
}

}  // namespace

template <int Dim>
BodyColours colours_at(const RecordedRun<Dim>& run, int frame, std::string_view word) {
  if (word == "shape") return by_shape(run, frame);
  if (word == "size") return by_size(run, frame);
  if (word == "speed") return by_speed(run, frame);
  if (word == "layer") return by_layer(run, frame);
  if (word == "cause") return by_cause(run, frame);
  if (word == "age") return by_age(run, frame);
  return {};
}

template BodyColours colours_at(const RecordedRun<2>&, int, std::string_view);
template BodyColours colours_at(const RecordedRun<3>&, int, std::string_view);

}  // namespace talus
