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
inline void store(float* to, Lanes a) { _mm_storeu_ps(to, a.v); }
inline float first(Lanes a) { return _mm_cvtss_f32(a.v); }
inline Lanes operator+(Lanes a, Lanes b) { return {_mm_add_ps(a.v, b.v)}; }
inline Lanes operator-(Lanes a, Lanes b) { return {_mm_sub_ps(a.v, b.v)}; }
inline Lanes operator*(Lanes a, Lanes b) { return {_mm_mul_ps(a.v, b.v)}; }
inline Lanes operator/(Lanes a, Lanes b) { return {_mm_div_ps(a.v, b.v)}; }
inline Lanes operator-(Lanes a) { return {_mm_xor_ps(a.v, _mm_set1_ps(-0.0F))}; }
inline Lanes absolute(Lanes a) { return {_mm_andnot_ps(_mm_set1_ps(-0.0F), a.v)}; }
/// a > b ? a : b, so b where one is no number.
inline Lanes larger(Lanes a, Lanes b) { return {_mm_max_ps(a.v, b.v)}; }
/// a < b ? a : b, so b where one is no number.
inline Lanes smaller(Lanes a, Lanes b) { return {_mm_min_ps(a.v, b.v)}; }
/// x == y ? a : b.
inline Lanes select_equal(Lanes x, Lanes y, Lanes a, Lanes b) {
  const __m128 mask = _mm_cmpeq_ps(x.v, y.v);
  return {_mm_or_ps(_mm_and_ps(mask, a.v), _mm_andnot_ps(mask, b.v))};
}
/// Whether a > b and c > d in none of the first three lanes.
inline bool none_above(Lanes a, Lanes b, Lanes c, Lanes d) {
  return (_mm_movemask_ps(_mm_or_ps(_mm_cmpgt_ps(a.v, b.v), _mm_cmpgt_ps(c.v, d.v))) & 7) == 0;
}
/// Whether a <= b and c <= d in all of the first three lanes.
inline bool all_at_most(Lanes a, Lanes b, Lanes c, Lanes d) {
  return (_mm_movemask_ps(_mm_and_ps(_mm_cmple_ps(a.v, b.v), _mm_cmple_ps(c.v, d.v))) & 7) == 7;
}
template <int I, int J, int K, int L>
Lanes shuffled(Lanes a) {
  return {_mm_shuffle_ps(a.v, a.v, _MM_SHUFFLE(L, K, J, I))};
}
inline void transpose(Lanes& a, Lanes& b, Lanes& c, Lanes& d) { _MM_TRANSPOSE4_PS(a.v, b.v, c.v, d.v); }
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
inline void store(float* to, Lanes a) {
  for (int i = 0; i < 4; ++i) to[i] = a.v[i];
}
inline float first(Lanes a) { return a.v[0]; }
inline Lanes operator+(Lanes a, Lanes b) {
  return each_lane([&](int i) { return a.v[i] + b.v[i]; });
}
inline Lanes operator-(Lanes a, Lanes b) {
  return each_lane([&](int i) { return a.v[i] - b.v[i]; });
}
inline Lanes operator*(Lanes a, Lanes b) {
  return each_lane([&](int i) { return a.v[i] * b.v[i]; });
}
inline Lanes operator/(Lanes a, Lanes b) {
  return each_lane([&](int i) { return a.v[i] / b.v[i]; });
}
inline Lanes operator-(Lanes a) {
  return each_lane([&](int i) { return -a.v[i]; });
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
inline Lanes select_equal(Lanes x, Lanes y, Lanes a, Lanes b) {
  return each_lane([&](int i) { return x.v[i] == y.v[i] ? a.v[i] : b.v[i]; });
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
template <int I, int J, int K, int L>
Lanes shuffled(Lanes a) {
  return {{a.v[I], a.v[J], a.v[K], a.v[L]}};
}
inline void transpose(Lanes& a, Lanes& b, Lanes& c, Lanes& d) {
  const Lanes rows[4] = {a, b, c, d};
  Lanes* const columns[4] = {&a, &b, &c, &d};
  for (int i = 0; i < 4; ++i) *columns[i] = {{rows[0].v[i], rows[1].v[i], rows[2].v[i], rows[3].v[i]}};
}
#endif

/// A vector of Bullet's, with its fourth float as it is.
inline Lanes load(const btVector3& from) { return load(from.m_floats); }
/// With 0 or another float as the fourth.
inline Lanes lanes(const btVector3& from, float w = 0) { return lanes(from.x(), from.y(), from.z(), w); }
/// Bullet's fourth float is overwritten too.
inline btVector3 to_vector(Lanes a) {
  btVector3 vector;
  store(vector.m_floats, a);
  return vector;
}

}  // namespace talus::bullet
