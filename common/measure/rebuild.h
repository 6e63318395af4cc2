#pragma once
// A recorded state in a fresh world.

#include <memory>

#include "common/scene/scene.h"
#include "common/world/scaled_world.h"

namespace talus {

/// Whether bodies that slept are rebuilt awake or frozen.
enum class Sleepers { awake, frozen };

/// A fresh world that holds the bodies of `states` where and as fast as they were; a body keeps its index, removed ones
/// are removed again. An engine limits speed and spin when a step begins, so those at its end may be above the limits;
/// here they are brought down to them. What an engine stores of its last step (impulses to start the next one from) is
/// not in a state and is lost: that alone moves a heap by some millimetres, so a measure built on this comes with the
/// same for a full run.
template <int Dim>
std::unique_ptr<World<Dim>> rebuild(const WorldMaker<Dim>& make_world, const WorldDescription<Dim>& description,
                                    const BodyStates<Dim>& states, Sleepers sleepers);

/// The description at the settings of a reference: no sleeping, 50 velocity and 20 position iterations, two
/// friction directions, steps of 1/120 s or the description's if shorter.
template <int Dim>
WorldDescription<Dim> reference_settings(WorldDescription<Dim> description);

/// The scene of a reference: policy `full`, reference_settings(), at least the usual sub-steps, and a time step in
/// which a body moves at most a quarter of its thickness as it reaches the ground.
template <int Dim>
Scene<Dim> reference_scene(Scene<Dim> scene);

/// Settings that tell whether a pile would stay at rest. With small steps its own: they let no pile creep, and finer
/// ones have stiffer contacts, which would lift it. Else reference_settings().
template <int Dim>
WorldDescription<Dim> judging_settings(const WorldDescription<Dim>& description);

}  // namespace talus
