#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "common/policy/observer.h"
#include "lcmtypes/event_log.h"
#include "lcmtypes/moment_writer.h"
#include "lcmtypes/run_info.h"

namespace talus {

struct RecorderParams {
  double flush_interval = 1.0;      // [s] of wall time, >= 0: what kill -9 may cost. Small: a system call each time
  double key_frame_interval = 1.0;  // [s] of simulated time, > 0: at least so long between two key frames, which have
                                    // the poses of all bodies. Long: a reader that starts in the middle waits long;
                                    // short: the file of a lively run doubles
};

/// Writes the record of a run: the scene's files and shapes at the start, events of the scene, sleep events of each
/// step, piles, statistics and poses of each frame of output, of obstacles that move too, key frames, and why it ended.
/// Key frames come after at least as many poses of moving bodies, so together they take no more room than what moves,
/// however many sleep; and once bodies have left the world. Stamps are simulated time and nothing in the file is from
/// the wall clock, so the same run gives the same bytes. When the disk is full a call throws std::system_error, and
/// later ones do nothing.
template <int Dim>
class RunRecorder final : public Observer<Dim>, private MessageSink {
 public:
  /// Throws std::system_error when the file cannot be made, std::invalid_argument on bad parameters and on a shape
  /// too large for a message, or where a file that the scene names can no longer be read.
  RunRecorder(const std::string& path, const RunInfo& info, const Scene<Dim>& scene, const RecorderParams& params = {});
  /// Of a run without a scene, with `frame_rate` frames of output in a second. Shapes are written as they come.
  RunRecorder(const std::string& path, const RunInfo& info, double frame_rate, const RecorderParams& params = {});

  /// Before the first frame: the readings of the scene's instruments are told too. `meters` must be an
  /// observer of the run before this one, and live longer.
  void set_instruments(const InstrumentMeters<Dim>& meters) { writer_.set_instruments(meters); }
  /// The same for the contacts, while they are wanted.
  void set_contacts(const ContactForces<Dim>& contacts) { writer_.set_contacts(contacts); }

  void on_frame(const Frame<Dim>& frame) override;
  void on_end(const Frame<Dim>& last, std::string_view reason) override;

 private:
  RunRecorder(const std::string& path, const RunInfo& info, std::int64_t steps_per_frame, const RecorderParams& params);
  std::int64_t stamp(double time) override;
  void put(Packet packet) override { log_.write(packet); }
  void write_output(const Frame<Dim>& frame, bool key_frame);

  std::int64_t steps_per_frame_ = 1;
  std::int64_t steps_per_key_frame_ = 1;
  std::int64_t poses_since_key_frame_ = 0;
  double flush_interval_ = 0.0;
  EventLog log_;
  std::int64_t last_utime_ = -1;
  MomentWriter<Dim> writer_;
};

}  // namespace talus
