#pragma once
// The solver's inner loops over blocks of contacts, in the lanes of the file that includes this.

#include "common/solver/lanes.h"

namespace talus::solver {
namespace {

template <int Size>
struct Several {
  Lanes x[Size] = {};
};

inline Lanes dot(const Several<2>& a, const Several<2>& b) { return a.x[0] * b.x[0] + a.x[1] * b.x[1]; }
inline Lanes dot(const Several<3>& a, const Several<3>& b) {
  return (a.x[0] * b.x[0] + a.x[1] * b.x[1]) + a.x[2] * b.x[2];
}
template <int Size>
Several<Size> operator+(const Several<Size>& a, const Several<Size>& b) {
  Several<Size> out;
  for (int i = 0; i < Size; ++i) out.x[i] = a.x[i] + b.x[i];
  return out;
}
template <int Size>
Several<Size> operator-(const Several<Size>& a, const Several<Size>& b) {
  Several<Size> out;
  for (int i = 0; i < Size; ++i) out.x[i] = a.x[i] - b.x[i];
  return out;
}
template <int Size>
Several<Size> operator*(Lanes s, const Several<Size>& a) {
  Several<Size> out;
  for (int i = 0; i < Size; ++i) out.x[i] = s * a.x[i];
  return out;
}
template <int Size>
Several<Size> load(const Eight (&from)[Size]) {
  Several<Size> out;
  for (int i = 0; i < Size; ++i) out.x[i] = load(from[i]);
  return out;
}
template <int Size>
void store(Eight (&to)[Size], const Several<Size>& a) {
  for (int i = 0; i < Size; ++i) store(to[i], a.x[i]);
}

/// Torque of an impulse at an arm.
inline Several<1> cross(const Several<2>& arm, const Several<2>& p) {
  return {{arm.x[0] * p.x[1] - arm.x[1] * p.x[0]}};
}
inline Several<3> cross(const Several<3>& a, const Several<3>& b) {
  return {{a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2], a.x[0] * b.x[1] - a.x[1] * b.x[0]}};
}
/// Velocity of the end of an arm by a spin.
inline Several<2> turned(const Several<1>& spin, const Several<2>& arm) {
  return {{splat(0.0F) - spin.x[0] * arm.x[1], spin.x[0] * arm.x[0]}};
}
inline Several<3> turned(const Several<3>& spin, const Several<3>& arm) { return cross(spin, arm); }
inline Several<1> times(const Several<1>& m, const Several<1>& a) { return {{m.x[0] * a.x[0]}}; }
inline Several<3> times(const Several<6>& m, const Several<3>& a) {
  return {{(m.x[0] * a.x[0] + m.x[3] * a.x[1]) + m.x[4] * a.x[2], (m.x[3] * a.x[0] + m.x[1] * a.x[1]) + m.x[5] * a.x[2],
           (m.x[4] * a.x[0] + m.x[5] * a.x[1]) + m.x[2] * a.x[2]}};
}
inline Several<3> second_tangent(const Several<3>& normal, const Several<3>& tangent) { return cross(normal, tangent); }

/// Velocities or displacements of eight bodies.
template <int Dim>
struct Motion {
  Several<Dim> linear;
  Several<spin_size<Dim>> angular;
};

template <int Dim>
Motion<Dim> load_motion(const Quad* quads, const std::int32_t* places) {
  Lanes linear[4];
  load_quads(quads, Dim - 1, places, linear);
  if constexpr (Dim == 2) {
    return {{{linear[0], linear[1]}}, {{linear[2]}}};
  } else {
    Lanes angular[4];
    load_quads(quads + 1, 2, places, angular);
    return {{{linear[0], linear[1], linear[2]}}, {{angular[0], angular[1], angular[2]}}};
  }
}
inline void store_motion(Quad* quads, const std::int32_t* places, const Motion<2>& m) {
  const Lanes quad[4] = {m.linear.x[0], m.linear.x[1], m.angular.x[0], splat(0.0F)};
  store_quads(quads, 1, places, quad);
}
inline void store_motion(Quad* quads, const std::int32_t* places, const Motion<3>& m) {
  const Lanes linear[4] = {m.linear.x[0], m.linear.x[1], m.linear.x[2], splat(0.0F)};
  const Lanes angular[4] = {m.angular.x[0], m.angular.x[1], m.angular.x[2], splat(0.0F)};
  store_quads(quads, 2, places, linear);
  store_quads(quads + 1, 2, places, angular);
}

/// A block while it is solved: both bodies of each contact.
template <int Dim>
struct Pair {
  Motion<Dim> a;
  Motion<Dim> b;
  Lanes inverse_mass_a;
  Lanes inverse_mass_b;
  Several<inertia_size<Dim>> inverse_inertia_a;
  Several<inertia_size<Dim>> inverse_inertia_b;

  Pair(const ContactBlock<Dim>& block, const Quad* velocity)
      : a(load_motion<Dim>(velocity, block.a)),
        b(load_motion<Dim>(velocity, block.b)),
        inverse_mass_a(load(block.inverse_mass_a)),
        inverse_mass_b(load(block.inverse_mass_b)),
        inverse_inertia_a(load(block.inverse_inertia_a)),
        inverse_inertia_b(load(block.inverse_inertia_b)) {}

  void store_to(const ContactBlock<Dim>& block, Quad* velocity) const {
    store_motion(velocity, block.a, a);
    store_motion(velocity, block.b, b);
  }

  static Several<Dim> relative(const Motion<Dim>& of_a, const Motion<Dim>& of_b, const Several<Dim>& arm_a,
                               const Several<Dim>& arm_b) {
    return (of_b.linear + turned(of_b.angular, arm_b)) - (of_a.linear + turned(of_a.angular, arm_a));
  }

  void push(const Several<Dim>& impulse, const Several<Dim>& arm_a, const Several<Dim>& arm_b) {
    a.linear = a.linear - inverse_mass_a * impulse;
    a.angular = a.angular - times(inverse_inertia_a, cross(arm_a, impulse));
    b.linear = b.linear + inverse_mass_b * impulse;
    b.angular = b.angular + times(inverse_inertia_b, cross(arm_b, impulse));
  }

  void twist(const Several<spin_size<Dim>>& impulse) {
    a.angular = a.angular - times(inverse_inertia_a, impulse);
    b.angular = b.angular + times(inverse_inertia_b, impulse);
  }
};

template <int Dim, Pass Of>
void solve_normal(const ContactArrays<Dim>& arrays, const ContactBlock<Dim>& block, const Motion<Dim>& moved_a,
                  const Motion<Dim>& moved_b, Pair<Dim>& pair, PointBlock<Dim>& point) {
  const Lanes zero = splat(0.0F);
  const Several<Dim> normal = load(point.normal);
  const Several<Dim> arm_a = load(point.arm_a);
  const Several<Dim> arm_b = load(point.arm_b);
  const Lanes speed = dot(normal, Pair<Dim>::relative(pair.a, pair.b, arm_a, arm_b));
  const Lanes gap = load(point.gap) + dot(normal, Pair<Dim>::relative(moved_a, moved_b, arm_a, arm_b));
  const Lanes impulse = load(point.impulse);
  const Lanes closing = larger(gap, zero) * splat(arrays.inverse_h);  // speed at which the gap closes in a sub-step
  Lanes next;
  if constexpr (Of == Pass::soft) {
    // What the spring gives beyond the load that it carries is limited, and not the spring: under a heavy body it must
    // stay one.
    const Lanes soft_gain = load(point.soft_gain);
    const Lanes stiffness = soft_gain * load(block.rate);
    const Lanes overlap = smaller(zero - gap, splat(arrays.deepest));
    const Lanes spring = stiffness * overlap - load(point.soft_keep) * impulse;
    const Lanes soft = soft_gain * speed - smaller(spring, stiffness * splat(arrays.deep));
    const Lanes hard = load(point.gain) * (speed + closing);
    next = impulse - if_below(zero, gap, hard, soft);
  } else {
    next = impulse - load(point.gain) * (speed + closing);
  }
  next = larger(next, zero);
  pair.push((next - impulse) * normal, arm_a, arm_b);
  store(point.impulse, next);
  store(point.highest, larger(load(point.highest), next));
}

/// Friction of one point, at most its coefficient times the normal impulse.
template <int Dim>
void solve_friction(Pair<Dim>& pair, PointBlock<Dim>& point) {
  const Several<Dim> tangent = load(point.tangent);
  const Several<Dim> arm_a = load(point.arm_a);
  const Several<Dim> arm_b = load(point.arm_b);
  const Several<Dim> slip = Pair<Dim>::relative(pair.a, pair.b, arm_a, arm_b);
  const Lanes limit = load(point.friction) * load(point.impulse);
  const Several<Dim - 1> impulse = load(point.tangent_impulse);
  const Lanes gain = load(point.tangent_gain);
  if constexpr (Dim == 2) {
    const Lanes free = impulse.x[0] - gain * dot(tangent, slip);
    const Lanes next = larger(smaller(free, limit), splat(0.0F) - limit);
    pair.push((next - impulse.x[0]) * tangent, arm_a, arm_b);
    store(point.tangent_impulse[0], next);
  } else {
    const Several<Dim> second = second_tangent(load(point.normal), tangent);
    const Lanes free_1 = impulse.x[0] - gain * dot(tangent, slip);
    const Lanes free_2 = impulse.x[1] - gain * dot(second, slip);
    const Lanes length = root(free_1 * free_1 + free_2 * free_2);
    const Lanes share = if_below(limit, length, limit / length, splat(1.0F));
    const Several<2> next = {{share * free_1, share * free_2}};
    pair.push((next.x[0] - impulse.x[0]) * tangent + (next.x[1] - impulse.x[1]) * second, arm_a, arm_b);
    store(point.tangent_impulse, next);
  }
}

/// The normal impulse of a pair.
template <int Dim>
Lanes push_of(const ContactArrays<Dim>& arrays, const ContactBlock<Dim>& block) {
  Lanes push = load(arrays.points[block.first_point].impulse);
  for (int j = 1; j < block.points; ++j) push = push + load(arrays.points[block.first_point + j].impulse);
  return push;
}

/// Share of a rolling impulse that a pair's normal impulse allows.
template <int Size>
Lanes share_within(Lanes limit, const Several<Size>& impulse) {
  Lanes square = impulse.x[0] * impulse.x[0];
  for (int i = 1; i < Size; ++i) square = square + impulse.x[i] * impulse.x[i];
  const Lanes length = root(square);
  return if_below(limit, length, limit / length, splat(1.0F));
}

template <int Dim>
void solve_rolling(Pair<Dim>& pair, RollingBlock<Dim>& rolling, Lanes push) {
  const auto impulse = load(rolling.impulse);
  auto next = impulse - times(load(rolling.gain), pair.b.angular - pair.a.angular);
  next = share_within(load(rolling.arm) * push, next) * next;
  pair.twist(next - impulse);
  store(rolling.impulse, next);
}

/// What a limited impulse lacks is taken from what its bodies carry on.
template <int Dim>
void take_back(const ContactArrays<Dim>& arrays, const ContactBlock<Dim>& block, const Several<Dim>& cut,
               const PointBlock<Dim>& point) {
  Pair<Dim> carried(block, arrays.free);
  carried.push(splat(-1.0F) * cut, load(point.arm_a), load(point.arm_b));  // carried on: velocity less the free one
  carried.store_to(block, arrays.free);
}

/// Adds up the impulses of a sub-step. Those of an impact must not start the next one: they would throw the bodies
/// back.
template <int Dim>
void end_sub_step(const ContactArrays<Dim>& arrays, const ContactBlock<Dim>& block, PointBlock<Dim>& point) {
  const Lanes zero = splat(0.0F);
  const Lanes impulse = load(point.impulse);
  const Several<Dim - 1> tangential = load(point.tangent_impulse);
  store(point.sum, load(point.sum) + impulse);
  store(point.tangent_sum, load(point.tangent_sum) + tangential);
  const Lanes most = splat(arrays.carry) * load(point.before);
  const Lanes kept = smaller(impulse, most);
  Several<Dim - 1> kept_tangential;
  for (int i = 0; i < Dim - 1; ++i) {
    const Lanes before = load(point.tangent_before[i]);
    const Lanes limit = splat(arrays.carry) * larger(before, zero - before);
    kept_tangential.x[i] = larger(smaller(tangential.x[i], limit), zero - limit);
  }
  store(point.before, impulse);
  store(point.tangent_before, tangential);
  store(point.impulse, kept);
  store(point.tangent_impulse, kept_tangential);
  bool limited = any_below(kept, impulse);
  for (int i = 0; i < Dim - 1; ++i)
    limited =
        limited || any_below(kept_tangential.x[i], tangential.x[i]) || any_below(tangential.x[i], kept_tangential.x[i]);
  if (!limited) return;
  const Several<Dim> normal = load(point.normal);
  const Several<Dim> tangent = load(point.tangent);
  Several<Dim> cut = (kept - impulse) * normal + (kept_tangential.x[0] - tangential.x[0]) * tangent;
  if constexpr (Dim == 3) cut = cut + (kept_tangential.x[1] - tangential.x[1]) * second_tangent(normal, tangent);
  take_back(arrays, block, cut, point);
}

/// Limits the rolling impulse that starts the next sub-step by the normal impulses that start it.
template <int Dim>
void end_rolling(const ContactArrays<Dim>& arrays, const ContactBlock<Dim>& block) {
  RollingBlock<Dim>& rolling = arrays.rolling[block.rolling];
  const auto impulse = load(rolling.impulse);
  const Lanes share = share_within(load(rolling.arm) * push_of(arrays, block), impulse);
  if (!any_below(share, splat(1.0F))) return;
  store(rolling.impulse, share * impulse);
  Pair<Dim> carried(block, arrays.free);
  carried.twist((splat(1.0F) - share) * impulse);
  carried.store_to(block, arrays.free);
}

// How often a pair's points are solved again in a pass in which they are hit, and the speed that an impact takes away
// at least [m/s]. Solved once, a box that lands flat loses a fourth of the friction of its impact.
constexpr int impact_repeats = 4;
constexpr float impact_speed = 0.05F;

template <int Dim>
bool has_impact(const ContactArrays<Dim>& arrays, const ContactBlock<Dim>& block) {
  bool impact = false;
  for (int j = 0; j < block.points; ++j) {
    const PointBlock<Dim>& point = arrays.points[block.first_point + j];
    const Lanes load_most = splat(arrays.carry) * load(point.before) + splat(impact_speed) * load(point.gain);
    impact = impact || any_below(load_most, load(point.impulse));
  }
  return impact;
}

/// Flattened: with calls that are not inlined, which pass vectors through memory, a pass takes 1.4 times as long.
template <int Dim, Pass Of>
[[gnu::flatten]] void pass(const ContactArrays<Dim>& arrays) {
  for (int i = 0; i < arrays.block_count; ++i) {
    ContactBlock<Dim>& block = arrays.blocks[i];
    PointBlock<Dim>* const points = arrays.points + block.first_point;
    Pair<Dim> pair(block, arrays.velocity);
    const Motion<Dim> moved_a = load_motion<Dim>(arrays.moved, block.a);
    const Motion<Dim> moved_b = load_motion<Dim>(arrays.moved, block.b);
    const auto solve_points = [&] {
      for (int j = 0; j < block.points; ++j) solve_normal<Dim, Of>(arrays, block, moved_a, moved_b, pair, points[j]);
      for (int j = 0; j < block.points; ++j) solve_friction<Dim>(pair, points[j]);
    };
    solve_points();
    if (has_impact(arrays, block))
      for (int j = 0; j < impact_repeats; ++j) solve_points();
    if (block.rolling >= 0) solve_rolling<Dim>(pair, arrays.rolling[block.rolling], push_of(arrays, block));
    pair.store_to(block, arrays.velocity);
    if constexpr (Of == Pass::end) {
      for (int j = 0; j < block.points; ++j) end_sub_step<Dim>(arrays, block, points[j]);
      if (block.rolling >= 0) end_rolling(arrays, block);
    }
  }
}

/// Restitution of what was hit, with friction: without, a box that falls on its corner keeps half of its energy.
template <int Dim>
[[gnu::flatten]] void bounce(const ContactArrays<Dim>& arrays) {
  const Lanes zero = splat(0.0F);
  for (int i = 0; i < arrays.block_count; ++i) {
    ContactBlock<Dim>& block = arrays.blocks[i];
    if (!block.bounces) continue;
    Pair<Dim> pair(block, arrays.velocity);
    for (int j = 0; j < block.points; ++j) {
      PointBlock<Dim>& point = arrays.points[block.first_point + j];
      const Several<Dim> normal = load(point.normal);
      const Several<Dim> arm_a = load(point.arm_a);
      const Several<Dim> arm_b = load(point.arm_b);
      const Lanes speed = dot(normal, Pair<Dim>::relative(pair.a, pair.b, arm_a, arm_b));
      const Lanes impulse = load(point.impulse);
      const Lanes target = load(point.bounce);
      const Lanes hit = if_below(zero, load(point.highest), target, zero);  // below 0: bounces
      const Lanes gain = if_below(hit, zero, load(point.gain), zero);
      const Lanes next = larger(impulse - gain * (speed + target), zero);
      pair.push((next - impulse) * normal, arm_a, arm_b);
      store(point.sum, load(point.sum) + (next - impulse));
      store(point.impulse, next);
      const Several<Dim - 1> before = load(point.tangent_impulse);
      if (any_below(hit, zero)) solve_friction<Dim>(pair, point);
      store(point.tangent_sum, load(point.tangent_sum) + (load(point.tangent_impulse) - before));
    }
    pair.store_to(block, arrays.velocity);
  }
}

template <int Dim>
void solve(const ContactArrays<Dim>& arrays, Pass of) {
  switch (of) {
    case Pass::soft:
      return pass<Dim, Pass::soft>(arrays);
    case Pass::relax:
      return pass<Dim, Pass::relax>(arrays);
    case Pass::end:
      return pass<Dim, Pass::end>(arrays);
    case Pass::bounce:
      return bounce<Dim>(arrays);
  }
}

}  // namespace
}  // namespace talus::solver
