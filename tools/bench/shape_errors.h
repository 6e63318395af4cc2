#pragma once
// Whether two ensembles of runs built the same pile.

#include <vector>

#include "common/measure/distributions.h"
#include "common/measure/shape_statistics.h"
#include "tools/bench/row.h"

namespace talus {

/// Shapes of the last states of an ensemble's runs, all on one grid.
template <int Dim>
struct ShapeEnsemble {
  std::vector<ShapeStatistics<Dim>> runs;
  RunSamples heights;
  RunSamples radii;
};

/// Bodies faster than 1 m/s are no part of the pile. A run without any other body is left out.
template <int Dim>
ShapeEnsemble<Dim> shape_ensemble(std::span<const BodyStates<Dim>> states, std::span<const Shape<Dim>> shapes,
                                  const ProfileGrid<Dim>& grid, double extent);

/// Adds the shape's columns of a row: `runs`' own means and deviations, and how far from `baseline`, whose own scatter
/// (each of its runs against the others) is the floor. Nothing where either is empty.
template <int Dim>
void add_shape_errors(const ShapeEnsemble<Dim>& baseline, const ShapeEnsemble<Dim>& runs, double extent,
                      Values& values);

}  // namespace talus
