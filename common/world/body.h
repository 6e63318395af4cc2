#pragma once
// Bodies as dense indices with their state in arrays by field.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/math/vector.h"

namespace talus {

/// Number of a body: counted from 0 in the order of World::add. Never used again, but in the world of a sleeper.
using BodyIndex = std::int32_t;

/// The other side of a contact where it is no body: the ground, or obstacle k as `first_obstacle - k`.
inline constexpr BodyIndex ground_index = -1;
inline constexpr BodyIndex first_obstacle = -2;

/// In a world inside one with periodic sides: which body it is another place of. A body and its images move as one.
/// Where two bodies touch follows from `sides`: those that have one in common do not meet, and images meet bodies
/// alone.
struct Image {
  BodyIndex of = 0;
  int sides = 0;  // a bit for each periodic axis along which it is a period away; 0: the body itself
};

/// What is needed to create a body.
template <int Dim>
struct BodyDef {
  int shape = 0;  // index into WorldDescription::shapes
  Pose<Dim> pose;
  Vec<Dim> velocity = Vec<Dim>::Zero();  // of the centre of mass [m/s]
  Spin<Dim> spin = Spin<Dim>::Zero();    // [rad/s]
  std::optional<Image> image = {};       // without: a body of its own
};

/// State of every body that was ever added; entry i belongs to body i. A sleeping body's velocity is zero.
template <int Dim>
struct BodyStates {
  std::vector<int> shape;
  std::vector<Pose<Dim>> pose;
  std::vector<Vec<Dim>> velocity;     // [m/s]
  std::vector<Spin<Dim>> spin;        // [rad/s]
  std::vector<std::uint8_t> asleep;   // 1: costs nothing until thawed (or woken by the engine's own rule)
  std::vector<std::uint8_t> removed;  // 1: no longer in the world; its other entries stay as they last were
  std::vector<float> grip;            // see World::set_grip(); bodies beyond its end have 0

  BodyIndex size() const { return static_cast<BodyIndex>(shape.size()); }
};

/// Of a contact between two sides, each a body, the ground or an obstacle: the larger grip of its bodies.
template <int Dim>
float grip_between(const BodyStates<Dim>& states, BodyIndex a, BodyIndex b) {
  const auto of = [&](BodyIndex side) {
    return side >= 0 && side < std::ssize(states.grip) ? states.grip[side] : 0.0F;
  };
  return std::max(of(a), of(b));
}

/// One point of contact of an awake body after a step.
template <int Dim>
struct Contact {
  BodyIndex a = 0;                               // an awake body
  BodyIndex b = ground_index;                    // awake or sleeping body, ground or obstacle
  Vec<Dim> point = Vec<Dim>::Zero();             // [m], in the world's axes
  Vec<Dim> normal = Vec<Dim>::Zero();            // unit, from b to a
  double normal_impulse = 0.0;                   // [N s] over the step, below 0 where a grip pulls
  Vec<Dim> friction_impulse = Vec<Dim>::Zero();  // [N s] over the step, on a
  double approach_speed = 0.0;                   // [m/s] at which the two came together before the step, >= 0
  double depth = 0.0;                            // [m], positive where they overlap
};

/// Whether World::contacts() lists a contact between `a` and `b`, each a body or another side, under `b`: the first is
/// awake, and of two awake bodies it has the lower index. `asleep`: by body.
inline bool listed_under_second(BodyIndex a, BodyIndex b, std::span<const std::uint8_t> asleep) {
  const auto awake = [&](BodyIndex side) { return side >= 0 && asleep[side] == 0; };
  return !awake(a) || (awake(b) && b < a);
}

/// Ascending as (first, second) are.
inline std::int64_t pair_order(std::int32_t first, std::int32_t second) { return (std::int64_t{first} << 32) + second; }

/// A point of contact of two bodies, awake or asleep, or of one with the ground or an obstacle.
template <int Dim>
struct ContactForce {
  BodyIndex a = 0;
  BodyIndex b = ground_index;                  // as in Contact
  Vec<Dim> point = Vec<Dim>::Zero();           // [m]
  Vec<Dim> normal_force = Vec<Dim>::Zero();    // on a [N], mean over the step
  Vec<Dim> friction_force = Vec<Dim>::Zero();  // on a [N], mean over the step
  bool kept = false;                           // neither side is awake
};

}  // namespace talus
