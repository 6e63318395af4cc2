#pragma once

#include <optional>

namespace talus {

/// An event of the scene that has happened.
struct DoneEvent {
  int number = 0;                  // in Scene::events
  double time = 0.0;               // [s]
  std::optional<int> bodies = {};  // on which it acted; none of an event that chooses none, as `gravity`
};

}  // namespace talus
