#pragma once
// The shapes of bodies that come and go, each once.

#include <deque>
#include <map>
#include <vector>

#include "common/shape/shape.h"

namespace talus {

/// Numbers the distinct shapes of the bodies that are there. Equal shapes have one number.
template <int Dim>
class ShapeStore {
 public:
  struct Taken {
    int number = 0;
    bool is_new = false;  // no shape had this number, or another one
  };
  /// One body more has this shape.
  Taken take(const Shape<Dim>& shape);
  /// One body less has it. Its number is not used again soon, since records name shapes by number.
  void release(int number);

 private:
  using Key = std::vector<double>;
  struct Entry {
    int users = 0;  // bodies
    typename std::map<Key, int>::iterator place;
  };
  static Key key_of(const Shape<Dim>& shape);
  int next_number();

  std::map<Key, int> numbers_;
  std::vector<Entry> entries_;
  std::deque<int> unused_;  // without users; those unused for the longest time come first
};

}  // namespace talus
