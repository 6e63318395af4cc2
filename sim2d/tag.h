#pragma once
// To which body or obstacle a fixture belongs, kept in its user data.

#include <box2d/box2d.h>

#include "common/world/body.h"

namespace talus::box2d {

/// Owner and piece of a fixture in one number, which also orders pairs of fixtures the same in every run.
enum class Tag : std::uint64_t {};

inline Tag make_tag(BodyIndex owner, int piece) {
  return Tag{(std::uint64_t{static_cast<std::uint32_t>(owner)} << 32U) | static_cast<std::uint32_t>(piece)};
}

/// A body, the ground or an obstacle (see BodyIndex).
inline BodyIndex owner_of(Tag tag) {
  return static_cast<BodyIndex>(static_cast<std::uint32_t>(static_cast<std::uint64_t>(tag) >> 32U));
}

/// Number of the fixture among the pieces of its owner.
inline int piece_of(Tag tag) { return static_cast<int>(static_cast<std::uint32_t>(static_cast<std::uint64_t>(tag))); }

inline b2FixtureUserData to_user_data(Tag tag) {
  static_assert(sizeof(std::uintptr_t) >= sizeof(Tag), "a tag must fit into Box2D's user data");
  b2FixtureUserData data;
  data.pointer = static_cast<std::uintptr_t>(tag);
  return data;
}

// Box2D has no const access to user data, hence no const here.
inline Tag tag_of(b2Fixture& fixture) { return Tag{fixture.GetUserData().pointer}; }
inline BodyIndex owner_of(b2Fixture& fixture) { return owner_of(tag_of(fixture)); }

}  // namespace talus::box2d
