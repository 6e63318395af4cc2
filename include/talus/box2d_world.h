#pragma once
/// @file
/// make_box2d_world(): a world of Box2D for a Simulation<2>. Link talus::box2d.

#include "sim2d/make_world.h"
