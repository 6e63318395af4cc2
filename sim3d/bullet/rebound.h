#pragma once
// Rebound of bodies that meet the surface within a step.

#include <btBulletDynamicsCommon.h>

namespace talus::bullet {

/// Sets the restitution of all contact points for the coming solve, where both surfaces have one, so that surfaces
/// which meet at speed v part at e v. Bullet's target (setupContactConstraint) is e v - gap / dt where a gap is still
/// open, which at short steps takes all of the rebound and slows down bodies that do not meet in this step; where
/// bodies overlap a little it is e v plus the speed that moves them apart, which adds energy. O(contact points); for a
/// world in which a shape has restitution. `dt` [s].
void set_rebounds(btDispatcher& dispatcher, const btContactSolverInfo& info, btScalar dt);

}  // namespace talus::bullet
