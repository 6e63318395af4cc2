#pragma once
// Contacts of a run as the browser page reads them.

#include <span>
#include <string>

#include "common/world/body.h"
#include "tools/view/frame_stream.h"

namespace talus {

/// A point of contact with its forces.
template <int Dim>
struct ShownContact {
  BodyIndex a = 0;
  BodyIndex b = ground_index;                  // as in Contact
  Vec<Dim> point = Vec<Dim>::Zero();           // [m]
  Vec<Dim> normal_force = Vec<Dim>::Zero();    // on a [N], mean over the step
  Vec<Dim> friction_force = Vec<Dim>::Zero();  // on a [N], mean over the step
  bool kept = false;                           // of bodies that sleep: as it was in the last step before
};

/// Bytes that follow a block of FrameEncoder, with numbers written as there:
///
///     u number of points; of each: u body a; s b; u 1 where it is kept; s change of each coordinate from that of the
///     point before, in quanta; f each component of the normal force; f each component of the friction force
template <int Dim>
std::string encode_contacts(std::span<const ShownContact<Dim>> contacts, const Quantum& quantum);

}  // namespace talus
