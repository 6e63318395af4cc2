#include "sim2d/warm_start.h"

#include <algorithm>
#include <tuple>

namespace talus::box2d {
namespace {

// Both bodies stand where they stood, so a point is where it was; what differs is which face Box2D measures from, at
// most the skins of both shapes.
constexpr float match_distance = 4.0F * b2_polygonRadius;

bool before(const SavedContact& a, const SavedContact& b) { return std::tie(a.low, a.high) < std::tie(b.low, b.high); }

std::array<Tag, 2> sorted_tags(b2Contact& contact) {
  const Tag a = tag_of(*contact.GetFixtureA());
  const Tag b = tag_of(*contact.GetFixtureB());
  return {std::min(a, b), std::max(a, b)};
}

std::array<b2Vec2, b2_maxManifoldPoints> points_of(const b2Contact& contact) {
  b2WorldManifold world;
  contact.GetWorldManifold(&world);
  return {world.points[0], world.points[1]};
}

float distance(const b2Vec2& a, const b2Vec2& b) { return (a - b).Length(); }

}  // namespace

SavedContact save(b2Contact& contact) {
  const auto [low, high] = sorted_tags(contact);
  const auto at = points_of(contact);
  const b2Manifold& manifold = *contact.GetManifold();
  SavedContact saved{low, high, {}, manifold.pointCount};
  for (std::size_t i = 0; i < static_cast<std::size_t>(saved.count); ++i) {
    saved.points[i] = {at[i], manifold.points[i].normalImpulse, manifold.points[i].tangentImpulse};
  }
  return saved;
}

void restore(const SavedContact& saved, b2Contact& contact) {
  const auto at = points_of(contact);
  b2Manifold& manifold = *contact.GetManifold();
  const auto count = static_cast<std::size_t>(manifold.pointCount);
  const bool crossed = count == 2 && saved.count == 2 &&
                       distance(at[0], saved.points[1].at) + distance(at[1], saved.points[0].at) <
                           distance(at[0], saved.points[0].at) + distance(at[1], saved.points[1].at);
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t match = crossed ? 1 - i : i;
    if (saved.count == 1) {
      match = 0;
    } else if (count == 1 && distance(at[0], saved.points[1].at) < distance(at[0], saved.points[0].at)) {
      match = 1;
    }
    if (distance(at[i], saved.points[match].at) <= match_distance) {
      // Both impulses are measured along axes that turn round with the choice of A and B, so their signs stay.
      manifold.points[i].normalImpulse = saved.points[match].normal;
      manifold.points[i].tangentImpulse = saved.points[match].tangent;
    }
  }
}

std::int32_t& SleepingContacts::next_of(std::int32_t node, BodyIndex body) {
  Node& n = nodes_[static_cast<std::size_t>(node)];
  return n.next[owner_of(n.contact.low) == body ? 0 : 1];
}

void SleepingContacts::keep(const SavedContact& contact) {
  if (free_.empty()) {
    free_.push_back(static_cast<std::int32_t>(nodes_.size()));
    nodes_.emplace_back();
  }
  const std::int32_t node = free_.back();
  free_.pop_back();
  nodes_[static_cast<std::size_t>(node)].contact = contact;
  for (const BodyIndex body : {owner_of(contact.low), owner_of(contact.high)}) {
    if (body < 0) {
      continue;  // ground and obstacles never wake, so nobody asks for theirs
    }
    if (static_cast<std::size_t>(body) >= first_.size()) {
      first_.resize(static_cast<std::size_t>(body) + 1, -1);
    }
    std::int32_t& first = first_[static_cast<std::size_t>(body)];
    next_of(node, body) = first;
    first = node;
  }
}

void SleepingContacts::unlink(std::int32_t node, BodyIndex body) {
  std::int32_t* link = &first_[static_cast<std::size_t>(body)];
  while (*link != node) {
    link = &next_of(*link, body);
  }
  *link = next_of(node, body);
}

void SleepingContacts::release(BodyIndex body, std::vector<SavedContact>& out) {
  if (static_cast<std::size_t>(body) >= first_.size()) {
    return;
  }
  std::int32_t& first = first_[static_cast<std::size_t>(body)];
  while (first >= 0) {
    const std::int32_t node = first;
    const SavedContact& contact = nodes_[static_cast<std::size_t>(node)].contact;
    out.push_back(contact);
    const BodyIndex low = owner_of(contact.low);
    const BodyIndex other = low == body ? owner_of(contact.high) : low;
    first = next_of(node, body);
    if (other >= 0) {
      unlink(node, other);
    }
    free_.push_back(node);
  }
}

void WarmStart::save(b2Contact& contact) {
  if (contact.IsTouching()) {
    waiting_.push_back(box2d::save(contact));
  }
}

void WarmStart::forget(BodyIndex body) {
  sleeping_.release(body, waiting_);
  std::erase_if(waiting_,
                [body](const SavedContact& c) { return owner_of(c.low) == body || owner_of(c.high) == body; });
}

void WarmStart::start_step(std::span<const std::uint8_t> asleep) {
  const auto sleeps = [asleep](Tag tag) {
    const BodyIndex owner = owner_of(tag);
    return owner < 0 || asleep[static_cast<std::size_t>(owner)] != 0;
  };
  // A contact of two bodies that fell asleep together was saved from both sides.
  std::ranges::stable_sort(waiting_, before);
  const auto twice = std::ranges::unique(
      waiting_, [](const SavedContact& a, const SavedContact& b) { return a.low == b.low && a.high == b.high; });
  waiting_.erase(twice.begin(), twice.end());
  std::erase_if(waiting_, [&](const SavedContact& contact) {
    const bool put_away = sleeps(contact.low) && sleeps(contact.high);
    if (put_away) {
      sleeping_.keep(contact);
    }
    return put_away;
  });
}

void WarmStart::apply(b2Contact& contact) const {
  const auto [low, high] = sorted_tags(contact);
  const auto found = std::ranges::lower_bound(waiting_, SavedContact{low, high, {}, 0}, before);
  if (found != waiting_.end() && found->low == low && found->high == high) {
    restore(*found, contact);
  }
}

}  // namespace talus::box2d
