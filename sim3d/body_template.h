#pragma once
// What all bodies of one shape have in common in Bullet.

#include <btBulletCollisionCommon.h>

#include <memory>
#include <span>
#include <vector>

#include "common/shape/shape.h"

namespace talus::bullet {

/// Factor of all masses and inertias that go into Bullet, and so of all impulses that come out. A power of two, which
/// changes no bit of the motion; 1 where Bullet holds the masses as they are.
template <int Dim>
double mass_scale(std::span<const Shape<Dim>> shapes);

/// Of the surface of an object. Friction and restitution are square roots of the material's values: Bullet multiplies
/// those of both objects, which makes the pair's value their geometric mean.
struct Surface {
  btScalar friction = 0;
  btScalar restitution = 0;
};

/// All that a body of one Shape needs from it; made once and shared by its bodies.
///
/// Bullet requires a diagonal inertia, so it keeps each body in its principal axes; `frame` turns those into the
/// shape's own. Boxes, balls and capsules are exact. A convex hull keeps its corners and is `hull_margin` thicker
/// against ground, balls and capsules; hulls and boxes meet at their true faces (polyhedral clipping).
struct BodyTemplate {
  btCollisionShape* whole = nullptr;  // the last of `parts`
  std::vector<std::unique_ptr<btCollisionShape>> parts;
  Eigen::Quaterniond frame = Eigen::Quaterniond::Identity();
  Eigen::Quaterniond frame_inverse = Eigen::Quaterniond::Identity();
  btScalar mass = 0;                             // [kg times the world's mass scale]
  btVector3 inertia = btVector3(0, 0, 0);        // about the principal axes [kg m^2 times the mass scale]
  btVector3 linear_factor = btVector3(1, 1, 1);  // 0 where a planar body must not move
  btVector3 angular_factor = btVector3(1, 1, 1);
  Surface surface;
  btScalar inner_radius = 0;  // half the smallest width of the thinnest piece [m]
  btScalar sweep_from = 0;    // a body that moves further in a step gets continuous collision [m]
};

/// Thickness that a convex hull gains against what is no polyhedron [m]: what Bullet's distance algorithm (GJK) needs
/// between two surfaces that touch. More lifts bodies visibly, less makes its normals unsteady.
inline constexpr double hull_margin = 0.001;

/// `mass_scale`: factor of mass and inertia, see mass_scale().
template <int Dim>
BodyTemplate make_body_template(const Shape<Dim>& shape, double mass_scale = 1.0);

}  // namespace talus::bullet
