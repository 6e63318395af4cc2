#pragma once

namespace talus {

/// For tests: each option puts work back that a step leaves out since it would change nothing, or the engine's own path
/// in the place of a shorter one. A run has the same bits with any of them, but for `sweep_slow_bodies`.
/// docs/architecture.md says where each is used.
struct DebugOptions {
  bool step_when_idle = false;     // the engine steps while no body is awake
  bool keep_sleepers = false;      // in the lists that the engine walks, each as a body of its own
  bool recount_sleepers = false;   // in each step
  bool gather_contacts = false;    // in each step, even if no policy or observer uses them
  bool sweep_slow_bodies = false;  // continuous collision of slow bodies too

  bool collide_in_flight = false;     // bodies in flight collide with the ground
  bool bullet_compounds = false;      // else sim3d/bullet/placed_pieces.h
  bool visit_separate_pairs = false;  // else sim3d/bullet/idle_pairs.h; no effect with bullet_compounds
};

}  // namespace talus
