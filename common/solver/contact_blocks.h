#pragma once
// What the solver's inner loops work on: contacts in blocks of eight that share no body that moves.
//
// Plain data only: the loops are compiled for several processors, and no function that another file might share may
// be compiled with them.

#include <cstdint>

namespace talus::solver {

inline constexpr int lanes_of_a_block = 8;

/// One number of each contact of a block.
struct alignas(32) Eight {
  float v[lanes_of_a_block];
};

/// Numbers of a body: in 2D x, z and turn; in 3D a vector. The last is 0 or unused.
struct alignas(16) Quad {
  float v[4];
};

template <int Dim>
inline constexpr int spin_size = Dim == 2 ? 1 : 3;
/// Different numbers of an inverse inertia: of xx, yy, zz, xy, xz, yz in 3D.
template <int Dim>
inline constexpr int inertia_size = Dim == 2 ? 1 : 6;
/// Quads of a body's velocity and spin.
template <int Dim>
inline constexpr int quads_of_a_body = Dim == 2 ? 1 : 2;
/// Points of one pair that are solved together.
template <int Dim>
inline constexpr int points_of_a_group = Dim == 2 ? 2 : 4;

/// One point of each contact. See ContactPoint for signs; impulses are those of a sub-step.
template <int Dim>
struct PointBlock {
  Eight normal[Dim];
  Eight tangent[Dim];  // unit; in 3D the second is normal x tangent
  Eight arm_a[Dim];
  Eight arm_b[Dim];
  Eight gap;           // at the start of the step
  Eight gain;          // impulse over change of normal speed; 0 in an unused lane
  Eight soft_gain;     // the same of the spring
  Eight soft_keep;     // share of the impulse that the spring takes back
  Eight tangent_gain;  // the same in both directions, else sliding friction would not point against the slip
  Eight friction;
  Eight bounce;  // normal speed after the impact, with the sign of the speed before; 0: none
  Eight impulse;
  Eight tangent_impulse[Dim - 1];
  Eight before;  // at the end of the sub-step before
  Eight tangent_before[Dim - 1];
  Eight sum;  // of the step
  Eight tangent_sum[Dim - 1];
  Eight highest;
};

/// Resistance to relative spin of each contact.
template <int Dim>
struct RollingBlock {
  Eight arm;
  Eight gain[inertia_size<Dim>];
  Eight impulse[spin_size<Dim>];
};

/// Eight contacts with `points` points each, some of them perhaps unused.
template <int Dim>
struct ContactBlock {
  std::int32_t a[lanes_of_a_block];  // slots of the bodies
  std::int32_t b[lanes_of_a_block];
  Eight inverse_mass_a;
  Eight inverse_mass_b;
  Eight inverse_inertia_a[inertia_size<Dim>];
  Eight inverse_inertia_b[inertia_size<Dim>];
  Eight rate;  // of the spring: the speed at which it separates the bodies, per metre of overlap [1/s]
  std::int32_t first_point;
  std::int32_t points;
  std::int32_t rolling;  // number of its RollingBlock; -1: none
  bool bounces;          // one of them perhaps
};

/// All of a step.
template <int Dim>
struct ContactArrays {
  Quad* velocity;     // quads_of_a_body of each body
  const Quad* moved;  // since the start of the step
  Quad* free;         // velocity of this sub-step without contacts
  ContactBlock<Dim>* blocks;
  int block_count;
  PointBlock<Dim>* points;
  RollingBlock<Dim>* rolling;
  float inverse_h;  // 1 over the length of a sub-step
  float deep;       // largest overlap that acts on the spring, beyond that of the load
  float deepest;    // largest overlap that acts on the spring
  float carry;      // an impulse is carried on at this times the one before at most
};

enum class Pass {
  soft,    // with the spring
  relax,   // without
  end,     // without; the last of a sub-step: adds up the impulses and limits what is carried on
  bounce,  // restitution
};

template <int Dim>
using Kernel = void (*)(const ContactArrays<Dim>& arrays, Pass pass);

#define TALUS_DECLARE_KERNELS(name)                     \
  void name(const ContactArrays<2>& arrays, Pass pass); \
  void name(const ContactArrays<3>& arrays, Pass pass)
TALUS_DECLARE_KERNELS(solve_plain);
TALUS_DECLARE_KERNELS(solve_sse2);
TALUS_DECLARE_KERNELS(solve_avx2);
#undef TALUS_DECLARE_KERNELS

}  // namespace talus::solver
