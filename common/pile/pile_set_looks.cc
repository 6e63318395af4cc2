#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/pile/natural_slope.h"
#include "common/pile/pile_set.h"

namespace talus {

namespace {

/// A centre that moves makes all bodies be counted anew, so it moves by no less than this share of D.
constexpr double least_drift = 0.02;

/// Piles merge when their centres were near at so many looks in a row: piles that just pass stay apart.
constexpr int looks_to_merge = 2;

// A slope that is not given is measured each time that the pile has grown by a tenth, and when it has come to rest; all
// measurements together cost a few dozen passes over the bodies.
constexpr int least_to_measure = 16;
constexpr double growth_to_measure = 1.1;
constexpr double growth_to_measure_at_rest = 1.01;
constexpr double least_turn = std::numbers::pi / 180.0;  // changes below this are not worth a new count

}  // namespace

/// What changes slowly: where piles lie, how steep they are, which are one.
template <int Dim>
void PileSet<Dim>::look_around(const BodyStates<Dim>& states, double dt) {
  for (std::size_t p = 0; p < piles_.size(); ++p) {
    drift(p, states, dt);
    find_slope(p, states);
  }
  if (piles_.size() > 1) merge_near(states);
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

/// Section 3.1 has alpha measured on a simulation made before; without one, the pile itself tells. All bodies in
/// its reach that have landed count.
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
    if (now.reaches(states.pose[i].position)) places.push_back(states.pose[i].position - now.centre);
  }
  if (places.empty()) return;
  const double slope = natural_slope<Dim>(places);
  if (std::abs(slope - now.alpha) < least_turn) return;
  replace(pile, make_pile<Dim>(now.centre, slope, now.structure_size, body_), states);
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
  const bool alike = one.alpha == other.alpha && one.hold_slope == other.hold_slope;
  if (!alive || !alike || one.boundary || other.boundary) return false;
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
  replace(kept, make_pile<Dim>(centre, piles_[kept].alpha, size, body_), states);
  piles_[gone].held = false;
  piles_[gone].layers.clear();
  piles_[gone].merged_into = static_cast<int>(kept);
  recount(gone, states);
}

template void PileSet<2>::look_around(const BodyStates<2>&, double);
template void PileSet<3>::look_around(const BodyStates<3>&, double);

}  // namespace talus
