#pragma once
/// @file
/// Piles from a program: the structs of a scene, the catalogue of shapes, the loop and the policies. Link talus::core,
/// and talus::box2d or talus::bullet for a world.

#include "common/shape/catalogue.h"
#include "common/simulation/make_policy.h"
#include "common/simulation/simulation.h"
#include "common/simulation/sleeper_watch.h"
