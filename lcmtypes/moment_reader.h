#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "common/moment/moment.h"
#include "lcmtypes/bodies_message.h"
#include "lcmtypes/channels.h"
#include "lcmtypes/sequence_tracker.h"
#include "lcmtypes/wire.h"

namespace talus {

/// What messages may name. They may be forged, and each body takes memory.
struct MomentLimits {
  int bodies = 1'000'000;
  std::optional<int> shapes = {};  // nothing: as many as the messages have, and bodies are left out until all are known
  int obstacles = 100'000;
  int events = 10'000;                   // of the scene
  std::size_t later_events = 1'000'000;  // sleep events between two moments; beyond, they are dropped
  int piles = 1000;
  std::size_t layers = 64 * max_layers;  // of all piles
  /// Without them messages of bodies, shapes, obstacles and events of the scene are counted only, and the run may be of
  /// either dimension. No moment is whole then, but all else of it is the newest that is known.
  bool poses = true;
  /// The messages are all that the run gave, as in a record: a number missing at the start is a loss too.
  bool from_start = false;
};

/// The limits of a record of this scene.
template <int Dim>
MomentLimits limits_of(const Scene<Dim>& scene);

/// Puts the moments of one run together from its messages, of a record or of the bus. Beyond the limits piles are left
/// out and counted.
class MomentReader {
 public:
  /// `dimension`: 2 or 3.
  MomentReader(int dimension, const MomentLimits& limits);

  /// Takes the bytes of a message; whether moment() is a whole one now. What does not decode is left out and counted.
  /// `before` is called with the step of a message that decodes, before it changes anything. Throws
  /// std::invalid_argument on a run of another format, and as take() of a message does.
  bool take(Channel channel, std::span<const std::uint8_t> bytes,
            const std::function<void(std::int64_t step)>& before = {});

  /// Takes a message of the run that has passed decode(); whether moment() is a whole one now. A duplicate, and what is
  /// older than what is known, changes nothing. Throws std::invalid_argument on a message that is of another dimension
  /// or names what is beyond the limits.
  bool take(const talus_lcm::talus_run& message);
  bool take(const talus_lcm::talus_piles& message);
  bool take(const talus_lcm::talus_sleep& message);
  bool take(const talus_lcm::talus_stats& message);
  bool take(const talus_lcm::talus_bodies& message);
  bool take(const talus_lcm::talus_shapes& message);
  bool take(const talus_lcm::talus_event& message);
  bool take(const talus_lcm::talus_obstacles& message);
  bool take(const talus_lcm::talus_scene& message);
  bool take(const talus_lcm::talus_instruments& message);
  bool take(const talus_lcm::talus_contacts& message);

  /// Valid until the next call of take(). A step that is told again, as at the end of a run, keeps its events.
  const Moment& moment() const { return moment_; }
  /// Those since the moment.
  const std::vector<SleepEvent>& later_events() const { return later_events_; }

  /// The newest message about the run and its numbers.
  const std::optional<talus_lcm::talus_run>& run() const { return run_; }
  const std::optional<talus_lcm::talus_stats>& stats() const { return stats_; }
  /// The newest readings of instruments, in as many messages as they came.
  const std::vector<talus_lcm::talus_instruments>& instruments() const { return instruments_; }
  /// By index; an obstacle's as it was first told.
  const std::map<int, talus_lcm::talus_shapes>& shapes() const { return shapes_; }
  const std::map<int, talus_lcm::talus_shapes>& obstacles() const { return obstacles_; }
  /// Of the scene, by number.
  const std::map<int, talus_lcm::talus_event>& events() const { return events_; }
  /// Whether no shape and no obstacle is missing.
  bool has_all_shapes() const;
  /// Goes up when a shape of bodies is told for the first time, or is another one now.
  std::int64_t shape_form() const { return shape_form_; }
  /// Goes up when a shape, an obstacle or an event of the scene is told for the first time, or is another one now.
  std::int64_t form() const { return form_; }

  std::int64_t undecodable() const { return undecodable_; }
  /// Piles received for which there was no room; each message counts.
  std::int64_t piles_left_out() const { return piles_left_out_; }
  std::int64_t lost(Channel channel) const { return numbers_[static_cast<std::size_t>(channel)].lost(); }
  std::int64_t received(Channel channel) const { return numbers_[static_cast<std::size_t>(channel)].received(); }
  /// Of all channels.
  std::int64_t lost() const;
  std::int64_t received() const;
  std::int64_t slept() const { return slept_; }  // sleep events, all so far
  std::int64_t woken() const { return woken_; }

  /// Whether a run of the same number begins again with this message, as when a record is played twice.
  bool is_restart(const talus_lcm::talus_run& message) const;

 private:
  enum class Age : std::uint8_t { newest, late, duplicate };
  template <class Message>
  Age count(const Message& message);
  template <class Message>
  bool counted_only(const Message& message);
  void require_dimension(int dimension) const;
  void place_pile(std::size_t number, const talus_lcm::talus_pile& message);
  void place_obstacle(int obstacle, std::span<const float> values);
  void place_contacts();
  void note_lost_events();

  MomentLimits limits_;
  Moment moment_;
  BodiesReader bodies_;
  std::int64_t piles_step_ = 0;
  std::size_t layers_ = 0;  // of all piles
  std::int64_t piles_left_out_ = 0;
  std::vector<SleepEvent> later_events_;
  std::size_t sure_events_ = 0;  // of these, after which none is lost
  bool events_lost_ = false;     // since the moment
  std::optional<talus_lcm::talus_run> run_;
  std::optional<talus_lcm::talus_stats> stats_;
  Parts<talus_lcm::talus_instruments> instrument_parts_;
  std::vector<talus_lcm::talus_instruments> instruments_;
  Parts<talus_lcm::talus_contacts> contact_parts_;
  std::vector<talus_lcm::talus_contacts> contacts_;  // of a whole step
  std::map<int, talus_lcm::talus_shapes> shapes_;
  std::map<int, talus_lcm::talus_shapes> obstacles_;
  std::map<int, talus_lcm::talus_event> events_;
  std::int64_t form_ = 0;
  std::int64_t shape_form_ = 0;
  std::array<SequenceTracker, channel_names.size()> numbers_;
  std::int64_t undecodable_ = 0;
  std::int64_t slept_ = 0;
  std::int64_t woken_ = 0;
};

}  // namespace talus
