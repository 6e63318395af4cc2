// The extension module `_talus`, which the Python files of the package wrap.

#include "tools/python/module.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <string>
#include <system_error>

#include "common/scene/diagnostics.h"
#include "common/world/world.h"
#include "tools/python/arrays.h"

namespace py = pybind11;

namespace talus {
namespace {

/// An error of the operating system, with its number and what was done.
void raise_os_error(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(std::move(thrown));
  } catch (const std::system_error& error) {
    const py::object arguments = py::make_tuple(error.code().value(), error.what());
    PyErr_SetObject(PyExc_OSError, arguments.ptr());
  }
}

}  // namespace

std::vector<EventRow> event_rows(std::span<const SleepEvent> events) {
  std::vector<EventRow> rows;
  rows.reserve(events.size());
  for (const SleepEvent& event : events)
    rows.push_back({event.step, event.body, event.woke, static_cast<std::uint8_t>(event.cause), event.pile, event.layer,
                    event.score});
  return rows;
}

}  // namespace talus

PYBIND11_MODULE(_talus, module) {
  py::register_exception_translator(talus::raise_os_error);
  py::register_exception<talus::SceneErrors>(module, "SceneError", PyExc_ValueError).attr("__doc__") =
      "Errors of a scene, a line each with file, line, field, value and rule.";
  py::register_exception<talus::NonFiniteState>(module, "NonFiniteState", PyExc_RuntimeError).attr("__doc__") =
      "The state of a body became NaN or infinite; the message has step and body.";
  PYBIND11_NUMPY_DTYPE(talus::EventRow, step, body, woke, cause, pile, layer, score);
  module.attr("cause_names") = talus::cause_names();
  talus::add_runs(module);
  talus::add_sleepers(module);
#ifdef TALUS_LCM
  talus::add_records(module);
#endif
}
