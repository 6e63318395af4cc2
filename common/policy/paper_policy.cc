#include "common/policy/paper_policy.h"

#include <algorithm>

namespace talus {

double sleep_score(double density, double closeness, double speed) {
  return density * closeness * (1.0 / (1.0 + speed));
}

namespace {

/// How many layers may sleep: those with sleepers, counted from the bottom without a gap, and the one above.
template <int Dim>
int layers_open_to_sleep(const Pile<Dim>& pile) {
  int open = 1;
  for (const Layer& layer : pile.layers) {
    if (layer.sleeping == 0) break;
    ++open;
  }
  return open;
}

template <int Dim>
std::vector<int> open_layers(std::span<const Pile<Dim>> piles) {
  std::vector<int> open(piles.size());
  std::transform(piles.begin(), piles.end(), open.begin(), layers_open_to_sleep<Dim>);
  return open;
}

}  // namespace

template <int Dim>
PaperPolicy<Dim>::PaperPolicy(const PaperParams& params, const WorldDescription<Dim>& world)
    : params_(params), dt_(world.dt) {}

template <int Dim>
void PaperPolicy<Dim>::decide(const Frame<Dim>& frame, Decision<Dim>& decision) {
  body_rests_from_.resize(frame.world.states().shape.size(), 0);
  pile_calm_from_.resize(frame.piles.piles().size(), 0);
  pile_woken_.assign(frame.piles.piles().size(), 0);
  wake_hit_piles(frame, decision);
  wake_overfull_piles(frame, decision);
  choose_sleepers(frame, decision);
}

/// Section 3.4, momentum: the impact may go through the whole pile in one step, so the whole pile wakes, before the
/// contact exists, so that the impact itself is simulated.
template <int Dim>
void PaperPolicy<Dim>::wake_hit_piles(const Frame<Dim>& frame, Decision<Dim>& decision) {
  for (const BodyIndex body : frame.world.awake()) {
    if (!hits(frame, body)) continue;
    for (const BodyIndex sleeper : near_) {
      for (std::size_t p = 0; p < pile_woken_.size(); ++p)
        if (frame.piles.layer_of(p, sleeper) >= 0) wake(p, SleepCause::momentum, frame, decision);
    }
  }
}

/// Whether `body` carries enough momentum and reaches sleepers within the next step; these are left in near_.
template <int Dim>
bool PaperPolicy<Dim>::hits(const Frame<Dim>& frame, BodyIndex body) {
  const BodyStates<Dim>& states = frame.world.states();
  if (frame.world.shape_of(body).mass * states.velocity[body].norm() <
      params_.wake_speed * frame.piles.typical_body().mass)
    return false;
  Box<Dim> swept = frame.world.bounds_of(body);
  // Two steps ahead: what is decided now is in force for the next step, in which a body reached then must be awake.
  swept.extend(Box<Dim>(swept).translate(2.0 * dt_ * states.velocity[body]));
  near_.clear();
  frame.world.query_box(swept, near_);
  std::erase_if(near_, [&](BodyIndex other) { return states.asleep[other] == 0; });
  return !near_.empty();
}

/// Section 3.4, avalanche: "we temporarily wake up all objects".
template <int Dim>
void PaperPolicy<Dim>::wake_overfull_piles(const Frame<Dim>& frame, Decision<Dim>& decision) {
  const auto piles = frame.piles.piles();
  for (std::size_t p = 0; p < piles.size(); ++p) {
    const std::vector<Layer>& layers = piles[p].layers;
    bool overfull = false;
    for (std::size_t i = 0; i < layers.size() && !overfull; ++i) overfull = layers[i].density() > thresholds(i).wake;
    if (overfull && frame.step >= pile_calm_from_[p]) wake(p, SleepCause::avalanche, frame, decision);
  }
}

template <int Dim>
void PaperPolicy<Dim>::wake(std::size_t pile, SleepCause cause, const Frame<Dim>& frame, Decision<Dim>& decision) {
  if (pile_woken_[pile] != 0) return;
  pile_woken_[pile] = 1;
  pile_calm_from_[pile] = frame.step + params_.awake_steps;
  const BodyStates<Dim>& states = frame.world.states();
  for (BodyIndex body = 0; body < states.size(); ++body) {
    const int layer = frame.piles.layer_of(pile, body);
    if (layer < 0) continue;
    body_rests_from_[body] = frame.step + params_.awake_steps;
    if (states.asleep[body] == 0) continue;
    decision.thaw.push_back({.body = body, .pile = static_cast<int>(pile), .layer = layer, .cause = cause});
  }
}

/// The other two factors of the score are at most 1, so that it exceeds tau only where the density does.
template <int Dim>
LayerThresholds PaperPolicy<Dim>::thresholds(std::size_t layer) const {
  return {.sleep = params_.tau, .wake = params_.avalanche_density_of(layer)};
}

/// Section 3.3. A body in several piles goes by the one that scores it highest.
template <int Dim>
void PaperPolicy<Dim>::choose_sleepers(const Frame<Dim>& frame, Decision<Dim>& decision) const {
  const std::vector<int> open = open_layers(frame.piles.piles());
  for (const BodyIndex body : frame.world.awake()) {
    if (frame.step < body_rests_from_[body]) continue;
    const SleepEvent best = best_score(frame, body, open);
    if (best.pile >= 0 && best.score > params_.tau && frame.may_sleep(body)) decision.freeze.push_back(best);
  }
}

/// Of the piles in whose layers the body may sleep; without one, its pile is -1.
template <int Dim>
SleepEvent PaperPolicy<Dim>::best_score(const Frame<Dim>& frame, BodyIndex body, std::span<const int> open) const {
  const BodyStates<Dim>& states = frame.world.states();
  const auto piles = frame.piles.piles();
  SleepEvent best{.body = body, .cause = SleepCause::score};
  for (std::size_t p = 0; p < piles.size(); ++p) {
    const int layer = frame.piles.layer_of(p, body);
    if (layer < 0 || layer >= open[p]) continue;
    const Layer& slice = piles[p].layers[layer];
    const double closeness = piles[p].closeness(states.pose[body].position, slice);
    const double score = sleep_score(slice.density(), closeness, states.velocity[body].norm());
    if (best.pile < 0 || score > best.score) best.pile = static_cast<int>(p), best.layer = layer, best.score = score;
  }
  return best;
}

template <int Dim>
std::vector<Reading> PaperPolicy<Dim>::readings(const Frame<Dim>& frame, BodyIndex body) const {
  std::vector<Reading> readings;
  const auto piles = frame.piles.piles();
  if (frame.world.states().asleep[body] == 0) {
    const SleepEvent best = best_score(frame, body, open_layers(piles));
    if (best.pile >= 0) readings.push_back({"score now", best.score, params_.tau, "", "sleeps"});
    const double until = body < std::ssize(body_rests_from_) ? static_cast<double>(body_rests_from_[body]) : 0.0;
    const double left = until - static_cast<double>(frame.step);
    if (left > 0.0) readings.push_back({"kept awake for", left, std::nullopt, "steps", "since it woke with its pile"});
  }
  for (std::size_t p = 0; p < piles.size(); ++p) {
    const int layer = frame.piles.layer_of(p, body);
    if (layer >= 0)
      readings.push_back(
          {"density of its layer", piles[p].layers[layer].density(), thresholds(layer).wake, "", "the pile wakes"});
  }
  return readings;
}

template class PaperPolicy<2>;
template class PaperPolicy<3>;

}  // namespace talus
