#include <algorithm>

#include "tools/export/exporter.h"
#include "tools/export/npz_file.h"
#include "tools/export/solid.h"

namespace talus {
namespace {

class NpzExport final : public Exporter {
 public:
  explicit NpzExport(const ExportInput& input)
      : bodies_(input.bodies), axes_(input.dimension), nowhere_(input.dimension), file_(input.file) {
    const auto frames = static_cast<std::uint64_t>(input.frames);
    const auto bodies = static_cast<std::uint64_t>(input.bodies);
    const auto events = static_cast<std::uint64_t>(input.events);
    const auto contacts = static_cast<std::uint64_t>(input.contacts);
    step_ = file_.declare("step", "<i8", {frames});
    time_ = file_.declare("time", "<f8", {frames});
    position_ = file_.declare("position", "<f4", {frames, bodies, axes_});
    rotation_ = file_.declare("rotation", "<f4", {frames, bodies, axes_ == 2 ? 1U : 4U});
    present_ = file_.declare("present", "|b1", {frames, bodies});
    asleep_ = file_.declare("asleep", "|b1", {frames, bodies});
    cause_ = file_.declare("cause", "|i1", {frames, bodies});
    event_step_ = file_.declare("event_step", "<i8", {events});
    event_body_ = file_.declare("event_body", "<i4", {events});
    event_woke_ = file_.declare("event_woke", "|b1", {events});
    event_cause_ = file_.declare("event_cause", "|i1", {events});
    event_layer_ = file_.declare("event_layer", "<i4", {events});
    event_score_ = file_.declare("event_score", "<f4", {events});
    contact_step_ = file_.declare("contact_step", "<i8", {contacts});
    contact_body_ = file_.declare("contact_body", "<i4", {contacts, 2});
    contact_point_ = file_.declare("contact_point", "<f4", {contacts, axes_});
    contact_normal_force_ = file_.declare("contact_normal_force", "<f4", {contacts, axes_});
    contact_friction_force_ = file_.declare("contact_friction_force", "<f4", {contacts, axes_});
    contact_kept_ = file_.declare("contact_kept", "|b1", {contacts});
    shape_ = file_.declare("shape", "<i4", {bodies});
    nowhere_.resize(1);
    declare_names(input.shapes);
    declare_meshes(input.shapes);
  }

  void add(const Moment& moment, std::span<const SleepEvent> events) override {
    put<std::int64_t>(step_, moment.step);
    put<double>(time_, moment.time);
    std::string position;
    std::string rotation;
    std::string present;
    std::string asleep;
    std::string cause;
    const MomentBodies& bodies = moment.bodies;
    shapes_.resize(bodies_, -1);
    for (BodyIndex body = 0; body < bodies_; ++body) {
      const bool shown = body < bodies.size() && bodies.shows(body);
      append_pose(shown ? bodies.pose[body] : nowhere_[0], position, rotation);
      present += shown ? '\1' : '\0';
      asleep += shown && bodies.asleep[body] != 0 ? '\1' : '\0';
      cause += static_cast<char>(shown ? bodies.cause[body] : -1);
      if (shown) shapes_[body] = bodies.shape[body];
    }
    file_.append(position_, position);
    file_.append(rotation_, rotation);
    file_.append(present_, present);
    file_.append(asleep_, asleep);
    file_.append(cause_, cause);
    for (const SleepEvent& event : events) add(event);
    for (const ContactForce<3>& contact : moment.contacts) add(moment.step, contact);
  }

  void finish(std::span<const SleepEvent> later_events) override {
    for (const SleepEvent& event : later_events) add(event);
    for (const std::int32_t shape : shapes_) put(shape_, shape);
    file_.finish();
  }

 private:
  template <class Number>
  void put(int array, Number number) {
    std::string bytes;
    append_bytes(bytes, number);
    file_.append(array, bytes);
  }

  void append_pose(std::span<const float> pose, std::string& position, std::string& rotation) const {
    for (const float value : pose.first(axes_)) append_bytes(position, value);
    for (const float value : pose.subspan(axes_)) append_bytes(rotation, value);
  }

  void add(const SleepEvent& event) {
    put<std::int64_t>(event_step_, event.step);
    put<std::int32_t>(event_body_, event.body);
    put<std::int8_t>(event_woke_, event.woke ? 1 : 0);
    put(event_cause_, static_cast<std::int8_t>(event.cause));
    put<std::int32_t>(event_layer_, event.layer);
    put(event_score_, static_cast<float>(event.score));
  }

  void add(std::int64_t step, const ContactForce<3>& contact) {
    put(contact_step_, step);
    put<std::int32_t>(contact_body_, contact.a);
    put<std::int32_t>(contact_body_, contact.b);
    put_vector(contact_point_, contact.point);
    put_vector(contact_normal_force_, contact.normal_force);
    put_vector(contact_friction_force_, contact.friction_force);
    put<std::int8_t>(contact_kept_, contact.kept ? 1 : 0);
  }

  /// In 2D without y.
  void put_vector(int array, const Vec3& vector) {
    for (int axis = 0; axis < 3; ++axis)
      if (axes_ == 3 || axis != 1) put(array, static_cast<float>(vector[axis]));
  }

  /// Texts of equal length, filled with zeros.
  void declare_names(std::string_view array, const std::vector<std::string>& names) {
    std::size_t length = 1;
    for (const std::string& name : names) length = std::max(length, name.size());
    std::string bytes;
    for (const std::string& name : names) bytes += name + std::string(length - name.size(), '\0');
    const int number = file_.declare(array, "|S" + std::to_string(length), {names.size()});
    file_.append(number, bytes);
  }

  void declare_names(const std::vector<ExportShape>& shapes) {
    std::vector<std::string> names;
    for (const ExportShape& shape : shapes) names.push_back(shape.name);
    declare_names("shape_name", names);
    declare_names("cause_name", cause_names());
  }

  /// The surfaces of all shapes as triangles.
  void declare_meshes(const std::vector<ExportShape>& shapes) {
    std::string vertices;
    std::string triangles;
    std::string owners;
    std::uint64_t vertex_count = 0;
    std::uint64_t triangle_count = 0;
    for (std::size_t shape = 0; shape < shapes.size(); ++shape) {
      const TriangleMesh mesh = triangles_of(shapes[shape].polygons);
      for (const Vec3& corner : mesh.corners)
        for (int axis = 0; axis < 3; ++axis) append_bytes(vertices, static_cast<float>(corner[axis]));
      for (const int index : mesh.indices) append_bytes(triangles, static_cast<std::int32_t>(vertex_count + index));
      for (std::size_t i = 0; i < mesh.indices.size(); i += 3) append_bytes(owners, static_cast<std::int32_t>(shape));
      vertex_count += mesh.corners.size();
      triangle_count += mesh.indices.size() / 3;
    }
    file_.append(file_.declare("mesh_vertex", "<f4", {vertex_count, 3}), vertices);
    file_.append(file_.declare("mesh_triangle", "<i4", {triangle_count, 3}), triangles);
    file_.append(file_.declare("mesh_shape", "<i4", {triangle_count}), owners);
  }

  BodyIndex bodies_;
  std::size_t axes_;
  PoseList nowhere_;  // one pose, of bodies that are not there
  NpzFile file_;
  std::vector<std::int32_t> shapes_;
  int step_, time_, position_, rotation_, present_, asleep_, cause_, shape_;
  int event_step_, event_body_, event_woke_, event_cause_, event_layer_, event_score_;
  int contact_step_, contact_body_, contact_point_, contact_normal_force_, contact_friction_force_, contact_kept_;
};

}  // namespace

std::unique_ptr<Exporter> make_npz_export(const ExportInput& input) { return std::make_unique<NpzExport>(input); }

}  // namespace talus
