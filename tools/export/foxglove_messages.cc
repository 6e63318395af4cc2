#include "tools/export/foxglove_messages.h"

#include <array>
#include <cmath>
#include <map>

namespace talus {
namespace {

constexpr std::string_view time_type = "google.protobuf.Timestamp";

ProtoField text_field(std::string_view name, int number) { return {name, number, ProtoType::text}; }
ProtoField time_field() { return {"timestamp", 1, ProtoType::message, false, time_type}; }
ProtoField one_of(std::string_view name, int number, std::string_view of) {
  return {name, number, ProtoType::message, false, of};
}
ProtoField list_of(std::string_view name, int number, std::string_view of) {
  return {name, number, ProtoType::message, true, of};
}

// Fields of Foxglove's types that are never written are left out.

std::vector<ProtoSchema> schemas_of_places() {
  return {
      {time_type, {{"seconds", 1, ProtoType::int64}, {"nanos", 2, ProtoType::int32}}},
      {"foxglove.Vector3", {{"x", 1}, {"y", 2}, {"z", 3}}},
      {"foxglove.Point3", {{"x", 1}, {"y", 2}, {"z", 3}}},
      {"foxglove.Quaternion", {{"x", 1}, {"y", 2}, {"z", 3}, {"w", 4}}},
      {"foxglove.Pose", {one_of("position", 1, "foxglove.Vector3"), one_of("orientation", 2, "foxglove.Quaternion")}},
      {"foxglove.Color", {{"r", 1}, {"g", 2}, {"b", 3}, {"a", 4}}},
      {"foxglove.FrameTransform",
       {time_field(), text_field("parent_frame_id", 2), text_field("child_frame_id", 3),
        one_of("translation", 4, "foxglove.Vector3"), one_of("rotation", 5, "foxglove.Quaternion")}},
      {"foxglove.FrameTransforms", {list_of("transforms", 1, "foxglove.FrameTransform")}},
  };
}

std::vector<ProtoSchema> schemas_of_scenes() {
  const ProtoField pose = one_of("pose", 1, "foxglove.Pose");
  return {
      {"foxglove.CubePrimitive", {pose, one_of("size", 2, "foxglove.Vector3"), one_of("color", 3, "foxglove.Color")}},
      {"foxglove.CylinderPrimitive",
       {pose,
        one_of("size", 2, "foxglove.Vector3"),
        {"bottom_scale", 3},
        {"top_scale", 4},
        one_of("color", 5, "foxglove.Color")}},
      {"foxglove.TriangleListPrimitive",
       {pose,
        list_of("points", 2, "foxglove.Point3"),
        one_of("color", 3, "foxglove.Color"),
        {"indices", 5, ProtoType::fixed32, true}}},
      {"foxglove.SceneEntity",
       {time_field(),
        text_field("frame_id", 2),
        text_field("id", 3),
        {"frame_locked", 5, ProtoType::boolean},
        list_of("cubes", ScenePrimitive::cube, "foxglove.CubePrimitive"),
        list_of("cylinders", ScenePrimitive::cylinder, "foxglove.CylinderPrimitive"),
        list_of("triangles", ScenePrimitive::triangles, "foxglove.TriangleListPrimitive")}},
      {"foxglove.SceneEntityDeletion", {time_field(), text_field("id", 3)}},
      {"foxglove.SceneUpdate",
       {list_of("deletions", 1, "foxglove.SceneEntityDeletion"), list_of("entities", 2, "foxglove.SceneEntity")}},
      {"foxglove.LogLevel", {}, {"UNKNOWN", "DEBUG", "INFO", "WARNING", "ERROR", "FATAL"}},
      {"foxglove.Log",
       {time_field(),
        {"level", 2, ProtoType::enumeration, false, "foxglove.LogLevel"},
        text_field("message", 3),
        text_field("name", 4)}},
  };
}

/// Of the messages that mcap_export.cc makes.
std::vector<ProtoSchema> schemas_of_talus() {
  return {
      {"talus.Counts",
       {time_field(),
        {"awake", 2, ProtoType::int32},
        {"asleep", 3, ProtoType::int32},
        {"slept", 4, ProtoType::int32},
        {"woken", 5, ProtoType::int32},
        {"kinetic_energy_J", 6},
        {"drift_estimate_D", 7},
        {"densities", 8, ProtoType::number, true}}},
      {"talus.SleepEvent",
       {{"step", 1, ProtoType::int64},
        {"body", 2, ProtoType::int32},
        {"woke", 3, ProtoType::boolean},
        text_field("cause", 4),
        {"score", 5},
        {"pile", 6, ProtoType::int32},
        {"layer", 7, ProtoType::int32}}},
      {"talus.SleepEvents", {time_field(), list_of("events", 2, "talus.SleepEvent")}},
  };
}

ProtoMessage vector_message(const Vec3& vector) {
  ProtoMessage message;
  for (int axis = 0; axis < 3; ++axis) message.add(axis + 1, vector[axis]);
  return message;
}

ProtoMessage quaternion_message(const Rotation<3>& rotation) {
  ProtoMessage message;
  int field = 0;
  for (const double part : {rotation.x(), rotation.y(), rotation.z(), rotation.w()}) message.add(++field, part);
  return message;
}

}  // namespace

std::string foxglove_descriptors() {
  std::vector<ProtoSchema> schemas = schemas_of_places();
  for (const std::vector<ProtoSchema>& more : {schemas_of_scenes(), schemas_of_talus()})
    schemas.insert(schemas.end(), more.begin(), more.end());
  return descriptor_set(schemas);
}

ProtoMessage timestamp_message(double seconds) {
  constexpr std::int64_t per_second = 1'000'000'000;
  const std::int64_t nanoseconds = std::llround(seconds * per_second);
  ProtoMessage message;
  message.add_integer(1, nanoseconds / per_second);
  message.add_integer(2, nanoseconds % per_second);
  return message;
}

ProtoMessage pose_message(const Pose<3>& pose) {
  ProtoMessage message;
  message.add(1, vector_message(pose.position));
  message.add(2, quaternion_message(pose.rotation));
  return message;
}

ProtoMessage colour_message(const Colour& colour, double opacity) {
  ProtoMessage message;
  int field = 0;
  for (const double part : {colour.red, colour.green, colour.blue, opacity}) message.add(++field, part);
  return message;
}

ProtoMessage frame_transform(double seconds, const std::string& child, const Pose<3>& pose) {
  ProtoMessage message;
  message.add(1, timestamp_message(seconds));
  message.add(2, "world");
  message.add(3, child);
  message.add(4, vector_message(pose.position));
  message.add(5, quaternion_message(pose.rotation));
  return message;
}

ProtoMessage triangles_message(const TriangleMesh& mesh, const Pose<3>& pose, const Colour& colour) {
  ProtoMessage message;
  message.add(1, pose_message(pose));
  std::map<std::array<double, 3>, std::uint32_t> numbers;
  std::vector<std::uint32_t> indices;
  for (const int index : mesh.indices) {
    const Vec3& corner = mesh.corners[index];
    const auto next = static_cast<std::uint32_t>(numbers.size());
    const auto [at, added] = numbers.try_emplace({corner.x(), corner.y(), corner.z()}, next);
    if (added) message.add(2, vector_message(corner));
    indices.push_back(at->second);
  }
  message.add(3, colour_message(colour));
  message.add_packed(5, indices);
  return message;
}

ScenePrimitive block_message(bool round, const Vec3& centre, const Vec3& size, const Colour& colour, double opacity) {
  ScenePrimitive primitive{round ? ScenePrimitive::cylinder : ScenePrimitive::cube, {}};
  primitive.message.add(1, pose_message({centre, Rotation<3>::Identity()}));
  primitive.message.add(2, vector_message(size));
  if (round)
    for (const int scale : {3, 4}) primitive.message.add(scale, 1.0);
  primitive.message.add(round ? 5 : 3, colour_message(colour, opacity));
  return primitive;
}

ProtoMessage scene_entity(double seconds, const std::string& frame, const std::string& id,
                          std::span<const ScenePrimitive> primitives) {
  ProtoMessage message;
  message.add(1, timestamp_message(seconds));
  message.add(2, frame);
  message.add(3, id);
  message.add_integer(5, 1);
  for (const ScenePrimitive& primitive : primitives) message.add(primitive.field, primitive.message);
  return message;
}

ProtoMessage warning_message(double seconds, std::string_view name, std::string_view text) {
  constexpr int warning = 3;
  ProtoMessage message;
  message.add(1, timestamp_message(seconds));
  message.add_integer(2, warning);
  message.add(3, text);
  message.add(4, name);
  return message;
}

}  // namespace talus
