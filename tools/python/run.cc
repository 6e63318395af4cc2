// Runs of scenes.

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/math/require.h"
#include "common/math/require_finite.h"
#include "common/policy/observer.h"
#include "common/scene/read_scene.h"
#include "common/simulation/state_hash.h"
#include "common/world/stopwatch.h"
#include "tools/python/arrays.h"
#include "tools/python/contact_row.h"
#include "tools/python/module.h"
#include "tools/run/backends.h"
#include "tools/run/find_scene.h"
#include "tools/run/finish_run.h"
#include "tools/run/make_simulation.h"
#include "tools/run/run_options.h"
#include "tools/run/run_outputs.h"
#include "tools/run/run_statistics.h"
#include "tools/sweep/sweep_plan.h"

namespace py = pybind11;

namespace talus {
namespace {

/// What a run collects for Python besides its states.
struct Wanted {
  bool warnings = false;
  bool contacts = false;      // of each step
  std::filesystem::path out;  // run folder; empty: none
};

/// Has each step record its contacts.
template <int Dim>
struct ContactsWanted final : Observer<Dim> {
  bool needs_contacts() const override { return true; }
  void on_frame(const Frame<Dim>&) override {}
};

/// During work without the interpreter's lock: takes it every few milliseconds to see whether Ctrl-C was pressed, and
/// now and then to call a function of the program.
class Attention {
 public:
  explicit Attention(std::function<void()> tell = {}) : tell_(std::move(tell)) {}

  /// Throws what the program's handler of a signal, or its function, has raised.
  void pay() {
    const auto now = Clock::now();
    if (now - looked_ < std::chrono::milliseconds(5)) return;
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (tell_ && now - told_ > std::chrono::milliseconds(200)) {
      tell_();
      told_ = now;
    }
    looked_ = Clock::now();
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::function<void()> tell_;
  Clock::time_point looked_ = Clock::now();
  Clock::time_point told_ = looked_;
};

/// A layer of a pile as a row of a structured array.
struct LayerRow {
  double bottom;
  double top;
  double radius;
  double capacity;
  std::int32_t count;
  std::int32_t sleeping;
};

template <int Dim>
ContactRow<Dim> contact_row(const Contact<Dim>& contact) {
  ContactRow<Dim> row{};
  row.a = contact.a;
  row.b = contact.b;
  std::ranges::copy(contact.point, row.point);
  std::ranges::copy(contact.normal, row.normal);
  row.normal_impulse = contact.normal_impulse;
  std::ranges::copy(contact.friction_impulse, row.friction_impulse);
  row.approach_speed = contact.approach_speed;
  row.depth = contact.depth;
  return row;
}

template <class Vector>
Vector vector_in(const std::vector<double>& values, std::string_view field) {
  const Eigen::Map<const Eigen::VectorXd> given(values.data(), std::ssize(values));
  require(given.size() == Vector::RowsAtCompileTime, fmt::format("{}.size", field), static_cast<double>(given.size()),
          fmt::format("must be {}", Vector::RowsAtCompileTime));
  require_finite(given, field);
  return given;
}

/// A run as Python has it. Its members are called with the interpreter's lock held.
template <int Dim>
class Run {
 public:
  Run(const Scene<Dim>& scene, const std::string& name, const std::string& backend, const Wanted& wanted)
      : scene_(scene), simulation_(make_simulation(scene_, backend)), wanted_(wanted) {
    summary_.scene_name = name;
    summary_.backend = backend;
    summary_.scene_warnings = scene_warnings(scene_, backend);
    if (wanted.contacts) simulation_.add_observer(contacts_wanted_);
    if (wanted.warnings) simulation_.add_observer(statistics_);
    options_.quiet = true;
    if (wanted.out.empty()) return;
    options_.out = wanted.out;
    options_.telemetry = false;
    options_.hash_only = true;
    outputs_.emplace(options_, scene_, name, backend, simulation_);
  }

  /// Throws std::runtime_error while step() or run() go on without the lock.
  void require_idle() const {
    if (busy_) throw std::runtime_error("a step is under way in another thread");
  }

  bool finished() const { return simulation_.finished(); }
  bool at_rest() const { return simulation_.at_rest(); }
  double time() const { return simulation_.time(); }
  std::int64_t step_count() const { return simulation_.frame().step; }
  std::uint64_t hash() const { return state_hash(states()); }

  /// Without the interpreter's lock.
  void step(std::int64_t count) {
    Attention attention;
    const Busy busy(busy_);
    const py::gil_scoped_release released;
    advance(count, attention);
  }

  /// To the end, whatever it is; then the folder is completed and an error thrown on. `progress`: None, or called with
  /// the steps done and those of the scene.
  void run(const py::object& progress) {
    const auto tell = [&] { progress(step_count(), scene_.steps()); };
    Attention attention = progress.is_none() ? Attention() : Attention(tell);
    std::exception_ptr failure;
    {
      const Busy busy(busy_);
      const py::gil_scoped_release released;
      Stopwatch watch;
      failure = advance_to_end(attention);
      summary_.wall_seconds = watch.lap();
      finish(failure);
    }
    if (failure) std::rethrow_exception(failure);
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress.is_none()) tell();
  }

  /// All warnings of scene and run so far, a line each.
  std::vector<std::string> warnings() const {
    std::vector<std::string> all = summary_.scene_warnings;
    const std::span<const Warning> of_run =
        summary_.reason.empty() ? simulation_.warnings() : std::span<const Warning>(summary_.warnings);
    for (const Warning& warning : of_run) all.push_back(advice(warning));
    return all;
  }
  std::uint64_t seed() const { return scene_.seed; }
  py::bytes folder() const { return outputs_ ? outputs_->folder().string() : ""; }
  std::vector<std::string> shape_names() const {
    std::vector<std::string> names;
    for (const Shape<Dim>& shape : scene_.world.shapes) names.push_back(shape.name);
    return names;
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
  void wake_all() { simulation_.thaw_all(); }
  void wake(const std::vector<BodyIndex>& bodies) { act({.action = EventAction::wake}, bodies); }
  void kick(const std::vector<BodyIndex>& bodies, const std::vector<double>& velocity,
            const std::vector<double>& spin) {
    Event<Dim> event{.action = EventAction::kick};
    event.velocity = vector_in<Vec<Dim>>(velocity, "velocity");
    if (!spin.empty()) event.spin = vector_in<Spin<Dim>>(spin, "spin");
    act(std::move(event), bodies);
  }

  /// Of the last step.
  py::array_t<EventRow> events() const { return array_of(event_rows(simulation_.frame().events)); }
  py::array_t<ContactRow<Dim>> contacts() const {
    require(wanted_.contacts, "contacts", "False", "must be True when the simulation is made");
    std::vector<ContactRow<Dim>> rows;
    for (const Contact<Dim>& contact : simulation_.world().contacts()) rows.push_back(contact_row(contact));
    return array_of(std::move(rows));
  }
  py::list piles() const {
    py::list all;
    for (const Pile<Dim>& pile : simulation_.piles().piles()) {
      const std::vector<double> centre(pile.centre.begin(), pile.centre.end());
      std::vector<LayerRow> layers;
      for (const Layer& layer : pile.layers)
        layers.push_back({layer.bottom, layer.top, layer.radius, layer.capacity, layer.count, layer.sleeping});
      all.append(py::make_tuple(array_of(centre), pile.alpha, pile.height, pile.radius, pile.structure_size,
                                array_of(std::move(layers))));
    }
    return all;
  }

 private:
  /// Sets the flag as long as it exists, which is until the lock is held again.
  class Busy {
   public:
    explicit Busy(bool& flag) : flag_(&flag) { *flag_ = true; }
    ~Busy() { *flag_ = false; }
    Busy(const Busy&) = delete;
    Busy& operator=(const Busy&) = delete;

   private:
    bool* flag_;
  };

  const BodyStates<Dim>& states() const { return simulation_.world().states(); }

  /// As an event of the scene does, to these bodies alone.
  void act(Event<Dim> event, const std::vector<BodyIndex>& bodies) {
    for (const BodyIndex body : bodies) simulation_.world().require_present(body);
    if (bodies.empty()) return;  // to an event it means all
    event.numbers.assign(bodies.begin(), bodies.end());
    simulation_.do_event(event);
  }

  void advance(std::int64_t count, Attention& attention) {
    for (std::int64_t i = 0; i < count && !simulation_.finished(); ++i) {
      simulation_.step();
      attention.pay();
    }
  }

  /// The error that ended the run, if one did; the summary gets the reason.
  std::exception_ptr advance_to_end(Attention& attention) {
    try {
      advance(scene_.steps(), attention);
      summary_.reason = "finished";
      return {};
    } catch (const NonFiniteState& error) {
      summary_.reason = error.what();
      return std::current_exception();
    } catch (const py::error_already_set&) {
      summary_.reason = "interrupted";
      return std::current_exception();
    }
  }

  void finish(std::exception_ptr& failure) {
    summary_.emit_waits = simulation_.emitter().waits();
    Attention attention;
    const auto stop = [&] {
      try {
        attention.pay();
      } catch (const py::error_already_set&) {
        failure = std::current_exception();
      }
      return failure != nullptr;
    };
    finish_run<Dim>(options_, scene_, simulation_, statistics_, stop, summary_);
    if (outputs_) outputs_->finish(summary_, scene_, simulation_);
  }

  Scene<Dim> scene_;
  Simulation<Dim> simulation_;
  Wanted wanted_;
  ContactsWanted<Dim> contacts_wanted_;
  RunStatistics<Dim> statistics_;
  RunOptions options_;  // of the outputs
  SummaryInput summary_;
  std::optional<RunOutputs<Dim>> outputs_;
  bool busy_ = false;
};

/// A member that throws where another thread is within step() or run().
template <class Run, class Result, class... Arguments>
auto idle(Result (Run::*member)(Arguments...)) {
  return [member](Run& run, Arguments... arguments) -> Result {
    run.require_idle();
    return (run.*member)(std::forward<Arguments>(arguments)...);
  };
}
template <class Run, class Result, class... Arguments>
auto idle(Result (Run::*member)(Arguments...) const) {
  return [member](const Run& run, Arguments... arguments) -> Result {
    run.require_idle();
    return (run.*member)(std::forward<Arguments>(arguments)...);
  };
}

/// `is_text`: the scene is TOML text; else it is a path or the name of a scene in a folder.
py::object open_run(const std::string& scene_text, bool is_text, const std::string& folder, const std::string& policy,
                    std::optional<std::int64_t> seed, const std::string& backend,
                    const std::vector<std::string>& settings, bool warnings, bool contacts, const std::string& out) {
  SceneChoice choice;
  choice.scene = scene_text;
  choice.policy = policy;
  choice.seed = seed;
  choice.backend = backend;
  choice.settings = settings;
  const std::vector<Override> overrides = overrides_of(choice);
  const std::filesystem::path file = is_text ? "scene" : find_scene(scene_text, folder);
  const AnyScene scene = is_text ? parse_scene(scene_text, "scene", overrides) : read_scene(file, overrides);
  return std::visit(
      [&]<int Dim>(const Scene<Dim>& of_dimension) -> py::object {
        const std::string engine = backend_for(backend, Dim);
        check_window(of_dimension, engine, file, choice.force);
        return py::cast(
            std::make_unique<Run<Dim>>(of_dimension, file.stem().string(), engine, Wanted{warnings, contacts, out}));
      },
      scene);
}

template <int Dim>
void add_run(py::module_& module, const char* name) {
  using RunHere = Run<Dim>;
  py::class_<RunHere>(module, name)
      .def_property_readonly_static("dimension", [](const py::object&) { return Dim; })
      .def_property_readonly("finished", idle(&RunHere::finished))
      .def_property_readonly("at_rest", idle(&RunHere::at_rest))
      .def_property_readonly("warnings", idle(&RunHere::warnings))
      .def_property_readonly("seed", idle(&RunHere::seed))
      .def_property_readonly("folder", idle(&RunHere::folder))
      .def_property_readonly("shape_names", idle(&RunHere::shape_names))
      .def_property_readonly("time", idle(&RunHere::time))
      .def_property_readonly("step_count", idle(&RunHere::step_count))
      .def("step", idle(&RunHere::step))
      .def("run", idle(&RunHere::run))
      .def("hash", idle(&RunHere::hash))
      .def("poses", idle(&RunHere::poses))
      .def("write_poses", idle(&RunHere::write_poses), py::arg("out").noconvert())
      .def("velocities", idle(&RunHere::velocities))
      .def("spins", idle(&RunHere::spins))
      .def("asleep", idle(&RunHere::asleep))
      .def("removed", idle(&RunHere::removed))
      .def("shapes", idle(&RunHere::shapes))
      .def("remove", idle(&RunHere::remove))
      .def("wake_all", idle(&RunHere::wake_all))
      .def("wake", idle(&RunHere::wake))
      .def("kick", idle(&RunHere::kick))
      .def("events", idle(&RunHere::events))
      .def("contacts", idle(&RunHere::contacts))
      .def("piles", idle(&RunHere::piles));
}

}  // namespace

void add_runs(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(LayerRow, bottom, top, radius, capacity, count, sleeping);
  add_run<2>(module, "Run2");
  add_run<3>(module, "Run3");
  module.def("open_run", &open_run);
  module.def("overlap", &overlap);
  module.def("has_twins", &has_twins);
}

}  // namespace talus
