#include "common/policy/adaptive/support_criterion.h"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

/// Least part of a body's weight that bodies at rest must carry. A body at rest on a supporter that sleeps is carried
/// in full; half leaves room for the solver's noise and keeps a body at the top of a bounce awake. Chosen, not
/// measured.
constexpr double least_rest_share = 0.5;

constexpr std::size_t not_a_candidate = -1;

/// Which candidate carries which, and how much of each one's weight bodies at rest and awake bodies carry.
template <int Dim>
class SupportGraph {
 public:
  SupportGraph(const RuleInput<Dim>& in, const std::vector<BodyIndex>& candidates)
      : in_(in), candidates_(candidates), load_on_rest_(candidates.size()), load_on_awake_(candidates.size()) {
    for (const Contact<Dim>& contact : in.contacts) add(contact);
    std::ranges::stable_sort(edges_, {}, &Edge::supporter);
  }

  bool supported(std::size_t candidate, double weight, double awake_share) const {
    return load_on_rest_[candidate] >= least_rest_share * weight && load_on_awake_[candidate] <= awake_share * weight;
  }

  /// From now on counts a candidate among those that stay awake.
  void keep_awake(std::size_t candidate) {
    auto edge = std::ranges::lower_bound(edges_, candidate, {}, &Edge::supporter);
    for (; edge != edges_.end() && edge->supporter == candidate; ++edge) {
      load_on_rest_[edge->supported] -= edge->load;
      load_on_awake_[edge->supported] += edge->load;
    }
  }

 private:
  /// One candidate carries another.
  struct Edge {
    std::size_t supporter = 0;
    std::size_t supported = 0;
    double load = 0.0;  // impulse against gravity over the step [N s]
  };

  void add(const Contact<Dim>& contact) {
    const double lift = in_.rise(contact.normal_impulse * contact.normal + contact.friction_impulse);
    const BodyIndex supporter = lift > 0.0 ? contact.b : contact.a;
    const std::size_t up = candidate_of(lift > 0.0 ? contact.a : contact.b);
    if (up == not_a_candidate) return;
    const std::size_t down = candidate_of(supporter);
    const bool at_rest = supporter < 0 || in_.asleep(supporter) || down != not_a_candidate;
    (at_rest ? load_on_rest_ : load_on_awake_)[up] += std::abs(lift);
    if (down != not_a_candidate) edges_.push_back({down, up, std::abs(lift)});
  }

  std::size_t candidate_of(BodyIndex body) const {
    const auto found = std::lower_bound(candidates_.begin(), candidates_.end(), body);
    if (found == candidates_.end() || *found != body) return not_a_candidate;
    return found - candidates_.begin();
  }

  const RuleInput<Dim>& in_;
  const std::vector<BodyIndex>& candidates_;
  std::vector<double> load_on_rest_;   // [candidate] carried by ground, obstacles, sleepers, candidates [N s]
  std::vector<double> load_on_awake_;  // [candidate] carried by all others [N s]
  std::vector<Edge> edges_;            // ascending by supporter
};

}  // namespace

template <int Dim>
SupportCriterion<Dim>::SupportCriterion(const RuleSetup<Dim>& setup) : awake_share_(setup.params.awake_share) {}

template <int Dim>
void SupportCriterion<Dim>::keep_supported(const RuleInput<Dim>& in, std::vector<BodyIndex>& candidates) const {
  if (candidates.empty()) return;
  SupportGraph<Dim> graph(in, candidates);
  std::vector<std::uint8_t> kept(candidates.size(), 1);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const double weight = in.shape_of(candidates[i]).mass * in.world.gravity_size() * in.world.dt();
      if (kept[i] == 0 || graph.supported(i, weight, awake_share_)) continue;
      kept[i] = 0;
      graph.keep_awake(i);
      changed = true;
    }
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (kept[i] != 0) candidates[count++] = candidates[i];
  candidates.resize(count);
}

template class SupportCriterion<2>;
template class SupportCriterion<3>;

}  // namespace talus
