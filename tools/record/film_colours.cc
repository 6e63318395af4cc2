#include "tools/record/film_colours.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "common/text/printable.h"

namespace talus {
namespace {

using LastEvents = std::vector<const SleepEvent*>;  // [body], nullptr where there was none

const std::string never_slept = "never slept";

template <int Dim>
BodyColours by_shape(const RecordedRun<Dim>& run, int frame, const LastEvents& /*last*/) {
  std::vector<std::string> names;
  std::vector<std::string> own;
  for (const Shape<Dim>& shape : run.scene.world.shapes) {
    names.push_back(printable(shape.name));
    own.push_back(shape.colour);
  }
  std::vector<int> kind;
  for (BodyIndex body = 0; body < run.frames.bodies(frame); ++body) kind.push_back(run.frames.shape(body));
  return colours_of_kinds(kind, names, "no shape", own);
}

template <int Dim>
BodyColours by_size(const RecordedRun<Dim>& run, int frame, const LastEvents& /*last*/) {
  const std::vector<Shape<Dim>>& shapes = run.scene.world.shapes;
  const auto [least, greatest] = std::minmax_element(shapes.begin(), shapes.end(),
                                                     [](const auto& a, const auto& b) { return a.extent < b.extent; });
  std::vector<double> extents;
  for (BodyIndex body = 0; body < run.frames.bodies(frame); ++body)
    extents.push_back(shapes[run.frames.shape(body)].extent);
  const double range = std::max(greatest->extent - least->extent, 1e-9);
  return colours_of_values(extents, least->extent, least->extent + range,
                           fmt::format("extent, {:.3g} to {:.3g} m", least->extent, greatest->extent), "no extent");
}

/// From the frame before: a record has no velocities. The scale ends at the speed after a fall of two extents.
template <int Dim>
BodyColours by_speed(const RecordedRun<Dim>& run, int frame, const LastEvents& /*last*/) {
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
  return colours_of_values(speeds, 0.0, std::max(fast, 1e-9), fmt::format("speed, 0 to {:.3g} m/s or more", fast),
                           "no speed");
}

template <int Dim>
BodyColours by_layer(const RecordedRun<Dim>& /*run*/, int /*frame*/, const LastEvents& last) {
  std::vector<int> layers;
  int top = 0;
  for (const SleepEvent* event : last) {
    layers.push_back(event == nullptr ? -1 : event->layer);
    top = std::max(top, layers.back());
  }
  std::vector<std::string> names;
  for (int layer = 0; layer <= top; ++layer) names.push_back(fmt::format("layer {}", layer));
  return colours_of_kinds(layers, names, never_slept);
}

template <int Dim>
BodyColours by_cause(const RecordedRun<Dim>& /*run*/, int /*frame*/, const LastEvents& last) {
  std::vector<std::string> names;
  for (int cause = 0; cause <= static_cast<int>(SleepCause::check); ++cause)
    names.emplace_back(to_string(static_cast<SleepCause>(cause)));
  std::vector<int> causes;
  for (const SleepEvent* event : last) causes.push_back(event == nullptr ? -1 : static_cast<int>(event->cause));
  return colours_of_kinds(causes, names, never_slept);
}

template <int Dim>
BodyColours by_age(const RecordedRun<Dim>& run, int frame, const LastEvents& last) {
  const double end = run.frames.frame_time() * run.frames.frames();
  std::vector<double> ages;
  for (const SleepEvent* event : last) {
    const std::int64_t steps = event == nullptr ? 0 : run.frames.step(frame) - event->step;
    ages.push_back(event == nullptr ? std::nan("") : static_cast<double>(steps) * run.frames.step_time());
  }
  return colours_of_values(ages, 0.0, end, fmt::format("since it slept or woke, 0 to {:.3g} s", end), never_slept);
}

template <int Dim>
struct ColourWay {
  std::string_view word;
  BodyColours (*colours)(const RecordedRun<Dim>& run, int frame, const LastEvents& last);  // nullptr: none
  bool of_events = false;
};

template <int Dim>
constexpr std::array<ColourWay<Dim>, 7> colour_ways = {{{"state", nullptr},
                                                        {"shape", by_shape<Dim>},
                                                        {"size", by_size<Dim>},
                                                        {"speed", by_speed<Dim>},
                                                        {"layer", by_layer<Dim>, true},
                                                        {"cause", by_cause<Dim>, true},
                                                        {"age", by_age<Dim>, true}}};

template <int Dim>
const ColourWay<Dim>& way_of(std::string_view word) {
  const auto way = std::ranges::find(colour_ways<Dim>, word, &ColourWay<Dim>::word);
  if (way == colour_ways<Dim>.end())
    throw std::invalid_argument(fmt::format("colour = {}: must be one of {}", word, fmt::join(colour_words(), ", ")));
  return *way;
}

}  // namespace

std::vector<std::string> colour_words() {
  std::vector<std::string> words;
  for (const auto& way : colour_ways<2>) words.emplace_back(way.word);
  return words;
}

template <int Dim>
FilmColours<Dim>::FilmColours(const RecordedRun<Dim>& run, std::string_view word)
    : run_(run), word_(way_of<Dim>(word).word) {
  if (!way_of<Dim>(word).of_events) return;
  for (const SleepEvent& event : run.events) {
    if (event.body >= std::ssize(events_)) events_.resize(event.body + 1);
    events_[event.body].push_back(&event);
  }
}

template <int Dim>
BodyColours FilmColours<Dim>::at(int frame) const {
  const ColourWay<Dim>& way = way_of<Dim>(word_);
  if (way.colours == nullptr) return {};
  LastEvents last(run_.frames.bodies(frame), nullptr);
  const auto step = [](const SleepEvent* event) { return event->step; };
  for (std::size_t body = 0; body < std::min(last.size(), events_.size()); ++body) {
    const auto later = std::ranges::upper_bound(events_[body], run_.frames.step(frame), {}, step);
    if (later != events_[body].begin()) last[body] = *std::prev(later);
  }
  return way.colours(run_, frame, last);
}

template class FilmColours<2>;
template class FilmColours<3>;

}  // namespace talus
