#include "sim2d/warm_start.h"

#include <algorithm>
#include <tuple>

namespace talus::box2d {
namespace {

bool before(const SavedContact& a, const SavedContact& b) { return std::tie(a.low, a.high) < std::tie(b.low, b.high); }

bool is_with(const SavedContact& contact, BodyIndex side) {
  return owner_of(contact.low) == side || owner_of(contact.high) == side;
}

std::array<Tag, 2> sorted_tags(b2Contact& contact) {
  const Tag a = tag_of(*contact.GetFixtureA());
  const Tag b = tag_of(*contact.GetFixtureB());
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace

void WarmStart::save(b2Contact& contact) {
  if (!contact.IsTouching()) return;
  const auto [low, high] = sorted_tags(contact);
  SavedContact saved{low, high, {}};
  const b2Manifold& manifold = *contact.GetManifold();
  for (int i = 0; i < manifold.pointCount; ++i) {
    const b2ManifoldPoint& point = manifold.points[i];
    saved.points[i] = {point.id.key, point.normalImpulse, point.tangentImpulse};
  }
  waiting_.push_back(saved);
}

void WarmStart::apply(b2Contact& contact) const {
  const auto [low, high] = sorted_tags(contact);
  const auto found = std::ranges::lower_bound(waiting_, SavedContact{low, high, {}}, before);
  if (found == waiting_.end() || found->low != low || found->high != high) return;
  b2Manifold& manifold = *contact.GetManifold();
  for (b2ManifoldPoint& point : std::span(manifold.points, manifold.pointCount)) {
    for (const SavedPoint& saved : found->points) {
      if (saved.feature == point.id.key) {
        point.normalImpulse = saved.normal;
        point.tangentImpulse = saved.tangent;
      }
    }
  }
}

std::int32_t& SavedContacts::next_of(std::int32_t node, BodyIndex body) {
  Node& n = nodes_[node];
  return n.next[owner_of(n.contact.low) == body ? 0 : 1];
}

void SavedContacts::keep(const SavedContact& contact) {
  if (free_.empty()) {
    free_.push_back(static_cast<std::int32_t>(nodes_.size()));
    nodes_.emplace_back();
  }
  const std::int32_t node = free_.back();
  free_.pop_back();
  nodes_[node].contact = contact;
  for (const BodyIndex body : {owner_of(contact.low), owner_of(contact.high)}) {
    if (body < 0) continue;  // ground and obstacles never wake, so theirs are not needed
    if (body >= std::ssize(first_)) first_.resize(body + 1, -1);
    std::int32_t& first = first_[body];
    next_of(node, body) = first;
    first = node;
  }
}

void SavedContacts::unlink(std::int32_t node, BodyIndex body) {
  std::int32_t* link = &first_[body];
  while (*link != node) link = &next_of(*link, body);
  *link = next_of(node, body);
}

void SavedContacts::release(BodyIndex body, std::vector<SavedContact>& out) {
  if (body >= std::ssize(first_)) return;
  std::int32_t& first = first_[body];
  while (first >= 0) {
    const std::int32_t node = first;
    const SavedContact& contact = nodes_[node].contact;
    out.push_back(contact);
    const BodyIndex low = owner_of(contact.low);
    const BodyIndex other = low == body ? owner_of(contact.high) : low;
    first = next_of(node, body);
    if (other >= 0) unlink(node, other);
    free_.push_back(node);
  }
}

void SavedContacts::drop(BodyIndex obstacle) {
  for (BodyIndex body = 0; body < std::ssize(first_); ++body) {
    for (std::int32_t* link = &first_[body]; *link >= 0;) {
      const std::int32_t node = *link;
      std::int32_t& next = next_of(node, body);
      if (is_with(nodes_[node].contact, obstacle)) {
        *link = next;
        free_.push_back(node);
      } else {
        link = &next;
      }
    }
  }
}

/// An obstacle may come back, at another place.
void WarmStart::forget(BodyIndex side) {
  if (side < 0)
    sleeping_.drop(side);
  else
    sleeping_.release(side, waiting_);
  std::erase_if(waiting_, [side](const SavedContact& contact) { return is_with(contact, side); });
}

void WarmStart::start_step(std::span<const std::uint8_t> asleep, bool keeps) {
  const auto sleeps = [asleep](Tag tag) {
    const BodyIndex owner = owner_of(tag);
    return owner < 0 || asleep[owner] != 0;
  };
  // A contact of two bodies that fell asleep together was saved from both sides.
  std::ranges::stable_sort(waiting_, before);
  const auto same = [](const SavedContact& a, const SavedContact& b) { return a.low == b.low && a.high == b.high; };
  waiting_.erase(std::unique(waiting_.begin(), waiting_.end(), same), waiting_.end());
  std::erase_if(waiting_, [&](const SavedContact& contact) {
    const bool put_away = sleeps(contact.low) && sleeps(contact.high);
    if (put_away && keeps) sleeping_.keep(contact);
    return put_away;
  });
}

}  // namespace talus::box2d
