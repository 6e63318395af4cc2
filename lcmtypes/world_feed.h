#pragma once
// Record and live view of a world that another program simulates.

#include <memory>
#include <string>

#include "lcmtypes/publisher.h"
#include "lcmtypes/run_recorder.h"

namespace talus {

/// What a program's world is called where it is shown.
struct WorldLabel {
  std::string name = "program";  // short: lists of runs show it
  std::string title = {};        // one line; empty: the name
  std::string engine = "own";    // that simulates it
  double dt = 1.0 / 60.0;        // [s] > 0 of its usual step. A record counts its time in steps of this length
  double frame_rate = 30.0;      // [1/s] > 0 frames of a record in a second of simulated time
};

/// For PileSleeper::observe(): writes the record of the world into a file, in place of one that is there. Throws
/// InvalidValue on a bad label and as RunRecorder does, within observe() already.
template <int Dim>
std::unique_ptr<Observer<Dim>> record_world(const std::string& path, const WorldLabel& label = {},
                                            const RecorderParams& params = {});

/// For PileSleeper::observe(): shows the world to `talus monitor` and `talus view --live`. Throws InvalidValue on a bad
/// label and as Publisher does.
template <int Dim>
std::unique_ptr<Observer<Dim>> publish_world(const WorldLabel& label = {}, const PublisherParams& params = {});

}  // namespace talus
