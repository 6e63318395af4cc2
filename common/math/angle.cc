#include "common/math/angle.h"

namespace talus {

Rotation<2> turn_to(const Vec2& direction) { return Rotation<2>(std::atan2(direction.y(), direction.x())); }
Rotation<3> turn_to(const Vec3& direction) { return Rotation<3>::FromTwoVectors(Vec3::UnitX(), direction); }

}  // namespace talus
