#include "common/solver/sleeping_contacts.h"

#include <algorithm>

namespace talus {

/// Null for the ground: its points are in no list.
template <int Dim>
std::vector<int>* SleepingContacts<Dim>::list_of(BodyIndex side) {
  if (side == ground_index) return nullptr;
  Lists& lists = side >= 0 ? of_bodies_ : of_obstacles_;
  const auto place = static_cast<std::size_t>(side >= 0 ? side : first_obstacle - side);
  if (place >= lists.size()) lists.resize(place + 1);
  return &lists[place];
}

template <int Dim>
std::span<const int> SleepingContacts<Dim>::of(BodyIndex side) const {
  const Lists& lists = side >= 0 ? of_bodies_ : of_obstacles_;
  const auto place = static_cast<std::size_t>(side >= 0 ? side : first_obstacle - side);
  if (place >= lists.size()) return {};
  return lists[place];
}

template <int Dim>
void SleepingContacts<Dim>::keep(const SleepingPoint<Dim>& point) {
  if (free_.empty()) {
    free_.push_back(static_cast<int>(points_.size()));
    points_.emplace_back();
  }
  const int number = free_.back();
  free_.pop_back();
  points_[number] = point;
  for (const BodyIndex side : {point.a, point.b})
    if (std::vector<int>* list = list_of(side)) list->push_back(number);
}

template <int Dim>
void SleepingContacts<Dim>::release(BodyIndex side, std::vector<SleepingPoint<Dim>>& out) {
  std::vector<int> numbers;
  numbers.swap(*list_of(side));
  for (const int number : numbers) {
    const SleepingPoint<Dim>& point = points_[number];
    out.push_back(point);
    if (std::vector<int>* list = list_of(point.a == side ? point.b : point.a)) std::erase(*list, number);
    free_.push_back(number);
  }
}

template class SleepingContacts<2>;
template class SleepingContacts<3>;

}  // namespace talus
