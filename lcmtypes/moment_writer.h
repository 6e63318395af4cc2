#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "common/measure/contact_forces.h"
#include "common/measure/instrument_meters.h"
#include "common/measure/pile_form.h"
#include "common/policy/frame.h"
#include "common/scene/happened.h"
#include "common/scene/scene.h"
#include "common/world/motion.h"
#include "lcmtypes/run_info.h"
#include "lcmtypes/scene_message.h"
#include "lcmtypes/shapes_message.h"
#include "lcmtypes/stats_message.h"
#include "lcmtypes/wire.h"

namespace talus {

/// Where the messages of a run go: to the bus or into a record.
class MessageSink {
 public:
  virtual ~MessageSink() = default;
  /// The stamp [us] of the next message, which is of this simulated time [s]; see the .lcm files.
  virtual std::int64_t stamp(double time) = 0;
  virtual void put(Packet packet) = 0;
};

/// Writes the messages of a run: what each says, not when it is sent. What many bodies, piles or events are told in
/// comes in several messages.
template <int Dim>
class MomentWriter {
 public:
  /// `sink` must live longer than this object.
  MomentWriter(const RunInfo& info, std::int64_t run_id, MessageSink& sink)
      : info_(info), encoder_(run_id), sink_(sink) {}

  /// Before shapes() and bodies(). Throws std::invalid_argument on a shape too large for a message.
  void set_world(const WorldDescription<Dim>& world) { set_shapes(world.shapes, world.obstacles); }
  /// The scene's events, its obstacles that move, and what its slope is measured of.
  void set_scene(const Scene<Dim>& scene);
  /// The files of the scene, which is written down then.
  void set_files(const Scene<Dim>& scene) { files_ = to_scene_files(scene); }
  /// What the scene measures, if it measures anything; must live longer than this object.
  void set_instruments(const InstrumentMeters<Dim>& meters) { meters_ = &meters; }
  /// The contacts to tell of, while they are wanted; must live longer than this object.
  void set_contacts(const ContactForces<Dim>& contacts) { contacts_ = &contacts; }
  bool has_shapes() const { return !shapes_.empty(); }

  /// `phase` as in talus_run.
  void run(std::int8_t phase, std::string_view reason, std::int64_t step, double time);
  void files();
  /// All shapes, and the obstacles where they are now.
  void shapes(const Frame<Dim>& frame);
  /// As they were at the start.
  void shapes();
  /// All, if the frame's world has got other shapes or obstacles since the last call.
  void new_shapes(const Frame<Dim>& frame);

  /// After each step: events of the scene and sleep events of it.
  void events(const Frame<Dim>& frame);
  /// An event that happened just before the frame's step.
  void event(talus_lcm::talus_event& message, const Frame<Dim>& frame);
  /// Some of the scene's events again, in turn.
  void events_again(const Frame<Dim>& frame, std::size_t most);

  void piles(const Frame<Dim>& frame);
  void stats(const Frame<Dim>& frame) { stats(to_stats<Dim>(frame), frame); }
  /// Adds the slope, where the scene is known.
  void stats(talus_lcm::talus_stats message, const Frame<Dim>& frame);
  /// Measures the slope at this frame; else stats() does so once a second of simulated time.
  void measure_slope(const Frame<Dim>& frame);
  /// The readings of the scene's instruments, where it has any.
  void instruments(const Frame<Dim>& frame);
  /// The contacts, while they are wanted, in how many messages.
  std::size_t contacts(const Frame<Dim>& frame);
  /// Of obstacles that have moved since the last time; of all that may move the first time and where `all` is set.
  void obstacles(const Frame<Dim>& frame, bool all = false);
  /// Poses of the bodies awake, of those that fell asleep since the last time, and of `more`; how many these are and in
  /// how many messages.
  struct Sent {
    std::size_t bodies = 0;
    std::size_t messages = 0;
  };
  Sent bodies(const Frame<Dim>& frame, std::span<const BodyIndex> more = {});
  /// Sends a key frame, the poses of all bodies in the world. Returns the number of its messages.
  std::size_t all_bodies(const Frame<Dim>& frame);
  /// Whether bodies have left the world since the last key frame: only a key frame says which are left.
  bool owes_key_frame() const { return removed_; }

 private:
  void set_shapes(std::span<const Shape<Dim>> shapes, std::span<const Obstacle<Dim>> obstacles);
  template <class Message>
  void send(Message&& message, std::int64_t step, double time) {
    sink_.put(encoder_.encode(message, {.utime = sink_.stamp(time), .step = step, .sim_time = time}));
  }
  template <class Message>
  void send_all(std::vector<Message> messages, std::int64_t step, double time) {
    for (Message& message : messages) send(message, step, time);
  }

  RunInfo info_;
  MessageEncoder encoder_;
  MessageSink& sink_;
  std::vector<talus_lcm::talus_shapes> shapes_;  // and obstacles; empty: not known
  std::int64_t form_ = 0;                        // of the world that they are of
  std::vector<ObstaclePose<Dim>> moving_;        // obstacles that may move, where they were when they were sent last
  bool moving_sent_ = false;                     // since they are these
  std::vector<talus_lcm::talus_event> events_;   // of the scene, as far as they have happened
  std::size_t event_turn_ = 0;                   // the one from which on they are sent again
  std::optional<Scene<Dim>> scene_;
  const InstrumentMeters<Dim>* meters_ = nullptr;
  const ContactForces<Dim>* contacts_ = nullptr;
  Applicable<AngleOfRepose> slope_;
  double slope_time_ = -1.0;            // when it was measured last [s]; below 0: never
  std::vector<BodyIndex> fell_asleep_;  // since poses were sent last
  std::vector<talus_lcm::talus_scene> files_;
  bool removed_ = false;
  std::int64_t removals_ = 0;  // of the world in the last frame
};

}  // namespace talus
