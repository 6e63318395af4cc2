#include "lcmtypes/moment_reader.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "lcmtypes/contacts_message.h"
#include "lcmtypes/piles_message.h"
#include "lcmtypes/run_message.h"
#include "lcmtypes/sleep_message.h"
#include "lcmtypes/stats_message.h"
#include "lcmtypes/wire.h"

namespace talus {

using talus_lcm::talus_bodies;
using talus_lcm::talus_contacts;
using talus_lcm::talus_event;
using talus_lcm::talus_instruments;
using talus_lcm::talus_obstacles;
using talus_lcm::talus_piles;
using talus_lcm::talus_run;
using talus_lcm::talus_scene;
using talus_lcm::talus_shapes;
using talus_lcm::talus_sleep;
using talus_lcm::talus_stats;

template <int Dim>
MomentLimits limits_of(const Scene<Dim>& scene) {
  return {.bodies = static_cast<int>(scene.bodies_planned()),
          .shapes = static_cast<int>(scene.world.shapes.size()),
          .obstacles = static_cast<int>(scene.world.obstacles.size()),
          .events = static_cast<int>(scene.events.size()),
          .later_events = std::numeric_limits<std::size_t>::max(),
          .piles = 100'000,
          .layers = 10'000'000,
          .from_start = true};
}
template MomentLimits limits_of(const Scene<2>&);
template MomentLimits limits_of(const Scene<3>&);

MomentReader::MomentReader(int dimension, const MomentLimits& limits) : limits_(limits), moment_(dimension) {
  if (limits.from_start)
    for (SequenceTracker& numbers : numbers_) numbers.expect(0);
}

bool MomentReader::take(Channel channel, std::span<const std::uint8_t> bytes,
                        const std::function<void(std::int64_t)>& before) {
  bool whole = false;
  with_message_of(channel, [&](auto message) {
    if (decode(bytes, message).empty()) {
      if (before) before(message.step);
      whole = take(message);
      return;
    }
    refuse_other_format(channel, bytes);
    ++undecodable_;
  });
  return whole;
}

template <class Message>
MomentReader::Age MomentReader::count(const Message& message) {
  SequenceTracker& numbers = numbers_[static_cast<std::size_t>(channel_of<Message>)];
  const std::int64_t before = numbers.received();
  if (numbers.see(message.seq)) return Age::newest;
  return numbers.received() > before ? Age::late : Age::duplicate;
}

template <class Message>
bool MomentReader::counted_only(const Message& message) {
  count(message);
  return false;
}

void MomentReader::require_dimension(int dimension) const {
  if (limits_.poses && dimension != moment_.dimension())
    throw std::invalid_argument(
        fmt::format("a message of a run in {}D: must be {}D as its scene", dimension, moment_.dimension()));
}

bool MomentReader::take(const talus_run& message) {
  require_dimension(message.dimension);
  if (count(message) != Age::newest) return false;
  run_ = message;
  for (const Channel channel : all_channels) {
    const auto named = std::ranges::find(message.channels, name_of(channel));
    if (channel == Channel::run || named == message.channels.end()) continue;
    numbers_[static_cast<std::size_t>(channel)].expect(message.sent[named - message.channels.begin()]);
  }
  return false;
}

bool MomentReader::take(const talus_piles& message) {
  if (count(message) == Age::duplicate || message.step < piles_step_) return false;
  piles_step_ = message.step;
  for (std::size_t i = 0; i < message.piles.size(); ++i)
    place_pile(static_cast<std::size_t>(message.first_pile) + i, message.piles[i]);
  return false;
}

void MomentReader::place_pile(std::size_t number, const talus_lcm::talus_pile& message) {
  std::vector<Pile<3>>& piles = moment_.piles;
  const std::size_t before = number < piles.size() ? piles[number].layers.size() : 0;
  if (number >= static_cast<std::size_t>(limits_.piles) || layers_ - before + message.layers.size() > limits_.layers) {
    if (limits_.from_start) throw std::invalid_argument("more piles or layers than a run can have");
    ++piles_left_out_;
    return;
  }
  if (number >= piles.size()) piles.resize(number + 1);
  layers_ += message.layers.size() - before;
  piles[number] = pile_of(message);
}

bool MomentReader::take(const talus_sleep& message) {
  const std::int64_t lost_before = lost(Channel::sleep);
  if (count(message) == Age::duplicate) return false;
  if (lost(Channel::sleep) > lost_before) note_lost_events();
  const std::vector<SleepEvent> events = events_of(message);
  for (const SleepEvent& event : events) {
    if (limits_.poses && event.body >= limits_.bodies)
      throw std::invalid_argument(
          fmt::format("sleep event of body {}, but the scene has {} bodies", event.body, limits_.bodies));
    if (limits_.poses) bodies_.note_event(event.body);
    ++(event.woke ? woken_ : slept_);
  }
  if (later_events_.size() + events.size() > limits_.later_events) {
    later_events_.clear();
    note_lost_events();
  }
  sure_events_ += events.size();
  later_events_.insert(later_events_.end(), events.begin(), events.end());
  return false;
}

/// The last events of all bodies are unknown.
void MomentReader::note_lost_events() {
  bodies_.note_lost_events();
  events_lost_ = true;
  sure_events_ = 0;
}

bool MomentReader::take(const talus_stats& message) {
  if (count(message) != Age::newest) return false;
  stats_ = message;
  moment_.kinetic_energy = message.kinetic_energy;
  moment_.drift = drift_of(message);
  moment_.warnings = warnings_of(message);
  return false;
}

bool MomentReader::take(const talus_bodies& message) {
  require_dimension(message.dimension);
  if (!limits_.poses || (!limits_.shapes && !has_all_shapes())) return counted_only(message);
  const int shapes = limits_.shapes.value_or(static_cast<int>(shapes_.size()));
  for (std::size_t entry = 0; entry < message.body.size(); ++entry) {
    if (message.body[entry] < limits_.bodies && message.shape[entry] < shapes) continue;
    throw std::invalid_argument(fmt::format("step {}: body {} of shape {}, but the scene has {} bodies and {} shapes",
                                            message.step, message.body[entry], message.shape[entry], limits_.bodies,
                                            shapes));
  }
  if (count(message) == Age::duplicate || !bodies_.take(message, moment_.bodies)) return false;
  if (message.step != moment_.step) moment_.events.clear();
  moment_.events.insert(moment_.events.end(), later_events_.begin(), later_events_.end());
  later_events_.clear();
  const std::span sure = std::span(moment_.events).last(std::exchange(sure_events_, 0));
  moment_.step = message.step;
  moment_.time = message.sim_time;
  place_contacts();
  if (std::exchange(events_lost_, false)) std::ranges::fill(moment_.bodies.cause, std::int8_t{-1});
  for (const SleepEvent& event : sure)
    if (event.body < moment_.bodies.size()) moment_.bodies.cause[event.body] = static_cast<std::int8_t>(event.cause);
  return true;
}

/// Of an obstacle that moves the message has the present pose.
bool MomentReader::take(const talus_shapes& message) {
  if (!limits_.poses) return counted_only(message);
  require_dimension(message.dimension);
  constexpr int most_shapes = 32'767;  // that a body can name
  if (message.total > (message.obstacle != 0 ? limits_.obstacles : limits_.shapes.value_or(most_shapes)))
    throw std::invalid_argument(fmt::format("{} shapes or obstacles, more than there can be", message.total));
  if (count(message) != Age::newest) return false;
  auto& known = message.obstacle != 0 ? obstacles_ : shapes_;
  const auto [place, first] = known.try_emplace(message.index, message);
  talus_shapes& before = place->second;
  if (!first && before.values == message.values) {
    if (message.obstacle == 0 || std::ranges::equal(message.pose, before.pose)) return false;
    const std::vector<float> values(std::begin(message.pose), std::end(message.pose));
    place_obstacle(message.index, values);
    return false;
  }
  before = message;
  ++form_;
  if (message.obstacle == 0) ++shape_form_;
  return false;
}

/// What has happened stays so, whatever comes late.
bool MomentReader::take(const talus_event& message) {
  if (!limits_.poses) return counted_only(message);
  if (message.number >= limits_.events)
    throw std::invalid_argument(fmt::format("event {}, but the scene has {} events", message.number, limits_.events));
  if (count(message) == Age::duplicate) return false;
  const auto [place, first] = events_.try_emplace(message.number, message);
  if (first) ++form_;
  const bool happened = message.happened_step >= 0 && (first || place->second.happened_step < 0);
  if (!happened) return false;
  moment_.done.push_back({message.number, message.happened_time});
  place->second = message;
  return false;
}

/// Only of obstacles that are known: a forged message can name any number of others.
bool MomentReader::take(const talus_obstacles& message) {
  if (!limits_.poses) return counted_only(message);
  require_dimension(message.dimension);
  if (count(message) == Age::duplicate) return false;
  const std::size_t values = message.obstacle.empty() ? 0 : message.poses.size() / message.obstacle.size();
  for (std::size_t i = 0; i < message.obstacle.size(); ++i)
    if (obstacles_.contains(message.obstacle[i]))
      place_obstacle(message.obstacle[i], std::span(message.poses).subspan(i * values, values));
  return false;
}

bool MomentReader::take(const talus_scene& message) { return counted_only(message); }

bool MomentReader::take(const talus_instruments& message) {
  if (count(message) == Age::newest && instrument_parts_.take(message)) instruments_ = instrument_parts_.all();
  return false;
}

bool MomentReader::take(const talus_contacts& message) {
  if (!limits_.poses) return counted_only(message);
  if (count(message) == Age::newest && contact_parts_.take(message)) contacts_ = contact_parts_.all();
  return false;
}

/// Those of the moment's step, of bodies that it has.
void MomentReader::place_contacts() {
  std::vector<ContactForce<3>>& contacts = moment_.contacts;
  contacts.clear();
  if (contacts_.empty() || contacts_.front().step != moment_.step) return;
  for (const talus_contacts& part : contacts_) append_contacts(part, contacts);
  std::erase_if(contacts, [&](const ContactForce<3>& contact) {
    return std::max(contact.a, contact.b) >= moment_.bodies.size();
  });
}

void MomentReader::place_obstacle(int obstacle, std::span<const float> values) {
  std::vector<int>& moved = moment_.moved_obstacle;
  const auto place = std::ranges::lower_bound(moved, obstacle);
  const auto index = static_cast<std::size_t>(place - moved.begin());
  if (place == moved.end() || *place != obstacle) {
    moved.insert(place, obstacle);
    PoseList& poses = moment_.obstacle_pose;
    poses.resize(moved.size());
    for (std::size_t i = moved.size() - 1; i > index; --i) {
      const std::vector<float> before(poses[i - 1].begin(), poses[i - 1].end());
      poses.set(i, before);
    }
  }
  moment_.obstacle_pose.set(index, values);
}

std::int64_t MomentReader::lost() const {
  std::int64_t sum = 0;
  for (const SequenceTracker& numbers : numbers_) sum = sum_of_counts(sum, numbers.lost());
  return sum;
}

std::int64_t MomentReader::received() const {
  std::int64_t sum = 0;
  for (const SequenceTracker& numbers : numbers_) sum += numbers.received();
  return sum;
}

bool MomentReader::has_all_shapes() const {
  const auto complete = [](const std::map<int, talus_shapes>& known) {
    return known.empty() || static_cast<int>(known.size()) == known.rbegin()->second.total;  // the one told last
  };
  return !shapes_.empty() && complete(shapes_) && complete(obstacles_);
}

bool MomentReader::is_restart(const talus_run& message) const {
  return run_ && message.seq < run_->seq && (message.phase == talus_run::BEGIN || run_->phase == talus_run::END);
}

}  // namespace talus
