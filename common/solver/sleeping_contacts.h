#pragma once
// The contact points of sleeping bodies.

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "common/solver/contact_solver.h"
#include "common/world/body.h"

namespace talus {

/// How an engine finds a point again.
struct PointKey {
  std::uint64_t a = 0;
  std::uint64_t b = 0;
  std::uint32_t point = 0;
};

/// A point between a sleeping body and another one, the ground or an obstacle.
template <int Dim>
struct SleepingPoint {
  BodyIndex a = ground_index;
  BodyIndex b = ground_index;
  ContactPoint<Dim> contact;  // its slots mean nothing here
  PointKey key;
  VecF<Dim> slip = VecF<Dim>::Zero();  // of b over a since the body fell asleep; against ground and obstacles only [m]
};

/// The contact points of which no side is awake, with the impulses that hold them: the engines have none of these. Each
/// is in the lists of both its sides; those of one pair that were kept one after the other stay so.
template <int Dim>
class SleepingContacts {
 public:
  void keep(const SleepingPoint<Dim>& point);
  /// Takes all points of a body or an obstacle out and appends them to `out`.
  void release(BodyIndex side, std::vector<SleepingPoint<Dim>>& out);

  /// Numbers of the points of a body or an obstacle; valid until the next keep() or release().
  std::span<const int> of(BodyIndex side) const;
  SleepingPoint<Dim>& operator[](int number) { return points_[number]; }
  const SleepingPoint<Dim>& operator[](int number) const { return points_[number]; }

 private:
  using Lists = std::vector<std::vector<int>>;
  std::vector<int>* list_of(BodyIndex side);

  std::deque<SleepingPoint<Dim>> points_;  // grows without copies and spare room
  std::vector<int> free_;
  Lists of_bodies_;
  Lists of_obstacles_;
};

}  // namespace talus
