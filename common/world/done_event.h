#pragma once

namespace talus {

/// An event of the scene that has happened.
struct DoneEvent {
  int number = 0;     // in Scene::events
  double time = 0.0;  // [s]
};

}  // namespace talus
