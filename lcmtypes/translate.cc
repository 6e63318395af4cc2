#include "lcmtypes/translate.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <type_traits>

#include "common/math/in_space.h"
#include "common/math/pose_values.h"
#include "common/scene/happened.h"
#include "common/scene/write_scene.h"
#include "common/world/energy.h"

namespace talus {

using talus_lcm::talus_bodies;
using talus_lcm::talus_layer;
using talus_lcm::talus_obstacles;
using talus_lcm::talus_pile;
using talus_lcm::talus_piles;
using talus_lcm::talus_run;
using talus_lcm::talus_sleep;
using talus_lcm::talus_stats;

namespace {

constexpr std::size_t layer_bytes = fixed_bytes(layout<talus_layer>);
constexpr std::size_t pile_bytes = fixed_bytes(layout<talus_pile>);  // without its layers
constexpr std::size_t event_bytes = bytes_per_entry(layout<talus_sleep>, "event_count");

/// Bytes that a message of fixed and counted fields has for the counted ones.
template <class Message>
constexpr std::size_t room = max_message_bytes - fingerprint_bytes - fixed_bytes(layout<Message>);
static_assert(pile_bytes + max_layers * layer_bytes <= room<talus_piles>);

/// Texts come from scene files and error messages; a message must stay small whatever they hold.
std::string clipped(std::string_view text) { return std::string(text.substr(0, 1000)); }

/// Numbers the parts of one frame.
template <class Message>
std::vector<Message> numbered(std::vector<Message> messages) {
  for (std::size_t i = 0; i < messages.size(); ++i) {
    messages[i].part = static_cast<std::int32_t>(i);
    messages[i].parts = static_cast<std::int32_t>(messages.size());
  }
  return messages;
}

talus_layer to_layer(const Layer& layer) {
  talus_layer message{};
  message.bottom = static_cast<float>(layer.bottom);
  message.top = static_cast<float>(layer.top);
  message.radius = static_cast<float>(std::max(0.0, layer.radius));
  message.capacity = static_cast<float>(layer.capacity);
  message.density = static_cast<float>(layer.density());
  message.sleep_density = static_cast<float>(layer.thresholds.sleep);
  message.wake_density = static_cast<float>(layer.thresholds.wake);
  message.count = layer.count;
  message.sleeping = layer.sleeping;
  return message;
}

template <int Dim>
talus_pile to_pile(Pile<Dim> pile, const SleepPolicy<Dim>* policy) {
  if (policy != nullptr) set_thresholds(*policy, pile);
  talus_pile message{};
  const Vec3 centre = in_space(pile.centre);
  std::copy(centre.begin(), centre.end(), message.centre);
  message.alpha = pile.alpha;
  message.structure_size = pile.structure_size;
  message.lift = pile.lift;
  message.height = pile.height;
  message.radius = pile.radius;
  message.occupation_ratio = pile.occupation_ratio();
  message.merged_into = pile.merged_into;
  message.layer_total = static_cast<std::int32_t>(pile.layers.size());
  for (const Layer& layer : std::span(pile.layers).first(std::min(pile.layers.size(), max_layers)))
    message.layers.push_back(to_layer(layer));
  message.layer_count = static_cast<std::int32_t>(message.layers.size());
  return message;
}

}  // namespace

talus_run to_run(const RunInfo& info, std::int8_t phase, std::string_view reason, std::span<const Channel> channels,
                 const MessageEncoder& encoder) {
  talus_run message{};
  message.format = talus_run::FORMAT;
  message.phase = phase;
  message.reason = clipped(reason);
  message.scene = clipped(info.scene);
  message.title = clipped(info.title);
  message.backend = clipped(info.backend);
  message.policy = clipped(info.policy);
  message.version = clipped(info.version);
  message.units = "SI";
  message.seed = static_cast<std::int64_t>(info.seed);
  message.dimension = info.dimension;
  message.dt = info.dt;
  message.steps = info.steps;
  message.tolerance = info.tolerance.value_or(-1.0);
  message.score_threshold = info.score_threshold.value_or(-1.0);
  std::copy(info.gravity.begin(), info.gravity.end(), message.gravity);
  message.ground = info.ground.present ? 1 : 0;
  message.ground_height = info.ground.present ? info.ground.height : 0.0;
  message.ground_friction = info.ground.material.friction;
  message.ground_restitution = info.ground.material.restitution;
  message.velocity_iterations = info.solver.velocity_iterations;
  message.position_iterations = info.solver.position_iterations;
  message.friction_directions = info.solver.friction_directions;
  message.warm_friction = info.solver.warm_friction ? 1 : 0;
  message.restitution_threshold = info.solver.restitution_threshold;
  message.channel_count = static_cast<std::int32_t>(channels.size());
  for (const Channel channel : channels) {
    message.channels.emplace_back(name_of(channel));
    message.sent.push_back(encoder.sent(channel));
  }
  return message;
}

template <int Dim>
std::vector<talus_piles> to_piles(std::span<const Pile<Dim>> piles, const SleepPolicy<Dim>* policy) {
  std::vector<talus_piles> messages(1);
  std::size_t used = 0;
  for (std::size_t i = 0; i < piles.size(); ++i) {
    talus_pile pile = to_pile(piles[i], policy);
    const std::size_t bytes = pile_bytes + pile.layers.size() * layer_bytes;
    if (used + bytes > room<talus_piles>) {
      messages.emplace_back().first_pile = static_cast<std::int32_t>(i);
      used = 0;
    }
    used += bytes;
    messages.back().piles.push_back(std::move(pile));
  }
  for (talus_piles& message : messages) {
    message.pile_total = static_cast<std::int32_t>(piles.size());
    message.pile_count = static_cast<std::int32_t>(message.piles.size());
  }
  return numbered(std::move(messages));
}

std::vector<talus_sleep> to_sleep(std::span<const SleepEvent> events) {
  std::vector<talus_sleep> messages;
  for (; !events.empty(); events = events.subspan(messages.back().event_count)) {
    talus_sleep& message = messages.emplace_back();
    for (const SleepEvent& event : events.first(std::min(events.size(), room<talus_sleep> / event_bytes))) {
      message.body.push_back(event.body);
      message.pile.push_back(event.pile);
      message.layer.push_back(event.layer);
      message.woke.push_back(event.woke ? 1 : 0);
      message.cause.push_back(static_cast<std::int8_t>(event.cause));
      message.score.push_back(static_cast<float>(event.score));
    }
    message.event_count = static_cast<std::int32_t>(message.body.size());
  }
  return numbered(std::move(messages));
}

void set_phase_times(const PhaseTimes& sum, std::int64_t steps, talus_lcm::talus_stats& message) {
  const auto mean = [&](double seconds) { return static_cast<float>(1e3 * seconds / static_cast<double>(steps)); };
  message.ms_emit = mean(sum.emit);
  message.ms_step = mean(sum.step);
  message.ms_collide = mean(sum.collide);
  message.ms_solve = mean(sum.solve);
  message.ms_read = mean(sum.read);
  message.ms_count = mean(sum.count);
  message.ms_decide = mean(sum.decide);
  message.ms_apply = mean(sum.apply);
  message.ms_observe = mean(sum.observe);
}

PhaseTimes phase_times_of(const talus_lcm::talus_stats& message) {
  return {.emit = message.ms_emit,
          .step = message.ms_step,
          .collide = message.ms_collide,
          .solve = message.ms_solve,
          .read = message.ms_read,
          .count = message.ms_count,
          .decide = message.ms_decide,
          .apply = message.ms_apply,
          .observe = message.ms_observe};
}

std::vector<SleepEvent> events_of(const talus_sleep& message) {
  std::vector<SleepEvent> events;
  events.reserve(message.body.size());
  for (std::size_t i = 0; i < message.body.size(); ++i) {
    events.push_back({.step = message.step,
                      .body = message.body[i],
                      .pile = message.pile[i],
                      .layer = message.layer[i],
                      .woke = message.woke[i] != 0,
                      .cause = static_cast<SleepCause>(message.cause[i]),
                      .score = message.score[i]});
  }
  return events;
}

template <int Dim>
talus_stats to_stats(const Frame<Dim>& frame) {
  const BodyStates<Dim>& states = frame.world.states();
  talus_stats message{};
  const auto removed = std::count(states.removed.begin(), states.removed.end(), 1);
  message.awake = static_cast<std::int32_t>(frame.world.awake().size());
  message.asleep = states.size() - message.awake - static_cast<std::int32_t>(removed);
  message.contacts = -1;
  message.kinetic_energy = kinetic_energy(frame.world);
  message.planned = frame.bodies_planned;
  message.appeared = states.size();
  const std::optional<ToldDrift> drift = told_drift(frame);
  message.drift_estimate = drift ? drift->drift : -1.0;
  message.checked_share = drift ? drift->checked_share : 0.0;
  message.overlap = frame.overlap.deepest;
  message.overlap_share = frame.overlap.share;
  message.slope = -1.0;
  for (const Warning& warning : frame.warnings) {
    message.warning_kind.push_back(static_cast<std::int8_t>(warning.kind));
    message.warning_step.push_back(warning.step);
    message.warning_body.push_back(warning.body);
    message.warning_bodies.push_back(warning.bodies);
    message.warning_value.push_back(warning.value);
    message.warning_text.push_back(account(warning));
  }
  message.warning_count = static_cast<std::int32_t>(frame.warnings.size());
  return message;
}

std::optional<double> drift_of(const talus_stats& message) {
  return message.drift_estimate >= 0.0 ? std::optional(message.drift_estimate) : std::nullopt;
}

std::vector<Warning> warnings_of(const talus_stats& message) {
  std::vector<Warning> warnings;
  for (std::size_t i = 0; i < message.warning_kind.size(); ++i) {
    warnings.push_back({.kind = static_cast<WarningKind>(message.warning_kind[i]),
                        .step = message.warning_step[i],
                        .body = message.warning_body[i],
                        .bodies = message.warning_bodies[i],
                        .value = message.warning_value[i]});
  }
  return warnings;
}

template <int Dim>
std::vector<talus_bodies> to_bodies(const BodyStates<Dim>& states, std::span<const BodyIndex> bodies, bool key_frame) {
  constexpr std::span fields = layout<talus_bodies>;
  constexpr std::size_t at_most = room<talus_bodies> / (bytes_per_entry(fields, "body_count") +
                                                        pose_values<Dim> * bytes_per_entry(fields, "value_count"));
  std::vector<talus_bodies> messages;
  do {
    const auto here = bodies.first(std::min(bodies.size(), at_most));
    bodies = bodies.subspan(here.size());
    talus_bodies& message = messages.emplace_back();
    message.key_frame = key_frame ? 1 : 0;
    message.dimension = Dim;
    message.body_count = static_cast<std::int32_t>(here.size());
    message.body.assign(here.begin(), here.end());
    for (const BodyIndex body : here) {
      message.shape.push_back(static_cast<std::int16_t>(states.shape[body]));
      message.asleep.push_back(static_cast<std::int8_t>(states.asleep[body]));
      append_pose<Dim>(states.pose[body], message.poses);
    }
    message.value_count = static_cast<std::int32_t>(message.poses.size());
  } while (!bodies.empty());
  return numbered(std::move(messages));
}

template std::vector<talus_piles> to_piles<2>(std::span<const Pile<2>>, const SleepPolicy<2>*);
template std::vector<talus_piles> to_piles<3>(std::span<const Pile<3>>, const SleepPolicy<3>*);
template talus_stats to_stats<2>(const Frame<2>&);
template talus_stats to_stats<3>(const Frame<3>&);
template std::vector<talus_bodies> to_bodies<2>(const BodyStates<2>&, std::span<const BodyIndex>, bool);
template std::vector<talus_bodies> to_bodies<3>(const BodyStates<3>&, std::span<const BodyIndex>, bool);

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
std::vector<talus_shapes> to_shapes(const WorldDescription<Dim>& world) {
  std::vector<talus_shapes> messages;
  for (std::size_t i = 0; i < world.shapes.size(); ++i)
    messages.push_back(to_message<Dim>(world.shapes[i], i, world.shapes.size()));
  for (std::size_t i = 0; i < world.obstacles.size(); ++i) {
    talus_shapes& message = messages.emplace_back(to_message<Dim>(world.obstacles[i].shape, i, world.obstacles.size()));
    message.obstacle = 1;
    set_pose<Dim>(world.obstacles[i].pose, message);
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

template <int Dim>
std::vector<talus_lcm::talus_scene> to_scene_files(const Scene<Dim>& scene) {
  constexpr std::size_t part_bytes = 48'000;
  std::vector<talus_lcm::talus_scene> messages;
  for (const SceneFile& file : scene_files(scene)) {
    const std::size_t parts = std::max<std::size_t>(1, (file.text.size() + part_bytes - 1) / part_bytes);
    for (std::size_t part = 0; part < parts; ++part) {
      talus_lcm::talus_scene& message = messages.emplace_back();
      message.file = file.name;
      message.part = static_cast<std::int32_t>(part);
      message.parts = static_cast<std::int32_t>(parts);
      message.text = file.text.substr(part * part_bytes, part_bytes);
    }
  }
  return messages;
}
template std::vector<talus_lcm::talus_scene> to_scene_files(const Scene<2>&);
template std::vector<talus_lcm::talus_scene> to_scene_files(const Scene<3>&);

Pile<3> pile_of(const talus_lcm::talus_pile& message) {
  Pile<3> pile;
  pile.centre = {message.centre[0], message.centre[1], message.centre[2]};
  pile.alpha = message.alpha;
  pile.structure_size = message.structure_size;
  pile.lift = message.lift;
  pile.height = message.height;
  pile.radius = message.radius;
  pile.merged_into = message.merged_into;
  for (const talus_lcm::talus_layer& layer : message.layers) {
    pile.layers.push_back({.bottom = layer.bottom,
                           .top = layer.top,
                           .radius = layer.radius,
                           .capacity = layer.capacity,
                           .count = layer.count,
                           .sleeping = layer.sleeping,
                           .thresholds = {.sleep = layer.sleep_density, .wake = layer.wake_density}});
  }
  return pile;
}

template <int Dim>
std::vector<talus_lcm::talus_event> to_events(const Scene<Dim>& scene) {
  std::vector<talus_lcm::talus_event> messages(scene.events.size());
  for (std::size_t i = 0; i < scene.events.size(); ++i) {
    const Event<Dim>& event = scene.events[i];
    talus_lcm::talus_event& message = messages[i];
    message.number = static_cast<std::int32_t>(i);
    message.total = static_cast<std::int32_t>(scene.events.size());
    message.happened_step = -1;
    message.happened_time = -1.0;
    message.action = to_string(event.action);
    message.text = clipped(event_text(scene, message.number));
    const ObstacleName name = event.obstacle ? scene.obstacle_names[*event.obstacle] : ObstacleName();
    const int most = static_cast<int>((max_message_bytes - 3000) / sizeof(std::int32_t));
    for (int k = 0; k < std::min(name.count, most); ++k) message.removed.push_back(name.first + k);
    message.removed_count = static_cast<std::int32_t>(message.removed.size());
  }
  return messages;
}

template <int Dim>
void set_happened(const Frame<Dim>& frame, double dt, talus_lcm::talus_event& message) {
  message.happened_step = frame.step;
  message.happened_time = std::max(0.0, frame.time - dt);
}

template <int Dim>
std::vector<talus_obstacles> to_obstacles(std::span<const ObstaclePose<Dim>> poses) {
  constexpr std::span fields = layout<talus_obstacles>;
  constexpr std::size_t at_most = room<talus_obstacles> / (bytes_per_entry(fields, "obstacle_count") +
                                                           pose_values<Dim> * bytes_per_entry(fields, "value_count"));
  std::vector<talus_obstacles> messages;
  for (; !poses.empty(); poses = poses.subspan(messages.back().obstacle.size())) {
    talus_obstacles& message = messages.emplace_back();
    message.dimension = Dim;
    for (const ObstaclePose<Dim>& each : poses.first(std::min(poses.size(), at_most))) {
      message.obstacle.push_back(each.obstacle);
      append_pose<Dim>(each.pose, message.poses);
    }
    message.obstacle_count = static_cast<std::int32_t>(message.obstacle.size());
    message.value_count = static_cast<std::int32_t>(message.poses.size());
  }
  return messages;
}

template std::vector<talus_obstacles> to_obstacles<2>(std::span<const ObstaclePose<2>>);
template std::vector<talus_obstacles> to_obstacles<3>(std::span<const ObstaclePose<3>>);
template std::vector<talus_lcm::talus_event> to_events(const Scene<2>&);
template std::vector<talus_lcm::talus_event> to_events(const Scene<3>&);
template void set_happened(const Frame<2>&, double, talus_lcm::talus_event&);
template void set_happened(const Frame<3>&, double, talus_lcm::talus_event&);
template void set_pose(const Pose<2>&, talus_shapes&);
template void set_pose(const Pose<3>&, talus_shapes&);
template Shape<2> to_shape<2>(const talus_shapes&);
template Shape<3> to_shape<3>(const talus_shapes&);
template Pose<2> pose_of<2>(const talus_shapes&);
template Pose<3> pose_of<3>(const talus_shapes&);
template std::vector<talus_shapes> to_shapes<2>(const WorldDescription<2>&);
template std::vector<talus_shapes> to_shapes<3>(const WorldDescription<3>&);

}  // namespace talus
