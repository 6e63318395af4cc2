#pragma once
// The bodies of a sleeper by handle.

#include <vector>

#include "common/math/require.h"
#include "common/sleeper/handle.h"
#include "common/world/body.h"

namespace talus {

/// Handles of the bodies that are there. Slots of removed ones are used again.
class HandleTable {
 public:
  struct Entry {
    std::uint32_t generation = 0;
    BodyRole role = BodyRole::sleeps;
    bool present = false;
    int number = 0;  // of a kinematic body among these, else in the world
  };

  Handle add(BodyRole role, int number) {
    if (free_.empty()) {
      free_.push_back(static_cast<std::uint32_t>(entries_.size()));
      entries_.emplace_back();
    }
    const std::uint32_t slot = free_.back();
    free_.pop_back();
    Entry& entry = entries_[slot];
    entry = {entry.generation + 1, role, true, number};
    ++size_;
    return {slot, entry.generation};
  }

  void remove(Handle handle) {
    entries_[handle.slot].present = false;
    free_.push_back(handle.slot);
    --size_;
  }

  /// Of a body that is there.
  void set_role(Handle handle, BodyRole role) { entries_[handle.slot].role = role; }

  bool has(Handle handle) const {
    return handle.slot < entries_.size() && entries_[handle.slot].present &&
           entries_[handle.slot].generation == handle.generation;
  }
  /// Throws InvalidValue, naming `field`, where the handle names no body that is there.
  const Entry& at(Handle handle, std::string_view field) const {
    require(has(handle), field, static_cast<double>(handle.slot), "must be the handle of a body that is there");
    return entries_[handle.slot];
  }
  int size() const { return size_; }
  /// By slot; those that are not present too.
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> free_;
  int size_ = 0;
};

}  // namespace talus
