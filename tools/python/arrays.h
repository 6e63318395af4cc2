#pragma once
// NumPy arrays of what talus keeps. Rotations are angles in 2D, quaternions x, y, z, w in 3D.

#include <pybind11/numpy.h>

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "common/math/angle.h"
#include "common/math/pose_values.h"
#include "common/math/vector.h"
#include "common/policy/sleep_event.h"

namespace talus {

using DoubleArray = pybind11::array_t<double, pybind11::array::c_style>;

/// An array that owns the values, which must be as many as the shape says.
template <class Value>
pybind11::array_t<Value> array_of(std::vector<Value> values, std::vector<pybind11::ssize_t> shape) {
  auto kept = std::make_unique<std::vector<Value>>(std::move(values));
  const Value* data = kept->data();
  const pybind11::capsule owner(kept.get(), [](void* all) { delete static_cast<std::vector<Value>*>(all); });
  kept.release();
  return pybind11::array_t<Value>(std::move(shape), data, owner);
}

template <class Value>
pybind11::array_t<Value> array_of(std::vector<Value> values) {
  const auto size = std::ssize(values);
  return array_of(std::move(values), {size});
}

/// A row for each vector.
template <class Vectors>
DoubleArray rows_of(const Vectors& vectors) {
  constexpr pybind11::ssize_t width = Vectors::value_type::RowsAtCompileTime;
  std::vector<double> values;
  values.reserve(vectors.size() * width);
  for (const auto& vector : vectors) values.insert(values.end(), vector.begin(), vector.end());
  return array_of(std::move(values), {std::ssize(vectors), width});
}

/// Writes a pose into pose_values<Dim> numbers.
template <int Dim>
void write_pose(const Pose<Dim>& pose, double* row) {
  for (int k = 0; k < Dim; ++k) row[k] = pose.position[k];
  if constexpr (Dim == 2)
    row[2] = wrapped_angle(pose.rotation);
  else
    for (int k = 0; k < 4; ++k) row[3 + k] = pose.rotation.coeffs()[k];  // Eigen's order is x, y, z, w
}

/// A body that fell asleep or woke, as a row of a structured array.
struct EventRow {
  std::int64_t step;
  std::int32_t body;
  bool woke;
  std::uint8_t cause;  // SleepCause
  std::int32_t pile;
  std::int32_t layer;
  double score;
};

std::vector<EventRow> event_rows(std::span<const SleepEvent> events);

}  // namespace talus
