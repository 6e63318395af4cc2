#pragma once
// The algebra of three directions at once.

#include "sim3d/bullet/lanes.h"

namespace talus::bullet {

/// Four vectors, one a lane.
struct Vectors {
  Lanes x;
  Lanes y;
  Lanes z;
};

inline Vectors same(const btVector3& v) { return {splat(v.x()), splat(v.y()), splat(v.z())}; }

/// The fourth is 0.
inline Vectors three(const btVector3& a, const btVector3& b, const btVector3& c) {
  return {lanes(a.x(), b.x(), c.x(), 0), lanes(a.y(), b.y(), c.y(), 0), lanes(a.z(), b.z(), c.z(), 0)};
}

inline Vectors operator-(const Vectors& a) { return {-a.x, -a.y, -a.z}; }

/// As btVector3::dot.
inline Lanes dot(const Vectors& a, const Vectors& b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }

/// As btVector3::cross.
inline Vectors cross(const Vectors& a, const Vectors& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// As btMatrix3x3 times btVector3, with the matrix by rows, then lane by lane times `factor`.
inline Vectors product(const btVector3 (&rows)[3], const Vectors& v, const btVector3& factor) {
  return {dot(same(rows[0]), v) * splat(factor.x()), dot(same(rows[1]), v) * splat(factor.y()),
          dot(same(rows[2]), v) * splat(factor.z())};
}

/// The first three vectors, each with a number of its own behind it.
struct ThreeRows {
  Lanes row[3];
};
inline ThreeRows by_rows(const Vectors& v, Lanes fourth) {
  Lanes a = v.x;
  Lanes b = v.y;
  Lanes c = v.z;
  Lanes d = fourth;
  transpose(a, b, c, d);
  return {{a, b, c}};
}

}  // namespace talus::bullet
