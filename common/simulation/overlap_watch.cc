#include "common/simulation/overlap_watch.h"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

constexpr std::int64_t shortest_period = 16;  // [steps]
constexpr double longest_period = 1.0;        // [s]; with little gravity
constexpr double least_depth = 0.005;         // [D]; what engines leave at any contact

}  // namespace

template <int Dim>
std::int64_t OverlapWatch<Dim>::period(double extent, double gravity, double dt) {
  const double time = std::min(longest_period, time_unit(extent, gravity));
  return std::max<std::int64_t>(shortest_period, std::llround(time / dt));
}

template <int Dim>
auto OverlapWatch<Dim>::sample(const World<Dim>& world, std::int64_t step) -> std::span<const Finding> {
  next_ = step + period(extent_, world.gravity_size(), world.dt());
  findings_.clear();
  find_pairs(world);
  for (const Pair& before : last_) {
    const double depth = lasting_depth(world, before);
    overlap_.deepest = std::max(overlap_.deepest, depth);
    if (depth < overlap_limit) continue;
    ++overlapping_;
    for (const BodyIndex body : {before.low, before.high})
      if (body >= 0) findings_.push_back({body, depth});
  }
  if (pairs_ > 0) overlap_.share = static_cast<double>(overlapping_) / static_cast<double>(pairs_);
  last_.swap(now_);
  return findings_;
}

/// The contacts of a pair stand side by side.
template <int Dim>
void OverlapWatch<Dim>::find_pairs(const World<Dim>& world) {
  now_.clear();
  const std::span<const Contact<Dim>> contacts = world.contacts();
  for (std::size_t i = 0; i < contacts.size();) {
    const BodyIndex a = contacts[i].a;
    const BodyIndex b = contacts[i].b;
    double depth = 0.0;
    for (; i < contacts.size() && contacts[i].a == a && contacts[i].b == b; ++i)
      depth = std::max(depth, contacts[i].depth / extent_);
    ++pairs_;
    if (depth >= least_depth) now_.push_back({std::min(a, b), std::max(a, b), depth});
  }
  std::ranges::sort(now_, {}, &Pair::bodies);
}

/// 0 where the pair no longer overlaps.
template <int Dim>
double OverlapWatch<Dim>::lasting_depth(const World<Dim>& world, const Pair& before) const {
  const auto now = std::ranges::lower_bound(now_, before.bodies(), {}, &Pair::bodies);
  if (now != now_.end() && now->bodies() == before.bodies()) return std::min(before.depth, now->depth);
  const auto sleeps = [&](BodyIndex body) {
    return body < 0 || (world.states().asleep[body] != 0 && world.states().removed[body] == 0);
  };
  return sleeps(before.low) && sleeps(before.high) ? before.depth : 0.0;
}

template class OverlapWatch<2>;
template class OverlapWatch<3>;

}  // namespace talus
