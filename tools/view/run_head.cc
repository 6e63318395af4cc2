#include "tools/view/run_head.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "common/policy/sleep_event.h"
#include "common/scene/happened.h"
#include "common/shape/surface.h"
#include "tools/picture/body_colours.h"

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

constexpr int many_bodies = 1500;  // of which round shapes get fewer faces

/// Rounded to a number of few digits.
double few_digits(double value) {
  constexpr double resolution = 1e-5;  // [m]
  return std::round(value / resolution) * resolution;
}

template <int Dim>
Json json_of(const Vec<Dim>& point) {
  Json json = Json::array();
  for (int axis = 0; axis < Dim; ++axis) json.push_back(few_digits(point[axis]));
  return json;
}

Json json_of(const Colour& colour) { return Json::array({colour.red, colour.green, colour.blue}); }

template <int Dim>
Json json_of(const Pose<Dim>& pose) {
  Json json = Json::array();
  for (int axis = 0; axis < Dim; ++axis) json.push_back(pose.position[axis]);
  if constexpr (Dim == 2) {
    json.push_back(pose.rotation.angle());
  } else {
    const Rotation<3>& q = pose.rotation;
    for (const double part : {q.w(), q.x(), q.y(), q.z()}) json.push_back(part);
  }
  return json;
}

std::vector<Loop<2>> loops_of(const Shape<2>& shape, int segments) { return outlines(shape, segments); }
std::vector<Loop<3>> loops_of(const Shape<3>& shape, int segments) { return faces(shape, segments); }

/// The polygons of each piece, and of a round piece the ends of the line that it is round about.
template <int Dim>
Json pieces_of(const Shape<Dim>& shape, int segments) {
  Json pieces = Json::array();
  for (const Piece<Dim>& piece : shape.pieces) {
    Shape<Dim> alone;
    alone.pieces.push_back(piece);
    Json loops = Json::array();
    for (const Loop<Dim>& loop : loops_of(alone, segments)) {
      Json corners = Json::array();
      for (const Vec<Dim>& corner : loop) corners.push_back(json_of<Dim>(corner));
      loops.push_back(corners);
    }
    Json json = {{"loops", loops}};
    if (const HullPiece<Dim> hull = as_hull(piece); hull.round())
      json["core"] = {json_of<Dim>(hull.corners.front()), json_of<Dim>(hull.corners.back())};
    pieces.push_back(json);
  }
  return pieces;
}

template <int Dim>
Json shapes_of(const Scene<Dim>& scene) {
  const PictureParams params;
  Json shapes = Json::array();
  for (const Shape<Dim>& shape : scene.world.shapes) {
    const auto number = static_cast<int>(shapes.size());
    shapes.push_back({{"name", shape.name},
                      {"awake", json_of(body_paint(params, number, shape.colour, false).fill)},
                      {"asleep", json_of(body_paint(params, number, shape.colour, true).fill)},
                      {"mass", shape.mass},
                      {"extent", shape.extent},
                      {"pieces", pieces_of(shape, scene.bodies_planned() > many_bodies ? 12 : 24)}});
  }
  return shapes;
}

/// Legend of the shapes with colours of their own.
template <int Dim>
Json coloured_shapes_of(const Scene<Dim>& scene) {
  Json legend = Json::array();
  for (const LegendEntry& entry : legend_of_shapes<Dim>(scene.world.shapes))
    legend.push_back({{"name", entry.text}, {"colour", json_of(entry.fill)}});
  return legend;
}

template <int Dim>
Json obstacles_of(const Scene<Dim>& scene) {
  Json obstacles = Json::array();
  for (const Obstacle<Dim>& obstacle : scene.world.obstacles)
    obstacles.push_back(
        {{"name", obstacle.shape.name}, {"pose", json_of(obstacle.pose)}, {"pieces", pieces_of(obstacle.shape, 48)}});
  return obstacles;
}

/// Names and meanings by the number of the cause; null where no cause has it.
Json causes() {
  struct Meaning {
    SleepCause cause;
    const char* slept;
    const char* woke;
  };
  constexpr auto meanings = std::to_array<Meaning>({
      {SleepCause::score, "its score of density, depth and speed is above the threshold", ""},
      {SleepCause::rest, "it was at rest for long enough, and supported", ""},
      {SleepCause::avalanche, "", "its pile has an overfull layer, or its part of the heap is too steep"},
      {SleepCause::momentum, "", "an impact on it or on its pile"},
      {SleepCause::lost_support, "", "its support moved away"},
      {SleepCause::engine, "the engine's own rule", "the engine's own rule"},
      {SleepCause::user, "by hand", "by hand, or a body near it was removed"},
      {SleepCause::check, "the check of its region ended", "its region is checked for stability"},
  });
  Json list = Json::array();
  for (const Meaning& each : meanings) {
    const auto number = static_cast<std::size_t>(each.cause);
    while (list.size() <= number) list.push_back(nullptr);
    list[number] = {{"name", to_string(each.cause)}, {"slept", each.slept}, {"woke", each.woke}};
  }
  return list;
}

/// Texts of the scene's events, and the obstacles that they remove.
template <int Dim>
Json events_of(const Scene<Dim>& scene) {
  Json events = Json::array();
  for (const Event<Dim>& event : scene.events) {
    Json removed = Json::array();
    const ObstacleName name = event.obstacle ? scene.obstacle_names[*event.obstacle] : ObstacleName();
    for (int k = name.first; k < name.first + name.count; ++k) removed.push_back(k);
    events.push_back({{"text", event_text(scene, static_cast<int>(events.size()))}, {"removes", removed}});
  }
  return events;
}

Json colours() {
  const PictureParams params;
  Json awake = Json::array();
  for (const Colour& colour : params.awake) awake.push_back(json_of(colour));
  return {{"paper", json_of(params.paper)},
          {"text", json_of(params.text)},
          {"quiet_text", json_of(params.quiet_text)},
          {"asleep", json_of(params.asleep)},
          {"asleep_outline", json_of(params.asleep_outline)},
          {"awake", awake},
          {"awake_outline", json_of(params.awake_outline)},
          {"layer", json_of(params.layer)},
          {"obstacle", json_of(params.obstacle)},
          {"obstacle_outline", json_of(params.obstacle_outline)},
          {"ground", json_of(params.ground)}};
}

}  // namespace

template <int Dim>
Json run_head(const Scene<Dim>& scene, const RunTexts& texts, const Quantum& quantum, const Box<Dim>& box) {
  const PictureParams picture;
  return {{"title", scene.title},
          {"name", texts.name},
          {"backend", texts.backend},
          {"policy", texts.policy},
          {"version", texts.version},
          {"seed", texts.seed},
          {"reason", texts.reason},
          {"damage", texts.damage},
          {"dimension", Dim},
          {"dt", scene.world.dt},
          {"steps", scene.steps()},
          {"steps_per_frame", scene.steps_per_frame()},
          {"ground", {{"present", scene.world.ground.present}, {"height", scene.world.ground.height}}},
          {"quantum", {{"position", quantum.position}, {"angle", quantum.angle}, {"quaternion", quantum.quaternion}}},
          {"box", {json_of<Dim>(box.min()), json_of<Dim>(box.max())}},
          {"camera", {{"azimuth", picture.azimuth}, {"elevation", picture.elevation}}},
          {"colours", colours()},
          {"score_threshold", scene.policy.kind == "paper" ? Json(scene.policy.paper.tau) : Json()},
          {"tolerance", scene.policy.kind == "adaptive" ? Json(scene.policy.adaptive.tolerance) : Json()},
          {"causes", causes()},
          {"events", events_of(scene)},
          {"coloured_shapes", coloured_shapes_of(scene)},
          {"shapes", shapes_of(scene)},
          {"obstacles", obstacles_of(scene)}};
}

template <int Dim>
Box<Dim> box_of(const Scene<Dim>& scene) {
  Box<Dim> box;
  box.extend(Vec<Dim>::Zero().eval());
  for (const Source<Dim>& source : scene.sources) {
    const Vec<Dim> reach = source.sweep.cwiseAbs() + source.grid_extent();
    box.extend(Vec<Dim>(source.position - source.sweep.cwiseAbs()));
    box.extend(Vec<Dim>(source.position + reach));
  }
  for (const InitialBody<Dim>& body : scene.bodies)
    box.extend(bounds_at(scene.world.shapes[body.def.shape], body.def.pose));
  for (const Obstacle<Dim>& obstacle : scene.world.obstacles) box.extend(bounds_at(obstacle.shape, obstacle.pose));
  return box;
}

template Json run_head(const Scene<2>&, const RunTexts&, const Quantum&, const Box<2>&);
template Json run_head(const Scene<3>&, const RunTexts&, const Quantum&, const Box<3>&);
template Box<2> box_of(const Scene<2>&);
template Box<3> box_of(const Scene<3>&);

}  // namespace talus
