// Runs of scenes.

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/math/require.h"
#include "common/scene/read_scene.h"
#include "common/simulation/state_hash.h"
#include "tools/python/arrays.h"
#include "tools/python/module.h"
#include "tools/run/backends.h"
#include "tools/run/find_scene.h"
#include "tools/run/make_simulation.h"
#include "tools/run/run_options.h"

namespace py = pybind11;

namespace talus {
namespace {

/// A run as Python has it.
template <int Dim>
class Run {
 public:
  Run(const Scene<Dim>& scene, const std::string& backend) : simulation_(make_simulation(scene, backend)) {}

  bool finished() const { return simulation_.finished(); }
  double time() const { return simulation_.time(); }
  std::int64_t step_count() const { return simulation_.frame().step; }
  std::uint64_t hash() const { return state_hash(states()); }

  /// Without the interpreter's lock, which it takes every few milliseconds to see whether Ctrl-C was pressed.
  void step(std::int64_t count) {
    using Clock = std::chrono::steady_clock;
    constexpr auto between_looks = std::chrono::milliseconds(5);
    const py::gil_scoped_release released;
    auto looked = Clock::now();
    for (std::int64_t i = 0; i < count && !simulation_.finished(); ++i) {
      simulation_.step();
      if (Clock::now() - looked < between_looks) continue;
      const py::gil_scoped_acquire held;
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      looked = Clock::now();
    }
  }

  static constexpr py::ssize_t pose_width = pose_values<Dim>;

  /// Writes the poses into an array of a row for each body. Throws std::invalid_argument on one of another shape.
  void write_poses(DoubleArray& array) const {
    require(array.ndim() == 2 && array.shape(0) == states().size() && array.shape(1) == pose_width, "out.shape",
            std::string(py::str(array.attr("shape"))), fmt::format("must be ({}, {})", states().size(), pose_width));
    for (BodyIndex i = 0; i < states().size(); ++i) write_pose<Dim>(states().pose[i], array.mutable_data(i, 0));
  }
  DoubleArray poses() const {
    DoubleArray array({static_cast<py::ssize_t>(states().size()), pose_width});
    write_poses(array);
    return array;
  }

  DoubleArray velocities() const { return rows_of(states().velocity); }
  DoubleArray spins() const { return rows_of(states().spin); }
  std::vector<std::uint8_t> asleep() const { return states().asleep; }
  std::vector<std::uint8_t> removed() const { return states().removed; }
  std::vector<int> shapes() const { return states().shape; }
  void remove(BodyIndex body) { simulation_.remove(body); }
  void wake() { simulation_.thaw_all(); }

 private:
  const BodyStates<Dim>& states() const { return simulation_.world().states(); }

  Simulation<Dim> simulation_;
};

/// A text with a line end or a `=` is a scene itself, every other one names it.
py::object open_run(const std::string& scene_text, const std::string& policy, std::optional<std::int64_t> seed,
                    const std::string& backend, const std::vector<std::string>& settings) {
  SceneChoice choice;
  choice.scene = scene_text;
  choice.policy = policy;
  choice.seed = seed;
  choice.backend = backend;
  choice.settings = settings;
  const std::vector<Override> overrides = overrides_of(choice);
  const bool is_text = scene_text.find_first_of("\n=") != std::string::npos;
  const std::filesystem::path file = is_text ? "scene" : find_scene(scene_text);
  const AnyScene scene = is_text ? parse_scene(scene_text, "scene", overrides) : read_scene(file, overrides);
  return std::visit(
      [&]<int Dim>(const Scene<Dim>& of_dimension) -> py::object {
        const std::vector<std::string> engines = backends(Dim);
        const std::string engine = backend.empty() && !engines.empty() ? engines.front() : backend;
        check_window(of_dimension, engine, file, choice.force);
        return py::cast(std::make_unique<Run<Dim>>(of_dimension, engine));
      },
      scene);
}

template <int Dim>
void add_run(py::module_& module, const char* name) {
  using RunHere = Run<Dim>;
  py::class_<RunHere>(module, name)
      .def_property_readonly_static("dimension", [](const py::object&) { return Dim; })
      .def_property_readonly("finished", &RunHere::finished)
      .def_property_readonly("time", &RunHere::time)
      .def_property_readonly("step_count", &RunHere::step_count)
      .def("step", &RunHere::step)
      .def("hash", &RunHere::hash)
      .def("poses", &RunHere::poses)
      .def("write_poses", &RunHere::write_poses, py::arg("out").noconvert())
      .def("velocities", &RunHere::velocities)
      .def("spins", &RunHere::spins)
      .def("asleep", &RunHere::asleep)
      .def("removed", &RunHere::removed)
      .def("shapes", &RunHere::shapes)
      .def("remove", &RunHere::remove)
      .def("wake", &RunHere::wake);
}

}  // namespace

void add_runs(py::module_& module) {
  add_run<2>(module, "Run2");
  add_run<3>(module, "Run3");
  module.def("open_run", &open_run);
}

}  // namespace talus
