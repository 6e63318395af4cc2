#include "common/scene/read_motion.h"

#include <fmt/format.h>

#include <algorithm>

namespace talus {
namespace {

template <int Dim>
void read_motion_axis(TableReader& table, const Key& key, Motion<Dim>& motion, bool required) {
  if (required && Dim == 3) table.require("axis");
  table.read(key, motion.axis);
  if (motion.axis.norm() < 1e-6)
    table.error("axis", "must have a length, of any size");
  else
    motion.axis.normalize();
}

template <int Dim>
void check_times(TableReader& table, const Motion<Dim>& motion) {
  if (motion.times.size() < 2 || !std::ranges::is_sorted(motion.times, std::ranges::less_equal()))
    table.error("times", "must be two or more, each later than the one before");
}

template <int Dim>
void check_path(TableReader& table, const Motion<Dim>& motion) {
  if (!table.ok()) return;
  const std::size_t corners = motion.times.size();
  check_times(table, motion);
  if (motion.shifts.size() != corners || motion.shifts.front().norm() > 0.0)
    table.error("shifts", fmt::format("must be {}, as many as times, the first of them 0", corners));
  if (!motion.angles.empty() && (motion.angles.size() != corners || motion.angles.front() != 0.0))
    table.error("angles_deg", fmt::format("must be {}, as many as times, the first of them 0", corners));
}

template <int Dim>
void check_gravity_path(TableReader& table, const Motion<Dim>& motion) {
  if (!table.ok()) return;
  check_times(table, motion);
  if (table.has("gravity") == table.has("angles_deg")) table.error("", "must have one of gravity and angles_deg");
  const std::string rule = fmt::format("must be {}, as many as times", motion.times.size());
  if (table.has("gravity") && motion.shifts.size() != motion.times.size()) table.error("gravity", rule);
  if (table.has("angles_deg") && motion.angles.size() != motion.times.size()) table.error("angles_deg", rule);
}

/// The engines' limits hold for obstacles too.
template <int Dim>
void check_motion(TableReader& table, const Motion<Dim>& motion, const Vec<Dim>& position, double reach,
                  const WorldDescription<Dim>& world) {
  if (motion.end && *motion.end <= motion.start) table.error("end", "must be after start");
  if (!table.ok()) return;
  const double speed = motion.fastest_shift() + reach * motion.fastest_turn() + motion.belt.norm();
  const double turn = motion.fastest_turn();
  double farthest = motion.amplitude.norm();
  for (const Vec<Dim>& shift : motion.shifts) farthest = std::max(farthest, shift.norm());
  farthest += position.norm() + reach;
  table.check_later([=, &world](TableReader& complete) {
    const double fastest = fastest_speed<Dim>(world.dt, world.units);
    if (speed > fastest)
      complete.error("", fmt::format("must move at most at {:.4g} m/s, here {:.4g}", fastest, speed));
    if (turn > fastest_spin(world.dt))
      complete.error("",
                     fmt::format("must turn by at most {:.4g} rad/s, a quarter turn a step", fastest_spin(world.dt)));
    if (farthest > farthest_place(world.units))
      complete.error("", fmt::format("must stay within {:g} m of the origin", farthest_place(world.units)));
  });
}

}  // namespace

template <int Dim>
Motion<Dim> read_motion(TableReader& table, const Vec<Dim>& position, double reach,
                        const WorldDescription<Dim>& world) {
  Motion<Dim> motion;
  const std::string kind = read_kind(table, {motion_kinds.begin(), motion_kinds.end()});
  if (kind == "sine") {
    table.read_fields(motion, sine_fields<Dim>);
  } else if (kind == "turn") {
    table.read_fields(motion, turn_fields<Dim>);
    read_motion_axis(table, motion_axis_key, motion, true);
  } else if (kind == "path") {
    table.read_fields(motion, path_fields<Dim>);
    read_motion_axis(table, motion_axis_key, motion, !motion.angles.empty());
    check_path(table, motion);
  } else if (kind == "belt") {
    table.read_fields(motion, belt_fields<Dim>);
  }
  check_motion(table, motion, position, reach, world);
  return motion;
}

template <int Dim>
Motion<Dim> read_gravity_motion(TableReader& table, const Vec<Dim>& gravity) {
  Motion<Dim> motion;
  const std::string kind = read_kind(table, {gravity_motion_kinds.begin(), gravity_motion_kinds.end()});
  if (kind == "sine") {
    table.read_fields(motion, gravity_sine_fields<Dim>);
  } else if (kind == "turn") {
    table.read_fields(motion, gravity_turn_fields<Dim>);
    read_motion_axis(table, gravity_motion_axis_key, motion, true);
  } else if (kind == "path") {
    table.read_fields(motion, gravity_path_fields<Dim>);
    read_motion_axis(table, gravity_motion_axis_key, motion, !motion.angles.empty());
    check_gravity_path(table, motion);
  }
  if (motion.end && *motion.end <= motion.start) table.error("end", "must be after start");
  for (Vec<Dim>& value : motion.shifts) value -= gravity;
  return motion;
}

template Motion<2> read_gravity_motion(TableReader&, const Vec<2>&);
template Motion<3> read_gravity_motion(TableReader&, const Vec<3>&);
template Motion<2> read_motion(TableReader&, const Vec<2>&, double, const WorldDescription<2>&);
template Motion<3> read_motion(TableReader&, const Vec<3>&, double, const WorldDescription<3>&);

}  // namespace talus
