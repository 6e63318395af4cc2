#pragma once
// The contacts of a step in an order in which several are solved at once.

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "common/solver/contact_blocks.h"
#include "common/solver/contact_solver.h"
#include "common/solver/regions.h"

namespace talus::solver {

/// Sorts the contact points of a step and gives each body that moves a place in memory.
///
/// A group is of the points of one pair that stand side by side. A block is of eight groups that share no body that
/// moves: the lanes of the processor solve them. A set is of the groups within a region, of those across the border of
/// two that are side by side, or of the few others. In a pass threads solve the sets of all regions, then every second
/// border, then the other borders, then the rest: sets that are solved at the same time share no body that moves.
template <int Dim>
class ContactSets {
 public:
  static constexpr int most = 2 * Regions<Dim>::most;

  /// When in a pass a set is solved.
  enum Turn { inside, even_border, odd_border, remaining, turns };

  struct Group {
    int first = 0;  // point
    int count = 0;
    int set = 0;
    int colour = 0;  // groups of one colour in a set share no body that moves
    int block = 0;
    int lane = 0;
  };
  struct Set {
    std::span<const int> groups;  // their numbers
    int first_block = 0;
    int blocks = 0;
    int first_point = 0;  // among the PointBlocks
    int points = 0;
    int still = 0;  // place of all fixed bodies, and of unused lanes
  };
  /// Places from `first` to before `last`.
  struct Places {
    int first = 0;
    int last = 0;
  };

  void arrange(std::span<const SolverBody<Dim>> bodies, std::span<const ContactPoint<Dim>> points);

  // Of the last arrange().

  int regions() const { return divided_.count(); }
  /// Numbers of the sets: inside of each region, at the border to the next, and last the remaining.
  int count() const { return 2 * regions(); }
  int last() const { return count() - 1; }
  Turn turn_of(int set) const;
  const Set& operator[](int set) const { return sets_[set]; }

  std::span<const Group> groups() const { return groups_; }
  /// With the places of their bodies and the numbers of their points; all else is 0.
  std::vector<ContactBlock<Dim>>& blocks() { return blocks_; }
  int point_blocks() const { return point_blocks_; }
  int rolling_blocks() const { return rolling_blocks_; }

  /// Of a body that moves.
  int place(int slot) const { return place_[slot]; }
  /// All places.
  int places() const { return tail_ + static_cast<int>(copied_.size()); }
  /// Of the bodies of a region.
  const Places& bodies_of(int region) const { return bodies_of_[region]; }
  /// Slots of the obstacles that move, one by one for the places from tail() on.
  std::span<const int> copied() const { return copied_; }
  int tail() const { return tail_; }
  /// Of those of a region.
  const Places& copies_of(int region) const { return copies_of_[region]; }

 private:
  void place_bodies();
  void sort();
  int set_of(int a, int b) const;
  void make_blocks();
  int place_in(int set, int slot);

  std::span<const SolverBody<Dim>> bodies_;
  std::span<const ContactPoint<Dim>> points_;
  Regions<Dim> divided_;
  std::vector<int> place_;  // by slot
  std::vector<Places> bodies_of_;
  int tail_ = 0;  // place of the first that is of no region
  std::vector<Places> copies_of_;
  std::vector<std::pair<int, int>> copy_;  // by slot of a moving obstacle: the set that its last copy is of, its place
  std::vector<int> copied_;
  std::vector<Group> groups_;
  std::vector<int> start_;                              // scratch of sort()
  std::vector<int> order_;                              // of the groups, by set, colour and number of points
  std::vector<std::array<std::uint64_t, turns>> used_;  // by place: colours of its groups
  std::array<Set, most> sets_;
  std::vector<ContactBlock<Dim>> blocks_;
  int point_blocks_ = 0;
  int rolling_blocks_ = 0;
};

}  // namespace talus::solver
