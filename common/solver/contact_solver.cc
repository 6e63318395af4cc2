#include "common/solver/contact_solver.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <functional>
#include <numbers>

#include "common/solver/contact_blocks.h"
#include "common/solver/contact_sets.h"

namespace talus {

using solver::ContactBlock;
using solver::Eight;
using solver::Kernel;
using solver::Pass;
using solver::PointBlock;
using solver::Quad;
using solver::quads_of_a_body;
using solver::RollingBlock;
using solver::solve_avx2;
using solver::solve_plain;
using solver::solve_sse2;
using solver::spin_size;

namespace {

constexpr float damping_ratio = 10.0F;  // of a contact's spring: overlap goes away without bouncing
constexpr float spring = 0.125F;        // its frequency, over that of the sub-steps; from 0.15 on pyramids buckle
constexpr float fixed_spring = 1.4F;    // factor of that frequency against what never moves; at 2, one pass no longer
                                        // carries a body a hundred times as heavy as the one below it
constexpr float carry = 2.0F;           // an impulse is carried into the next sub-step at this times its last at most
constexpr int first_passes = 2;         // of the first sub-step, in which contacts begin
constexpr int bounce_passes = 4;
constexpr int deep_passes = 3;
constexpr float cohesive_reach = 0.01F;  // gap over which bodies attract each other [m]
constexpr float deepest = 0.04F;       // largest overlap that acts on the spring [m]: that of a hundred times a body's
                                       // weight. Two that press on a body from both sides would else grow without end
constexpr float deep_overlap = 0.01F;  // beyond this and that of the load it is moved apart without giving velocity [m]
constexpr float deep_share = 0.2F;     // of a deep overlap, moved apart in each of them

float inverse(float x) { return x > 0.0F ? 1.0F / x : 0.0F; }

float cross(const VecF<2>& a, const VecF<2>& b) { return a.x() * b.y() - a.y() * b.x(); }

SpinF<2> torque(const VecF<2>& arm, const VecF<2>& impulse) { return SpinF<2>(cross(arm, impulse)); }
SpinF<3> torque(const VecF<3>& arm, const VecF<3>& impulse) { return arm.cross(impulse); }

std::array<VecF<2>, 1> tangents_of(const VecF<2>& normal) { return {VecF<2>(normal.y(), -normal.x())}; }
std::array<VecF<3>, 2> tangents_of(const VecF<3>& normal) {
  // Away from the axis that is nearest to the normal.
  Eigen::Index nearest = 0;
  normal.cwiseAbs().maxCoeff(&nearest);
  const VecF<3> first = normal.cross(VecF<3>::Unit((nearest + 1) % 3)).normalized();
  return {first, normal.cross(first)};
}

/// Velocity along `direction` that a unit impulse in it at the point gives it there, of one body.
template <int Dim>
float yield(const SolverBody<Dim>& body, const VecF<Dim>& arm, const VecF<Dim>& direction) {
  const SpinF<Dim> twist = torque(arm, direction);
  return body.inverse_mass + twist.dot(body.inverse_inertia * twist);
}

void put(Eight* to, const InertiaF<2>& m, int lane) { to[0].v[lane] = m(0, 0); }
void put(Eight* to, const InertiaF<3>& m, int lane) {
  const std::array<float, 6> numbers = {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)};
  for (int i = 0; i < 6; ++i) to[i].v[lane] = numbers[i];
}
template <int Dim>
void put(Eight (&to)[Dim], const VecF<Dim>& vector, int lane) {
  for (int i = 0; i < Dim; ++i) to[i].v[lane] = vector[i];
}

/// A velocity or displacement, as the inner loops have it.
template <int Dim>
VecF<Dim> linear_of(const Quad* quads) {
  return VecF<Dim>(quads->v);
}
template <int Dim>
SpinF<Dim> angular_of(const Quad* quads) {
  return SpinF<Dim>(Dim == 2 ? quads->v + 2 : quads[1].v);
}
template <int Dim>
void set(Quad* quads, const VecF<Dim>& linear, const SpinF<Dim>& angular) {
  VecF<Dim>::Map(quads->v) = linear;
  SpinF<Dim>::Map(Dim == 2 ? quads->v + 2 : quads[1].v) = angular;
}
template <int Dim>
void add_to(Quad* quads, const VecF<Dim>& linear, const SpinF<Dim>& angular) {
  VecF<Dim>::Map(quads->v) += linear;
  SpinF<Dim>::Map(Dim == 2 ? quads->v + 2 : quads[1].v) += angular;
}

/// A contact's spring, Box2D v3's soft constraint, for a step of `h` [s].
struct Spring {
  float rate;   // speed at which the spring separates the bodies, per metre of overlap [1/s]
  float stiff;  // of an infinitely stiff one: 1 over 1 + this is its softness
};
Spring spring_of(float frequency, float h) {
  const float omega = 2.0F * std::numbers::pi_v<float> * frequency;
  const float a = 2.0F * damping_ratio + h * omega;
  return {omega / a, h * omega * a};
}

template <int Dim>
Kernel<Dim> kernel_of(SolverLanes lanes) {
#if defined(TALUS_AVX2_LANES)
  if (lanes == SolverLanes::avx2) return static_cast<Kernel<Dim>>(solve_avx2);
#endif
#if defined(__SSE2__) && !defined(TALUS_PLAIN_LANES)
  if (lanes != SolverLanes::plain) return static_cast<Kernel<Dim>>(solve_sse2);
#endif
  return static_cast<Kernel<Dim>>(solve_plain);
}

}  // namespace

std::span<const SolverLanes> solver_lanes() {
  static constexpr std::array all = {SolverLanes::plain, SolverLanes::sse2, SolverLanes::avx2};
#if defined(TALUS_AVX2_LANES)
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  return std::span(all).first(has_avx2 ? 3 : 2);
#elif defined(__SSE2__) && !defined(TALUS_PLAIN_LANES)
  return std::span(all).first(2);
#else
  return std::span(all).first(1);
#endif
}

/// The step at hand: its points in blocks, and the motion of its bodies.
template <int Dim>
struct ContactSolver<Dim>::Work {
  using Sets = solver::ContactSets<Dim>;
  using Set = typename Sets::Set;
  using Group = typename Sets::Group;
  using Places = typename Sets::Places;
  using Turn = typename Sets::Turn;
  static constexpr int quads = quads_of_a_body<Dim>;

  struct DeepPoint {
    int group = 0;
    int point = 0;
    float gain = 0.0F;
    float sag = 0.0F;  // overlap by the load that the point carries [m]
  };
  explicit Work(SolverLanes kind) : kernel(kernel_of<Dim>(kind)) {}

  void load_bodies();
  SpinF<Dim> join_rolling(const Group& group);
  void fill_blocks(int number);
  void fill_body(const SolverBody<Dim>& body, Eight& mass, Eight* inertia, int lane) const;
  float fill_point(int number, PointBlock<Dim>& to, int lane, const Spring& of_contact);
  void fill_rolling(const ContactPoint<Dim>& point, RollingBlock<Dim>& to, int lane) const;
  void advance(const VecF<Dim>& gravity, std::span<const Push> pushes, Team& team, int member);
  void begin_sub_step(const VecF<Dim>& gravity, std::span<const Push> pushes, const Places& region);
  void move(int first, int last);
  void keep_changes(const Places& region);
  void push_deep();
  void read_bodies(const Share& slots);
  void read_points(const Share& share);

  /// Calls `work` with the sets of a turn that are the member's.
  template <typename Function>
  void for_sets(Turn turn, const Share& regions_of_member, const Function& work);
  void run(Pass pass, const Set& set) {
    kernel({velocity.data(), moved.data(), free.data(), sets.blocks().data() + set.first_block, set.blocks,
            lanes.data(), rolling.data(), 1.0F / h, deep_overlap, deepest, carry},
           pass);
  }
  void run(Pass pass, Team& team, const Share& regions_of_member);

  Kernel<Dim> kernel;
  Team one_thread{1};  // for steps that are not divided
  // Given.
  std::span<SolverBody<Dim>> bodies;
  std::span<ContactPoint<Dim>> points;
  SolverParams params;
  float h = 0.0F;  // length of a sub-step [s]
  // Made from it.
  Sets sets;
  std::array<bool, Sets::most> bounces{};                // by set
  std::array<std::vector<DeepPoint>, Sets::most> deep;   // by set
  std::vector<std::array<VecF<Dim>, Dim - 1>> tangents;  // of each point
  std::vector<PointBlock<Dim>> lanes;
  std::vector<RollingBlock<Dim>> rolling;
  std::vector<Quad> velocity;
  std::vector<Quad> moved;
  // In a sub-step: velocity without contacts. Between two: the change of velocity by the contacts of the last.
  std::vector<Quad> free;
};

template <int Dim>
void ContactSolver<Dim>::Work::fill_blocks(int number) {
  const Set& set = sets[number];
  const float frequency = spring / h;
  const Spring between = spring_of(frequency, h);
  const Spring fixed = spring_of(fixed_spring * frequency, h);
  bounces[number] = false;
  deep[number].clear();
  std::fill_n(lanes.begin() + set.first_point, set.points, PointBlock<Dim>{});
  for (const int index : set.groups) {
    const Group& group = sets.groups()[index];
    ContactBlock<Dim>& block = sets.blocks()[group.block];
    const ContactPoint<Dim>& first = points[group.first];
    const SolverBody<Dim>& a = bodies[first.a];
    const SolverBody<Dim>& b = bodies[first.b];
    fill_body(a, block.inverse_mass_a, block.inverse_inertia_a, group.lane);
    fill_body(b, block.inverse_mass_b, block.inverse_inertia_b, group.lane);
    const Spring& of_contact = a.inverse_mass > 0.0F && b.inverse_mass > 0.0F ? between : fixed;
    block.rate.v[group.lane] = of_contact.rate;
    for (int k = 0; k < group.count; ++k) {
      PointBlock<Dim>& to = lanes[block.first_point + k];
      const float stiffness = fill_point(group.first + k, to, group.lane, of_contact);
      block.bounces = block.bounces || to.bounce.v[group.lane] < 0.0F;
      if (points[group.first + k].gap < -deep_overlap && stiffness > 0.0F)
        deep[number].push_back(
            {index, group.first + k, to.gain.v[group.lane], std::min(to.impulse.v[group.lane] / stiffness, deepest)});
    }
    bounces[number] = bounces[number] || block.bounces;
    if (first.rolling_arm > 0.0F) fill_rolling(first, rolling[block.rolling], group.lane);
  }
}

template <int Dim>
void ContactSolver<Dim>::Work::fill_body(const SolverBody<Dim>& body, Eight& mass, Eight* inertia, int lane) const {
  if (!body.moves) return;  // the block is all 0
  mass.v[lane] = body.inverse_mass;
  put(inertia, body.inverse_inertia, lane);
}

/// Returns the stiffness of its spring [N s/m].
template <int Dim>
float ContactSolver<Dim>::Work::fill_point(int number, PointBlock<Dim>& to, int lane, const Spring& of_contact) {
  ContactPoint<Dim>& point = points[number];
  const SolverBody<Dim>& a = bodies[point.a];
  const SolverBody<Dim>& b = bodies[point.b];
  const VecF<Dim>& n = point.normal;
  put(to.normal, n, lane);
  put(to.tangent, tangents[number][0], lane);
  put(to.arm_a, point.arm_a, lane);
  put(to.arm_b, point.arm_b, lane);
  to.gap.v[lane] = point.gap;
  const float yield_a = yield<Dim>(a, point.arm_a, n);
  const float yield_b = yield<Dim>(b, point.arm_b, n);
  const float here = (a.moves ? yield_a : 0.0F) + (b.moves ? yield_b : 0.0F);
  const float gain = inverse(here);
  const float stiff = of_contact.stiff * here * inverse(yield_a + yield_b);  // as with both awake
  to.gain.v[lane] = gain;
  to.soft_gain.v[lane] = gain * (stiff / (1.0F + stiff));
  to.soft_keep.v[lane] = 1.0F / (1.0F + stiff);
  float slip = 0.0F;  // by a unit impulse, mean of both directions
  for (const VecF<Dim>& tangent : tangents[number]) {
    if (a.moves) slip += yield<Dim>(a, point.arm_a, tangent) / static_cast<float>(Dim - 1);
    if (b.moves) slip += yield<Dim>(b, point.arm_b, tangent) / static_cast<float>(Dim - 1);
  }
  to.tangent_gain.v[lane] = inverse(slip);
  to.friction.v[lane] = point.friction;
  const auto velocity_at = [](const SolverBody<Dim>& body, const VecF<Dim>& arm) -> VecF<Dim> {
    return body.velocity + turned(body.spin, arm);
  };
  point.approach_speed = n.dot(velocity_at(a, point.arm_a) - velocity_at(b, point.arm_b));
  if (point.restitution > 0.0F && point.approach_speed > static_cast<float>(params.restitution_threshold))
    to.bounce.v[lane] = -point.restitution * point.approach_speed;
  const float share = 1.0F / static_cast<float>(params.sub_steps);
  to.impulse.v[lane] = to.before.v[lane] = share * point.pressing_impulse();
  for (int i = 0; i < Dim - 1; ++i)
    to.tangent_impulse[i].v[lane] = to.tangent_before[i].v[lane] =
        share * point.friction_impulse.dot(tangents[number][i]);
  return gain * stiff * of_contact.rate;
}

template <int Dim>
void ContactSolver<Dim>::Work::fill_rolling(const ContactPoint<Dim>& point, RollingBlock<Dim>& to, int lane) const {
  InertiaF<Dim> yields = InertiaF<Dim>::Zero();
  for (const int slot : {point.a, point.b})
    if (bodies[slot].moves) yields += bodies[slot].inverse_inertia;
  to.arm.v[lane] = point.rolling_arm;
  if (yields.trace() > 0.0F) put(to.gain, InertiaF<Dim>(yields.inverse()), lane);
  for (int i = 0; i < spin_size<Dim>; ++i)
    to.impulse[i].v[lane] = point.rolling_impulse[i] / static_cast<float>(params.sub_steps);
}

/// With what the impulses of the last sub-step gave them: applying those to each body once is what applying them in
/// each sub-step, contact by contact, would come to.
template <int Dim>
void ContactSolver<Dim>::Work::load_bodies() {
  const std::size_t places = sets.places();
  velocity.assign(quads * places, Quad{});
  moved.assign(quads * places, Quad{});
  free.assign(quads * places, Quad{});
  for (int i = 0; i < std::ssize(bodies); ++i)
    if (bodies[i].moves) set<Dim>(&velocity[quads * sets.place(i)], bodies[i].velocity, bodies[i].spin);
  int copy = sets.tail();
  for (const int slot : sets.copied()) set<Dim>(&velocity[quads * copy++], bodies[slot].velocity, bodies[slot].spin);
  const float share = 1.0F / static_cast<float>(params.sub_steps);
  const auto push = [&](int slot, const VecF<Dim>& impulse, const SpinF<Dim>& twist) {
    const SolverBody<Dim>& body = bodies[slot];
    if (!body.moves) return;
    add_to<Dim>(&free[quads * sets.place(slot)], body.inverse_mass * impulse, body.inverse_inertia * twist);
  };
  tangents.clear();
  for (const ContactPoint<Dim>& point : points) {
    tangents.push_back(tangents_of(point.normal));
    if (point.normal_impulse == 0.0F) continue;
    // Friction lies in the plane of contact, as it was loaded.
    VecF<Dim> impulse = share * point.pressing_impulse() * point.normal;
    for (const VecF<Dim>& tangent : tangents.back()) impulse += share * point.friction_impulse.dot(tangent) * tangent;
    push(point.a, -impulse, -torque(point.arm_a, impulse));
    push(point.b, impulse, torque(point.arm_b, impulse));
  }
  for (const Group& group : sets.groups()) {
    if (points[group.first].rolling_arm == 0.0F) continue;
    const SpinF<Dim> twist = share * join_rolling(group);
    push(points[group.first].a, VecF<Dim>::Zero(), -twist);
    push(points[group.first].b, VecF<Dim>::Zero(), twist);
  }
}

/// A group has one rolling impulse, which its first point carries from now on. A pair with several contacts may be
/// grouped otherwise than in the step before.
template <int Dim>
SpinF<Dim> ContactSolver<Dim>::Work::join_rolling(const Group& group) {
  ContactPoint<Dim>& first = points[group.first];
  for (ContactPoint<Dim>& other : points.subspan(group.first + 1, group.count - 1)) {
    first.rolling_impulse += other.rolling_impulse;
    other.rolling_impulse.setZero();
  }
  return first.rolling_impulse;
}

template <int Dim>
void ContactSolver<Dim>::Work::begin_sub_step(const VecF<Dim>& gravity, std::span<const Push> pushes,
                                              const Places& region) {
  for (const Push& push : pushes)
    if (const int at = sets.place(push.slot); at >= region.first && at < region.last)
      add_to<Dim>(&velocity[quads * at], h * push.acceleration, h * push.turning);
  std::array<Quad, quads> fall{};
  set<Dim>(fall.data(), h * gravity, SpinF<Dim>::Zero());
  for (int i = region.first; i < region.last; ++i) {
    for (int j = 0; j < quads; ++j) {
      for (int k = 0; k < 4; ++k) {
        const float alone = velocity[quads * i + j].v[k] + fall[j].v[k];
        velocity[quads * i + j].v[k] = alone + free[quads * i + j].v[k];
        free[quads * i + j].v[k] = alone;
      }
    }
  }
}

template <int Dim>
void ContactSolver<Dim>::Work::move(int first, int last) {
  for (int i = quads * first; i < quads * last; ++i)
    for (int k = 0; k < 4; ++k) moved[i].v[k] += h * velocity[i].v[k];
}

/// After a sub-step: what its contacts gave the bodies.
template <int Dim>
void ContactSolver<Dim>::Work::keep_changes(const Places& region) {
  for (int i = quads * region.first; i < quads * region.last; ++i)
    for (int k = 0; k < 4; ++k) free[i].v[k] = velocity[i].v[k] - free[i].v[k];
}

template <int Dim>
template <typename Function>
void ContactSolver<Dim>::Work::for_sets(Turn turn, const Share& regions_of_member, const Function& work) {
  for (int r = regions_of_member.first; r < regions_of_member.last; ++r) {
    const int number = turn == Sets::inside ? r : sets.regions() + r;
    if (sets.turn_of(number) == turn && !sets[number].groups.empty()) work(sets[number]);
  }
}

template <int Dim>
void ContactSolver<Dim>::Work::run(Pass pass, Team& team, const Share& regions_of_member) {
  for_sets(Sets::inside, regions_of_member, [&](const Set& set) { run(pass, set); });
  if (sets.regions() == 1) return;
  for (const Turn turn : {Sets::even_border, Sets::odd_border, Sets::remaining}) {
    if (turn == Sets::remaining && sets[sets.last()].groups.empty()) continue;
    team.meet();
    for_sets(turn, regions_of_member, [&](const Set& set) { run(pass, set); });
  }
  team.meet();
}

/// What one thread does in a step.
template <int Dim>
void ContactSolver<Dim>::Work::advance(const VecF<Dim>& gravity, std::span<const Push> pushes, Team& team, int member) {
  const Share mine = share_of(sets.regions(), member, team.size());
  const auto for_regions = [&](const auto& work) {
    for (int r = mine.first; r < mine.last; ++r) work(r);
  };
  for_regions([&](int r) {
    fill_blocks(r);
    fill_blocks(sets.regions() + r);
  });
  team.meet();
  const bool any_bounces = std::ranges::any_of(std::span(bounces).first(sets.count()), std::identity());
  for (int step = 0; step < params.sub_steps; ++step) {
    const int passes = step == 0 ? first_passes : 1;
    for_regions([&](int r) { begin_sub_step(gravity, pushes, sets.bodies_of(r)); });
    for (int i = 0; i < passes; ++i) run(Pass::soft, team, mine);
    for_regions([&](int r) {
      move(sets.bodies_of(r).first, sets.bodies_of(r).last);
      move(sets.copies_of(r).first, sets.copies_of(r).last);
    });
    for (int i = 1; i < passes; ++i) run(Pass::relax, team, mine);
    run(Pass::end, team, mine);
    for_regions([&](int r) { keep_changes(sets.bodies_of(r)); });
  }
  team.meet();
  if (any_bounces)
    for (int i = 0; i < bounce_passes; ++i) run(Pass::bounce, team, mine);
  if (member == 0) push_deep();
  team.meet();
  read_bodies(share_of(static_cast<int>(bodies.size()), member, team.size()));
  read_points(share_of(static_cast<int>(sets.groups().size()), member, team.size()));
}

/// Moves what overlaps by more than `deep` beyond its load apart. It gets no velocity by that: as a spring it would be
/// thrown.
template <int Dim>
void ContactSolver<Dim>::Work::push_deep() {
  for (int pass = 0; pass < deep_passes; ++pass) {
    for (const std::vector<DeepPoint>& of_set : std::span(deep).first(sets.count()))
      for (const DeepPoint& at : of_set) {
        const ContactPoint<Dim>& point = points[at.point];
        const VecF<Dim>& n = point.normal;
        const Group& group = sets.groups()[at.group];
        const ContactBlock<Dim>& block = sets.blocks()[group.block];
        Quad* const a = &moved[quads * block.a[group.lane]];
        Quad* const b = &moved[quads * block.b[group.lane]];
        const auto way = [&](const Quad* of, const VecF<Dim>& arm) -> VecF<Dim> {
          return linear_of<Dim>(of) + turned(angular_of<Dim>(of), arm);
        };
        const float gap = point.gap + n.dot(way(b, point.arm_b) - way(a, point.arm_a));
        const float excess = -(gap + deep_overlap + at.sag);
        if (excess <= 0.0F) continue;
        const VecF<Dim> push = at.gain * deep_share * excess * n;
        const auto shift = [&](int slot, Quad* to, const VecF<Dim>& arm, float sign) {
          const SolverBody<Dim>& body = bodies[slot];
          if (!body.moves) return;
          const SpinF<Dim> turn = body.inverse_inertia * torque(arm, push);
          add_to<Dim>(to, sign * body.inverse_mass * push, sign * turn);
        };
        shift(point.a, a, point.arm_a, -1.0F);
        shift(point.b, b, point.arm_b, 1.0F);
      }
  }
}

template <int Dim>
void ContactSolver<Dim>::Work::read_bodies(const Share& slots) {
  for (int i = slots.first; i < slots.last; ++i) {
    SolverBody<Dim>& body = bodies[i];
    if (body.moves) {
      body.way = linear_of<Dim>(&moved[quads * sets.place(i)]);
      body.turn = angular_of<Dim>(&moved[quads * sets.place(i)]);
      body.velocity = linear_of<Dim>(&velocity[quads * sets.place(i)]);
      body.spin = angular_of<Dim>(&velocity[quads * sets.place(i)]);
    } else {
      body.way = h * body.velocity;
      body.turn = h * body.spin;
      for (int step = 1; step < params.sub_steps; ++step) {
        body.way += h * body.velocity;
        body.turn += h * body.spin;
      }
    }
  }
}

template <int Dim>
void ContactSolver<Dim>::Work::read_points(const Share& share) {
  const auto times = static_cast<float>(params.sub_steps);
  for (int number = share.first; number < share.last; ++number) {
    const Group& group = sets.groups()[number];
    const ContactBlock<Dim>& block = sets.blocks()[group.block];
    const int lane = group.lane;
    for (int i = 0; i < group.count; ++i) {
      ContactPoint<Dim>& point = points[group.first + i];
      const PointBlock<Dim>& from = lanes[block.first_point + i];
      const bool bounced = from.bounce.v[lane] < 0.0F && from.highest.v[lane] > 0.0F;
      const float kept = bounced ? 0.0F : times;
      point.normal_sum = from.sum.v[lane] - point.attraction;
      point.normal_impulse = bounced ? 0.0F : times * from.impulse.v[lane] - point.attraction;
      point.friction_sum = from.tangent_sum[0].v[lane] * tangents[group.first + i][0];
      point.friction_impulse = kept * from.tangent_impulse[0].v[lane] * tangents[group.first + i][0];
      if constexpr (Dim == 3) {
        point.friction_sum += from.tangent_sum[1].v[lane] * tangents[group.first + i][1];
        point.friction_impulse += kept * from.tangent_impulse[1].v[lane] * tangents[group.first + i][1];
      }
    }
    ContactPoint<Dim>& first = points[group.first];
    if (first.rolling_arm > 0.0F)
      for (int i = 0; i < spin_size<Dim>; ++i)
        first.rolling_impulse[i] = times * rolling[block.rolling].impulse[i].v[lane];
  }
}

template <int Dim>
ContactSolver<Dim>::ContactSolver(SolverLanes lanes) : bodies_(1), work_(std::make_unique<Work>(lanes)) {}
template <int Dim>
ContactSolver<Dim>::~ContactSolver() = default;

template <int Dim>
void ContactSolver<Dim>::start() {
  bodies_.resize(1);
  points_.clear();
  pushes_.clear();
  cohesive_ = false;
}

/// Cohesion is a force that pulls both bodies of a pair together, in equal shares at the points where they touch; all
/// that never moves is one side. So their impulses become larger by it, and with them what friction and rolling
/// friction hold.
template <int Dim>
void ContactSolver<Dim>::attract(float gravity, float dt) {
  const auto pair_of = [this](int number) {
    return std::pair<int, int>(std::minmax(points_[number].a, points_[number].b));
  };
  cohesive_points_.clear();
  for (int i = 0; i < std::ssize(points_); ++i)
    if (points_[i].cohesion > 0.0F && points_[i].gap < cohesive_reach) cohesive_points_.push_back(i);
  std::ranges::stable_sort(cohesive_points_, {}, pair_of);  // those of a body of several pieces are not side by side
  for (std::span<const int> rest = cohesive_points_; !rest.empty();) {
    const auto end = std::ranges::upper_bound(rest, pair_of(rest[0]), {}, pair_of);
    const std::span<const int> same = rest.first(static_cast<std::size_t>(end - rest.begin()));
    for (const int number : same) {
      ContactPoint<Dim>& point = points_[number];
      const float weight = gravity / std::max(bodies_[point.a].inverse_mass, bodies_[point.b].inverse_mass);
      const float size = point.cohesion * weight / static_cast<float>(same.size());
      point.attraction = dt * size;
      pull(point.a, point.arm_a, size * point.normal);
      pull(point.b, point.arm_b, -size * point.normal);
    }
    rest = rest.subspan(same.size());
  }
}

template <int Dim>
void ContactSolver<Dim>::pull(int slot, const VecF<Dim>& arm, const VecF<Dim>& force) {
  const SolverBody<Dim>& body = bodies_[slot];
  if (body.moves) pushes_.push_back({slot, body.inverse_mass * force, body.inverse_inertia * torque(arm, force)});
}

template <int Dim>
void ContactSolver<Dim>::solve(const SolverParams& params, const VecF<Dim>& gravity, float dt) {
  Work& work = *work_;
  if (cohesive_) attract(gravity.norm(), dt);
  work.bodies = bodies_;
  work.points = points_;
  work.params = params;
  work.h = dt / static_cast<float>(params.sub_steps);
  work.sets.arrange(bodies_, points_);
  work.lanes.resize(work.sets.point_blocks());
  work.rolling.assign(work.sets.rolling_blocks(), RollingBlock<Dim>{});
  work.load_bodies();
  Team& team = work.sets.regions() > 1 ? *team_ : work.one_thread;
  team.run([&](int member) { work.advance(gravity, pushes_, team, member); });
}

template class ContactSolver<2>;
template class ContactSolver<3>;

}  // namespace talus
