#include "lcmtypes/run_recorder.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace talus {

using talus_lcm::talus_run;

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
RunRecorder<Dim>::RunRecorder(const std::string& path, const RunInfo& info, std::int64_t steps_per_frame,
                              const RecorderParams& params)
    : steps_per_frame_(steps_per_frame),
      steps_per_key_frame_(std::max<std::int64_t>(1, std::llround(checked(params).key_frame_interval / info.dt))),
      flush_interval_(params.flush_interval),
      log_(path),
      writer_(info, record_id(info), *this) {
  // A key frame is a frame of output too.
  steps_per_key_frame_ = std::max<std::int64_t>(1, steps_per_key_frame_ / steps_per_frame_) * steps_per_frame_;
}

template <int Dim>
RunRecorder<Dim>::RunRecorder(const std::string& path, const RunInfo& info, double frame_rate,
                              const RecorderParams& params)
    : RunRecorder(path, info, std::max<std::int64_t>(1, std::llround(1.0 / (frame_rate * info.dt))), params) {
  writer_.run(talus_run::BEGIN, {}, 0, 0.0);
  log_.flush();
}

template <int Dim>
RunRecorder<Dim>::RunRecorder(const std::string& path, const RunInfo& info, const Scene<Dim>& scene,
                              const RecorderParams& params)
    : RunRecorder(path, info, scene.steps_per_frame(), params) {
  writer_.set_world(scene.world);
  writer_.set_scene(scene);
  writer_.set_files(scene);
  writer_.run(talus_run::BEGIN, {}, 0, 0.0);
  writer_.files();
  writer_.shapes();
  log_.flush();
}

template <int Dim>
void RunRecorder<Dim>::on_frame(const Frame<Dim>& frame) {
  writer_.new_shapes(frame);
  writer_.events(frame);
  if (frame.step % steps_per_frame_ == 0) {
    const bool due = frame.step % steps_per_key_frame_ == 0;
    if (due) writer_.run(talus_run::ALIVE, {}, frame.step, frame.time);
    write_output(frame, writer_.owes_key_frame() || (due && poses_since_key_frame_ >= frame.world.states().size()));
  }
  log_.flush_after(flush_interval_);
}

template <int Dim>
void RunRecorder<Dim>::on_end(const Frame<Dim>& last, std::string_view reason) {
  writer_.measure_slope(last);
  write_output(last, true);
  writer_.run(talus_run::END, reason, last.step, last.time);
  log_.flush();
}

template <int Dim>
void RunRecorder<Dim>::write_output(const Frame<Dim>& frame, bool key_frame) {
  writer_.piles(frame);
  writer_.stats(frame);
  writer_.instruments(frame);
  writer_.contacts(frame);
  writer_.obstacles(frame, key_frame);
  if (!key_frame) {
    poses_since_key_frame_ += static_cast<std::int64_t>(writer_.bodies(frame).bodies);
    return;
  }
  poses_since_key_frame_ = 0;
  writer_.all_bodies(frame);
}

template <int Dim>
std::int64_t RunRecorder<Dim>::stamp(double time) {
  const auto simulated = static_cast<std::int64_t>(std::llround(time * 1e6));
  last_utime_ = std::max(simulated, last_utime_ + pace);
  return last_utime_;
}

template class RunRecorder<2>;
template class RunRecorder<3>;

}  // namespace talus
