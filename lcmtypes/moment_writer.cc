#include "lcmtypes/moment_writer.h"

#include <algorithm>
#include <utility>

#include "common/measure/resting_shape.h"
#include "common/moment/moment.h"
#include "common/world/motion.h"
#include "lcmtypes/bodies_message.h"
#include "lcmtypes/contacts_message.h"
#include "lcmtypes/event_message.h"
#include "lcmtypes/instruments_message.h"
#include "lcmtypes/obstacles_message.h"
#include "lcmtypes/piles_message.h"
#include "lcmtypes/run_message.h"
#include "lcmtypes/sleep_message.h"

namespace talus {

template <int Dim>
void MomentWriter<Dim>::set_scene(const Scene<Dim>& scene) {
  scene_ = scene;
  events_ = to_events(scene);
}

template <int Dim>
void MomentWriter<Dim>::run(std::int8_t phase, std::string_view reason, std::int64_t step, double time) {
  std::vector<Channel> channels(usual_channels.begin(), usual_channels.end());
  if (!events_.empty()) channels.push_back(Channel::events);
  if (!moving_.empty()) channels.push_back(Channel::obstacles);
  if (scene_ && !scene_->instruments.empty()) channels.push_back(Channel::instruments);
  if (scene_ && scene_->run.contacts) channels.push_back(Channel::contacts);
  if (!files_.empty()) channels.push_back(Channel::scene);
  send(to_run(info_, phase, reason, channels, encoder_), step, time);
}

template <int Dim>
void MomentWriter<Dim>::files() {
  send_all(files_, 0, 0.0);
}

template <int Dim>
void MomentWriter<Dim>::shapes(const Frame<Dim>& frame) {
  for (talus_lcm::talus_shapes& message : shapes_) {
    if (message.obstacle != 0) set_pose<Dim>(frame.world.obstacle_pose(message.index), message);
    send(message, frame.step, frame.time);
  }
}

template <int Dim>
void MomentWriter<Dim>::shapes() {
  send_all(shapes_, 0, 0.0);
}

template <int Dim>
void MomentWriter<Dim>::set_shapes(std::span<const Shape<Dim>> shapes, std::span<const Obstacle<Dim>> obstacles) {
  shapes_ = to_shapes<Dim>(shapes, obstacles);
  moving_.clear();
  moving_sent_ = false;
  for (int k = 0; k < std::ssize(obstacles); ++k)
    if (obstacles[k].moves) moving_.push_back({k, obstacles[k].pose});
}

template <int Dim>
void MomentWriter<Dim>::new_shapes(const Frame<Dim>& frame) {
  if (frame.world.form() == form_) return;
  form_ = frame.world.form();
  const std::vector<talus_lcm::talus_shapes> known = std::exchange(shapes_, {});
  set_shapes(frame.world.shapes(), frame.world.obstacles());
  const auto is_known = [&](const talus_lcm::talus_shapes& message) {
    return std::ranges::any_of(known, [&](const talus_lcm::talus_shapes& before) {
      return before.obstacle == message.obstacle && before.index == message.index && before.values == message.values;
    });
  };
  for (const talus_lcm::talus_shapes& message : shapes_)
    if (!is_known(message)) send(talus_lcm::talus_shapes(message), frame.step, frame.time);
}

template <int Dim>
void MomentWriter<Dim>::events(const Frame<Dim>& frame) {
  removed_ = removed_ || frame.world.removals() != removals_;
  removals_ = frame.world.removals();
  for (const DoneEvent& event : frame.done_events.last(frame.done_now))
    if (event.number < std::ssize(events_)) this->event(events_[event.number], frame);
  send_all(to_sleep(frame.events), frame.step, frame.time);
  if (!has_shapes()) return;
  for (const SleepEvent& event : frame.events)
    if (!event.woke) fell_asleep_.push_back(event.body);
}

template <int Dim>
void MomentWriter<Dim>::event(talus_lcm::talus_event& message, const Frame<Dim>& frame) {
  set_happened(frame, info_.dt, message);
  send(message, frame.step, frame.time);
}

template <int Dim>
void MomentWriter<Dim>::events_again(const Frame<Dim>& frame, std::size_t most) {
  for (std::size_t left = std::min(most, events_.size()); left > 0; --left) {
    if (event_turn_ >= events_.size()) event_turn_ = 0;
    send(events_[event_turn_++], frame.step, frame.time);
  }
}

template <int Dim>
void MomentWriter<Dim>::stats(talus_lcm::talus_stats message, const Frame<Dim>& frame) {
  constexpr double between_slopes = 1.0;  // [s] simulated
  if (scene_ && (slope_time_ < 0.0 || frame.time >= slope_time_ + between_slopes)) measure_slope(frame);
  if (slope_.value) message.slope = slope_.value->angle;
  message.slope_reason = slope_.why_not;
  send(message, frame.step, frame.time);
}

template <int Dim>
void MomentWriter<Dim>::measure_slope(const Frame<Dim>& frame) {
  if (!scene_) return;
  WorldDescription<Dim> world = world_at<Dim>(*scene_, frame.done_events, frame.time);
  world.obstacles.clear();  // also by hand they are taken away
  for (int k = 0; k < std::ssize(scene_->world.obstacles); ++k)
    if (frame.world.has_obstacle(k))
      world.obstacles.push_back({scene_->world.obstacles[k].shape, frame.world.obstacle_pose(k)});
  slope_ = resting_form(*scene_, frame.world.states(), world, frame.piles.typical_body().extent).slope;
  slope_time_ = frame.time;
}

template <int Dim>
void MomentWriter<Dim>::piles(const Frame<Dim>& frame) {
  send_all(to_piles(piles_in_space(frame)), frame.step, frame.time);
}

template <int Dim>
void MomentWriter<Dim>::instruments(const Frame<Dim>& frame) {
  if (meters_ == nullptr || meters_->instruments().empty()) return;
  send_all(to_instruments(*meters_, scene_->obstacle_names), frame.step, frame.time);
}

template <int Dim>
std::size_t MomentWriter<Dim>::contacts(const Frame<Dim>& frame) {
  if (contacts_ == nullptr || !contacts_->needs_contacts()) return 0;
  auto messages = to_contacts<Dim>(contacts_->of(frame.world));
  const std::size_t sent = messages.size();
  send_all(std::move(messages), frame.step, frame.time);
  return sent;
}

template <int Dim>
void MomentWriter<Dim>::obstacles(const Frame<Dim>& frame, bool all) {
  std::vector<ObstaclePose<Dim>> poses;
  for (ObstaclePose<Dim>& sent : moving_) {
    const Pose<Dim>& now = frame.world.obstacle_pose(sent.obstacle);
    if (moving_sent_ && !all && now == sent.pose) continue;
    sent.pose = now;
    poses.push_back(sent);
  }
  moving_sent_ = true;
  send_all(to_obstacles<Dim>(poses), frame.step, frame.time);
}

template <int Dim>
typename MomentWriter<Dim>::Sent MomentWriter<Dim>::bodies(const Frame<Dim>& frame, std::span<const BodyIndex> more) {
  const BodyStates<Dim>& states = frame.world.states();
  std::vector<BodyIndex> bodies(frame.world.awake().begin(), frame.world.awake().end());
  bodies.insert(bodies.end(), fell_asleep_.begin(), fell_asleep_.end());
  bodies.insert(bodies.end(), more.begin(), more.end());
  fell_asleep_.clear();
  std::erase_if(bodies, [&](BodyIndex body) { return states.removed[body] != 0; });
  std::sort(bodies.begin(), bodies.end());
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  auto messages = to_bodies<Dim>(states, bodies, false);
  const Sent sent{.bodies = bodies.size(), .messages = messages.size()};
  send_all(std::move(messages), frame.step, frame.time);
  return sent;
}

template <int Dim>
std::size_t MomentWriter<Dim>::all_bodies(const Frame<Dim>& frame) {
  const BodyStates<Dim>& states = frame.world.states();
  std::vector<BodyIndex> bodies;
  for (BodyIndex body = 0; body < states.size(); ++body)
    if (states.removed[body] == 0) bodies.push_back(body);
  auto messages = to_bodies<Dim>(states, bodies, true);
  const std::size_t sent = messages.size();
  send_all(std::move(messages), frame.step, frame.time);
  fell_asleep_.clear();
  removed_ = false;
  return sent;
}

template class MomentWriter<2>;
template class MomentWriter<3>;

}  // namespace talus
