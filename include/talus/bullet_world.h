#pragma once
/// @file
/// Worlds of Bullet for a Simulation<3>, and for a Simulation<2> held in a plane. Link talus::bullet.

#include "sim3d/make_world.h"
