#include "common/pile/pile_set.h"

#include <algorithm>
#include <cassert>
#include <numbers>

#include "common/pile/angle_of_repose.h"

namespace talus {
namespace {

/// Least distance by which a centre drifts [D]. A drift makes all bodies be recounted, so smaller ones wait.
constexpr double min_drift = 0.02;

/// Piles merge when their centres were near at so many slow updates in a row: piles that pass each other stay apart.
constexpr int updates_to_merge = 2;

// A slope that is not given is measured each time that the pile has grown by a tenth, and by a hundredth if the pile
// has stopped growing. All measurements of a run together cost a few dozen passes over the bodies.
constexpr double growth_to_measure = 1.1;
constexpr double growth_to_measure_at_rest = 1.01;
constexpr double min_slope_change = std::numbers::pi / 180.0;  // [rad]; less is not worth a recount

}  // namespace

template <int Dim>
PileSet<Dim>::PileSet(std::vector<PileParams<Dim>> params, const TypicalBody& body, bool count_flying)
    : body_(body), count_flying_(count_flying) {
  for (const PileParams<Dim>& pile : params)
    if (pile.at)
      add_pile(pile, *pile.at);
    else
      unplaced_.push_back(pile);
}

template <int Dim>
void PileSet<Dim>::count_flying(bool flying, const BodyStates<Dim>& states) {
  if (flying == count_flying_) return;
  count_flying_ = flying;
  recount_all(states);
}

template <int Dim>
bool PileSet<Dim>::needs_contacts() const {
  return std::ranges::any_of(records_, [this](const Record& each) { return needs_contacts(each.params); }) ||
         std::ranges::any_of(unplaced_, [this](const PileParams<Dim>& each) { return needs_contacts(each); });
}

template <int Dim>
bool PileSet<Dim>::needs_contacts(const PileParams<Dim>& params) const {
  return !counts_flying(params) || !params.alpha || params.control_slope;
}

template <int Dim>
void PileSet<Dim>::add_pile(const PileParams<Dim>& params, const Vec<Dim>& centre) {
  piles_.push_back(make_pile<Dim>(centre, params.alpha.value_or(default_angle_of_repose), params.initial_size, body_,
                                  params.boundary));
  piles_.back().slope_controlled = params.control_slope;
  records_.push_back({.params = params});
}

template <int Dim>
void PileSet<Dim>::place(const Vec<Dim>& landing, const BodyStates<Dim>& states) {
  assert(has_unplaced());
  add_pile(unplaced_.front(), landing);
  unplaced_.erase(unplaced_.begin());
  recount(piles_.size() - 1, states);
}

template <int Dim>
void PileSet<Dim>::note_contacts(std::span<const Contact<Dim>> contacts, const BodyStates<Dim>& states) {
  for (const Contact<Dim>& contact : contacts) {
    note_touch(states, contact.a);
    if (contact.b >= 0) note_touch(states, contact.b);
  }
}

template <int Dim>
void PileSet<Dim>::note_touch(const BodyStates<Dim>& states, BodyIndex body) {
  if (has_touched_.size() < states.shape.size()) has_touched_.resize(states.shape.size(), 0);
  if (has_touched_[body] != 0) return;
  has_touched_[body] = 1;
  if (states.asleep[body] != 0) recount_body(states, body);  // update() recounts the awake bodies only
}

template <int Dim>
void PileSet<Dim>::forget(BodyIndex body) {
  if (body < std::ssize(has_touched_)) has_touched_[body] = 0;
}

template <int Dim>
void PileSet<Dim>::update(const BodyStates<Dim>& states, std::span<const BodyIndex> awake, double dt, double times) {
  const std::int64_t steps = steps_between_slow_updates(dt * times);
  const bool slow_update_due = ++since_slow_update_ >= steps;
  if (slow_update_due) since_slow_update_ = 0;
  if (awake.empty()) return;
  for (std::size_t p = 0; p < piles_.size(); ++p) {
    records_[p].counts.resize(states.shape.size());
    for (const BodyIndex body : awake) records_[p].counts.count(piles_[p], body, counted_now(p, states, body));
  }
  if (slow_update_due) update_slowly(states, static_cast<double>(steps) * dt);
  for (std::size_t p = 0; p < piles_.size(); ++p) grow(p, states);
}

/// Gives a pile a structure of another place, slope or size.
template <int Dim>
void PileSet<Dim>::replace(std::size_t pile, Pile<Dim> structure, const BodyStates<Dim>& states) {
  structure.slope_controlled = records_[pile].params.control_slope;
  piles_[pile] = std::move(structure);
  recount(pile, states);
}

/// Section 3.2: above the growth ratio N doubles. A pile that fills its walls to the rim stays as it is (3.5).
template <int Dim>
void PileSet<Dim>::grow(std::size_t pile, const BodyStates<Dim>& states) {
  const PileParams<Dim>& params = records_[pile].params;
  while (piles_[pile].occupation_ratio() > params.growth_ratio) {
    const Pile<Dim>& now = piles_[pile];
    Pile<Dim> larger = make_pile<Dim>(now.centre, now.alpha, 2.0 * now.structure_size, body_, params.boundary);
    if (larger.structure_size <= now.structure_size) return;
    replace(pile, std::move(larger), states);
  }
}

template <int Dim>
CountedAs<Dim> PileSet<Dim>::counted_now(std::size_t pile, const BodyStates<Dim>& states, BodyIndex body) const {
  if (states.removed[body] != 0) return {};
  if (!has_touched(body) && !counts_flying(records_[pile].params)) return {};
  return counted_as(piles_[pile], states, body);
}

template <int Dim>
void PileSet<Dim>::recount(std::size_t pile, const BodyStates<Dim>& states) {
  PileCounts<Dim>& counts = records_[pile].counts;
  counts.clear(piles_[pile], states.shape.size());
  for (BodyIndex body = 0; body < states.size(); ++body)
    counts.count(piles_[pile], body, counted_now(pile, states, body));
}

template <int Dim>
void PileSet<Dim>::recount_all(const BodyStates<Dim>& states) {
  for (std::size_t p = 0; p < piles_.size(); ++p) recount(p, states);
}

template <int Dim>
void PileSet<Dim>::recount_body(const BodyStates<Dim>& states, BodyIndex body) {
  for (std::size_t p = 0; p < piles_.size(); ++p) {
    records_[p].counts.resize(states.shape.size());
    records_[p].counts.count(piles_[p], body, counted_now(p, states, body));
  }
}

template <int Dim>
bool PileSet<Dim>::counts_match(const BodyStates<Dim>& states) const {
  PileSet fresh = *this;
  for (std::size_t p = 0; p < piles_.size(); ++p) {
    fresh.recount(p, states);
    if (!fresh.records_[p].counts.same_totals(records_[p].counts)) return false;
    for (std::size_t i = 0; i < piles_[p].layers.size(); ++i) {
      const Layer& kept = piles_[p].layers[i];
      const Layer& counted = fresh.piles_[p].layers[i];
      if (kept.count != counted.count || kept.sleeping != counted.sleeping) return false;
    }
  }
  return true;
}

/// What changes slowly: the piles' places, their slopes, and which of them are one.
template <int Dim>
void PileSet<Dim>::update_slowly(const BodyStates<Dim>& states, double time) {
  for (std::size_t p = 0; p < piles_.size(); ++p) {
    drift(p, states, time);
    update_slope(p, states);
  }
  if (piles_.size() > 1) merge_near(states);
}

/// Section 3.2: the centre approaches the horizontal mean of the pile's bodies. Walls hold it in place.
template <int Dim>
void PileSet<Dim>::drift(std::size_t pile, const BodyStates<Dim>& states, double time) {
  const Record& record = records_[pile];
  if (record.counts.bodies() == 0 || record.params.boundary) return;
  Vec<Dim> step = Vec<Dim>::Zero();
  for (Eigen::Index axis = 0; axis < Dim - 1; ++axis) step[axis] = record.counts.mean(axis) - piles_[pile].centre[axis];
  step *= 1.0 - std::exp(-record.params.drift_rate * time);
  if (step.norm() < min_drift * body_.extent) return;
  piles_[pile].centre += step;
  recount(pile, states);
}

/// Section 3.1 measures alpha in a simulation made before. Without one it is measured on the pile itself, over all
/// bodies in its reach that have touched something.
template <int Dim>
void PileSet<Dim>::update_slope(std::size_t pile, const BodyStates<Dim>& states) {
  Record& record = records_[pile];
  const Pile<Dim>& now = piles_[pile];
  const int count = record.counts.bodies();
  if (record.params.alpha || now.layers.empty() || count < static_cast<int>(min_bodies_for_slope)) return;
  const bool at_rest = count == record.last_count;
  record.last_count = count;
  if (count < (at_rest ? growth_to_measure_at_rest : growth_to_measure) * record.measured_count) return;
  record.measured_count = count;
  std::vector<Vec<Dim>> positions;
  for (std::size_t i = 0; i < has_touched_.size(); ++i) {
    if (has_touched_[i] == 0 || states.removed[i] != 0) continue;
    if (now.reaches(states.pose[i].position)) positions.push_back(states.pose[i].position - now.centre);
  }
  if (positions.empty()) return;
  const double slope = estimate_angle_of_repose<Dim>(positions);
  if (std::abs(slope - now.alpha) < min_slope_change) return;
  replace(pile, make_pile<Dim>(now.centre, slope, now.structure_size, body_), states);
}

/// Section 3.5: two piles of one kind whose centres lie near each other become one.
template <int Dim>
void PileSet<Dim>::merge_near(const BodyStates<Dim>& states) {
  for (std::size_t b = 1; b < piles_.size(); ++b) {
    std::size_t a = 0;
    while (a < b && !may_merge(a, b)) ++a;
    int& updates = records_[b].near_updates;
    updates = a < b ? updates + 1 : 0;
    if (updates >= updates_to_merge) merge(a, b, states);
  }
}

template <int Dim>
bool PileSet<Dim>::may_merge(std::size_t a, std::size_t b) const {
  const PileParams<Dim>& one = records_[a].params;
  const PileParams<Dim>& other = records_[b].params;
  const bool alive = piles_[a].merged_into < 0 && piles_[b].merged_into < 0;
  const bool alike = one.alpha == other.alpha && one.control_slope == other.control_slope;
  if (!alive || !alike || one.boundary || other.boundary) return false;
  const double distance = (piles_[a].centre - piles_[b].centre).norm();
  return distance < std::min(one.merge_distance, other.merge_distance) * body_.extent;
}

/// The kept pile moves to the common mean and has room for both.
template <int Dim>
void PileSet<Dim>::merge(std::size_t kept, std::size_t gone, const BodyStates<Dim>& states) {
  const double gone_bodies = records_[gone].counts.bodies();
  const double bodies = records_[kept].counts.bodies() + gone_bodies;
  const double share = bodies > 0.0 ? gone_bodies / bodies : 0.5;
  const Vec<Dim> centre = (1.0 - share) * piles_[kept].centre + share * piles_[gone].centre;
  const double size = std::max(piles_[kept].structure_size, piles_[gone].structure_size);
  replace(kept, make_pile<Dim>(centre, piles_[kept].alpha, size, body_), states);
  piles_[gone].slope_controlled = false;
  piles_[gone].layers.clear();
  piles_[gone].merged_into = static_cast<int>(kept);
  recount(gone, states);
}

template class PileSet<2>;
template class PileSet<3>;

}  // namespace talus
