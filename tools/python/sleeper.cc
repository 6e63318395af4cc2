// Sleep for other engines.

#include <fmt/format.h>
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "common/math/require.h"
#include "common/simulation/sleeper_watch.h"
#include "common/sleeper/pile_sleeper.h"
#include "common/sleeper/step_buffer.h"
#ifdef TALUS_LCM
#include "lcmtypes/world_feed.h"
#endif
#include "tools/python/arrays.h"
#include "tools/python/contact_row.h"
#include "tools/python/module.h"

namespace py = pybind11;

namespace talus {
namespace {

/// NumPy's usual whole numbers have a sign.
std::int64_t whole(Handle handle) { return static_cast<std::int64_t>(number_of(handle)); }

using HandleArray = py::array_t<std::int64_t, py::array::c_style>;

/// SavedSleep as a row of a structured array.
struct SavedRow {
  std::int64_t body;
  bool asleep;
  bool settled;
};

void require_rows(const py::array& array, py::ssize_t rows, py::ssize_t width, std::string_view field) {
  require(array.ndim() == 2 && array.shape(0) == rows && array.shape(1) == width, fmt::format("{}.shape", field),
          std::string(py::str(array.attr("shape"))), fmt::format("must be ({}, {})", rows, width));
}

template <class Vector>
Vector vector_at(const double* numbers) {
  return Eigen::Map<const Vector>(numbers);
}

template <int Dim>
Vec<Dim> vector_in(const DoubleArray& array, std::string_view field) {
  require(array.ndim() == 1 && array.size() == Dim, fmt::format("{}.shape", field),
          std::string(py::str(array.attr("shape"))), fmt::format("must be ({},)", Dim));
  return vector_at<Vec<Dim>>(array.data());
}

/// Of pose_values<Dim> numbers, as write_pose() writes them.
template <int Dim>
Pose<Dim> pose_at(const double* row) {
  Pose<Dim> pose{.position = vector_at<Vec<Dim>>(row)};
  if constexpr (Dim == 2)
    pose.rotation = Rotation<2>(row[2]);
  else
    pose.rotation.coeffs() = vector_at<Eigen::Vector4d>(row + 3);
  return pose;
}

template <int Dim>
Pose<Dim> pose_in(const DoubleArray& array) {
  constexpr auto width = static_cast<py::ssize_t>(pose_values<Dim>);
  require(array.ndim() == 1 && array.size() == width, "pose.shape", std::string(py::str(array.attr("shape"))),
          fmt::format("must be ({},)", width));
  return pose_at<Dim>(array.data());
}

template <int Dim>
std::vector<Pose<Dim>> poses_in(const DoubleArray& array, py::ssize_t rows) {
  constexpr auto width = static_cast<py::ssize_t>(pose_values<Dim>);
  require_rows(array, rows, width, "poses");
  std::vector<Pose<Dim>> poses;
  for (py::ssize_t i = 0; i < rows; ++i) poses.push_back(pose_at<Dim>(array.data(i, 0)));
  return poses;
}

template <int Dim>
GivenContact<Dim> contact_of(const ContactRow<Dim>& row) {
  return {.a = handle_of(row.a),
          .b = handle_of(row.b),
          .point = vector_at<Vec<Dim>>(row.point),
          .normal = vector_at<Vec<Dim>>(row.normal),
          .normal_impulse = row.normal_impulse,
          .friction_impulse = vector_at<Vec<Dim>>(row.friction_impulse),
          .approach_speed = row.approach_speed,
          .depth = row.depth};
}

/// A PileSleeper that takes and gives arrays. Changes are three lists of tuples.
template <int Dim>
class ArraySleeper {
 public:
  ArraySleeper(const DoubleArray& gravity, bool enabled, std::optional<int> up, std::optional<double> extent,
               double tolerance)
      : sleeper_(vector_in<Dim>(gravity, "gravity"), options(enabled, up, extent, tolerance)) {}

  std::int64_t add_box(const DoubleArray& pose, double mass, const DoubleArray& size, double friction, int role) {
    return add(pose, box_traits<Dim>(mass, vector_in<Dim>(size, "size")), friction, role);
  }
  std::int64_t add_ball(const DoubleArray& pose, double mass, double radius, double friction, int role) {
    return add(pose, ball_traits<Dim>(mass, radius), friction, role);
  }
  std::int64_t add_other(const DoubleArray& pose, double mass, const DoubleArray& inertia, const DoubleArray& bounds,
                         double friction, int role) {
    constexpr py::ssize_t width = Inertia<Dim>::RowsAtCompileTime;
    require_rows(inertia, width, width, "inertia");
    require_rows(bounds, 2, Dim, "bounds");
    BodyTraits<Dim> traits{.mass = mass};
    traits.inertia = vector_at<Inertia<Dim>>(inertia.data());
    traits.bounds = Box<Dim>(vector_at<Vec<Dim>>(bounds.data(0, 0)), vector_at<Vec<Dim>>(bounds.data(1, 0)));
    return add(pose, traits, friction, role);
  }
  py::tuple remove(std::int64_t body) { return changes(sleeper_.remove(handle_of(body))); }
  py::tuple set_role(std::int64_t body, int role) {
    return changes(sleeper_.set_role(handle_of(body), static_cast<BodyRole>(role)));
  }

  HandleArray followed() {
    std::vector<std::int64_t> numbers;
    for (const Handle handle : sleeper_.followed()) numbers.push_back(whole(handle));
    return array_of(std::move(numbers));
  }

  py::tuple step(double dt, const HandleArray& bodies, const DoubleArray& poses, const DoubleArray& velocities,
                 const DoubleArray& spins, const py::array_t<ContactRow<Dim>, py::array::c_style>& contacts) {
    constexpr py::ssize_t spin_width = Spin<Dim>::RowsAtCompileTime;
    require(bodies.ndim() == 1 && contacts.ndim() == 1, "bodies and contacts",
            fmt::format("{} and {} axes", bodies.ndim(), contacts.ndim()), "must have one axis each");
    const py::ssize_t count = bodies.size();
    require_rows(velocities, count, Dim, "velocities");
    require_rows(spins, count, spin_width, "spins");
    buffer_.clear();
    buffer_.poses = poses_in<Dim>(poses, count);
    for (py::ssize_t i = 0; i < count; ++i) {
      buffer_.bodies.push_back(handle_of(bodies.at(i)));
      buffer_.velocities.push_back(vector_at<Vec<Dim>>(velocities.data(i, 0)));
      buffer_.spins.push_back(vector_at<Spin<Dim>>(spins.data(i, 0)));
    }
    for (py::ssize_t i = 0; i < contacts.size(); ++i) buffer_.contacts.push_back(contact_of<Dim>(*contacts.data(i)));
    return changes(sleeper_.after_step(buffer_.step(dt)));
  }

  py::tuple wake(std::int64_t body) { return changes(sleeper_.wake(handle_of(body))); }
  py::tuple wake_all() { return changes(sleeper_.wake_all()); }
  py::tuple wake_near(const DoubleArray& low, const DoubleArray& high) {
    return changes(sleeper_.wake_near(Box<Dim>(vector_in<Dim>(low, "low"), vector_in<Dim>(high, "high"))));
  }
  py::tuple moved(std::int64_t body, const DoubleArray& pose) {
    return changes(sleeper_.moved(handle_of(body), pose_in<Dim>(pose)));
  }
  py::tuple set_gravity(const DoubleArray& gravity) {
    return changes(sleeper_.set_gravity(vector_in<Dim>(gravity, "gravity")));
  }

#ifdef TALUS_LCM
  void observe(const std::optional<std::string>& record, bool publish, const std::string& name,
               const std::string& title, const std::string& engine, double dt, double frame_rate) {
    const WorldLabel label{.name = name, .title = title, .engine = engine, .dt = dt, .frame_rate = frame_rate};
    if (record) sleeper_.observe(record_world<Dim>(*record, label));
    if (publish) sleeper_.observe(publish_world<Dim>(label));
  }
#endif
  using Report = std::function<void(std::string_view kind, std::int64_t body, double value, const std::string& text)>;
  void watch(const Report& report) {
    sleeper_.observe(std::make_unique<SleeperWatch<Dim>>([this, report](const Warning& warning) {
      report(to_string(warning.kind), whole(sleeper_.handle_of(warning.body)), warning.value, advice(warning));
    }));
  }
  void end_observers() { sleeper_.end_observers(); }

  std::int64_t of_number(BodyIndex number) const { return whole(sleeper_.handle_of(number)); }
  bool has(std::int64_t body) const { return sleeper_.has(handle_of(body)); }
  bool asleep(std::int64_t body) const { return sleeper_.asleep(handle_of(body)); }
  int size() const { return sleeper_.size(); }
  int awake() const { return sleeper_.awake(); }

  py::array_t<SavedRow> snapshot() const {
    std::vector<SavedRow> rows;
    for (const SavedSleep& saved : sleeper_.snapshot())
      rows.push_back({whole(saved.body), saved.asleep, saved.settled});
    return array_of(std::move(rows));
  }
  py::tuple restore(const py::array_t<SavedRow, py::array::c_style>& saved, const DoubleArray& poses) {
    std::vector<SavedSleep> bodies;
    for (py::ssize_t i = 0; i < saved.size(); ++i) {
      const SavedRow& row = *saved.data(i);
      bodies.push_back({handle_of(row.body), row.asleep, row.settled});
    }
    return changes(sleeper_.restore(bodies, poses_in<Dim>(poses, saved.size())));
  }

 private:
  static SleeperOptions options(bool enabled, std::optional<int> up, std::optional<double> extent, double tolerance) {
    SleeperOptions options{.enabled = enabled, .extent = extent};
    if (up) options.up = static_cast<UpAxis>(*up);
    options.adaptive.tolerance = tolerance;
    return options;
  }

  std::int64_t add(const DoubleArray& pose, BodyTraits<Dim> traits, double friction, int role) {
    traits.friction = friction;
    return whole(sleeper_.add(traits, pose_in<Dim>(pose), static_cast<BodyRole>(role)));
  }

  static py::list list_of(const std::vector<SleepChange>& changes) {
    py::list list;
    for (const SleepChange& change : changes) list.append(py::make_tuple(whole(change.body), to_string(change.cause)));
    return list;
  }
  static py::tuple changes(const SleepChanges<Dim>& all) {
    py::list velocities;
    for (const GivenVelocity<Dim>& change : all.velocities)
      velocities.append(py::make_tuple(whole(change.body), DoubleArray(Dim, change.velocity.data()),
                                       DoubleArray(change.spin.size(), change.spin.data()), to_string(change.cause)));
    return py::make_tuple(list_of(all.thaw), velocities, list_of(all.freeze));
  }

  PileSleeper<Dim> sleeper_;
  StepBuffer<Dim> buffer_;
};

template <int Dim>
void add_sleeper(py::module_& module, const char* name) {
  using Sleeper = ArraySleeper<Dim>;
  py::class_<Sleeper> bound(module, name);
#ifdef TALUS_LCM
  bound.def("observe", &Sleeper::observe);
#endif
  bound.def(py::init<const DoubleArray&, bool, std::optional<int>, std::optional<double>, double>())
      .def_property_readonly_static("contact_dtype", [](const py::object&) { return py::dtype::of<ContactRow<Dim>>(); })
      .def("add_box", &Sleeper::add_box)
      .def("add_ball", &Sleeper::add_ball)
      .def("add_other", &Sleeper::add_other)
      .def("remove", &Sleeper::remove)
      .def("set_role", &Sleeper::set_role)
      .def("followed", &Sleeper::followed)
      .def("step", &Sleeper::step)
      .def("wake", &Sleeper::wake)
      .def("wake_all", &Sleeper::wake_all)
      .def("wake_near", &Sleeper::wake_near)
      .def("moved", &Sleeper::moved)
      .def("set_gravity", &Sleeper::set_gravity)
      .def("watch", &Sleeper::watch)
      .def("end_observers", &Sleeper::end_observers)
      .def("handle_of", &Sleeper::of_number)
      .def("has", &Sleeper::has)
      .def("asleep", &Sleeper::asleep)
      .def("size", &Sleeper::size)
      .def("awake", &Sleeper::awake)
      .def("snapshot", &Sleeper::snapshot)
      .def("restore", &Sleeper::restore);
}

}  // namespace

void add_sleepers(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(ContactRow<2>, a, b, point, normal, normal_impulse, friction_impulse, approach_speed, depth);
  PYBIND11_NUMPY_DTYPE(ContactRow<3>, a, b, point, normal, normal_impulse, friction_impulse, approach_speed, depth);
  PYBIND11_NUMPY_DTYPE(SavedRow, body, asleep, settled);
  add_sleeper<2>(module, "Sleeper2");
  add_sleeper<3>(module, "Sleeper3");
}

}  // namespace talus
