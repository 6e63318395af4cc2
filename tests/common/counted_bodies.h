#pragma once
// States of bodies without a world, for what only counts them.

#include <vector>

#include "common/world/body.h"

namespace talus {

template <int Dim>
struct Bodies {
  BodyStates<Dim> states;

  void add(const Vec<Dim>& at) {
    states.shape.push_back(0);
    states.pose.push_back({.position = at});
    states.velocity.push_back(Vec<Dim>::Zero());
    states.spin.push_back(Spin<Dim>::Zero());
    states.asleep.push_back(0);
    states.removed.push_back(0);
  }
  std::vector<BodyIndex> awake() const {
    std::vector<BodyIndex> list;
    for (BodyIndex i = 0; i < states.size(); ++i)
      if (states.asleep[i] == 0 && states.removed[i] == 0) list.push_back(i);
    return list;
  }
};

}  // namespace talus
