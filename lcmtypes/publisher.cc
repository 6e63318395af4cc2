#include "lcmtypes/publisher.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <lcm/lcm-cpp.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

namespace talus {

using talus_lcm::talus_run;

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

const PublisherParams& checked(const PublisherParams& params) {
  if (!(params.piles_rate >= 0.0))
    throw std::invalid_argument(fmt::format("piles_rate = {}: must be >= 0 per second", params.piles_rate));
  if (!(params.bodies_rate >= 0.0))
    throw std::invalid_argument(fmt::format("bodies_rate = {}: must be >= 0 per second", params.bodies_rate));
  if (params.queue_bytes < 1U << 20U)
    throw std::invalid_argument(fmt::format("queue_bytes = {}: must be >= 1 MiB", params.queue_bytes));
  return params;
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
Publisher<Dim>::Publisher(const RunInfo& info, const PublisherParams& params, std::unique_ptr<SendQueue> queue)
    : run_id_(live_id(info)),
      queue_(std::move(queue)),
      writer_(info, run_id_, *this),
      piles_pulse_(params.piles_rate),
      bodies_pulse_(params.bodies_rate),
      bodies_rate_(params.bodies_rate) {
  run_pulse_.due(Clock::now());
  if (queue_) writer_.run(talus_run::BEGIN, {}, 0, 0.0);
}

template <int Dim>
Publisher<Dim>::Publisher(const RunInfo& info, const PublisherParams& params)
    : Publisher(info, params, open_queue(checked(params))) {}

template <int Dim>
Publisher<Dim>::Publisher(const RunInfo& info, const PublisherParams& params, lcm::LCM& lcm)
    : Publisher(info, params, std::make_unique<SendQueue>(lcm, checked(params).queue_bytes)) {}

template <int Dim>
void Publisher<Dim>::on_frame(const Frame<Dim>& frame) {
  if (!queue_) return;
  const auto now = Clock::now();
  sum_ += frame.phases;
  ++summed_steps_;
  writer_.events(frame);
  // A receiver that starts late then has the texts of all events before the first happens.
  if (events_pulse_.due(now)) writer_.events_again(frame, most_events_again);
  if (piles_pulse_.due(now)) writer_.piles(frame);
  if (stats_pulse_.due(now)) send_stats(frame, now);
  if (run_pulse_.due(now)) writer_.run(talus_run::ALIVE, {}, frame.step, frame.time);
  if (bodies_rate_ > 0.0) writer_.new_shapes(frame);
  if (!writer_.has_shapes()) return;
  if (shapes_pulse_.due(now)) writer_.shapes(frame);
  if (bodies_pulse_.due(now)) send_bodies(frame, now);
}

/// Poses of the bodies that move or have just fallen asleep, and of some of the others in turn; of all once bodies have
/// left. Obstacles and contacts are shown with the bodies of the same step, and so come before them.
template <int Dim>
void Publisher<Dim>::send_bodies(const Frame<Dim>& frame, Clock::time_point now) {
  const BodyIndex bodies = frame.world.states().size();
  const auto share = static_cast<BodyIndex>(std::ceil(bodies / (bodies_rate_ * turn_time)));
  std::vector<BodyIndex> in_turn;
  for (BodyIndex left = std::min({share, most_in_turn, bodies}); left > 0; --left) {
    if (turn_ >= bodies) turn_ = 0;
    in_turn.push_back(turn_++);
  }
  writer_.obstacles(frame);
  const std::size_t contacts = writer_.contacts(frame);
  const bool all = writer_.owes_key_frame() && bodies <= most_in_key_frame && key_frames_pulse_.due(now);
  const std::size_t poses = all ? writer_.all_bodies(frame) : writer_.bodies(frame, in_turn).messages;
  const auto bytes = static_cast<double>(max_message_bytes * (contacts + poses));
  bodies_pulse_.wait_until(now + std::chrono::duration_cast<Clock::duration>(
                                     std::chrono::duration<double>(bytes / bodies_bytes_per_second)));
}

template <int Dim>
void Publisher<Dim>::on_end(const Frame<Dim>& last, std::string_view reason) {
  if (!queue_) return;
  writer_.piles(last);
  writer_.measure_slope(last);
  send_stats(last, Clock::now());  // before the poses, which are shown with them
  if (writer_.has_shapes()) {
    writer_.shapes(last);
    writer_.obstacles(last);
    writer_.contacts(last);
    if (last.world.states().size() <= most_in_key_frame) writer_.all_bodies(last);
  }
  writer_.run(talus_run::END, reason, last.step, last.time);
  queue_->close(farewell_time);
  if (dropped() > 0) spdlog::warn("live view: {} messages were dropped; the record has everything", dropped());
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
  writer_.stats(std::move(message), frame);
  writer_.instruments(frame);
}

template <int Dim>
std::int64_t Publisher<Dim>::stamp(double /*time*/) {
  const auto wall = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(wall).count();
}

template class Publisher<2>;
template class Publisher<3>;

}  // namespace talus
