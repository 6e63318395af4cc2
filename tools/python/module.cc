// The extension module `_talus`: a run of a scene for Python.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/math/angle.h"
#include "common/scene/read_scene.h"
#include "common/simulation/state_hash.h"
#include "tools/run/backends.h"
#include "tools/run/find_scene.h"
#include "tools/run/make_simulation.h"
#include "tools/run/run_options.h"

namespace py = pybind11;

namespace talus {
namespace {

using Array = py::array_t<double, py::array::c_style>;

/// A run as Python has it, in 2D or 3D.
class AnyRun {
 public:
  virtual ~AnyRun() = default;
  virtual int dimension() const = 0;
  virtual void step(std::int64_t count) = 0;
  virtual bool finished() const = 0;
  virtual double time() const = 0;
  virtual std::int64_t step_count() const = 0;
  virtual std::uint64_t hash() const = 0;
  virtual Array poses() const = 0;
  virtual Array velocities() const = 0;
  virtual Array spins() const = 0;
  virtual std::vector<std::uint8_t> asleep() const = 0;
  virtual std::vector<std::uint8_t> removed() const = 0;
  virtual std::vector<int> shapes() const = 0;
  virtual void remove(BodyIndex body) = 0;
  virtual void wake() = 0;
};

/// A row for each vector.
template <class Vectors>
Array rows_of(const Vectors& vectors) {
  constexpr py::ssize_t width = Vectors::value_type::RowsAtCompileTime;
  Array array({static_cast<py::ssize_t>(vectors.size()), width});
  auto rows = array.template mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < std::ssize(vectors); ++i)
    for (py::ssize_t k = 0; k < width; ++k) rows(i, k) = vectors[i][k];
  return array;
}

template <int Dim>
class Run final : public AnyRun {
 public:
  Run(const Scene<Dim>& scene, const std::string& backend) : simulation_(make_simulation(scene, backend)) {}

  int dimension() const override { return Dim; }
  bool finished() const override { return simulation_.finished(); }
  double time() const override { return simulation_.time(); }
  std::int64_t step_count() const override { return simulation_.frame().step; }
  std::uint64_t hash() const override { return state_hash(states()); }

  /// Without the interpreter's lock, which it takes every few milliseconds to see whether Ctrl-C was pressed.
  void step(std::int64_t count) override {
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

  Array poses() const override {
    constexpr py::ssize_t width = Dim == 2 ? 3 : 7;
    Array array({static_cast<py::ssize_t>(states().size()), width});
    auto rows = array.template mutable_unchecked<2>();
    for (BodyIndex i = 0; i < states().size(); ++i) {
      const Pose<Dim>& pose = states().pose[i];
      for (int k = 0; k < Dim; ++k) rows(i, k) = pose.position[k];
      if constexpr (Dim == 2)
        rows(i, 2) = wrapped_angle(pose.rotation);
      else
        for (int k = 0; k < 4; ++k) rows(i, 3 + k) = pose.rotation.coeffs()[k];
    }
    return array;
  }

  Array velocities() const override { return rows_of(states().velocity); }
  Array spins() const override { return rows_of(states().spin); }
  std::vector<std::uint8_t> asleep() const override { return states().asleep; }
  std::vector<std::uint8_t> removed() const override { return states().removed; }
  std::vector<int> shapes() const override { return states().shape; }
  void remove(BodyIndex body) override { simulation_.remove(body); }
  void wake() override { simulation_.thaw_all(); }

 private:
  const BodyStates<Dim>& states() const { return simulation_.world().states(); }

  Simulation<Dim> simulation_;
};

/// A text with a line end or a `=` is a scene itself, every other one names it.
std::unique_ptr<AnyRun> open_run(const SceneChoice& choice) {
  const std::vector<Override> overrides = overrides_of(choice);
  const bool is_text = choice.scene.find_first_of("\n=") != std::string::npos;
  const std::filesystem::path file = is_text ? "scene" : find_scene(choice.scene);
  const AnyScene scene = is_text ? parse_scene(choice.scene, "scene", overrides) : read_scene(file, overrides);
  return std::visit(
      [&]<int Dim>(const Scene<Dim>& of_dimension) -> std::unique_ptr<AnyRun> {
        const std::vector<std::string> engines = backends(Dim);
        const std::string backend = choice.backend.empty() && !engines.empty() ? engines.front() : choice.backend;
        check_window(of_dimension, backend, file, choice.force);
        return std::make_unique<Run<Dim>>(of_dimension, backend);
      },
      scene);
}

std::unique_ptr<AnyRun> make_run(const std::string& scene, const std::string& policy, std::optional<std::int64_t> seed,
                                 const std::string& backend, const std::vector<std::string>& settings) {
  SceneChoice choice;
  choice.scene = scene;
  choice.policy = policy;
  choice.seed = seed;
  choice.backend = backend;
  choice.settings = settings;
  return open_run(choice);
}

}  // namespace
}  // namespace talus

PYBIND11_MODULE(_talus, module) {
  using talus::AnyRun;
  py::register_exception<talus::SceneErrors>(module, "SceneError", PyExc_ValueError);
  py::register_exception<talus::NonFiniteState>(module, "NonFiniteState", PyExc_RuntimeError);
  py::class_<AnyRun>(module, "Run")
      .def(py::init(&talus::make_run))
      .def_property_readonly("dimension", &AnyRun::dimension)
      .def_property_readonly("finished", &AnyRun::finished)
      .def_property_readonly("time", &AnyRun::time)
      .def_property_readonly("step_count", &AnyRun::step_count)
      .def("step", &AnyRun::step)
      .def("hash", &AnyRun::hash)
      .def("poses", &AnyRun::poses)
      .def("velocities", &AnyRun::velocities)
      .def("spins", &AnyRun::spins)
      .def("asleep", &AnyRun::asleep)
      .def("removed", &AnyRun::removed)
      .def("shapes", &AnyRun::shapes)
      .def("remove", &AnyRun::remove)
      .def("wake", &AnyRun::wake);
}
