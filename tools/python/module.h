#pragma once
// The parts of the extension module `_talus`.

#include <pybind11/pybind11.h>

namespace talus {

/// Runs of scenes.
void add_runs(pybind11::module_& module);
/// Recorded runs.
void add_records(pybind11::module_& module);
/// Sleep for other engines.
void add_sleepers(pybind11::module_& module);

}  // namespace talus
