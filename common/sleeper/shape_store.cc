#include "common/sleeper/shape_store.h"

#include "common/math/pose_values.h"

namespace talus {
namespace {

/// Shapes that no body has are kept up to this number.
constexpr std::size_t most_unused = 1000;

template <int Dim>
void append_piece(const BoxPiece<Dim>& box, std::vector<double>& key) {
  key.push_back(0.0);
  append_pose<Dim>(box.pose, key);
  key.insert(key.end(), box.half.begin(), box.half.end());
}

template <int Dim>
void append_piece(const HullPiece<Dim>& hull, std::vector<double>& key) {
  key.push_back(static_cast<double>(hull.corners.size()));
  for (const Vec<Dim>& corner : hull.corners) key.insert(key.end(), corner.begin(), corner.end());
  key.push_back(hull.radius);
}

}  // namespace

/// All that a sleeper takes from a shape.
template <int Dim>
auto ShapeStore<Dim>::key_of(const Shape<Dim>& shape) -> Key {
  Key key = {shape.mass, shape.material.friction};
  key.insert(key.end(), shape.inertia.reshaped().begin(), shape.inertia.reshaped().end());
  key.insert(key.end(), shape.bounds.min().begin(), shape.bounds.min().end());
  key.insert(key.end(), shape.bounds.max().begin(), shape.bounds.max().end());
  for (const Piece<Dim>& piece : shape.pieces) std::visit([&](const auto& p) { append_piece<Dim>(p, key); }, piece);
  return key;
}

template <int Dim>
auto ShapeStore<Dim>::take(const Shape<Dim>& shape) -> Taken {
  const auto [place, is_new] = numbers_.try_emplace(key_of(shape), 0);
  if (is_new) {
    place->second = next_number();
    entries_[place->second].place = place;
  }
  Entry& entry = entries_[place->second];
  if (!is_new && entry.users == 0) std::erase(unused_, place->second);
  ++entry.users;
  return {place->second, is_new};
}

template <int Dim>
int ShapeStore<Dim>::next_number() {
  if (unused_.size() <= most_unused) {
    entries_.emplace_back();
    return static_cast<int>(entries_.size()) - 1;
  }
  const int number = unused_.front();
  unused_.pop_front();
  numbers_.erase(entries_[number].place);
  return number;
}

template <int Dim>
void ShapeStore<Dim>::release(int number) {
  if (--entries_[number].users == 0) unused_.push_back(number);
}

template class ShapeStore<2>;
template class ShapeStore<3>;

}  // namespace talus
