#include "common/sleeper/body_columns.h"

#include <algorithm>

namespace talus {

template <int Dim>
std::size_t BodyColumns<Dim>::Hash::operator()(const Column& column) const {
  std::size_t hash = 0;
  for (const int number : column) hash = 0x9e3779b97f4a7c15U * (hash ^ static_cast<std::uint32_t>(number));
  return hash;
}

template <int Dim>
void BodyColumns<Dim>::put(BodyIndex body, const Vec<Dim>& position, double extent) {
  if (std::ssize(places_) <= body) places_.resize(body + 1);
  const bool large = extent > columns_.width();
  const Place& before = places_[body];
  if (large ? before.large : before.column && columns_.holds(*before.column, position)) return;
  const std::optional<Column> column = large ? std::nullopt : std::optional(columns_.cell_of(position));
  take_out(body);
  (large ? large_ : bodies_[*column]).push_back(body);
  places_[body] = {large, column};
}

template <int Dim>
void BodyColumns<Dim>::take_out(BodyIndex body) {
  Place& place = places_[body];
  if (place.large) std::erase(large_, body);
  if (place.column) {
    const auto entry = bodies_.find(*place.column);
    std::erase(entry->second, body);
    if (entry->second.empty()) bodies_.erase(entry);
  }
  place = {};
}

template <int Dim>
void BodyColumns<Dim>::query(const Box<Dim>& box, std::vector<BodyIndex>& found) const {
  found.insert(found.end(), large_.begin(), large_.end());
  const Vec<Dim> reach = Vec<Dim>::Constant(0.5 * columns_.width());  // a column holds bodies up to its own width
  const Column first = columns_.cell_of(Vec<Dim>(box.min() - reach));
  const Column last = columns_.cell_of(Vec<Dim>(box.max() + reach));
  double cells = 1.0;
  for (std::size_t axis = 0; axis < first.size(); ++axis) cells *= 1.0 + last[axis] - first[axis];
  if (cells <= static_cast<double>(bodies_.size())) return append_columns(first, last, found);
  for (const auto& [column, bodies] : bodies_) found.insert(found.end(), bodies.begin(), bodies.end());
}

template <int Dim>
void BodyColumns<Dim>::append_columns(const Column& first, const Column& last, std::vector<BodyIndex>& found) const {
  Column column = first;
  while (true) {
    if (const auto entry = bodies_.find(column); entry != bodies_.end())
      found.insert(found.end(), entry->second.begin(), entry->second.end());
    std::size_t axis = 0;
    while (axis < column.size() && column[axis] == last[axis]) column[axis] = first[axis], ++axis;
    if (axis == column.size()) return;
    ++column[axis];
  }
}

template class BodyColumns<2>;
template class BodyColumns<3>;

}  // namespace talus
