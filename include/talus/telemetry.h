#pragma once
/// @file
/// Observers of a run: RunRecorder writes its record, Publisher sends it live. Link talus::telemetry.

#include "lcmtypes/publisher.h"
#include "lcmtypes/run_info.h"
#include "lcmtypes/run_recorder.h"
