#pragma once
/// @file
/// Observers of a run: RunRecorder writes its record, Publisher sends it live. record_world() and publish_world() do
/// both for a world that a sleeper watches. Link talus::telemetry.

#include "lcmtypes/publisher.h"
#include "lcmtypes/run_info.h"
#include "lcmtypes/run_recorder.h"
#include "lcmtypes/world_feed.h"
