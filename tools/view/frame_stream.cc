#include "tools/view/frame_stream.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "tools/view/stream_numbers.h"

namespace talus {
namespace {

/// All numbers of a pile but its counts.
template <int Dim>
std::vector<float> form_of(const Pile<Dim>& pile) {
  std::vector<float> form;
  const auto add = [&](double value) { form.push_back(static_cast<float>(value)); };
  for (int axis = 0; axis < Dim; ++axis) add(pile.centre[axis]);
  for (const double value : {pile.alpha, pile.lift, pile.height, pile.radius}) add(value);
  for (const Layer& layer : pile.layers)
    for (const double value : {layer.bottom, layer.top, layer.radius, layer.capacity}) add(value);
  return form;
}

template <int Dim>
std::vector<std::int32_t> counts_of(const Pile<Dim>& pile) {
  std::vector<std::int32_t> counts;
  for (const Layer& layer : pile.layers) {
    counts.push_back(layer.count);
    counts.push_back(layer.sleeping);
  }
  return counts;
}

}  // namespace

template <int Dim>
Quantum quantum_of(const Scene<Dim>& scene) {
  double extent = std::numeric_limits<double>::infinity();
  for (const Shape<Dim>& shape : scene.world.shapes) extent = std::min(extent, shape.extent);
  Quantum quantum;
  if (std::isfinite(extent)) quantum.position = 1e-3 * extent;
  return quantum;
}

template <int Dim>
std::string FrameEncoder<Dim>::encode(const ViewFrame<Dim>& frame) {
  block_.clear();
  write_unsigned(block_, frame.step);
  write_bodies(frame.states);
  write_events(frame);
  write_piles(frame.piles);
  write_float(block_, static_cast<float>(frame.kinetic_energy));
  write_warnings(frame.warnings);
  const std::span<const DoneEvent> happened = frame.scene_events.subspan(known_scene_events_);
  known_scene_events_ = frame.scene_events.size();
  write_unsigned(block_, happened.size());
  for (const DoneEvent& event : happened) {
    write_unsigned(block_, event.number);
    write_float(block_, static_cast<float>(event.time));
  }
  return block_;
}

template <int Dim>
void FrameEncoder<Dim>::write_bodies(const BodyStates<Dim>& states) {
  write_unsigned(block_, states.size());
  std::vector<BodyIndex> removed;
  std::vector<BodyIndex> flipped;
  for (auto body = static_cast<BodyIndex>(known_.size()); body < states.size(); ++body) {
    known_.emplace_back();
    write_unsigned(block_, states.shape[body]);
  }
  for (BodyIndex body = 0; body < states.size(); ++body) {
    Known& known = known_[body];
    if (states.removed[body] != known.removed) removed.push_back(body);
    if (states.asleep[body] != known.asleep) flipped.push_back(body);
    known.removed = states.removed[body];
    known.asleep = states.asleep[body];
  }
  write_list(removed);
  write_list(flipped);
  write_poses(states);
}

template <int Dim>
void FrameEncoder<Dim>::write_poses(const BodyStates<Dim>& states) {
  std::vector<BodyIndex> moved;
  std::vector<Counts> changes;
  for (BodyIndex body = 0; body < states.size(); ++body) {
    Counts& before = known_[body].pose;
    const Counts now = counted(states.pose[body], before);
    if (states.removed[body] != 0 || now == before) continue;
    moved.push_back(body);
    Counts& change = changes.emplace_back();
    for (int i = 0; i < components; ++i) change[i] = now[i] - before[i];
    before = now;
  }
  write_list(moved);
  for (int i = 0; i < components; ++i)
    for (const Counts& change : changes) write_signed(block_, change[i]);
}

/// In whole quanta. A rotation has many numbers: those nearest to the ones before are taken.
template <int Dim>
typename FrameEncoder<Dim>::Counts FrameEncoder<Dim>::counted(const Pose<Dim>& pose, const Counts& before) const {
  Counts counts;
  for (int axis = 0; axis < Dim; ++axis) counts[axis] = in_quanta(pose.position[axis], quantum_.position);
  if constexpr (Dim == 2) {
    const double turn = std::remainder(pose.rotation.angle() - before[2] * quantum_.angle, 2.0 * std::numbers::pi);
    counts[2] = before[2] + in_quanta(turn, quantum_.angle);
  } else {
    const Rotation<3>& q = pose.rotation;
    const double along = q.w() * before[3] + q.x() * before[4] + q.y() * before[5] + q.z() * before[6];
    const double sign = along < 0.0 ? -1.0 : 1.0;
    int i = Dim;
    for (const double part : {q.w(), q.x(), q.y(), q.z()}) counts[i++] = in_quanta(sign * part, quantum_.quaternion);
  }
  return counts;
}

template <int Dim>
void FrameEncoder<Dim>::write_events(const ViewFrame<Dim>& frame) {
  write_unsigned(block_, frame.events.size());
  for (const SleepEvent& event : frame.events) {
    write_unsigned(block_, event.body);
    write_unsigned(block_, std::max<std::int64_t>(0, frame.step - event.step));
    write_unsigned(block_, 2 * static_cast<unsigned>(event.cause) + (event.woke ? 1 : 0));
    write_unsigned(block_, event.pile + 1);
    write_unsigned(block_, event.layer + 1);
    write_float(block_, static_cast<float>(event.score));
  }
}

template <int Dim>
void FrameEncoder<Dim>::write_piles(std::span<const Pile<Dim>> piles) {
  known_piles_.resize(piles.size());
  std::vector<int> changed;
  for (std::size_t i = 0; i < piles.size(); ++i)
    if (form_of(piles[i]) != known_piles_[i].form || counts_of(piles[i]) != known_piles_[i].counts)
      changed.push_back(static_cast<int>(i));
  write_unsigned(block_, piles.size());
  write_unsigned(block_, changed.size());
  for (const int number : changed) write_pile(number, piles[number], known_piles_[number]);
}

template <int Dim>
void FrameEncoder<Dim>::write_pile(int number, const Pile<Dim>& pile, KnownPile& known) {
  const std::vector<float> form = form_of(pile);
  const bool reshaped = form != known.form;
  write_unsigned(block_, number);
  write_unsigned(block_, reshaped ? 1 : 0);
  if (reshaped) {
    constexpr std::ptrdiff_t before_layers = Dim + 4;
    for (const float value : std::span(form).first(before_layers)) write_float(block_, value);
    write_unsigned(block_, pile.layers.size());
    for (const float value : std::span(form).subspan(before_layers)) write_float(block_, value);
    known.form = form;
  }
  const std::vector<std::int32_t> counts = counts_of(pile);
  known.counts.resize(counts.size());
  for (std::size_t i = 0; i < counts.size(); ++i) write_signed(block_, counts[i] - known.counts[i]);
  known.counts = counts;
}

template <int Dim>
void FrameEncoder<Dim>::write_warnings(std::span<const Warning> warnings) {
  std::vector<const Warning*> changed;
  for (const Warning& warning : warnings)
    if (std::exchange(known_warnings_[warning.kind], account(warning)) != account(warning)) changed.push_back(&warning);
  write_unsigned(block_, changed.size());
  for (const Warning* warning : changed) {
    const std::string text = account(*warning);
    write_unsigned(block_, static_cast<unsigned>(warning->kind));
    write_unsigned(block_, warning->step);
    write_unsigned(block_, text.size());
    block_ += text;
  }
}

template <int Dim>
void FrameEncoder<Dim>::write_list(std::span<const BodyIndex> bodies) {
  write_unsigned(block_, bodies.size());
  BodyIndex before = -1;
  for (const BodyIndex body : bodies) write_unsigned(block_, body - std::exchange(before, body));
}

template Quantum quantum_of(const Scene<2>&);
template Quantum quantum_of(const Scene<3>&);
template class FrameEncoder<2>;
template class FrameEncoder<3>;

}  // namespace talus
