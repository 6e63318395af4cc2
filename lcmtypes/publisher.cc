#include "lcmtypes/publisher.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <lcm/lcm-cpp.hpp>
#include <span>
#include <stdexcept>

#include "lcmtypes/translate.h"

namespace talus {

using talus_lcm::talus_run_v1;

namespace {

// Of wall time [s] within which the pose of each body is sent, also of those at rest, so that a receiver that starts
// late or missed a message has all of them; longer where they are more than fit one message each time.
constexpr double turn_time = 2.0;
constexpr BodyIndex most_in_turn = 1000;
// Events of the scene that are sent again each second.
constexpr std::size_t most_events_again = 200;
// Bodies of which the state at the end fits the queue.
constexpr BodyIndex most_in_key_frame = 100'000;
constexpr auto farewell_time = std::chrono::seconds(1);

void check(const PublisherParams& params) {
  if (!(params.piles_rate >= 0.0))
    throw std::invalid_argument(fmt::format("piles_rate = {}: must be >= 0 per second", params.piles_rate));
  if (!(params.bodies_rate >= 0.0))
    throw std::invalid_argument(fmt::format("bodies_rate = {}: must be >= 0 per second", params.bodies_rate));
  if (params.queue_bytes < 1U << 20U)
    throw std::invalid_argument(fmt::format("queue_bytes = {}: must be >= 1 MiB", params.queue_bytes));
}

std::unique_ptr<SendQueue> open_queue(const PublisherParams& params) {
  if (!params.allow_network) require_local(effective_url(params.url));
  LiveLink link = open_live_link(params.url);
  if (!link.lcm) {
    spdlog::warn("no live view: {}", link.problem);
    return nullptr;
  }
  return std::make_unique<SendQueue>(std::move(link.lcm), params.queue_bytes);
}

}  // namespace

template <int Dim>
Publisher<Dim>::Publisher(const RunInfo& info, const PublisherParams& params)
    : info_(info),
      run_id_(live_id(info)),
      encoder_(run_id_),
      piles_pulse_(params.piles_rate),
      bodies_pulse_(params.bodies_rate),
      bodies_rate_(params.bodies_rate) {
  check(params);
  queue_ = open_queue(params);
  begin();
}

template <int Dim>
Publisher<Dim>::Publisher(const RunInfo& info, const PublisherParams& params, lcm::LCM& lcm)
    : info_(info),
      run_id_(live_id(info)),
      encoder_(run_id_),
      piles_pulse_(params.piles_rate),
      bodies_pulse_(params.bodies_rate),
      bodies_rate_(params.bodies_rate) {
  check(params);
  queue_ = std::make_unique<SendQueue>(lcm, params.queue_bytes);
  begin();
}

template <int Dim>
void Publisher<Dim>::begin() {
  run_pulse_.due(Clock::now());
  send_run(talus_run_v1::BEGIN, {}, 0, 0.0);
}

template <int Dim>
void Publisher<Dim>::on_frame(const Frame<Dim>& frame) {
  if (!queue_) return;
  const auto now = Clock::now();
  sum_ += frame.phases;
  ++summed_steps_;
  send_events(frame);
  send(to_sleep(frame.events), frame.step, frame.time);
  if (piles_pulse_.due(now)) send(to_piles<Dim>(frame.piles.piles(), frame.policy), frame.step, frame.time);
  if (stats_pulse_.due(now)) send_stats(frame, now);
  if (run_pulse_.due(now)) send_run(talus_run_v1::ALIVE, {}, frame.step, frame.time);
  if (!sends_poses()) return;
  if (shapes_pulse_.due(now)) send_shapes(frame);
  for (const SleepEvent& event : frame.events)
    if (!event.woke) fell_asleep_.push_back(event.body);
  if (bodies_pulse_.due(now)) send_bodies(frame, now);
}

/// Poses of the bodies awake, of those that fell asleep since the last time, and of some of the others in turn.
template <int Dim>
void Publisher<Dim>::send_bodies(const Frame<Dim>& frame, Clock::time_point now) {
  const BodyStates<Dim>& states = frame.world.states();
  std::vector<BodyIndex> bodies(frame.world.awake().begin(), frame.world.awake().end());
  bodies.insert(bodies.end(), fell_asleep_.begin(), fell_asleep_.end());
  fell_asleep_.clear();
  const auto share = static_cast<BodyIndex>(std::ceil(states.size() / (bodies_rate_ * turn_time)));
  for (BodyIndex left = std::min({share, most_in_turn, states.size()}); left > 0; --left) {
    if (turn_ >= states.size()) turn_ = 0;
    bodies.push_back(turn_++);
  }
  std::erase_if(bodies, [&](BodyIndex body) { return states.removed[body] != 0; });
  std::sort(bodies.begin(), bodies.end());
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  send_obstacles(frame);
  auto messages = to_bodies<Dim>(states, bodies, false);
  const auto bytes = static_cast<double>(max_message_bytes * messages.size());
  bodies_pulse_.wait_until(now + std::chrono::duration_cast<Clock::duration>(
                                     std::chrono::duration<double>(bytes / bodies_bytes_per_second)));
  send(std::move(messages), frame.step, frame.time);
}

/// Unless they are where they were the last time. Before the bodies of the same step, which are shown with them.
template <int Dim>
void Publisher<Dim>::send_obstacles(const Frame<Dim>& frame) {
  if (!any_moves_after<Dim>(movers_, obstacles_time_)) return;
  obstacles_time_ = frame.time;
  send(to_obstacles<Dim>(moving_poses(obstacles_, movers_, frame.time)), frame.step, frame.time);
}

/// A key frame, in which a body that is missing was removed.
template <int Dim>
void Publisher<Dim>::send_all_poses(const Frame<Dim>& frame) {
  const BodyStates<Dim>& states = frame.world.states();
  send_obstacles(frame);
  if (states.size() > most_in_key_frame) return;
  std::vector<BodyIndex> bodies;
  for (BodyIndex body = 0; body < states.size(); ++body)
    if (states.removed[body] == 0) bodies.push_back(body);
  send(to_bodies<Dim>(states, bodies, true), frame.step, frame.time);
}

/// Those that happen, and each second those known, also before they happen: a receiver that starts late then has the
/// texts of all before the first.
template <int Dim>
void Publisher<Dim>::send_events(const Frame<Dim>& frame) {
  for (const int number : frame.scene_events) {
    if (number >= std::ssize(events_)) continue;
    set_happened(frame, info_.dt, events_[number]);
    send(events_[number], frame.step, frame.time);
  }
  if (!events_pulse_.due(Clock::now())) return;
  for (std::size_t left = std::min(most_events_again, events_.size()); left > 0; --left) {
    if (event_turn_ >= events_.size()) event_turn_ = 0;
    send(events_[event_turn_++], frame.step, frame.time);
  }
}

/// Of obstacles that move the present pose.
template <int Dim>
void Publisher<Dim>::send_shapes(const Frame<Dim>& frame) {
  for (talus_lcm::talus_shapes_v1& message : shapes_) {
    if (message.obstacle != 0) set_pose<Dim>(frame.world.obstacle_pose(message.index), message);
    send(message, frame.step, frame.time);
  }
}

template <int Dim>
void Publisher<Dim>::on_end(const Frame<Dim>& last, std::string_view reason) {
  if (!queue_) return;
  send(to_piles<Dim>(last.piles.piles(), last.policy), last.step, last.time);
  send_stats(last, Clock::now());  // before the poses, which are shown with them
  if (sends_poses()) {
    send_shapes(last);
    send_all_poses(last);
  }
  send_run(talus_run_v1::END, reason, last.step, last.time);
  queue_->close(farewell_time);
  if (dropped() > 0) spdlog::warn("live view: {} messages were dropped; the record has everything", dropped());
}

template <int Dim>
void Publisher<Dim>::send_run(std::int8_t phase, std::string_view reason, std::int64_t step, double time) {
  const auto channels = channels_of_run(!events_.empty(), !movers_.empty());
  auto message = to_run(info_, phase, reason, channels, encoder_);
  send(message, step, time);
}

template <int Dim>
void Publisher<Dim>::send_stats(const Frame<Dim>& frame, Clock::time_point now) {
  auto message = to_stats<Dim>(frame);
  message.timed = 1;
  if (summed_steps_ > 0) set_phase_times(sum_, summed_steps_, message);
  const std::chrono::duration<double> passed = now - stats_wall_;
  if (passed.count() > 0.0) message.real_time_factor = static_cast<float>((frame.time - stats_time_) / passed.count());
  message.queued_bytes = static_cast<std::int64_t>(queue_->queued_bytes());
  message.dropped = queue_->dropped();
  sum_ = {};
  summed_steps_ = 0;
  stats_wall_ = now;
  stats_time_ = frame.time;
  send(message, frame.step, frame.time);
}

template <int Dim>
template <class Message>
void Publisher<Dim>::send(std::vector<Message> messages, std::int64_t step, double time) {
  for (Message& message : messages) send(message, step, time);
}

template <int Dim>
template <class Message>
void Publisher<Dim>::send(Message& message, std::int64_t step, double time) {
  if (!queue_) return;
  const auto wall = std::chrono::system_clock::now().time_since_epoch();
  const auto utime = std::chrono::duration_cast<std::chrono::microseconds>(wall).count();
  queue_->push(encoder_.encode(message, {.utime = utime, .step = step, .sim_time = time}));
}

template class Publisher<2>;
template class Publisher<3>;

}  // namespace talus
