#include "lcmtypes/shapes_message.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "common/math/pose_values.h"
#include "lcmtypes/message.h"

namespace talus {

using talus_lcm::talus_shapes;

namespace {

template <int Dim>
void append(const Vec<Dim>& point, std::vector<double>& values) {
  values.insert(values.end(), point.begin(), point.end());
}

template <int Dim>
std::int8_t append(const BoxPiece<Dim>& box, std::vector<double>& values) {
  append_pose<Dim>(box.pose, values);
  append<Dim>(box.half, values);
  return talus_shapes::BOX;
}

template <int Dim>
std::int8_t append(const HullPiece<Dim>& hull, std::vector<double>& values) {
  for (const Vec<Dim>& corner : hull.corners) append<Dim>(corner, values);
  if (!hull.round()) return talus_shapes::HULL;
  values.push_back(hull.radius);
  return hull.corners.size() == 1 ? talus_shapes::BALL : talus_shapes::CAPSULE;
}

// Of a symmetric matrix: where its six numbers stand.
constexpr std::array<std::array<int, 2>, 6> inertia_places = {{{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};

template <int Dim>
void put_inertia(const Inertia<Dim>& inertia, talus_shapes& message) {
  if constexpr (Dim == 2)
    message.inertia[0] = inertia(0);
  else
    for (std::size_t i = 0; i < inertia_places.size(); ++i)
      message.inertia[i] = inertia(inertia_places[i][0], inertia_places[i][1]);
}

template <int Dim>
Inertia<Dim> inertia_of(const talus_shapes& message) {
  Inertia<Dim> inertia = Inertia<Dim>::Zero();
  if constexpr (Dim == 2)
    inertia(0) = message.inertia[0];
  else
    for (std::size_t i = 0; i < inertia_places.size(); ++i)
      inertia(inertia_places[i][0], inertia_places[i][1]) = inertia(inertia_places[i][1], inertia_places[i][0]) =
          message.inertia[i];
  return inertia;
}

template <int Dim>
talus_shapes to_message(const Shape<Dim>& shape, std::size_t index, std::size_t total) {
  talus_shapes message{};
  message.index = static_cast<std::int32_t>(index);
  message.total = static_cast<std::int32_t>(total);
  message.name = shape.name.substr(0, 1000);
  message.dimension = Dim;
  message.density = shape.material.density;
  message.friction = shape.material.friction;
  message.restitution = shape.material.restitution;
  message.rolling_friction = shape.material.rolling_friction;
  message.volume = shape.volume;
  put_inertia<Dim>(shape.inertia, message);
  message.colour = clipped(shape.colour);
  for (const Piece<Dim>& piece : shape.pieces) {
    const std::size_t before = message.values.size();
    message.kind.push_back(std::visit([&](const auto& p) { return append<Dim>(p, message.values); }, piece));
    message.length.push_back(static_cast<std::int32_t>(message.values.size() - before));
  }
  message.piece_count = static_cast<std::int32_t>(message.kind.size());
  message.value_count = static_cast<std::int32_t>(message.values.size());
  constexpr std::span fields = layout<talus_shapes>;
  constexpr std::size_t fixed = 1400;  // all fields of one size, and the name
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
std::vector<talus_shapes> to_shapes(std::span<const Shape<Dim>> shapes, std::span<const Obstacle<Dim>> obstacles) {
  std::vector<talus_shapes> messages;
  for (std::size_t i = 0; i < shapes.size(); ++i) messages.push_back(to_message<Dim>(shapes[i], i, shapes.size()));
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    talus_shapes& message = messages.emplace_back(to_message<Dim>(obstacles[i].shape, i, obstacles.size()));
    message.obstacle = 1;
    set_pose<Dim>(obstacles[i].pose, message);
  }
  return messages;
}

template <int Dim>
void set_pose(const Pose<Dim>& pose, talus_shapes& message) {
  std::vector<double> values;
  append_pose<Dim>(pose, values);
  std::copy(values.begin(), values.end(), message.pose);
}

namespace {

/// Takes values one after the other.
template <int Dim>
class ValueReader {
 public:
  explicit ValueReader(std::span<const double> values) : rest_(values) {}

  double number() {
    const double value = rest_.front();
    rest_ = rest_.subspan(1);
    return value;
  }
  Vec<Dim> point() {
    Vec<Dim> point;
    for (int axis = 0; axis < Dim; ++axis) point[axis] = number();
    return point;
  }
  Pose<Dim> pose() {
    Pose<Dim> pose = pose_from<Dim>(rest_);
    rest_ = rest_.subspan(pose_values<Dim>);
    return pose;
  }
  Piece<Dim> piece(std::int8_t kind) {
    if (kind == talus_shapes::BOX) {
      const Pose<Dim> at = pose();
      return BoxPiece<Dim>{at, point()};
    }
    HullPiece<Dim> hull;
    while (rest_.size() >= Dim) hull.corners.push_back(point());
    if (!rest_.empty()) hull.radius = number();
    return hull;
  }

 private:
  std::span<const double> rest_;
};

}  // namespace

template <int Dim>
Shape<Dim> to_shape(const talus_shapes& message) {
  std::vector<Piece<Dim>> pieces;
  std::span<const double> values = message.values;
  for (std::size_t i = 0; i < message.kind.size(); ++i) {
    pieces.push_back(ValueReader<Dim>(values.first(message.length[i])).piece(message.kind[i]));
    values = values.subspan(message.length[i]);
  }
  for (const Piece<Dim>& piece : pieces) (void)mass_properties<Dim>(piece);  // throws on one without a volume
  const MassProperties<Dim> masses = {.volume = message.volume, .inertia = inertia_of<Dim>(message) / message.density};
  Shape<Dim> shape = make_shape<Dim>(message.name, std::move(pieces),
                                     {.density = message.density,
                                      .friction = message.friction,
                                      .restitution = message.restitution,
                                      .rolling_friction = message.rolling_friction},
                                     masses);
  shape.inertia = inertia_of<Dim>(message);  // above rounded twice
  shape.colour = message.colour;
  return shape;
}

template <int Dim>
Pose<Dim> pose_of(const talus_shapes& message) {
  return pose_from<Dim>(std::span<const double>(message.pose));
}

template std::vector<talus_shapes> to_shapes<2>(std::span<const Shape<2>>, std::span<const Obstacle<2>>);
template std::vector<talus_shapes> to_shapes<3>(std::span<const Shape<3>>, std::span<const Obstacle<3>>);
template void set_pose(const Pose<2>&, talus_shapes&);
template void set_pose(const Pose<3>&, talus_shapes&);
template Shape<2> to_shape<2>(const talus_shapes&);
template Shape<3> to_shape<3>(const talus_shapes&);
template Pose<2> pose_of<2>(const talus_shapes&);
template Pose<3> pose_of<3>(const talus_shapes&);

namespace {

/// Values of one piece: exactly so many, or for a hull a whole number of corners.
bool piece_length_holds(int kind, int length, int dimension) {
  const int turn = dimension == 2 ? 1 : 4;
  switch (kind) {
    case talus_shapes::BOX:
      return length == 2 * dimension + turn;
    case talus_shapes::BALL:
      return length == dimension + 1;
    case talus_shapes::CAPSULE:
      return length == 2 * dimension + 1;
    case talus_shapes::HULL:
      return length > dimension * dimension && length % dimension == 0;
    default:
      return false;
  }
}

/// "#rrggbb" or empty.
bool colour_holds(std::string_view colour) {
  constexpr std::string_view digits = "0123456789abcdefABCDEF";
  return colour.empty() ||
         (colour.size() == 7 && colour[0] == '#' && colour.find_first_not_of(digits, 1) == std::string_view::npos);
}

}  // namespace

std::string_view range_fault(const talus_shapes& m) {
  if (!header_holds(m) || m.index < 0 || m.index >= m.total) return "header out of range";
  if (m.dimension != 2 && m.dimension != 3) return "dimension is neither 2 nor 3";
  if (m.density < 0 || m.friction < 0 || m.restitution < 0 || m.rolling_friction < 0) return "bad material";
  if (m.volume < 0) return "negative volume";
  if (!colour_holds(m.colour)) return "bad colour";
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < m.kind.size(); ++i) {
    if (!piece_length_holds(m.kind[i], m.length[i], m.dimension)) return "piece of a wrong length";
    sum += m.length[i];
  }
  if (sum != m.value_count) return "values do not match pieces";
  return {};
}

}  // namespace talus
