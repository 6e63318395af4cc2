#include "common/solver/contact_sets.h"

#include <algorithm>
#include <bit>

namespace talus::solver {
namespace {

constexpr int colours = 64;  // bits of a mask; contacts beyond are solved one by one

}  // namespace

template <int Dim>
void ContactSets<Dim>::arrange(std::span<const SolverBody<Dim>> bodies, std::span<const ContactPoint<Dim>> points) {
  bodies_ = bodies;
  points_ = points;
  place_bodies();
  sort();
  make_blocks();
}

/// Bodies that move stand by region, so that the memory of a region stays with its thread. Behind those of a region
/// come the places of fixed bodies, one for each set.
template <int Dim>
void ContactSets<Dim>::place_bodies() {
  divided_.divide(bodies_);
  bodies_of_.assign(regions(), {});
  const auto slots = static_cast<int>(bodies_.size());
  for (int slot = 0; slot < slots; ++slot)
    if (bodies_[slot].moves) ++bodies_of_[divided_.of(slot)].last;
  int next = 0;
  constexpr int apart = 4;  // from the next region's bodies: a line of memory
  for (int r = 0; r < regions(); ++r) {
    bodies_of_[r] = {next, next + bodies_of_[r].last};
    next = bodies_of_[r].last;
    sets_[r].still = next++;
    sets_[regions() + r].still = next++;
    next += apart;
  }
  tail_ = next;
  place_.assign(bodies_.size(), -1);
  std::array<int, Regions<Dim>::most> filled{};
  for (int slot = 0; slot < slots; ++slot) {
    if (!bodies_[slot].moves) continue;
    const int region = divided_.of(slot);
    place_[slot] = bodies_of_[region].first + filled[region]++;
  }
}

template <int Dim>
int ContactSets<Dim>::set_of(int a, int b) const {
  if (!bodies_[b].moves) return divided_.of(a);
  if (!bodies_[a].moves) return divided_.of(b);
  const auto [low, high] = std::minmax({divided_.of(a), divided_.of(b)});
  if (low == high) return low;
  return high == low + 1 ? regions() + low : last();
}

template <int Dim>
auto ContactSets<Dim>::turn_of(int set) const -> Turn {
  if (set < regions()) return inside;
  if (set == last()) return remaining;
  return (set - regions()) % 2 == 0 ? even_border : odd_border;
}

/// Puts points that stand side by side into groups and gives each the first colour that no group of its bodies has in
/// sets of the same turn.
template <int Dim>
void ContactSets<Dim>::sort() {
  used_.assign(tail_, {});
  groups_.clear();
  const int points = static_cast<int>(points_.size());
  for (int i = 0; i < points;) {
    const int a = points_[i].a;
    const int b = points_[i].b;
    int end = i + 1;
    while (end < points && end - i < points_of_a_group<Dim> && points_[end].a == a && points_[end].b == b) ++end;
    const int set = set_of(a, b);
    const Turn turn = turn_of(set);
    std::uint64_t taken = 0;
    for (const int slot : {a, b})
      if (bodies_[slot].moves) taken |= used_[place_[slot]][turn];
    const int colour = std::countr_one(taken);
    for (const int slot : {a, b})
      if (bodies_[slot].moves && colour < colours) used_[place_[slot]][turn] |= std::uint64_t{1} << colour;
    groups_.push_back({.first = i, .count = end - i, .set = set, .colour = colour});
    i = end;
  }
  constexpr int sizes = points_of_a_group<Dim>;
  const auto bin = [](const Group& group) {
    return (group.set * (colours + 1) + group.colour) * sizes + sizes - group.count;
  };
  const int bins_of_set = (colours + 1) * sizes;
  const int bins = count() * bins_of_set;
  start_.assign(bins + 1, 0);
  for (const Group& group : groups_) ++start_[bin(group) + 1];
  for (int i = 1; i <= bins; ++i) start_[i] += start_[i - 1];
  order_.resize(groups_.size());
  for (int set = 0; set < count(); ++set) {
    const int first = start_[set * bins_of_set];
    sets_[set].groups = std::span(order_).subspan(first, start_[(set + 1) * bins_of_set] - first);
  }
  for (std::size_t i = 0; i < groups_.size(); ++i) order_[start_[bin(groups_[i])]++] = static_cast<int>(i);
}

/// Gives each group its block and lane, and the block the places of its bodies. Groups that got no colour have a block
/// each.
template <int Dim>
void ContactSets<Dim>::make_blocks() {
  blocks_.clear();
  copied_.clear();
  copy_.assign(bodies_.size(), {-1, 0});
  copies_of_.assign(regions(), {});
  point_blocks_ = 0;
  rolling_blocks_ = 0;
  for (int number = 0; number < count(); ++number) {
    Set& set = sets_[number];
    set.first_block = static_cast<int>(blocks_.size());
    set.first_point = point_blocks_;
    const int first_copy = places();
    int lane = lanes_of_a_block;
    int last_colour = -1;
    for (const int index : set.groups) {
      Group& group = groups_[index];
      if (lane == lanes_of_a_block || group.colour != last_colour || group.colour == colours) {
        ContactBlock<Dim>& block = blocks_.emplace_back(ContactBlock<Dim>{});
        std::ranges::fill(block.a, set.still);
        std::ranges::fill(block.b, set.still);
        block.first_point = point_blocks_;
        block.points = group.count;  // the most of all in it, see sort()
        block.rolling = -1;
        point_blocks_ += group.count;
        lane = 0;
        last_colour = group.colour;
      }
      const ContactPoint<Dim>& first = points_[group.first];
      ContactBlock<Dim>& block = blocks_.back();
      block.a[lane] = place_in(number, first.a);
      block.b[lane] = place_in(number, first.b);
      if (first.rolling_arm > 0.0F && block.rolling < 0) block.rolling = rolling_blocks_++;
      group.block = static_cast<int>(blocks_.size()) - 1;
      group.lane = lane++;
    }
    set.blocks = static_cast<int>(blocks_.size()) - set.first_block;
    set.points = point_blocks_ - set.first_point;
    if (number < regions()) copies_of_[number] = {first_copy, places()};
  }
}

/// An obstacle that moves has a place for each region that it touches, all else that is not moved by its contacts
/// shares one.
template <int Dim>
int ContactSets<Dim>::place_in(int set, int slot) {
  const SolverBody<Dim>& body = bodies_[slot];
  if (body.moves) return place_[slot];
  if (body.velocity.isZero(0.0F) && body.spin.isZero(0.0F)) return sets_[set].still;
  if (copy_[slot].first != set) {
    copy_[slot] = {set, places()};
    copied_.push_back(slot);
  }
  return copy_[slot].second;
}

template class ContactSets<2>;
template class ContactSets<3>;

}  // namespace talus::solver
