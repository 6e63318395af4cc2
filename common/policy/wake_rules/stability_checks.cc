#include "common/policy/wake_rules/stability_checks.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace talus {
namespace {

// Times in time_unit() (lab/notes/stability_checks.md).
constexpr double sample_time = 0.8;       // between two samples of the displacement
constexpr double shortest_time = 0.8;     // of a check
constexpr double longest_time = 60.0;     // of a check: some contacts of an engine jitter for ever,
constexpr double longest_loaded = 2.4;    // and of one of a region that moves
constexpr double horizon = 13.0;          // for which the present speed is extrapolated,
constexpr double horizon_slowing = 6.0;   // and if the motion slows down
constexpr double horizon_estimate = 1.5;  // for the estimate of drift: the motion dies out
constexpr double arrival_time = 8.0;      // without arrivals after which a check need not wait
constexpr double rest_time = 0.4;         // at rest, after which an awake body no longer counts as moving

constexpr double slowing = 0.7;  // of the displacement of the sample before: less means that the motion slows down
constexpr double moving_share = 0.15;           // of the bodies of a region that may move when its check begins
constexpr double unchecked_share = 0.2;         // of its sleeping bodies for which a check is worth its cost,
constexpr double unchecked_share_calm = 0.05;   // and without arrivals
constexpr double block_width = 2.5;             // [D]
constexpr double slope_roughness = 1.15;        // of a slope found from the tops of columns, which are single bodies
constexpr double moving_share_estimate = 0.05;  // of the bodies that may be awake in contact when drift is estimated
constexpr std::int64_t averaged_bodies = 300;   // over which found_ averages

// Contacts of a body in a step.
constexpr std::uint8_t touches = 1;
constexpr std::uint8_t touches_body = 2;

/// Bodies that are awake and touch anything.
template <int Dim>
int awake_in_contact(const World<Dim>& world) {
  const BodyStates<Dim>& states = world.states();
  std::vector<std::uint8_t> found(states.asleep.size(), 0);
  const auto add = [&](BodyIndex body) { found[body] = states.asleep[body] == 0 && states.removed[body] == 0 ? 1 : 0; };
  for (const Contact<Dim>& contact : world.contacts()) {
    add(contact.a);
    if (contact.b >= 0) add(contact.b);
  }
  return static_cast<int>(std::ranges::count(found, 1));
}

/// How far a point of a body has moved from where it was at a pose [m], or more.
template <int Dim>
double displacement(const World<Dim>& world, BodyIndex body, const Pose<Dim>& from) {
  return max_displacement<Dim>(from, world.pose_near(body, from.position), 0.5 * world.shape_of(body).extent);
}

}  // namespace

template <int Dim>
StabilityChecks<Dim>::StabilityChecks(const RuleSetup<Dim>& setup)
    : columns_(setup.params.avalanche_width * setup.typical.extent),
      blocks_(block_width * setup.typical.extent),
      tolerance_(setup.params.tolerance * setup.typical.extent),
      extent_(setup.typical.extent),
      loaded_share_(setup.params.loaded_share()) {}

template <int Dim>
typename StabilityChecks<Dim>::Times StabilityChecks<Dim>::times_in(const World<Dim>& world) const {
  const double unit = time_unit(extent_, world);
  const auto steps = [&](double time) { return std::max<std::int64_t>(1, std::llround(time * unit / world.dt())); };
  return {.rest = rest_time * unit,
          .sample = steps(sample_time),
          .shortest_check = steps(shortest_time),
          .longest_check = steps(longest_time),
          .longest_loaded = steps(longest_loaded),
          .arrival = steps(arrival_time)};
}

template <int Dim>
bool StabilityChecks<Dim>::holds(BodyIndex body) const {
  return body < std::ssize(held_) && held_[body] != 0;
}

template <int Dim>
void StabilityChecks<Dim>::forget(BodyIndex body) {
  if (body >= std::ssize(held_)) return;
  held_[body] = 0;
  arrived_[body] = 0;
  checked_[body].reset();
  for (Check& check : checks_)
    std::erase_if(check.members, [body](const Member& member) { return member.body == body; });
}

template <int Dim>
Standing StabilityChecks<Dim>::note_asleep(const World<Dim>& world, BodyIndex body) {
  if (tolerance_ <= 0.0) return Standing::settled;
  checked_.resize(world.states().asleep.size());
  std::optional<Release>& checked = checked_[body];
  if (checked &&
      (displacement(world, body, checked->pose) > tolerance_ || !same_gravity<Dim>(checked->gravity, world.gravity())))
    checked.reset();
  if (checked && !checked->loaded) return Standing::settled;
  may_begin_ = true;
  return checked ? Standing::unchecked : Standing::fresh;
}

template <int Dim>
void StabilityChecks<Dim>::update(const RuleInput<Dim>& in, const RestCriterion<Dim>& rest, SleepLedger<Dim>& sleepers,
                                  RuleOutput<Dim>& out) {
  if (tolerance_ <= 0.0) return;
  held_.resize(in.states().asleep.size(), 0);
  arrived_.resize(held_.size(), 0);
  checked_.resize(held_.size());
  times_ = times_in(in.world);
  if (in.step % times_.sample != 0) return;
  for (Check& check : checks_) release_resting(in, check);
  std::erase_if(checks_, [](const Check& check) { return check.members.empty(); });
  observe_motion(in, rest);
  std::set<Column> waiting;
  for (const auto& [column, count] : sleepers.counts())
    if (count.unchecked > 0) waiting.insert(column);
  may_begin_ = !waiting.empty() && (expects_arrivals(in.step) || !in.world.awake().empty());
  while (!waiting.empty()) {
    const Region region = take_region(sleepers, waiting);
    if (is_quiet(region, in.step)) {
      begin(in, region, false, out);
    } else if (is_loaded(region, in.step)) {
      if (is_steep(in, region)) begin(in, region, true, out);
      for (const Column& column : region.columns) sleepers.settle(column);
    }
  }
  for (const Contact<Dim>& contact : in.contacts) {
    contact_[contact.a] = 0;
    if (contact.b >= 0) contact_[contact.b] = 0;
  }
}

/// Takes a sample, and releases the members of the blocks that have come to rest.
template <int Dim>
void StabilityChecks<Dim>::release_resting(const RuleInput<Dim>& in, Check& check) {
  std::erase_if(check.members, [&](const Member& member) { return in.states().removed[member.body] != 0; });
  std::map<Block, Motion> motion;
  const double pace = static_cast<double>(times_.sample) / static_cast<double>(in.step - check.sampled);
  check.sampled = in.step;
  for (Member& member : check.members) {
    const Pose<Dim>& pose = in.pose_of(member.body);
    const double moved = pace * displacement(in.world, member.body, member.sample);
    motion[blocks_.cell_of(pose.position)].add({.sum = moved, .before = member.moved, .bodies = 1});
    member.moved = moved;
    member.sample = pose;
  }
  const std::int64_t lasted = in.step - check.begun;
  if (lasted < times_.shortest_check) return;
  std::map<Block, Motion> around;
  for (const auto& block : motion) around[block.first] = motion_around(motion, block.first);
  std::erase_if(check.members, [&](const Member& member) {
    const Motion& near = around[blocks_.cell_of(member.sample.position)];
    if (!has_passed(check, near, lasted)) return false;
    const double expected = near.mean() * horizon_estimate / sample_time;
    release(in, member, {member.sample, expected, check.loaded, in.world.gravity()});
    return true;
  });
}

/// Whether a check that began `lasted` steps ago may release the bodies of a block, by the motion near them.
template <int Dim>
bool StabilityChecks<Dim>::has_passed(const Check& check, const Motion& near, std::int64_t lasted) const {
  const bool slows = near.sum <= slowing * near.before;
  const double to_come = near.mean() * (slows || check.loaded ? horizon_slowing : horizon) / sample_time;
  return to_come <= tolerance_ || lasted >= (check.loaded ? times_.longest_loaded : times_.longest_check);
}

/// That of the bodies in a block and in those around it: one body that is still moving does not keep the others awake,
/// and a slope is seen as a whole.
template <int Dim>
typename StabilityChecks<Dim>::Motion StabilityChecks<Dim>::motion_around(const std::map<Block, Motion>& motion,
                                                                          const Block& block) const {
  Motion near;
  for (const Block& beside : Blocks::around(block))
    if (const auto found = motion.find(beside); found != motion.end()) near.add(found->second);
  return near;
}

template <int Dim>
void StabilityChecks<Dim>::release(const RuleInput<Dim>& in, const Member& member, const Release& release) {
  held_[member.body] = 0;
  checked_[member.body] = release;
  if (!member.slept || release.loaded) return;
  found_count_ = std::min(found_count_ + 1, averaged_bodies);
  found_ += (displacement(in.world, member.body, *member.slept) - found_) / static_cast<double>(found_count_);
}

template <int Dim>
std::optional<double> StabilityChecks<Dim>::expected_motion(BodyIndex body) const {
  if (body >= std::ssize(checked_) || !checked_[body] || checked_[body]->loaded) return std::nullopt;
  return checked_[body]->expected;
}

template <int Dim>
std::optional<DriftEstimate> StabilityChecks<Dim>::drift_estimate(const World<Dim>& world) const {
  if (tolerance_ <= 0.0) return std::nullopt;
  const BodyStates<Dim>& states = world.states();
  double drift = 0.0;
  int sleeping = 0;
  int checked = 0;
  for (BodyIndex body = 0; body < states.size(); ++body) {
    if (states.asleep[body] == 0 || states.removed[body] != 0) continue;
    ++sleeping;
    const std::optional<double> expected = expected_motion(body);
    checked += expected ? 1 : 0;
    drift += expected.value_or(found_);
  }
  const int moving = awake_in_contact(world);
  if (moving > moving_share_estimate * (sleeping + moving)) return std::nullopt;
  if (sleeping == 0) return DriftEstimate{.drift = 0.0, .checked_share = 1.0};
  if (checked < sleeping && found_count_ == 0) return std::nullopt;
  return DriftEstimate{.drift = drift / sleeping, .checked_share = static_cast<double>(checked) / sleeping};
}

/// Finds where bodies move in contact with others, and whether bodies are on their way to a first contact.
template <int Dim>
void StabilityChecks<Dim>::observe_motion(const RuleInput<Dim>& in, const RestCriterion<Dim>& rest) {
  contact_.resize(held_.size(), 0);
  for (const Contact<Dim>& contact : in.contacts) {
    contact_[contact.a] |= touches;
    if (contact.b < 0) continue;
    contact_[contact.a] |= touches_body;
    contact_[contact.b] |= touches | touches_body;
  }
  moving_.clear();
  for (const BodyIndex body : in.world.awake()) {
    if (contact_[body] != 0) arrived_[body] = 1;
    if (arrived_[body] == 0) last_arrival_ = in.step;
    const bool moves = !holds(body) && rest.time_at_rest(body) < times_.rest;
    if (moves && (contact_[body] & touches_body) != 0) ++moving_[columns_.cell_of(in.pose_of(body).position)];
  }
  under_check_.clear();
  for (const Check& check : checks_)
    for (const Member& member : check.members) under_check_.insert(columns_.cell_of(member.sample.position));
}

/// Takes a set of connected columns out of `waiting`, and adds the columns around them.
template <int Dim>
typename StabilityChecks<Dim>::Region StabilityChecks<Dim>::take_region(const SleepLedger<Dim>& sleepers,
                                                                        std::set<Column>& waiting) const {
  std::vector<Column> connected = {*waiting.begin()};
  waiting.erase(waiting.begin());
  std::set<Column> all;
  for (std::size_t i = 0; i < connected.size(); ++i) {
    for (const Column& beside : Columns::around(connected[i])) {
      all.insert(beside);
      if (waiting.erase(beside) > 0) connected.push_back(beside);
    }
  }
  Region region{.columns = {all.begin(), all.end()}, .sleepers = {}};
  for (const Column& column : connected) {
    region.sleepers.unchecked += sleepers.count(column).unchecked;
    region.sleepers.fresh += sleepers.count(column).fresh;
  }
  for (const Column& column : region.columns) {
    region.sleepers.sleeping += sleepers.count(column).sleeping;
    if (const auto moving = moving_.find(column); moving != moving_.end()) region.moving += moving->second;
    region.under_check = region.under_check || under_check_.contains(column);
  }
  return region;
}

template <int Dim>
bool StabilityChecks<Dim>::is_quiet(const Region& region, std::int64_t step) const {
  if (region.under_check) return false;
  const bool arrivals = expects_arrivals(step);
  if (region.sleepers.unchecked < (arrivals ? unchecked_share : unchecked_share_calm) * region.sleepers.sleeping)
    return false;
  if (region.moving == 0) return true;
  return !arrivals && region.moving <= moving_share * (region.moving + region.sleepers.sleeping);
}

/// Whether enough bodies of a region are fresh for a check while others still arrive.
template <int Dim>
bool StabilityChecks<Dim>::is_loaded(const Region& region, std::int64_t step) const {
  if (region.under_check || !expects_arrivals(step)) return false;
  return region.sleepers.fresh >= loaded_share_ * region.sleepers.sleeping;
}

/// Whether the surface is steeper than friction alone holds: the root mean square of its slope from column to column,
/// against the tangent of the slope that two bodies of the lowest friction in the region hold on each other.
template <int Dim>
bool StabilityChecks<Dim>::is_steep(const RuleInput<Dim>& in, const Region& region) {
  std::map<Column, Surface> surfaces;
  for (const Column& column : region.columns)
    if (const auto surface = surface_of(in, column)) surfaces[column] = *surface;
  double squares = 0.0;
  int pairs = 0;
  double friction = std::numeric_limits<double>::infinity();
  for (const auto& [column, surface] : surfaces) {
    friction = std::min(friction, surface.friction);
    for (std::size_t axis = 0; axis < column.size(); ++axis) {
      Column next = column;
      ++next[axis];
      const auto beside = surfaces.find(next);
      if (beside == surfaces.end()) continue;
      const double rise = beside->second.top - surface.top;
      squares += rise * rise;
      ++pairs;
    }
  }
  const double slope = std::sqrt((Dim - 1) * squares / std::max(1, pairs)) / columns_.width();
  return slope > slope_roughness * pair_friction(friction, friction);
}

/// None where no body sleeps.
template <int Dim>
std::optional<typename StabilityChecks<Dim>::Surface> StabilityChecks<Dim>::surface_of(const RuleInput<Dim>& in,
                                                                                       const Column& column) {
  std::optional<Surface> surface;
  near_.clear();
  in.world.query_box(columns_.template box_of<Dim>(column, column), near_);
  for (const BodyIndex body : near_) {
    const Vec<Dim>& position = in.pose_of(body).position;
    if (!in.asleep(body) || columns_.cell_of(position) != column) continue;
    if (!surface) surface.emplace();
    surface->top = std::max(surface->top, height<Dim>(position));
    surface->friction = std::min(surface->friction, in.shape_of(body).material.friction);
  }
  return surface;
}

/// Wakes the bodies of a region and holds them, and those that are awake in contact.
template <int Dim>
void StabilityChecks<Dim>::begin(const RuleInput<Dim>& in, const Region& region, bool loaded, RuleOutput<Dim>& out) {
  Check check{.members = {}, .begun = in.step, .sampled = in.step, .loaded = loaded};
  for (const Column& column : region.columns) {
    near_.clear();
    in.world.query_box(columns_.template box_of<Dim>(column, column), near_);
    for (const BodyIndex body : near_) {
      const Pose<Dim>& pose = in.pose_of(body);
      if (columns_.cell_of(pose.position) != column) continue;
      const bool slept = in.asleep(body);
      if (!slept && contact_[body] == 0) continue;
      if (slept) out.wakes.try_emplace(body, Wake{.cause = SleepCause::check});
      check.members.push_back({.body = body, .sample = pose, .slept = slept ? std::optional(pose) : std::nullopt});
      held_[body] = 1;
    }
  }
  if (check.members.empty()) return;
  checks_.push_back(std::move(check));
  // The next region of this step may overlap this one.
  under_check_.insert(region.columns.begin(), region.columns.end());
}

template class StabilityChecks<2>;
template class StabilityChecks<3>;

}  // namespace talus
