#pragma once
// What a step's contacts were like, by contact.

#include <box2d/box2d.h>

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "sim2d/tag.h"

namespace talus::box2d {

/// Values of a contact within a step that only a b2ContactListener gets, and the tags of its fixtures, whose memory is
/// in the cache while Box2D works on them.
struct ContactRecord {
  b2Contact* contact = nullptr;
  Tag first{};
  Tag second{};
  std::array<double, b2_maxManifoldPoints> approach{};  // [m/s]
  std::array<double, b2_maxManifoldPoints> normal{};    // [N s]
  std::array<double, b2_maxManifoldPoints> tangent{};   // [N s]
};

/// A flat table: looked up by address, walked in the order in which Box2D reports the contacts, so no
/// address reaches the results. An std::unordered_map takes memory for each record and frees it in each step: 6 % of a
/// step in a dense rain of L shapes.
class ContactRecords {
 public:
  void clear() {
    records_.clear();
    places_.assign(places_.size(), 0);
  }

  /// The record of a contact, made if there is none. Valid until the next call.
  ContactRecord& operator[](b2Contact& contact) {
    if (2 * records_.size() >= places_.size()) grow();
    std::uint32_t& place = places_[find_place(&contact)];
    if (place == 0) {
      records_.push_back({&contact, tag_of(*contact.GetFixtureA()), tag_of(*contact.GetFixtureB())});
      place = static_cast<std::uint32_t>(records_.size());
    }
    return records_[place - 1];
  }

  std::span<const ContactRecord> all() const { return records_; }

 private:
  /// Where the contact's entry is noted, or would be.
  std::size_t find_place(const b2Contact* contact) const {
    constexpr std::uint64_t golden = 0x9e3779b97f4a7c15;  // spreads addresses that differ in a few bits (Knuth)
    const auto key = static_cast<std::uint64_t>(std::bit_cast<std::uintptr_t>(contact));
    std::size_t at = ((key * golden) >> 32) & (places_.size() - 1);
    while (places_[at] != 0 && records_[places_[at] - 1].contact != contact) at = (at + 1) & (places_.size() - 1);
    return at;
  }

  void grow() {
    places_.assign(2 * places_.size(), 0);
    for (std::uint32_t i = 0; i < records_.size(); ++i) places_[find_place(records_[i].contact)] = i + 1;
  }

  std::vector<ContactRecord> records_;
  std::vector<std::uint32_t> places_ = std::vector<std::uint32_t>(64, 0);  // number of a record plus 1; 0: none
};

}  // namespace talus::box2d
