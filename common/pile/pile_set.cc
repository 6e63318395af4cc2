#include "common/pile/pile_set.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/pile/natural_slope.h"

namespace talus {

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
  piles_.back().held = params.hold_slope;
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
  if (look) look_around(states, dt);
  for (std::size_t p = 0; p < piles_.size(); ++p) grow(p, states);
}

/// A structure of another place, slope or size for the same pile.
template <int Dim>
void PileSet<Dim>::replace(std::size_t pile, Pile<Dim> structure, const BodyStates<Dim>& states) {
  structure.held = ledgers_[pile].params.hold_slope;
  piles_[pile] = std::move(structure);
  recount(pile, states);
}

/// Section 3.2: above the growth ratio N doubles; a pile that fills its walls to the rim stays as it is (3.5).
template <int Dim>
void PileSet<Dim>::grow(std::size_t pile, const BodyStates<Dim>& states) {
  while (piles_[pile].occupation_ratio() > ledgers_[pile].params.growth_ratio) {
    const Pile<Dim>& now = piles_[pile];
    Pile<Dim> larger =
        make_pile<Dim>(now.centre, now.alpha, 2.0 * now.structure_size, body_, ledgers_[pile].params.boundary);
    if (larger.structure_size <= now.structure_size) return;
    replace(pile, std::move(larger), states);
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
