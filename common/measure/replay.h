#pragma once
// A run played again from its start, and simulated in full from a fork on.

#include "common/measure/fork.h"
#include "common/scene/scene.h"

namespace talus {

/// Plays `scene` again under its own policy until the fork's step, then wakes all bodies and lets none sleep any more.
/// Bodies that were awake keep all that the engine stores of them, so against a full run's recording this differs by
/// nothing, bit for bit: what is left is what sleeping, and waking at the fork, did. Each fork costs a run up to it:
/// take few. The settings are the scene's own. Throws std::invalid_argument for a scene with the engine's own sleeping,
/// which cannot be switched off on the way.
template <int Dim>
Continuation<Dim> replayed_continuation(WorldMaker<Dim> make_world, Scene<Dim> scene);

}  // namespace talus
