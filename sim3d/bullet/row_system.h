#pragma once
// All rows of one group of bodies, and their iterations.

#include <cstdint>
#include <span>
#include <vector>

#include "sim3d/bullet/rows.h"

namespace talus::bullet {

/// The bodies of a row in the order in which Bullet solves the rows.
struct RowBodies {
  std::int32_t a;
  std::int32_t b;
};

/// Sorts rows by level: a row stands one level above the highest earlier row with which it shares a moving body. Rows
/// of one level depend on none of each other, so their order is free; of two rows that share a body the earlier stays
/// the earlier. So all results keep their bits, and a row need not wait for the one before it.
class RowOrder {
 public:
  /// place[i]: where row i of `rows` goes. `bodies`: how many there are; `fixed`: the one that never moves, or -1.
  void sort(std::span<const RowBodies> rows, int bodies, std::int32_t fixed, std::vector<std::int32_t>& place);

 private:
  std::vector<std::int32_t> reached_;  // by body: level of the next row that it takes part in
  std::vector<std::int32_t> starts_;   // by level: the place of its next row
};

/// The order in which Bullet has them.
void keep_order(std::size_t rows, std::vector<std::int32_t>& place);

/// Replaces btSequentialImpulseConstraintSolver::solveSingleIteration and solveGroupCacheFriendlySplitImpulseIterations
/// for contacts without rolling friction, softness or joints: packed rows (rows.h), solved level by level
/// (RowOrder). Two more differences, of work alone: the split impulse walks the deep contacts, not all; and a row's
/// residual, a division in double precision, is computed for as many rows as it takes to find one that has changed.
class RowSystem {
 public:
  /// A system of that many bodies at no change of velocity; `fixed`: the one that stands for all that never move, or
  /// -1.
  void clear(int bodies, std::int32_t fixed);

  /// Adds one more body, at no change of velocity and of infinite mass; returns its number.
  std::int32_t add_heavy_body() {
    bodies_.push_back({splat(0), splat(0), splat(0)});
    return static_cast<std::int32_t>(bodies_.size()) - 1;
  }

  /// Makes room for the rows, and their places. The bodies of contact i are those of its friction rows, `directions`
  /// of them (1 or 2).
  void arrange(std::span<const RowBodies> contacts, int directions, bool by_level);

  PackedBody& body(std::int32_t i) { return bodies_[i]; }
  PackedRow& contact(std::size_t i) { return contacts_[contact_place_[i]]; }
  PackedRow& friction(std::size_t i) { return frictions_[friction_place_[i]]; }
  std::int32_t place_of_contact(std::size_t i) const { return contact_place_[i]; }

  /// Contact i is so deep that the bodies are moved apart by `rhs` [N s], without giving them velocity.
  void add_deep(std::size_t contact, float rhs);

  struct Settings {
    int iterations;
    float residual;          // squared; the iterations end early at or below it
    bool release_unpressed;  // friction of a contact that no longer pushes goes (WarmFrictionSolver)
  };
  void solve(const Settings& settings);

  /// Velocity that moves a body out of others but is not kept; null where nothing is deep.
  const PackedBody* push(std::int32_t i) const { return pushes_.empty() ? nullptr : &pushes_[i]; }

 private:
  void solve_deep(const Settings& settings);
  void solve_contacts();
  void solve_frictions(bool release_unpressed);
  bool at_rest(float residual) const;

  std::int32_t fixed_ = -1;
  std::vector<PackedBody> bodies_;
  std::vector<PackedBody> pushes_;
  std::vector<PackedRow> contacts_;
  std::vector<PackedRow> frictions_;
  std::vector<PackedRow> deep_;
  std::vector<std::int32_t> deep_contacts_;
  std::vector<float> deep_rhs_;
  std::vector<std::int32_t> contact_place_;
  std::vector<std::int32_t> friction_place_;
  std::vector<float> contact_changes_;   // of the last iteration
  std::vector<float> friction_changes_;  // of the last iteration
  std::vector<std::size_t> unpressed_;
  std::vector<RowBodies> friction_bodies_;
  RowOrder order_;
};

}  // namespace talus::bullet
