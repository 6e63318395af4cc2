#include <fmt/core.h>

#include <stdexcept>
#include <type_traits>

#include "lcmtypes/translate.h"

namespace talus {

using talus_lcm::talus_shapes_v1;

namespace {

template <int Dim>
void append(const Vec<Dim>& point, std::vector<double>& values) {
  values.insert(values.end(), point.begin(), point.end());
}

template <int Dim>
void append(const Pose<Dim>& pose, std::vector<double>& values) {
  append<Dim>(pose.position, values);
  if constexpr (Dim == 2) {
    values.push_back(pose.rotation.angle());
  } else {
    values.insert(values.end(), {pose.rotation.w(), pose.rotation.x(), pose.rotation.y(), pose.rotation.z()});
  }
}

template <int Dim>
std::int8_t append(const BoxPiece<Dim>& box, std::vector<double>& values) {
  append<Dim>(box.pose, values);
  append<Dim>(box.half, values);
  return talus_shapes_v1::BOX;
}

template <int Dim>
std::int8_t append(const HullPiece<Dim>& hull, std::vector<double>& values) {
  for (const Vec<Dim>& corner : hull.corners) {
    append<Dim>(corner, values);
  }
  if (!hull.round()) return talus_shapes_v1::HULL;
  values.push_back(hull.radius);
  return hull.corners.size() == 1 ? talus_shapes_v1::BALL : talus_shapes_v1::CAPSULE;
}

template <int Dim>
talus_shapes_v1 to_message(const Shape<Dim>& shape, std::size_t index, std::size_t total) {
  talus_shapes_v1 message{};
  message.index = static_cast<std::int32_t>(index);
  message.total = static_cast<std::int32_t>(total);
  message.name = shape.name.substr(0, 1000);
  message.dimension = Dim;
  message.density = shape.material.density;
  message.friction = shape.material.friction;
  message.restitution = shape.material.restitution;
  for (const Piece<Dim>& piece : shape.pieces) {
    const std::size_t before = message.values.size();
    message.kind.push_back(std::visit([&](const auto& p) { return append<Dim>(p, message.values); }, piece));
    message.length.push_back(static_cast<std::int32_t>(message.values.size() - before));
  }
  message.piece_count = static_cast<std::int32_t>(message.kind.size());
  message.value_count = static_cast<std::int32_t>(message.values.size());
  constexpr std::span fields = layout<talus_shapes_v1>;
  constexpr std::size_t fixed = 1200;  // all fields of one size, and the name
  constexpr std::size_t piece_bytes = bytes_per_entry(fields, "piece_count");
  constexpr std::size_t value_bytes = bytes_per_entry(fields, "value_count");
  const std::size_t bytes = message.values.size() * value_bytes + message.kind.size() * piece_bytes;
  if (bytes > max_message_bytes - fixed) {
    throw std::invalid_argument(fmt::format(
        "shape \"{}\": its {} pieces have {} numbers; rule: at most {} bytes of "
        "these ({} a number, {} a piece), what one telemetry message holds",
        message.name, message.kind.size(), message.values.size(), max_message_bytes - fixed, value_bytes, piece_bytes));
  }
  return message;
}

}  // namespace

template <int Dim>
std::vector<talus_shapes_v1> to_shapes(const WorldDescription<Dim>& world) {
  std::vector<talus_shapes_v1> messages;
  for (std::size_t i = 0; i < world.shapes.size(); ++i) {
    messages.push_back(to_message<Dim>(world.shapes[i], i, world.shapes.size()));
  }
  for (std::size_t i = 0; i < world.obstacles.size(); ++i) {
    talus_shapes_v1& message =
        messages.emplace_back(to_message<Dim>(world.obstacles[i].shape, i, world.obstacles.size()));
    message.obstacle = 1;
    std::vector<double> pose;
    append<Dim>(world.obstacles[i].pose, pose);
    std::copy(pose.begin(), pose.end(), message.pose);
  }
  return messages;
}

template std::vector<talus_shapes_v1> to_shapes<2>(const WorldDescription<2>&);
template std::vector<talus_shapes_v1> to_shapes<3>(const WorldDescription<3>&);

}  // namespace talus
