#include "common/pile/pile_set.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "common/pile/natural_slope.h"

namespace talus {

namespace {

constexpr double fixed_point = 65536.0;  // steps per metre: 15 micrometres, and 1e4 m still fits 32 bits

// A centre that moves makes all bodies be counted anew, so it moves seldom and by no less than this share of D.
constexpr int steps_between_looks = 30;
constexpr double least_drift = 0.02;

/// Piles merge when their centres were near at so many looks in a row: piles that just pass stay apart.
constexpr int looks_to_merge = 2;

// A slope that is not given is measured each time that the pile has grown by a tenth, and when it has come to rest; all
// measurements together cost a few dozen passes over the bodies. Until there are enough bodies to tell, it is a usual
// one.
constexpr double usual_slope = std::numbers::pi / 6.0;
constexpr int least_to_measure = 16;
constexpr double growth_to_measure = 1.1;
constexpr double growth_to_measure_at_rest = 1.01;
constexpr double least_turn = std::numbers::pi / 180.0;  // changes below this are not worth a new count

}  // namespace

template <int Dim>
PileSet<Dim>::PileSet(std::vector<PileParams<Dim>> params, const TypicalBody& body)
    : body_(body), steps_to_look_(steps_between_looks) {
  for (const PileParams<Dim>& pile : params) {
    needs_contacts_ = needs_contacts_ || !pile.count_flying.value_or(true) || !pile.alpha;
    if (pile.at) {
      add_pile(pile, *pile.at);
    } else {
      unlocated_.push_back(pile);
    }
  }
}

template <int Dim>
void PileSet<Dim>::add_pile(const PileParams<Dim>& params, const Vec<Dim>& centre) {
  piles_.push_back(
      make_pile<Dim>(centre, params.alpha.value_or(usual_slope), params.initial_size, body_, params.boundary));
  ledgers_.push_back({.params = params});
}

template <int Dim>
void PileSet<Dim>::locate(const Vec<Dim>& landing, const BodyStates<Dim>& states) {
  assert(waiting());
  add_pile(unlocated_.front(), landing);
  unlocated_.erase(unlocated_.begin());
  recount(piles_.size() - 1, states);
}

template <int Dim>
void PileSet<Dim>::land(std::span<const Contact<Dim>> contacts, const BodyStates<Dim>& states) {
  landed_.resize(states.shape.size(), 0);
  for (const Contact<Dim>& contact : contacts) {
    landed_[static_cast<std::size_t>(contact.a)] = 1;
    if (contact.b >= 0) landed_[static_cast<std::size_t>(contact.b)] = 1;
  }
}

template <int Dim>
void PileSet<Dim>::update(const BodyStates<Dim>& states, std::span<const BodyIndex> awake, double dt) {
  const bool look = --steps_to_look_ == 0;
  if (look) steps_to_look_ = steps_between_looks;
  if (awake.empty()) return;
  for (std::size_t p = 0; p < piles_.size(); ++p) {
    ledgers_[p].members.resize(states.shape.size());
    for (const BodyIndex body : awake) count(p, body, membership(p, states, body));
  }
  if (look) {
    for (std::size_t p = 0; p < piles_.size(); ++p) {
      drift(p, states, dt);
      find_slope(p, states);
    }
    if (piles_.size() > 1) merge_near(states);
  }
  for (std::size_t p = 0; p < piles_.size(); ++p) grow(p, states);
}

/// Section 3.2: above the growth ratio N doubles; a pile that fills its walls to the rim stays as it is (3.5).
template <int Dim>
void PileSet<Dim>::grow(std::size_t pile, const BodyStates<Dim>& states) {
  while (piles_[pile].occupation_ratio() > ledgers_[pile].params.growth_ratio) {
    const Pile<Dim>& now = piles_[pile];
    Pile<Dim> larger =
        make_pile<Dim>(now.centre, now.alpha, 2.0 * now.structure_size, body_, ledgers_[pile].params.boundary);
    if (larger.structure_size <= now.structure_size) return;
    piles_[pile] = std::move(larger);
    recount(pile, states);
  }
}

template <int Dim>
void PileSet<Dim>::refresh(const BodyStates<Dim>& states, BodyIndex body) {
  for (std::size_t p = 0; p < piles_.size(); ++p) {
    ledgers_[p].members.resize(states.shape.size());
    count(p, body, membership(p, states, body));
  }
}

template <int Dim>
typename PileSet<Dim>::Membership PileSet<Dim>::membership(std::size_t pile, const BodyStates<Dim>& states,
                                                           BodyIndex body) const {
  const auto i = static_cast<std::size_t>(body);
  Membership now;
  if (states.removed[i] != 0) return now;
  if (!ledgers_[pile].params.count_flying.value_or(true) && (i >= landed_.size() || landed_[i] == 0)) return now;
  const Vec<Dim>& position = states.pose[i].position;
  now.layer = static_cast<std::int16_t>(piles_[pile].layer_of(position));
  now.asleep = states.asleep[i] != 0;
  if (now.layer < 0) return now;
  for (std::size_t axis = 0; axis < now.at.size(); ++axis) {
    now.at[axis] = static_cast<std::int32_t>(std::lround(position[static_cast<Eigen::Index>(axis)] * fixed_point));
  }
  return now;
}

template <int Dim>
void PileSet<Dim>::count(std::size_t pile, BodyIndex body, const Membership& now) {
  Membership& kept = ledgers_[pile].members[static_cast<std::size_t>(body)];
  add(pile, kept, -1);
  add(pile, now, +1);
  kept = now;
}

template <int Dim>
void PileSet<Dim>::add(std::size_t pile, const Membership& member, int sign) {
  if (member.layer < 0) return;
  Layer& layer = piles_[pile].layers[static_cast<std::size_t>(member.layer)];
  layer.count += sign;
  layer.sleeping += member.asleep ? sign : 0;
  Ledger& ledger = ledgers_[pile];
  ledger.count += sign;
  for (std::size_t axis = 0; axis < member.at.size(); ++axis) ledger.sum[axis] += sign * member.at[axis];
}

template <int Dim>
void PileSet<Dim>::recount(std::size_t pile, const BodyStates<Dim>& states) {
  Ledger& ledger = ledgers_[pile];
  for (Layer& layer : piles_[pile].layers) layer.count = layer.sleeping = 0;
  ledger.members.assign(states.shape.size(), {});
  ledger.sum = {};
  ledger.count = 0;
  for (BodyIndex body = 0; body < states.size(); ++body) count(pile, body, membership(pile, states, body));
}

template <int Dim>
void PileSet<Dim>::count_anew(const BodyStates<Dim>& states) {
  for (std::size_t p = 0; p < piles_.size(); ++p) recount(p, states);
}

/// Section 3.2: the centre goes gradually to the horizontal mean of the pile's bodies. Walls hold it in place.
template <int Dim>
void PileSet<Dim>::drift(std::size_t pile, const BodyStates<Dim>& states, double dt) {
  const Ledger& ledger = ledgers_[pile];
  if (ledger.count == 0 || ledger.params.boundary) return;
  Vec<Dim> step = Vec<Dim>::Zero();
  for (std::size_t axis = 0; axis < ledger.sum.size(); ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    step[a] = static_cast<double>(ledger.sum[axis]) / (fixed_point * ledger.count) - piles_[pile].centre[a];
  }
  step *= 1.0 - std::exp(-ledger.params.drift_rate * steps_between_looks * dt);
  if (step.norm() < least_drift * body_.extent) return;
  piles_[pile].centre += step;
  recount(pile, states);
}

/// Section 3.1 has alpha measured on a simulation made before; without one, the pile itself tells. All bodies within
/// twice its radius that have landed count, since a cone of the wrong slope leaves some outside.
template <int Dim>
void PileSet<Dim>::find_slope(std::size_t pile, const BodyStates<Dim>& states) {
  Ledger& ledger = ledgers_[pile];
  const Pile<Dim>& now = piles_[pile];
  if (ledger.params.alpha || now.layers.empty() || ledger.count < least_to_measure) return;
  const bool at_rest = ledger.count == ledger.count_at_look;
  ledger.count_at_look = ledger.count;
  if (ledger.count < (at_rest ? growth_to_measure_at_rest : growth_to_measure) * ledger.measured_count) return;
  ledger.measured_count = ledger.count;
  std::vector<Vec<Dim>> places;
  for (std::size_t i = 0; i < landed_.size(); ++i) {
    if (landed_[i] == 0 || states.removed[i] != 0) continue;
    const Vec<Dim> place = states.pose[i].position - now.centre;
    if (horizontal<Dim>(place).norm() < 2.0 * now.radius) places.push_back(place);
  }
  if (places.empty()) return;
  const double slope = natural_slope<Dim>(places);
  if (std::abs(slope - now.alpha) < least_turn) return;
  piles_[pile] = make_pile<Dim>(now.centre, slope, now.structure_size, body_);
  recount(pile, states);
}

/// Section 3.5: two piles of one kind whose centres lie near each other become one.
template <int Dim>
void PileSet<Dim>::merge_near(const BodyStates<Dim>& states) {
  for (std::size_t a = 0; a < piles_.size(); ++a) {
    for (std::size_t b = a + 1; b < piles_.size(); ++b) {
      if (!may_merge(a, b)) continue;
      if (++ledgers_[b].near_looks < looks_to_merge) continue;
      merge(a, b, states);
    }
  }
}

template <int Dim>
bool PileSet<Dim>::may_merge(std::size_t a, std::size_t b) const {
  const PileParams<Dim>& one = ledgers_[a].params;
  const PileParams<Dim>& other = ledgers_[b].params;
  const bool alive = piles_[a].merged_into < 0 && piles_[b].merged_into < 0;
  if (!alive || one.alpha != other.alpha || one.boundary || other.boundary) return false;
  const double distance = (piles_[a].centre - piles_[b].centre).norm();
  return distance < std::min(one.merge_distance, other.merge_distance) * body_.extent;
}

/// The kept pile moves to the common mean and has room for both.
template <int Dim>
void PileSet<Dim>::merge(std::size_t kept, std::size_t gone, const BodyStates<Dim>& states) {
  const double bodies = ledgers_[kept].count + ledgers_[gone].count;
  const double share = bodies > 0.0 ? ledgers_[gone].count / bodies : 0.5;
  const Vec<Dim> centre = (1.0 - share) * piles_[kept].centre + share * piles_[gone].centre;
  const double size = std::max(piles_[kept].structure_size, piles_[gone].structure_size);
  piles_[kept] = make_pile<Dim>(centre, piles_[kept].alpha, size, body_);
  piles_[gone].layers.clear();
  piles_[gone].merged_into = static_cast<int>(kept);
  recount(kept, states);
  recount(gone, states);
}

template <int Dim>
int PileSet<Dim>::layer_of(std::size_t pile, BodyIndex body) const {
  const std::vector<Membership>& members = ledgers_[pile].members;
  const auto i = static_cast<std::size_t>(body);
  return i < members.size() ? members[i].layer : -1;
}

template <int Dim>
bool PileSet<Dim>::counts_match(const BodyStates<Dim>& states) const {
  PileSet fresh = *this;
  for (std::size_t p = 0; p < piles_.size(); ++p) {
    fresh.recount(p, states);
    if (fresh.ledgers_[p].count != ledgers_[p].count || fresh.ledgers_[p].sum != ledgers_[p].sum) return false;
    for (std::size_t i = 0; i < piles_[p].layers.size(); ++i) {
      const Layer& kept = piles_[p].layers[i];
      const Layer& counted = fresh.piles_[p].layers[i];
      if (kept.count != counted.count || kept.sleeping != counted.sleeping) return false;
    }
  }
  return true;
}

template class PileSet<2>;
template class PileSet<3>;

}  // namespace talus
