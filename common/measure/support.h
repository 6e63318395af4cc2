#pragma once
// Pairs of touching bodies, sleepers without support, and overlaps.

#include <span>
#include <vector>

#include "common/world/body.h"
#include "common/world/world_description.h"

namespace talus {

/// Two bodies, or a body and the ground or an obstacle, at or near contact.
struct Touch {
  BodyIndex a = 0;
  BodyIndex b = ground_index;  // > a, or negative for ground and obstacles as in Contact
  double distance = 0.0;       // between their nearest pieces [m], negative: depth of overlap
};

/// All pairs nearer than `reach` [m], in order of a, then b, found by shapes and poses alone: sleeping pairs, of which
/// engines report no contacts, are included. Engines hold resting bodies apart or together by up to 0.01 (Box2D: skin)
/// and 0.04 m (Bullet: margin of hulls), so a reach of 0.05 misses no contact; more calls near misses support.
template <int Dim>
std::vector<Touch> touching_pairs(const WorldDescription<Dim>& description, const BodyStates<Dim>& states,
                                  double reach);

/// Sleepers from which no chain of touching bodies leads to the ground or an obstacle, ascending. Must be none. Reports
/// nothing of forces: a body that leans on another counts as carried.
template <int Dim>
std::vector<BodyIndex> floating_sleepers(const BodyStates<Dim>& states, std::span<const Touch> touches);

/// Depths of overlap of touching pairs; pairs apart count with depth 0.
struct Penetration {
  int pairs = 0;
  double mean = 0.0;  // [m]
  double p99 = 0.0;   // 99 % of the pairs are no deeper [m]
  double max = 0.0;   // [m]
};
Penetration penetration(std::span<const Touch> touches);

}  // namespace talus
