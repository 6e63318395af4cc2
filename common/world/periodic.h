#pragma once
// Sides beyond which a world repeats itself.

#include <vector>

#include "common/math/vector.h"

namespace talus {

/// Along some horizontal axes what leaves a world through one side comes in through the opposite one, and bodies touch
/// through the sides. A place has an image in each repetition.
template <int Dim>
struct Periodic {
  Vec<Dim> low = Vec<Dim>::Zero();     // the lower side along each axis [m]
  Vec<Dim> period = Vec<Dim>::Zero();  // between the sides [m]; 0: does not repeat along this axis

  bool any() const { return !period.isZero(0.0); }

  /// The image between the sides; one that is beyond a side by less than `margin` periods stays.
  Vec<Dim> inside(Vec<Dim> place, double margin = 0.0) const {
    for (int axis = 0; axis < Dim; ++axis) {
      if (period[axis] == 0.0) continue;
      const double share = (place[axis] - low[axis]) / period[axis];
      if (share < -margin || share >= 1.0 + margin) place[axis] -= std::floor(share) * period[axis];
    }
    return place;
  }

  /// The image that is nearest to `reference` along each axis.
  Vec<Dim> near(Vec<Dim> place, const Vec<Dim>& reference) const {
    for (int axis = 0; axis < Dim; ++axis)
      if (period[axis] != 0.0) place[axis] -= std::round((place[axis] - reference[axis]) / period[axis]) * period[axis];
    return place;
  }
  Pose<Dim> near(const Pose<Dim>& pose, const Vec<Dim>& reference) const {
    return {near(pose.position, reference), pose.rotation};
  }

  /// From a place to its images, first to itself, by steps of a period from `first` to 1 along each axis that repeats.
  std::vector<Vec<Dim>> shifts(int first) const {
    std::vector<Vec<Dim>> all = {Vec<Dim>::Zero()};
    for (int axis = 0; axis < Dim; ++axis) {
      if (period[axis] == 0.0) continue;
      const auto known = all.size();
      for (int step = first; step <= 1; ++step)
        for (std::size_t i = 0; step != 0 && i < known; ++i)
          all.push_back(all[i] + step * period[axis] * Vec<Dim>::Unit(axis));
    }
    return all;
  }
};

}  // namespace talus
