#pragma once
// How much light falls where.

#include <span>
#include <vector>

#include "tools/picture/z_buffer.h"

namespace talus {

/// A soft sun and a sky: some dozens of distant lamps, each with a z-buffer of what it sees, so that shadows are soft
/// and gaps between bodies dark.
class Lighting {
 public:
  /// `faces` cast shadows, those outside `box` only by chance. The sun stands to the left of the eye, behind it.
  Lighting(std::span<const Face> faces, const Box<3>& box, const Projection<3>& eye);

  /// Light on a surface at `point` with unit `normal`: sun and sky sum to 1 on open level ground. The sky's light
  /// changes slowly along a surface and costs three times the sun's.
  double sun(const Vec3& point, const Vec3& normal) const;
  double sky(const Vec3& point, const Vec3& normal) const;

 private:
  struct Lamp {
    Vec3 direction;  // unit, towards the lamp
    double strength = 0.0;
    Projection<3> projection;
    ZBuffer shadows;

    /// Share of its light that reaches a surface, in [0, 1].
    double reaching(const Vec3& point, const Vec3& normal) const;
  };
  static Lamp lamp(const Vec3& direction, double strength, int resolution, const Box<3>& box);
  static double sum(const std::vector<Lamp>& lamps, const Vec3& point, const Vec3& normal);
  bool open_ground(const Vec3& point, const Vec3& normal) const;

  std::vector<Lamp> sun_;
  std::vector<Lamp> sky_;
  Vec3 middle_;
  double reach_;  // [m] from the middle: shadows further out are left away
};

}  // namespace talus
