#include "common/policy/bearing.h"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

constexpr std::size_t not_a_candidate = static_cast<std::size_t>(-1);

/// How the candidates' weights are borne.
template <int Dim>
class Burdens {
 public:
  Burdens(const std::vector<BodyIndex>& candidates, const BodyStates<Dim>& states)
      : candidates_(candidates), states_(states), on_rest_(candidates.size()), on_awake_(candidates.size()) {}

  void add(const Contact<Dim>& contact) {
    const double lift = height<Dim>(contact.normal_impulse * contact.normal + contact.friction_impulse);
    const BodyIndex borne = lift > 0.0 ? contact.a : contact.b;
    const BodyIndex bearer = lift > 0.0 ? contact.b : contact.a;
    const std::size_t up = place_of(borne);
    if (up == not_a_candidate) return;
    const std::size_t down = place_of(bearer);
    const bool rests = bearer < 0 || states_.asleep[static_cast<std::size_t>(bearer)] != 0 || down != not_a_candidate;
    (rests ? on_rest_ : on_awake_)[up] += std::abs(lift);
    if (down != not_a_candidate) bearings_.push_back({down, up, std::abs(lift)});
  }

  /// To be called once, when all contacts are in.
  void sort() { std::ranges::stable_sort(bearings_, {}, &Bearing::bearer); }

  bool borne(std::size_t candidate, double weight, double awake_share) const {
    return on_rest_[candidate] >= 0.5 * weight && on_awake_[candidate] <= awake_share * weight;
  }

  /// A candidate that stays awake bears as one awake.
  void drop(std::size_t candidate) {
    auto bearing = std::ranges::lower_bound(bearings_, candidate, {}, &Bearing::bearer);
    for (; bearing != bearings_.end() && bearing->bearer == candidate; ++bearing) {
      on_rest_[bearing->borne] -= bearing->load;
      on_awake_[bearing->borne] += bearing->load;
    }
  }

 private:
  struct Bearing {  // of one candidate by another
    std::size_t bearer = 0;
    std::size_t borne = 0;
    double load = 0.0;
  };

  std::size_t place_of(BodyIndex body) const {
    const auto found = std::lower_bound(candidates_.begin(), candidates_.end(), body);
    if (found == candidates_.end() || *found != body) return not_a_candidate;
    return static_cast<std::size_t>(found - candidates_.begin());
  }

  const std::vector<BodyIndex>& candidates_;
  const BodyStates<Dim>& states_;
  std::vector<double> on_rest_;   // [candidate] by ground, obstacles, sleepers, candidates [N s over the step]
  std::vector<double> on_awake_;  // [candidate] by all others [N s]
  std::vector<Bearing> bearings_;
};

}  // namespace

template <int Dim>
void keep_borne(std::span<const Contact<Dim>> contacts, const BodyStates<Dim>& states, std::span<const double> weights,
                double awake_share, std::vector<BodyIndex>& candidates) {
  if (candidates.empty()) return;
  Burdens<Dim> burdens(candidates, states);
  for (const Contact<Dim>& contact : contacts) burdens.add(contact);
  burdens.sort();
  std::vector<std::uint8_t> kept(candidates.size(), 1);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const auto shape = static_cast<std::size_t>(states.shape[static_cast<std::size_t>(candidates[i])]);
      if (kept[i] == 0 || burdens.borne(i, weights[shape], awake_share)) continue;
      kept[i] = 0;
      burdens.drop(i);
      changed = true;
    }
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (kept[i] != 0) candidates[count++] = candidates[i];
  }
  candidates.resize(count);
}

template void keep_borne(std::span<const Contact<2>>, const BodyStates<2>&, std::span<const double>, double,
                         std::vector<BodyIndex>&);
template void keep_borne(std::span<const Contact<3>>, const BodyStates<3>&, std::span<const double>, double,
                         std::vector<BodyIndex>&);

}  // namespace talus
