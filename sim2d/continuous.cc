#include "sim2d/continuous.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/shape/piece.h"
#include "sim2d/tag.h"

namespace talus::box2d {
namespace {

bool is_sleeper(b2Fixture& fixture) { return fixture.GetBody()->GetType() == b2_staticBody && owner_of(fixture) >= 0; }

bool is_dynamic(const b2Body& body) { return body.GetType() == b2_dynamicBody; }

double least_width(const Shape<2>& shape) {
  double least = std::numeric_limits<double>::infinity();
  for (const Piece<2>& piece : shape.pieces) least = std::min(least, smallest_width(piece));
  return least;
}

/// From the centre to the farthest corner of the bounding box [m].
double reach_of(const Shape<2>& shape) {
  return shape.bounds.min().cwiseAbs().cwiseMax(shape.bounds.max().cwiseAbs()).norm();
}

}  // namespace

ContinuousCollision::ContinuousCollision(const WorldDescription<2>& description) {
  for (const Shape<2>& shape : description.shapes) {
    const Size& size = sizes_.emplace_back(Size{.reach = static_cast<float>(reach_of(shape)),
                                                .slow = static_cast<float>(least_width(shape) / 2.0 / description.dt)});
    const bool first = sizes_.size() == 1;
    any_.reach = std::max(any_.reach, size.reach);
    any_.slow = first ? size.slow : std::min(any_.slow, size.slow);
    longest_ = std::max(longest_, static_cast<float>(shape.extent));
  }
  slow_ = any_.slow / 2.0F;
}

const ContinuousCollision::Size& ContinuousCollision::size_of(const b2Body& body) const {
  return sizes_[const_cast<b2Body&>(body).GetUserData().pointer];  // NOLINT(*-const-cast): Box2D has no const access
}

bool ContinuousCollision::may_pass(const b2Body& a, const b2Body& b) const {
  const Size& first = size_of(a);
  const Size& second = size_of(b);
  const float approach = (a.GetLinearVelocity() - b.GetLinearVelocity()).Length() +
                         first.reach * std::abs(a.GetAngularVelocity()) +
                         second.reach * std::abs(b.GetAngularVelocity());
  return approach > first.slow + second.slow;
}

void ContinuousCollision::sweep(b2Body& body) {
  body.SetBullet(true);
  swept_.push_back(&body);
}

void ContinuousCollision::sweep_if_needed(b2Body& body) {
  if (body.IsBullet()) return;
  for (const b2ContactEdge* edge = body.GetContactList(); edge != nullptr; edge = edge->next) {
    if (!is_dynamic(*edge->other) || !may_pass(body, *edge->other)) continue;
    sweep(body);
    return;
  }
}

void ContinuousCollision::end_step() {
  stepping_ = false;
  for (b2Body* body : swept_) body->SetBullet(false);
  swept_.clear();
}

void ContinuousCollision::note_solved(b2Contact& contact, bool sleepers) {
  b2Fixture& first = *contact.GetFixtureA();
  b2Fixture& second = *contact.GetFixtureB();
  if (sleepers && is_sleeper(first)) leave_out_if_slow(contact, *second.GetBody());
  if (sleepers && is_sleeper(second)) leave_out_if_slow(contact, *first.GetBody());
  if (is_sleeper(first) || is_sleeper(second)) return;
  for (b2Body* body : {first.GetBody(), second.GetBody()}) {
    if (!is_dynamic(*body)) continue;
    if (is_fast(*body)) sweep_if_needed(*body);
    if (sleepers && !is_slow(*body)) search_sleepers(*body, true);
  }
}

void ContinuousCollision::leave_out_if_slow(const b2Contact& contact, const b2Body& body) const {
  // Disabled: left out with another contact of the same body.
  if (contact.IsEnabled() && is_slow(body)) search_sleepers(body, false);
}

/// Box2D enables a contact again whenever it updates it, at the latest in the next step.
void ContinuousCollision::search_sleepers(const b2Body& body, bool search) {
  for (const b2ContactEdge* edge = body.GetContactList(); edge != nullptr; edge = edge->next)
    if (is_sleeper(*edge->contact->GetFixtureA()) || is_sleeper(*edge->contact->GetFixtureB()))
      edge->contact->SetEnabled(search);
}

bool ContinuousCollision::is_slow(const b2Body& body) const {
  return body.GetLinearVelocity().Length() + longest_ * std::abs(body.GetAngularVelocity()) <= slow_;
}

bool ContinuousCollision::ShouldCollide(b2Fixture* a, b2Fixture* b) {
  b2Body& first = *a->GetBody();
  b2Body& second = *b->GetBody();
  if (!stepping_ || !is_dynamic(first) || !is_dynamic(second)) return true;
  b2Body* fast = is_fast(first) ? &first : is_fast(second) ? &second : nullptr;
  if (fast != nullptr && !first.IsBullet() && !second.IsBullet() && may_pass(first, second)) sweep(*fast);
  return true;
}

}  // namespace talus::box2d
