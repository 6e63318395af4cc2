#include "common/policy/local_avalanches.h"

#include <algorithm>
#include <cmath>

#include "common/policy/containment.h"

namespace talus {
namespace {

constexpr double far_away = 1e9;  // [m, columns]; as an int and as an engine's float still a number

/// The column and those that share an edge or a corner with it.
template <std::size_t Axes>
std::vector<std::array<int, Axes>> around(const std::array<int, Axes>& cell) {
  std::vector<std::array<int, Axes>> cells = {cell};
  for (std::size_t axis = 0; axis < Axes; ++axis) {
    const std::size_t known = cells.size();
    for (const int step : {-1, 1}) {
      for (std::size_t i = 0; i < known; ++i) {
        cells.push_back(cells[i]);
        cells.back()[axis] += step;
      }
    }
  }
  return cells;
}

}  // namespace

template <int Dim>
LocalAvalanches<Dim>::LocalAvalanches(const AdaptiveParams& params, double extent, double ground)
    : extent_(extent),
      width_(params.avalanche_width * extent),
      growth_(params.avalanche_growth),
      growth_quiet_(params.avalanche_growth_quiet),
      angle_(params.avalanche_angle),
      ground_(ground) {}

template <int Dim>
typename LocalAvalanches<Dim>::Cell LocalAvalanches<Dim>::cell_of(const Vec<Dim>& position) const {
  Cell cell;
  for (std::size_t axis = 0; axis < cell.size(); ++axis) {
    const double column = std::floor(position[static_cast<Eigen::Index>(axis)] / width_);
    cell[axis] = static_cast<int>(std::clamp(column, -far_away, far_away));
  }
  return cell;
}

template <int Dim>
void LocalAvalanches<Dim>::note(const BodyStates<Dim>& states, std::span<const SleepEvent> falling_asleep,
                                std::span<const SleepEvent> waking) {
  const auto cell = [&](const SleepEvent& event) {
    return cell_of(states.pose[static_cast<std::size_t>(event.body)].position);
  };
  for (const SleepEvent& event : waking) --columns_[cell(event)].sleepers;
  for (const SleepEvent& event : falling_asleep) {
    grown_.push_back(cell(event));
    ++columns_[grown_.back()].sleepers;
  }
}

template <int Dim>
void LocalAvalanches<Dim>::update(const World<Dim>& world, std::span<const Pile<Dim>> piles, bool quiet,
                                  std::vector<BodyIndex>& sliding) {
  for (const Cell& cell : grown_) ask(world, piles, cell, growth_ * columns_[cell].looked_at, quiet, sliding);
  unasked_.insert(grown_.begin(), grown_.end());
  grown_.clear();
  if (quiet) {
    for (const Cell& cell : unasked_) {
      if (slope_held(piles, middle_of(cell)) > angle_) continue;  // who asks again and again brings it down
      const int last = columns_[cell].looked_at;
      ask(world, piles, cell, std::max(last + 1.0, growth_quiet_ * last), true, sliding);
    }
    unasked_.clear();
  }
  std::sort(sliding.begin(), sliding.end());
  sliding.erase(std::unique(sliding.begin(), sliding.end()), sliding.end());
}

/// Looks at a column that holds `enough` sleepers, and appends it with those around it where it is steep.
template <int Dim>
void LocalAvalanches<Dim>::ask(const World<Dim>& world, std::span<const Pile<Dim>> piles, const Cell& cell,
                               double enough, bool quiet, std::vector<BodyIndex>& sliding) {
  Column& column = columns_[cell];
  if (column.sleepers < enough) return;
  gather(world, cell);
  const std::size_t found = neighbourhood_[cell].bodies.size();
  column.sleepers = static_cast<int>(found);
  if (column.sleepers < enough) return;
  column.note_look(found);
  if ((!quiet && mostly_awake()) || !is_steep(piles, cell)) return;
  for (const auto& [place, stack] : neighbourhood_) {
    sliding.insert(sliding.end(), stack.bodies.begin(), stack.bodies.end());
    columns_[place].note_look(stack.bodies.size());
  }
}

/// Whether more are awake than asleep in the neighbourhood that is gathered.
template <int Dim>
bool LocalAvalanches<Dim>::mostly_awake() const {
  std::size_t asleep = 0;
  for (const auto& [place, stack] : neighbourhood_) asleep += stack.bodies.size();
  return awake_near_ > asleep;
}

/// Of the column whose neighbourhood is gathered.
template <int Dim>
bool LocalAvalanches<Dim>::is_steep(std::span<const Pile<Dim>> piles, const Cell& cell) const {
  const double top = neighbourhood_.at(cell).top.value_or(ground_);
  const Vec<Dim> middle = middle_of(cell);
  const double held = slope_held(piles, middle);
  // The tops are single bodies, each of which may stand out of a slope that is held.
  const double rise = held > angle_ ? width_ * std::tan(held) + 2.0 * extent_ : width_ * std::tan(angle_);
  return std::ranges::any_of(neighbourhood_, [&](const auto& beside) {
    const double wall = wall_between(piles, middle, middle_of(beside.first)).value_or(ground_);
    return top - std::max(beside.second.top.value_or(ground_), wall) > rise;
  });
}

template <int Dim>
void LocalAvalanches<Dim>::gather(const World<Dim>& world, const Cell& cell) {
  const BodyStates<Dim>& states = world.states();
  neighbourhood_.clear();
  Box<Dim> box(Vec<Dim>::Constant(-far_away), Vec<Dim>::Constant(far_away));
  for (std::size_t axis = 0; axis < cell.size(); ++axis) {
    box.min()[static_cast<Eigen::Index>(axis)] = (cell[axis] - 1) * width_;
    box.max()[static_cast<Eigen::Index>(axis)] = (cell[axis] + 2) * width_;
  }
  for (const Cell& beside : around(cell)) neighbourhood_[beside];
  near_.clear();
  awake_near_ = 0;
  world.near(box, near_);
  for (const BodyIndex body : near_) {
    const auto i = static_cast<std::size_t>(body);
    if (states.asleep[i] == 0) {
      ++awake_near_;
      continue;
    }
    const auto found = neighbourhood_.find(cell_of(states.pose[i].position));
    if (found == neighbourhood_.end()) continue;
    Stack& stack = found->second;
    const double z = height<Dim>(states.pose[i].position);
    stack.bodies.push_back(body);
    stack.top = std::max(stack.top.value_or(z), z);
  }
}

template <int Dim>
Vec<Dim> LocalAvalanches<Dim>::middle_of(const Cell& cell) const {
  Vec<Dim> middle = Vec<Dim>::Zero();
  for (std::size_t axis = 0; axis < cell.size(); ++axis) {
    middle[static_cast<Eigen::Index>(axis)] = (cell[axis] + 0.5) * width_;
  }
  return middle;
}

template class LocalAvalanches<2>;
template class LocalAvalanches<3>;

}  // namespace talus
