// Recorded runs as arrays.

#include <pybind11/stl.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string>

#include "lcmtypes/log_reader.h"
#include "tools/export/solid.h"
#include "tools/python/arrays.h"
#include "tools/python/module.h"
#include "tools/record/record_file.h"
#include "tools/record/record_walk.h"
#include "tools/record/recorded_run.h"

namespace py = pybind11;

namespace talus {
namespace {

/// A ContactForce of a step as a row of a structured array, in single precision, as it is recorded.
template <int Dim>
struct ForceRow {
  std::int64_t step;
  std::int32_t a;
  std::int32_t b;
  float point[Dim];
  float normal_force[Dim];
  float friction_force[Dim];
  bool kept;
};

template <int Dim>
ForceRow<Dim> force_row(std::int64_t step, const ContactForce<Dim>& contact) {
  ForceRow<Dim> row = {step, contact.a, contact.b, {}, {}, {}, contact.kept};
  for (int axis = 0; axis < Dim; ++axis) {
    row.point[axis] = static_cast<float>(contact.point[axis]);
    row.normal_force[axis] = static_cast<float>(contact.normal_force[axis]);
    row.friction_force[axis] = static_cast<float>(contact.friction_force[axis]);
  }
  return row;
}

/// The frames of a record. Where a body is not in the world, at a known pose, its numbers are NaN.
template <int Dim>
struct RecordedFrames {
  std::size_t frames = 0;
  BodyIndex bodies = 0;
  std::vector<std::int64_t> steps;
  std::vector<double> times;         // [s]
  std::vector<float> poses;          // [frame, body, number]
  std::vector<std::uint8_t> asleep;  // [frame, body]
  std::vector<int> shapes;           // [body]
  std::vector<EventRow> events;
  std::vector<ForceRow<Dim>> contacts;

  void reserve() {
    const std::size_t entries = frames * bodies;
    poses.reserve(entries * pose_values<Dim>);
    asleep.reserve(entries);
    shapes.assign(bodies, -1);
  }

  void add(const Moment& moment) {
    steps.push_back(moment.step);
    times.push_back(moment.time);
    const MomentBodies& all = moment.bodies;
    for (BodyIndex body = 0; body < bodies; ++body) {
      const bool shown = body < all.size() && all.shows(body);
      if (body < all.size()) shapes[body] = all.shape[body];
      asleep.push_back(shown && all.asleep[body] != 0 ? 1 : 0);
      if (shown)
        add_pose(all.pose[body]);
      else
        poses.insert(poses.end(), pose_values<Dim>, std::numeric_limits<float>::quiet_NaN());
    }
    for (const ContactForce<Dim>& contact : contacts_of<Dim>(moment))
      contacts.push_back(force_row<Dim>(moment.step, contact));
  }

  void add(std::span<const SleepEvent> more) {
    const std::vector<EventRow> rows = event_rows(more);
    events.insert(events.end(), rows.begin(), rows.end());
  }

 private:
  /// Records have quaternions as w, x, y, z.
  void add_pose(std::span<const float> values) {
    poses.insert(poses.end(), values.begin(), values.end());
    if constexpr (Dim == 3) std::rotate(poses.end() - 4, poses.end() - 3, poses.end());
  }
};

/// Read twice, so that memory is that of the arrays. A run that still goes on may have more to tell the second time.
template <int Dim>
WalkResult read_frames(const Scene<Dim>& scene, const std::filesystem::path& path, RecordedFrames<Dim>& read) {
  const std::string file = record_file(path).string();
  LogReader first(file);
  const WalkResult counted = walk_record<Dim>(scene, first, path, [&](const Moment& moment) {
    ++read.frames;
    read.bodies = moment.bodies.size();
  });
  if (read.frames == 0) throw no_frame(path, counted.damage.bytes);
  read.reserve();
  LogReader second(file);
  WalkResult walk = walk_record<Dim>(scene, second, path, [&](const Moment& moment) {
    if (read.steps.size() == read.frames) return;
    read.add(moment.events);
    read.add(moment);
  });
  read.add(walk.later_events);
  return walk;
}

std::string damage_text(const WalkDamage& damage) {
  RecordDamage all;
  all.bytes = damage.bytes;
  all.undecodable = damage.undecodable;
  all.lost_events = damage.lost_events;
  return text_of(all);
}

/// Corners [m] and triangles of each shape.
template <int Dim>
py::list meshes_of(const WorldDescription<Dim>& world) {
  py::list meshes;
  for (const Shape<Dim>& shape : world.shapes) {
    TriangleMesh mesh = triangles_of(polygons_in_space(shape));
    const auto triangles = std::ssize(mesh.indices) / 3;
    meshes.append(py::make_tuple(rows_of(mesh.corners), array_of(std::move(mesh.indices), {triangles, 3})));
  }
  return meshes;
}

template <int Dim>
py::dict as_dict(const Scene<Dim>& scene, const WalkResult& walk, RecordedFrames<Dim> read) {
  const auto frames = static_cast<py::ssize_t>(read.frames);
  const py::ssize_t bodies = read.bodies;
  constexpr py::ssize_t width = pose_values<Dim>;
  std::vector<std::string> names;
  for (const Shape<Dim>& shape : scene.world.shapes) names.push_back(shape.name);
  py::dict record;
  record["dimension"] = Dim;
  record["title"] = scene.title;
  record["backend"] = walk.run.backend;
  record["policy"] = walk.run.policy;
  record["seed"] = scene.seed;
  record["dt"] = scene.world.dt;
  record["version"] = walk.run.version;
  record["reason"] = walk.run.reason;
  record["damage"] = damage_text(walk.damage);
  record["steps"] = array_of(std::move(read.steps));
  record["times"] = array_of(std::move(read.times));
  record["poses"] = array_of(std::move(read.poses), {frames, bodies, width});
  record["asleep"] = array_of(std::move(read.asleep), {frames, bodies}).attr("view")("bool");
  record["shapes"] = array_of(std::move(read.shapes));
  record["shape_names"] = py::tuple(py::cast(names));
  record["meshes"] = py::tuple(meshes_of(scene.world));
  record["events"] = array_of(std::move(read.events));
  record["contacts"] = array_of(std::move(read.contacts));
  return record;
}

py::dict read_recorded(const std::string& path) {
  std::optional<AnyScene> scene;
  {
    const py::gil_scoped_release released;
    scene = scene_of_run(path);
  }
  return std::visit(
      [&]<int Dim>(const Scene<Dim>& of_dimension) {
        RecordedFrames<Dim> read;
        std::optional<WalkResult> walk;
        {
          const py::gil_scoped_release released;
          walk = read_frames(of_dimension, path, read);
        }
        return as_dict(of_dimension, *walk, std::move(read));
      },
      *scene);
}

}  // namespace

void add_records(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(ForceRow<2>, step, a, b, point, normal_force, friction_force, kept);
  PYBIND11_NUMPY_DTYPE(ForceRow<3>, step, a, b, point, normal_force, friction_force, kept);
  module.def("read_record", &read_recorded);
}

}  // namespace talus
