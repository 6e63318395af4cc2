#pragma once
/// @file
/// Scene files: read_scene() and parse_scene(). Link talus::scene.

#include "common/scene/read_scene.h"
