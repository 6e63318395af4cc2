#pragma once
// Eight floats at once. A file that includes this says how: TALUS_LANE_WIDTH is 8 (AVX2), 4 (SSE2) or 1 (plain loops).
// Everything is in an unnamed namespace, since the versions differ from file to file.

#include <cstdint>

#include "common/solver/contact_blocks.h"

#if TALUS_LANE_WIDTH > 1
#include <immintrin.h>
#endif

namespace talus::solver {
namespace {

#if TALUS_LANE_WIDTH == 8
using Native = __m256;
inline Native native_splat(float x) { return _mm256_set1_ps(x); }
inline Native native_load(const float* from) { return _mm256_load_ps(from); }
inline void native_store(float* to, Native x) { _mm256_store_ps(to, x); }
inline Native native_max(Native a, Native b) { return _mm256_max_ps(a, b); }
inline Native native_min(Native a, Native b) { return _mm256_min_ps(a, b); }
inline Native native_sqrt(Native a) { return _mm256_sqrt_ps(a); }
inline Native native_if_below(Native a, Native b, Native x, Native y) {
  return _mm256_blendv_ps(y, x, _mm256_cmp_ps(a, b, _CMP_LT_OQ));
}
inline bool native_any_below(Native a, Native b) { return _mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LT_OQ)) != 0; }
#elif TALUS_LANE_WIDTH == 4
using Native = __m128;
inline Native native_splat(float x) { return _mm_set1_ps(x); }
inline Native native_load(const float* from) { return _mm_load_ps(from); }
inline void native_store(float* to, Native x) { _mm_store_ps(to, x); }
inline Native native_max(Native a, Native b) { return _mm_max_ps(a, b); }
inline Native native_min(Native a, Native b) { return _mm_min_ps(a, b); }
inline Native native_sqrt(Native a) { return _mm_sqrt_ps(a); }
inline Native native_if_below(Native a, Native b, Native x, Native y) {
  const Native below = _mm_cmplt_ps(a, b);
  return _mm_or_ps(_mm_and_ps(below, x), _mm_andnot_ps(below, y));
}
inline bool native_any_below(Native a, Native b) { return _mm_movemask_ps(_mm_cmplt_ps(a, b)) != 0; }
#else
using Native = float;
inline Native native_splat(float x) { return x; }
inline Native native_load(const float* from) { return *from; }
inline void native_store(float* to, Native x) { *to = x; }
inline Native native_max(Native a, Native b) { return a > b ? a : b; }
inline Native native_min(Native a, Native b) { return a < b ? a : b; }
inline Native native_sqrt(Native a) { return __builtin_sqrtf(a); }
inline Native native_if_below(Native a, Native b, Native x, Native y) { return a < b ? x : y; }
inline bool native_any_below(Native a, Native b) { return a < b; }
#endif

constexpr int lane_width = TALUS_LANE_WIDTH;
constexpr int lane_parts = lanes_of_a_block / lane_width;

/// Each operation works lane by lane and rounds as the scalar one does.
struct Lanes {
  Native v[lane_parts] = {};
};

#define TALUS_EACH_PART(expression)                           \
  Lanes out;                                                  \
  for (int i = 0; i < lane_parts; ++i) out.v[i] = expression; \
  return out
inline Lanes splat(float x) { TALUS_EACH_PART(native_splat(x)); }
inline Lanes load(const Eight& from) { TALUS_EACH_PART(native_load(from.v + i * lane_width)); }
inline Lanes operator+(Lanes a, Lanes b) { TALUS_EACH_PART(a.v[i] + b.v[i]); }
inline Lanes operator-(Lanes a, Lanes b) { TALUS_EACH_PART(a.v[i] - b.v[i]); }
inline Lanes operator*(Lanes a, Lanes b) { TALUS_EACH_PART(a.v[i] * b.v[i]); }
inline Lanes operator/(Lanes a, Lanes b) { TALUS_EACH_PART(a.v[i] / b.v[i]); }
/// a > b ? a : b, so b where one is no number.
inline Lanes larger(Lanes a, Lanes b) { TALUS_EACH_PART(native_max(a.v[i], b.v[i])); }
/// a < b ? a : b.
inline Lanes smaller(Lanes a, Lanes b) { TALUS_EACH_PART(native_min(a.v[i], b.v[i])); }
inline Lanes root(Lanes a) { TALUS_EACH_PART(native_sqrt(a.v[i])); }
/// a < b ? x : y.
inline Lanes if_below(Lanes a, Lanes b, Lanes x, Lanes y) {
  TALUS_EACH_PART(native_if_below(a.v[i], b.v[i], x.v[i], y.v[i]));
}
#undef TALUS_EACH_PART
inline void store(Eight& to, Lanes a) {
  for (int i = 0; i < lane_parts; ++i) native_store(to.v + i * lane_width, a.v[i]);
}
/// Whether a < b in any lane.
inline bool any_below(Lanes a, Lanes b) {
  bool any = false;
  for (int i = 0; i < lane_parts; ++i) any = any || native_any_below(a.v[i], b.v[i]);
  return any;
}

#if TALUS_LANE_WIDTH == 4
inline void transpose(Native& a, Native& b, Native& c, Native& d) { _MM_TRANSPOSE4_PS(a, b, c, d); }
#elif TALUS_LANE_WIDTH == 8
/// In each half by itself.
inline void transpose(Native& a, Native& b, Native& c, Native& d) {
  const Native ab = _mm256_unpacklo_ps(a, b);
  const Native ab_high = _mm256_unpackhi_ps(a, b);
  const Native cd = _mm256_unpacklo_ps(c, d);
  const Native cd_high = _mm256_unpackhi_ps(c, d);
  a = _mm256_shuffle_ps(ab, cd, _MM_SHUFFLE(1, 0, 1, 0));
  b = _mm256_shuffle_ps(ab, cd, _MM_SHUFFLE(3, 2, 3, 2));
  c = _mm256_shuffle_ps(ab_high, cd_high, _MM_SHUFFLE(1, 0, 1, 0));
  d = _mm256_shuffle_ps(ab_high, cd_high, _MM_SHUFFLE(3, 2, 3, 2));
}
#endif

/// out[j], lane i: number j of quad `places[i]`, `stride` quads apart.
inline void load_quads(const Quad* quads, int stride, const std::int32_t* places, Lanes out[4]) {
#if TALUS_LANE_WIDTH == 8
  for (int i = 0; i < 4; ++i)
    out[i].v[0] = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(quads[stride * places[i]].v)),
                                       _mm_load_ps(quads[stride * places[i + 4]].v), 1);
  transpose(out[0].v[0], out[1].v[0], out[2].v[0], out[3].v[0]);
#elif TALUS_LANE_WIDTH == 4
  for (int part = 0; part < 2; ++part) {
    for (int i = 0; i < 4; ++i) out[i].v[part] = _mm_load_ps(quads[stride * places[4 * part + i]].v);
    transpose(out[0].v[part], out[1].v[part], out[2].v[part], out[3].v[part]);
  }
#else
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < lanes_of_a_block; ++i) out[j].v[i] = quads[stride * places[i]].v[j];
#endif
}

/// The opposite, lane after lane.
inline void store_quads(Quad* quads, int stride, const std::int32_t* places, const Lanes in[4]) {
#if TALUS_LANE_WIDTH == 8
  Native row[4] = {in[0].v[0], in[1].v[0], in[2].v[0], in[3].v[0]};
  transpose(row[0], row[1], row[2], row[3]);
  for (int i = 0; i < 4; ++i) _mm_store_ps(quads[stride * places[i]].v, _mm256_castps256_ps128(row[i]));
  for (int i = 0; i < 4; ++i) _mm_store_ps(quads[stride * places[i + 4]].v, _mm256_extractf128_ps(row[i], 1));
#elif TALUS_LANE_WIDTH == 4
  for (int part = 0; part < 2; ++part) {
    Native row[4] = {in[0].v[part], in[1].v[part], in[2].v[part], in[3].v[part]};
    transpose(row[0], row[1], row[2], row[3]);
    for (int i = 0; i < 4; ++i) _mm_store_ps(quads[stride * places[4 * part + i]].v, row[i]);
  }
#else
  for (int i = 0; i < lanes_of_a_block; ++i)
    for (int j = 0; j < 4; ++j) quads[stride * places[i]].v[j] = in[j].v[i];
#endif
}

}  // namespace
}  // namespace talus::solver
