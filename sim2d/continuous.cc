#include "sim2d/continuous.h"

#include <algorithm>
#include <limits>

#include "common/shape/piece.h"
#include "sim2d/tag.h"

namespace talus::box2d {
namespace {

bool is_sleeper(b2Fixture& fixture) { return fixture.GetBody()->GetType() == b2_staticBody && owner_of(fixture) >= 0; }

}  // namespace

ContinuousCollision::ContinuousCollision(const WorldDescription<2>& description) {
  double thinnest = std::numeric_limits<double>::infinity();
  double reach = 0.0;
  for (const Shape<2>& shape : description.shapes) {
    reach = std::max(reach, shape.extent);
    for (const Piece<2>& piece : shape.pieces) thinnest = std::min(thinnest, smallest_width(piece));
  }
  reach_ = static_cast<float>(reach);
  slow_ = description.shapes.empty() ? 0.0F : static_cast<float>(thinnest / 4.0 / description.dt);
}

void ContinuousCollision::leave_out_if_slow(b2Contact& contact) const {
  if (!contact.IsEnabled()) return;  // left out with another contact of the same body
  b2Fixture& a = *contact.GetFixtureA();
  b2Fixture& b = *contact.GetFixtureB();
  if (!is_sleeper(a) && !is_sleeper(b)) return;
  const b2Body& body = *(is_sleeper(a) ? b : a).GetBody();
  if (body.GetLinearVelocity().Length() + reach_ * std::abs(body.GetAngularVelocity()) > slow_) return;
  for (const b2ContactEdge* edge = body.GetContactList(); edge != nullptr; edge = edge->next)
    if (is_sleeper(*edge->contact->GetFixtureA()) || is_sleeper(*edge->contact->GetFixtureB()))
      edge->contact->SetEnabled(false);
}

}  // namespace talus::box2d
