#include "common/policy/wake_rules/local_avalanches.h"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

/// Height [m] of the highest wall of a pile between two points, of which only the horizontal parts count; none if no
/// wall separates them.
template <int Dim>
std::optional<double> wall_between(std::span<const Pile<Dim>> piles, const Vec<Dim>& a, const Vec<Dim>& b) {
  std::optional<double> highest;
  for (const Pile<Dim>& pile : piles) {
    if (!pile.boundary) continue;
    const auto within = [&](const Vec<Dim>& point) {
      return pile.boundary->gauge(horizontal<Dim>(Vec<Dim>(point - pile.centre))) <= 1.0;
    };
    const double rim = height<Dim>(pile.centre) + pile.boundary->rim;
    if (within(a) != within(b)) highest = std::max(highest.value_or(rim), rim);
  }
  return highest;
}

}  // namespace

template <int Dim>
LocalAvalanches<Dim>::LocalAvalanches(const RuleSetup<Dim>& setup)
    : grid_(setup.params.avalanche_width * setup.typical.extent),
      growth_(setup.params.avalanche_growth),
      angle_(setup.params.avalanche_angle),
      ground_(setup.world.ground.height) {}

template <int Dim>
void LocalAvalanches<Dim>::update(const RuleInput<Dim>& in, const SleepLedger<Dim>& sleepers, RuleOutput<Dim>& out) {
  for (const Cell& cell : grown_)
    if (sleepers.count(cell).sleeping >= growth_ * columns_[cell].last_checked) check_column(in, cell, out);
  grown_.clear();
}

/// Wakes a column with those around it if it is steep.
template <int Dim>
void LocalAvalanches<Dim>::check_column(const RuleInput<Dim>& in, const Cell& cell, RuleOutput<Dim>& out) {
  collect_neighbourhood(in, cell);
  columns_[cell].note_check(neighbourhood_[cell].bodies.size());
  if (mostly_awake() || !is_steep(in.piles, cell)) return;
  for (const auto& [place, stack] : neighbourhood_) {
    for (const BodyIndex body : stack.bodies) out.wakes.try_emplace(body, Wake{.cause = SleepCause::avalanche});
    columns_[place].note_check(stack.bodies.size());
  }
}

/// Whether the neighbourhood holds more awake than sleeping bodies.
template <int Dim>
bool LocalAvalanches<Dim>::mostly_awake() const {
  std::size_t asleep = 0;
  for (const auto& [place, stack] : neighbourhood_) asleep += stack.bodies.size();
  return awake_near_ > asleep;
}

/// Whether the column in the middle of the neighbourhood is steep towards one of the others.
template <int Dim>
bool LocalAvalanches<Dim>::is_steep(std::span<const Pile<Dim>> piles, const Cell& cell) const {
  const double top = neighbourhood_.at(cell).top.value_or(ground_);
  const Vec<Dim> middle = grid_.template middle_of<Dim>(cell);
  const double rise = grid_.width() * std::tan(angle_);
  return std::ranges::any_of(neighbourhood_, [&](const auto& beside) {
    const double wall = wall_between(piles, middle, grid_.template middle_of<Dim>(beside.first)).value_or(ground_);
    return top - std::max(beside.second.top.value_or(ground_), wall) > rise;
  });
}

template <int Dim>
void LocalAvalanches<Dim>::collect_neighbourhood(const RuleInput<Dim>& in, const Cell& cell) {
  neighbourhood_.clear();
  Cell first = cell;
  Cell last = cell;
  for (int& number : first) --number;
  for (int& number : last) ++number;
  for (const Cell& beside : Columns::around(cell)) neighbourhood_[beside];
  near_.clear();
  awake_near_ = 0;
  in.world.query_box(grid_.template box_of<Dim>(first, last), near_);
  for (const BodyIndex body : near_) {
    if (!in.asleep(body)) {
      ++awake_near_;
      continue;
    }
    const Vec<Dim>& position = in.pose_of(body).position;
    const auto found = neighbourhood_.find(grid_.cell_of(position));
    if (found == neighbourhood_.end()) continue;
    Stack& stack = found->second;
    const double z = height<Dim>(position);
    stack.bodies.push_back(body);
    stack.top = std::max(stack.top.value_or(z), z);
  }
}

template class LocalAvalanches<2>;
template class LocalAvalanches<3>;

}  // namespace talus
