#include "lcmtypes/run_recorder.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

#include "lcmtypes/translate.h"

namespace talus {

using talus_lcm::talus_run_v1;

namespace {

// Between the stamps of two messages [us]: lcm-logplayer then paces them so that no receive buffer runs over.
constexpr std::int64_t pace = 100;

RecorderParams checked(const RecorderParams& params) {
  if (!(params.flush_interval >= 0.0))
    throw std::invalid_argument(fmt::format("flush_interval = {}: must be >= 0 s", params.flush_interval));
  if (!(params.key_frame_interval > 0.0))
    throw std::invalid_argument(fmt::format("key_frame_interval = {}: must be > 0 s", params.key_frame_interval));
  return params;
}

}  // namespace

template <int Dim>
RunRecorder<Dim>::RunRecorder(const std::string& path, const RunInfo& info, const Scene<Dim>& scene,
                              const RecorderParams& params)
    : info_(info),
      steps_per_frame_(scene.steps_per_frame()),
      steps_per_key_frame_(std::max<std::int64_t>(1, std::llround(checked(params).key_frame_interval / info.dt))),
      flush_interval_(params.flush_interval),
      log_(path),
      encoder_(record_id(info)),
      scene_events_(to_events(scene)),
      movers_(scene.movers),
      obstacles_(scene.world.obstacles) {
  // A key frame is a frame of output too.
  steps_per_key_frame_ = std::max<std::int64_t>(1, steps_per_key_frame_ / steps_per_frame_) * steps_per_frame_;
  auto scene_files = to_scene_files(scene);
  has_scene_ = !scene_files.empty();
  write_run(talus_run_v1::BEGIN, {}, 0, 0.0);
  write(std::move(scene_files), 0, 0.0);
  write(to_shapes<Dim>(scene.world), 0, 0.0);
  log_.flush();
}

template <int Dim>
void RunRecorder<Dim>::on_frame(const Frame<Dim>& frame) {
  write_scene_events(frame);
  write(to_sleep(frame.events), frame.step, frame.time);
  for (const SleepEvent& event : frame.events)
    if (!event.woke) fell_asleep_.push_back(event.body);
  if (frame.step % steps_per_frame_ == 0) {
    const bool due = frame.step % steps_per_key_frame_ == 0;
    if (due) write_run(talus_run_v1::ALIVE, {}, frame.step, frame.time);
    write_output(frame, removed_ || (due && poses_since_key_frame_ >= frame.world.states().size()));
  }
  log_.flush_after(flush_interval_);
}

template <int Dim>
void RunRecorder<Dim>::on_end(const Frame<Dim>& last, std::string_view reason) {
  write_output(last, true);
  write_run(talus_run_v1::END, reason, last.step, last.time);
  log_.flush();
}

template <int Dim>
void RunRecorder<Dim>::write_output(const Frame<Dim>& frame, bool key_frame) {
  const BodyStates<Dim>& states = frame.world.states();
  write(to_piles<Dim>(frame.piles.piles(), frame.policy), frame.step, frame.time);
  auto stats = to_stats<Dim>(frame);
  write(stats, frame.step, frame.time);
  std::vector<BodyIndex> bodies = moved(frame);
  poses_since_key_frame_ += static_cast<std::int64_t>(bodies.size());
  if (key_frame) {
    poses_since_key_frame_ = 0;
    removed_ = false;
    bodies.clear();
    for (BodyIndex body = 0; body < states.size(); ++body)
      if (states.removed[body] == 0) bodies.push_back(body);
  }
  if (key_frame || any_moves_after<Dim>(movers_, obstacles_time_)) {
    obstacles_time_ = frame.time;
    write(to_obstacles<Dim>(moving_poses(obstacles_, movers_, frame.time)), frame.step, frame.time);
  }
  write(to_bodies<Dim>(states, bodies, key_frame), frame.step, frame.time);
}

/// A key frame follows the removal of bodies: only it says which bodies there are.
template <int Dim>
void RunRecorder<Dim>::write_scene_events(const Frame<Dim>& frame) {
  for (const int number : frame.scene_events) {
    talus_lcm::talus_event_v2& message = scene_events_[number];
    set_happened(frame, info_.dt, message);
    write(message, frame.step, frame.time);
    removed_ = removed_ || message.action == "remove";
  }
}

/// Bodies awake, and those that came to rest since the last frame of output: their last pose is not recorded yet.
template <int Dim>
std::vector<BodyIndex> RunRecorder<Dim>::moved(const Frame<Dim>& frame) {
  const BodyStates<Dim>& states = frame.world.states();
  std::vector<BodyIndex> bodies(frame.world.awake().begin(), frame.world.awake().end());
  std::copy_if(fell_asleep_.begin(), fell_asleep_.end(), std::back_inserter(bodies),
               [&](BodyIndex body) { return states.removed[body] == 0; });
  fell_asleep_.clear();
  std::sort(bodies.begin(), bodies.end());
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  return bodies;
}

template <int Dim>
void RunRecorder<Dim>::write_run(std::int8_t phase, std::string_view reason, std::int64_t step, double time) {
  auto channels = channels_of_run(!scene_events_.empty(), !movers_.empty());
  if (has_scene_) channels.push_back(Channel::scene);
  auto message = to_run(info_, phase, reason, channels, encoder_);
  write(message, step, time);
}

template <int Dim>
template <class Message>
void RunRecorder<Dim>::write(std::vector<Message> messages, std::int64_t step, double time) {
  for (Message& message : messages) write(message, step, time);
}

template <int Dim>
template <class Message>
void RunRecorder<Dim>::write(Message& message, std::int64_t step, double time) {
  Packet packet = encoder_.encode(message, stamp(step, time));
  log_.write(packet);
}

template <int Dim>
Stamp RunRecorder<Dim>::stamp(std::int64_t step, double time) {
  const auto simulated = static_cast<std::int64_t>(std::llround(time * 1e6));
  last_utime_ = std::max(simulated, last_utime_ + pace);
  return {.utime = last_utime_, .step = step, .sim_time = time};
}

template class RunRecorder<2>;
template class RunRecorder<3>;

}  // namespace talus
