#include "common/pile/pile_set.h"

#include <cassert>
#include <cmath>

namespace talus {

namespace {

constexpr double fixed_point = 65536.0;  // steps per metre: 15 micrometres, and 1e4 m still fits 32 bits

// A centre that moves makes all bodies be counted anew, so it moves seldom and by no less than this share of D.
constexpr int drift_interval = 30;
constexpr double least_drift = 0.02;

}  // namespace

template <int Dim>
PileSet<Dim>::PileSet(std::vector<PileParams<Dim>> params, const TypicalBody& body) : body_(body) {
  for (const PileParams<Dim>& pile : params) {
    if (pile.at) {
      add_pile(pile, *pile.at);
    } else {
      unlocated_.push_back(pile);
    }
  }
}

template <int Dim>
void PileSet<Dim>::add_pile(const PileParams<Dim>& params, const Vec<Dim>& centre) {
  piles_.push_back(make_pile<Dim>(centre, params.alpha, params.initial_size, body_));
  ledgers_.push_back({.params = params, .steps_to_drift = drift_interval});
}

template <int Dim>
void PileSet<Dim>::locate(const Vec<Dim>& landing, const BodyStates<Dim>& states) {
  assert(waiting());
  add_pile(unlocated_.front(), landing);
  unlocated_.erase(unlocated_.begin());
  recount(piles_.size() - 1, states);
}

template <int Dim>
void PileSet<Dim>::update(const BodyStates<Dim>& states, std::span<const BodyIndex> awake, double dt) {
  for (std::size_t p = 0; p < piles_.size(); ++p) {
    ledgers_[p].members.resize(states.shape.size());
    for (const BodyIndex body : awake) count(p, body, membership(p, states, body));
    if (drift(p, dt)) recount(p, states);
    while (piles_[p].occupation_ratio() > ledgers_[p].params.growth_ratio) {
      piles_[p] = make_pile<Dim>(piles_[p].centre, piles_[p].alpha, 2.0 * piles_[p].structure_size, body_);
      recount(p, states);
    }
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

/// Section 3.2: the centre goes gradually to the horizontal mean of the pile's bodies. Returns whether it moved.
template <int Dim>
bool PileSet<Dim>::drift(std::size_t pile, double dt) {
  Ledger& ledger = ledgers_[pile];
  if (--ledger.steps_to_drift > 0) return false;
  ledger.steps_to_drift = drift_interval;
  if (ledger.count == 0) return false;
  Vec<Dim> step = Vec<Dim>::Zero();
  for (std::size_t axis = 0; axis < ledger.sum.size(); ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    step[a] = static_cast<double>(ledger.sum[axis]) / (fixed_point * ledger.count) - piles_[pile].centre[a];
  }
  step *= 1.0 - std::exp(-ledger.params.drift_rate * drift_interval * dt);
  if (step.norm() < least_drift * body_.extent) return false;
  piles_[pile].centre += step;
  return true;
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
