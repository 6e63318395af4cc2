#include "sim2d/body_template.h"

#include "sim2d/materials.h"

namespace talus::box2d {

BodyTemplate make_body_template(const Shape<2>& shape, const SolverParams& solver) {
  b2MassData mass;
  mass.mass = static_cast<float>(shape.mass);
  mass.center.SetZero();
  mass.I = static_cast<float>(shape.inertia(0, 0));
  return {engine_pieces(shape), fixture_of(shape.material, solver), mass};
}

}  // namespace talus::box2d
