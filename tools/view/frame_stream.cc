#include "tools/view/frame_stream.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "common/measure/shape_statistics.h"
#include "common/pile/angle_of_repose.h"
#include "tools/view/hidden_bodies.h"
#include "tools/view/stream_numbers.h"

namespace talus {
namespace {

// In frames.
constexpr std::int64_t frames_between_updates = 8;  // of what is hidden
constexpr std::int64_t frames_between_slopes = 16;  // a fit costs some milliseconds

/// All numbers of a pile but its counts.
template <int Dim>
std::vector<float> form_of(const Pile<Dim>& pile) {
  std::vector<float> form;
  const auto add = [&](double value) { form.push_back(static_cast<float>(value)); };
  for (int axis = 0; axis < Dim; ++axis) add(pile.centre[axis]);
  for (const double value : {pile.alpha, pile.lift, pile.height, pile.radius}) add(value);
  for (const Layer& layer : pile.layers)
    for (const double value :
         {layer.bottom, layer.top, layer.radius, layer.capacity, layer.thresholds.sleep, layer.thresholds.wake})
      add(value);
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
std::shared_ptr<const FrameForm<Dim>> frame_form(const Scene<Dim>& scene) {
  const auto ground = scene.world.ground.present ? std::optional(scene.world.ground.height) : std::nullopt;
  return std::make_shared<FrameForm<Dim>>(FrameForm<Dim>{quantum_of(scene), scene.world.shapes, ground});
}

template <int Dim>
std::string FrameEncoder<Dim>::encode(const ViewFrame<Dim>& frame) {
  block_.clear();
  if (frames_ % frames_between_slopes == 0) slope_ = slope_of(frame);
  write_unsigned(block_, frame.step);
  write_bodies(frame.states);
  write_events(frame);
  write_piles(frame.piles);
  write_float(block_, static_cast<float>(frame.kinetic_energy));
  write_float(block_, static_cast<float>(frame.drift_estimate));
  write_float(block_, static_cast<float>(slope_));
  write_float(block_, static_cast<float>(frame.ms_per_step));
  write_warnings(frame.warnings);
  const std::span<const DoneEvent> happened = frame.scene_events.subspan(known_scene_events_);
  known_scene_events_ = frame.scene_events.size();
  write_unsigned(block_, happened.size());
  for (const DoneEvent& event : happened) {
    write_unsigned(block_, event.number);
    write_float(block_, static_cast<float>(event.time));
  }
  write_obstacles(frame.obstacles);
  ++frames_;
  return block_;
}

template <int Dim>
void FrameEncoder<Dim>::write_bodies(const BodyStates<Dim>& states) {
  write_unsigned(block_, states.size() - known_.size());
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
  write_hidden(states);
  write_poses(states);
}

/// What moves away from a sleeping body needs longer than until the next update to show it.
template <int Dim>
void FrameEncoder<Dim>::write_hidden(const BodyStates<Dim>& states) {
  std::vector<BodyIndex> changed;
  const bool due = frames_ % frames_between_updates == 0 || states.size() > 2 * bodies_at_update_;
  if (due) bodies_at_update_ = states.size();
  const std::vector<std::uint8_t> hidden =
      due ? hidden_bodies<Dim>(form_->shapes, states, form_->ground) : std::vector<std::uint8_t>();
  for (BodyIndex body = 0; body < states.size(); ++body) {
    const bool stays = due ? hidden[body] != 0 : known_[body].hidden != 0;
    const bool now = stays && states.asleep[body] != 0 && states.removed[body] == 0;
    if (now == (known_[body].hidden != 0)) continue;
    known_[body].hidden = now ? 1 : 0;
    changed.push_back(body);
  }
  write_list(changed);
}

/// Whether the body has hardly moved since the frame before.
template <int Dim>
bool FrameEncoder<Dim>::rests(BodyIndex body, const Pose<Dim>& pose) const {
  if (body >= std::ssize(known_)) return false;
  const Known& known = known_[body];
  if (known.hidden != 0) return true;
  const Counts now = counted(pose, known.pose);
  double distance = 0.0;  // in quanta, which are thousandths of the smallest extent
  for (int axis = 0; axis < Dim; ++axis)
    distance = std::max(distance, std::abs(static_cast<double>(now[axis]) - known.pose[axis]));
  return distance < 50.0;
}

/// Of the bodies of the largest pile that rest.
template <int Dim>
double FrameEncoder<Dim>::slope_of(const ViewFrame<Dim>& frame) const {
  const auto largest = std::ranges::max_element(frame.piles, {}, &Pile<Dim>::structure_size);
  if (largest == frame.piles.end() || form_->shapes.empty()) return -1.0;
  BodyStates<Dim> lying = frame.states;
  lying.velocity.resize(lying.pose.size(), Vec<Dim>::Zero());
  for (BodyIndex body = 0; body < lying.size(); ++body)
    if (!rests(body, lying.pose[body]) ||
        nearest_pile<Dim>(frame.piles, lying.pose[body].position) != largest - frame.piles.begin())
      lying.removed[body] = 1;
  const auto bodies = placed_bodies<Dim>(form_->shapes, lying);
  if (bodies.size() < min_bodies_for_slope) return -1.0;
  const double extent = form_->shapes.front().extent;
  const AngleOfRepose slope =
      shape_statistics<Dim>(bodies, grid_around<Dim>(bodies, form_->ground.value_or(0.0), extent)).repose;
  return slope.bins >= 3 ? slope.angle : -1.0;
}

template <int Dim>
void FrameEncoder<Dim>::write_poses(const BodyStates<Dim>& states) {
  std::vector<BodyIndex> moved;
  std::vector<Counts> changes;
  for (BodyIndex body = 0; body < states.size(); ++body) {
    Counts& before = known_[body].pose;
    const Counts now = counted(states.pose[body], before);
    if (states.removed[body] != 0 || known_[body].hidden != 0 || now == before) continue;
    moved.push_back(body);
    Counts& change = changes.emplace_back();
    for (int i = 0; i < components; ++i) change[i] = now[i] - before[i];
    before = now;
  }
  write_changes(moved, changes);
}

template <int Dim>
void FrameEncoder<Dim>::write_obstacles(std::span<const ObstaclePose<Dim>> obstacles) {
  std::vector<int> moved;
  std::vector<Counts> changes;
  for (const ObstaclePose<Dim>& each : obstacles) {
    const auto [known, first] = known_obstacles_.try_emplace(each.obstacle, Counts{});
    const Counts now = counted(each.pose, known->second);
    if (now == known->second && !first) continue;
    moved.push_back(each.obstacle);
    Counts& change = changes.emplace_back();
    for (int i = 0; i < components; ++i) change[i] = now[i] - known->second[i];
    known->second = now;
  }
  write_changes(moved, changes);
}

template <int Dim>
void FrameEncoder<Dim>::write_changes(std::span<const int> numbers, std::span<const Counts> changes) {
  write_list(numbers);
  for (int i = 0; i < components; ++i)
    for (const Counts& change : changes) write_signed(block_, change[i]);
}

/// In whole quanta. A rotation has many numbers: those nearest to the ones before are taken.
template <int Dim>
typename FrameEncoder<Dim>::Counts FrameEncoder<Dim>::counted(const Pose<Dim>& pose, const Counts& before) const {
  Counts counts;
  for (int axis = 0; axis < Dim; ++axis) counts[axis] = in_quanta(pose.position[axis], form_->quantum.position);
  if constexpr (Dim == 2) {
    const double turn =
        std::remainder(pose.rotation.angle() - before[2] * form_->quantum.angle, 2.0 * std::numbers::pi);
    counts[2] = before[2] + in_quanta(turn, form_->quantum.angle);
  } else {
    const Rotation<3>& q = pose.rotation;
    const double along = q.w() * before[3] + q.x() * before[4] + q.y() * before[5] + q.z() * before[6];
    const double sign = along < 0.0 ? -1.0 : 1.0;
    int i = Dim;
    for (const double part : {q.w(), q.x(), q.y(), q.z()})
      counts[i++] = in_quanta(sign * part, form_->quantum.quaternion);
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
  write_unsigned(block_, reshaped ? form.size() : 0);
  const std::vector<std::int32_t> counts = counts_of(pile);
  if (reshaped) {
    for (const float value : form) write_float(block_, value);
    known.form = form;
    known.counts.assign(counts.size(), 0);
  }
  write_unsigned(block_, counts.size());
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
void FrameEncoder<Dim>::write_list(std::span<const int> numbers) {
  write_unsigned(block_, numbers.size());
  int before = -1;
  for (const int number : numbers) write_unsigned(block_, number - std::exchange(before, number));
}

template Quantum quantum_of(const Scene<2>&);
template Quantum quantum_of(const Scene<3>&);
template std::shared_ptr<const FrameForm<2>> frame_form(const Scene<2>&);
template std::shared_ptr<const FrameForm<3>> frame_form(const Scene<3>&);
template class FrameEncoder<2>;
template class FrameEncoder<3>;

}  // namespace talus
