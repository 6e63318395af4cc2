#pragma once
// Whether two ensembles of runs built the same pile.

#include <vector>

#include "common/measure/distributions.h"
#include "common/measure/shape_statistics.h"
#include "tools/bench/measure.h"

namespace talus {

/// Shapes of the last states of an ensemble's runs, all on one grid.
template <int Dim>
struct ShapeEnsemble {
  std::vector<ShapeStatistics<Dim>> runs;
  RunSamples heights;
  RunSamples radii;
};

/// Bodies faster than 1 m/s do not belong to the pile. A run without any slower body is left out.
template <int Dim>
ShapeEnsemble<Dim> shape_ensemble(std::span<const BodyStates<Dim>> states, std::span<const Shape<Dim>> shapes,
                                  const ProfileGrid<Dim>& grid);

/// Adds the shape's measures: means and deviations of `runs`, and their distance from `baseline`; the floor is the
/// scatter of `baseline`, each of its runs against the others. Adds nothing where either ensemble is empty.
template <int Dim>
void add_shape_errors(const ShapeEnsemble<Dim>& baseline, const ShapeEnsemble<Dim>& runs, double extent,
                      Values& values);

}  // namespace talus
