#include "sim2d/continuous.h"

#include <box2d/b2_distance.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/shape/convex_piece.h"
#include "sim2d/conversions.h"
#include "sim2d/tag.h"

namespace talus::box2d {
namespace {

/// Relative error of a distance in single precision, and more.
constexpr float rounding = 1e-4F;

bool is_sleeper(b2Fixture& fixture) { return fixture.GetBody()->GetType() == b2_staticBody && owner_of(fixture) >= 0; }

/// How far the surface goes at most when the body turns by one radian [m]; a disc's about its centre stays.
double reach_of(const Shape<2>& shape) {
  double reach = 0.0;
  for (const ConvexPiece<2>& piece : convex_pieces(shape))
    for (const Vec2& corner : piece.corners) reach = std::max(reach, corner.norm());
  return reach;
}

}  // namespace

ContinuousCollision::ContinuousCollision(const WorldDescription<2>& description)
    : dt_(static_cast<float>(description.dt)) {
  double thinnest = std::numeric_limits<double>::infinity();
  for (const Shape<2>& shape : description.shapes) {
    const double width = least_width(shape);
    thinnest = std::min(thinnest, width);
    sizes_.push_back(
        {.reach = static_cast<float>(reach_of(shape)), .slow = static_cast<float>(width / 2.0 / description.dt)});
    any_.reach = std::max(any_.reach, sizes_.back().reach);
  }
  if (description.shapes.empty()) return;
  any_.slow = static_cast<float>(thinnest / 2.0 / description.dt);
  restless_size_ = {.reach = any_.reach, .slow = any_.slow / 4.0F};
  slow_ = static_cast<float>(thinnest / 4.0 / description.dt);
}

const ContinuousCollision::Size& ContinuousCollision::size_of(const b2Body& body) const {
  return sizes_[const_cast<b2Body&>(body).GetUserData().pointer];  // NOLINT(*-const-cast): Box2D has no const access
}

/// By how much two bodies may come together in a step beyond half the sum of their widths, as a speed [m/s].
float ContinuousCollision::excess(const b2Body& a, const b2Body& b) const {
  const Size& first = size_of(a);
  const Size& second = size_of(b);
  const float approach = (a.GetLinearVelocity() - b.GetLinearVelocity()).Length() +
                         first.reach * std::abs(a.GetAngularVelocity()) +
                         second.reach * std::abs(b.GetAngularVelocity());
  return approach - first.slow - second.slow;
}

/// The solver has parted those that touch; a time of impact may drive them together again.
bool ContinuousCollision::may_pass(b2Contact& contact) const {
  b2Fixture& a = *contact.GetFixtureA();
  b2Fixture& b = *contact.GetFixtureB();
  if (!contact.IsTouching()) return may_pass(a, b);
  b2WorldManifold world;
  contact.GetWorldManifold(&world);
  const float passing = size_of(*a.GetBody()).slow + size_of(*b.GetBody()).slow;
  for (int i = 0; i < contact.GetManifold()->pointCount; ++i) {
    const b2Vec2 relative = a.GetBody()->GetLinearVelocityFromWorldPoint(world.points[i]) -
                            b.GetBody()->GetLinearVelocityFromWorldPoint(world.points[i]);
    if (b2Dot(relative, world.normal) > passing) return true;
  }
  return false;
}

/// The gap between two pieces must close first. Two that would end middle on middle count too, whatever the rounding.
bool ContinuousCollision::may_pass(b2Fixture& a, b2Fixture& b) const {
  const float beyond = excess(*a.GetBody(), *b.GetBody());
  if (beyond <= 0.0F) return false;
  b2DistanceInput input;
  input.proxyA.Set(a.GetShape(), 0);
  input.proxyB.Set(b.GetShape(), 0);
  input.transformA = start_of(*a.GetBody());
  input.transformB = start_of(*b.GetBody());
  input.useRadii = true;
  b2SimplexCache cache{};
  b2DistanceOutput output;
  b2Distance(&output, &cache, &input);
  return output.distance < (1.0F + rounding) * dt_ * beyond;
}

/// Where a step with the body's velocity began; after a time of impact, where it would have begun.
b2Transform ContinuousCollision::start_of(const b2Body& body) const {
  if (!stepping_) return body.GetTransform();
  return {body.GetPosition() - dt_ * body.GetLinearVelocity(),
          b2Rot(body.GetAngle() - dt_ * body.GetAngularVelocity())};
}

void ContinuousCollision::sweep(b2Body& body) {
  body.SetBullet(true);
  swept_.push_back(&body);
}

void ContinuousCollision::sweep_if_needed(b2Body& body) {
  if (body.IsBullet()) return;
  for (const b2ContactEdge* edge = body.GetContactList(); edge != nullptr; edge = edge->next) {
    if (!is_dynamic(*edge->other) || excess(body, *edge->other) <= 0.0F || !may_pass(*edge->contact)) continue;
    sweep(body);
    return;
  }
}

void ContinuousCollision::end_step() {
  stepping_ = false;
  restless_ = false;
  for (b2Body* body : swept_) body->SetBullet(false);
  swept_.clear();
}

void ContinuousCollision::note_solved(b2Contact& contact, bool sleepers) {
  if (restless_) {
    b2Body& a = *contact.GetFixtureA()->GetBody();
    b2Body& b = *contact.GetFixtureB()->GetBody();
    if (is_dynamic(a) && is_fast(a)) sweep_if_needed(a);
    if (is_dynamic(b) && is_fast(b)) sweep_if_needed(b);
  }
  if (sleepers) weigh_sleepers(contact);
}

/// A contact with a sleeper shows whether a body is slow, one with another body whether it has been made fast.
void ContinuousCollision::weigh_sleepers(b2Contact& contact) const {
  b2Fixture& first = *contact.GetFixtureA();
  b2Fixture& second = *contact.GetFixtureB();
  const bool with_sleeper = is_sleeper(first) || is_sleeper(second);
  if (with_sleeper && !contact.IsEnabled()) return;  // left out with another contact of the same body
  for (const b2Body* body : {first.GetBody(), second.GetBody()})
    if (is_dynamic(*body) && is_slow(*body) == with_sleeper) search_sleepers(*body, !with_sleeper);
}

/// Box2D enables a contact again whenever it updates it, at the latest in the next step.
void ContinuousCollision::search_sleepers(const b2Body& body, bool search) {
  for (const b2ContactEdge* edge = body.GetContactList(); edge != nullptr; edge = edge->next)
    if (is_sleeper(*edge->contact->GetFixtureA()) || is_sleeper(*edge->contact->GetFixtureB()))
      edge->contact->SetEnabled(search);
}

bool ContinuousCollision::is_slow(const b2Body& body) const {
  return body.GetLinearVelocity().Length() + any_.reach * std::abs(body.GetAngularVelocity()) <= slow_;
}

bool ContinuousCollision::ShouldCollide(b2Fixture* a, b2Fixture* b) {
  if (!b2ContactFilter::ShouldCollide(a, b)) return false;
  b2Body& first = *a->GetBody();
  b2Body& second = *b->GetBody();
  if (!stepping_ || !is_dynamic(first) || !is_dynamic(second)) return true;
  b2Body* fast = is_fast(first) ? &first : is_fast(second) ? &second : nullptr;
  if (fast != nullptr && !first.IsBullet() && !second.IsBullet() && may_pass(*a, *b)) sweep(*fast);
  return true;
}

}  // namespace talus::box2d
