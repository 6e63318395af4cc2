#pragma once
// Four floats at once.

#if defined(__SSE2__) && !defined(TALUS_PLAIN_LANES)
#define TALUS_SSE2_LANES 1
#include <emmintrin.h>
#else
#define TALUS_SSE2_LANES 0
#include <cmath>
#endif

#include <LinearMath/btVector3.h>

namespace talus::bullet {

/// Four floats on which each operation works lane by lane, rounded as the scalar operation is: SSE2 where the processor
/// has it, else plain loops (also with the CMake option TALUS_PLAIN_LANES), to the same bits. A vector of Bullet's
/// takes the first three lanes.
#if TALUS_SSE2_LANES
struct Lanes {
  __m128 v;
};
inline Lanes splat(float x) { return {_mm_set1_ps(x)}; }
inline Lanes lanes(float x, float y, float z, float w) { return {_mm_setr_ps(x, y, z, w)}; }
inline Lanes load(const float* from) { return {_mm_loadu_ps(from)}; }
inline Lanes operator+(Lanes a, Lanes b) { return {_mm_add_ps(a.v, b.v)}; }
inline Lanes operator-(Lanes a, Lanes b) { return {_mm_sub_ps(a.v, b.v)}; }
inline Lanes operator*(Lanes a, Lanes b) { return {_mm_mul_ps(a.v, b.v)}; }
inline Lanes absolute(Lanes a) { return {_mm_andnot_ps(_mm_set1_ps(-0.0F), a.v)}; }
/// a > b ? a : b, so b where one is no number.
inline Lanes larger(Lanes a, Lanes b) { return {_mm_max_ps(a.v, b.v)}; }
/// a < b ? a : b, so b where one is no number.
inline Lanes smaller(Lanes a, Lanes b) { return {_mm_min_ps(a.v, b.v)}; }
/// Whether a > b and c > d in none of the first three lanes.
inline bool none_above(Lanes a, Lanes b, Lanes c, Lanes d) {
  return (_mm_movemask_ps(_mm_or_ps(_mm_cmpgt_ps(a.v, b.v), _mm_cmpgt_ps(c.v, d.v))) & 7) == 0;
}
/// Whether a <= b and c <= d in all of the first three lanes.
inline bool all_at_most(Lanes a, Lanes b, Lanes c, Lanes d) {
  return (_mm_movemask_ps(_mm_and_ps(_mm_cmple_ps(a.v, b.v), _mm_cmple_ps(c.v, d.v))) & 7) == 7;
}
#else
struct alignas(16) Lanes {
  float v[4];
};
template <class Operation>
Lanes each_lane(Operation operation) {
  return {{operation(0), operation(1), operation(2), operation(3)}};
}
inline Lanes splat(float x) { return {{x, x, x, x}}; }
inline Lanes lanes(float x, float y, float z, float w) { return {{x, y, z, w}}; }
inline Lanes load(const float* from) { return {{from[0], from[1], from[2], from[3]}}; }
inline Lanes operator+(Lanes a, Lanes b) {
  return each_lane([&](int i) { return a.v[i] + b.v[i]; });
}
inline Lanes operator-(Lanes a, Lanes b) {
  return each_lane([&](int i) { return a.v[i] - b.v[i]; });
}
inline Lanes operator*(Lanes a, Lanes b) {
  return each_lane([&](int i) { return a.v[i] * b.v[i]; });
}
inline Lanes absolute(Lanes a) {
  return each_lane([&](int i) { return std::fabs(a.v[i]); });
}
inline Lanes larger(Lanes a, Lanes b) {
  return each_lane([&](int i) { return a.v[i] > b.v[i] ? a.v[i] : b.v[i]; });
}
inline Lanes smaller(Lanes a, Lanes b) {
  return each_lane([&](int i) { return a.v[i] < b.v[i] ? a.v[i] : b.v[i]; });
}
inline bool none_above(Lanes a, Lanes b, Lanes c, Lanes d) {
  for (int i = 0; i < 3; ++i)
    if (a.v[i] > b.v[i] || c.v[i] > d.v[i]) return false;
  return true;
}
inline bool all_at_most(Lanes a, Lanes b, Lanes c, Lanes d) {
  for (int i = 0; i < 3; ++i)
    if (!(a.v[i] <= b.v[i]) || !(c.v[i] <= d.v[i])) return false;
  return true;
}
#endif

/// A vector of Bullet's, with its fourth float as it is.
inline Lanes load(const btVector3& from) { return load(from.m_floats); }
/// With 0 as the fourth.
inline Lanes lanes(const btVector3& from) { return lanes(from.x(), from.y(), from.z(), 0); }

}  // namespace talus::bullet
