#include "tools/serve/saved_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "common/scene/overlap.h"
#include "common/scene/text_limits.h"
#include "common/scene/toml_text.h"
#include "tools/serve/shape_text.h"

namespace talus {
namespace {

/// Numbers of bodies in the file, by their numbers in the run.
class Renumbering {
 public:
  template <int Dim>
  explicit Renumbering(const BodyStates<Dim>& states) : bodies_(states.size()) {
    for (BodyIndex body = 0; body < states.size(); ++body)
      numbers_.push_back(states.removed[body] != 0 ? -1 : present_++);
  }
  std::int64_t present() const { return present_; }
  /// Of bodies still to come too; -1: it was removed.
  std::int64_t of(std::int64_t body) const { return body < bodies_ ? numbers_[body] : body - bodies_ + present_; }

 private:
  std::int64_t bodies_;
  std::int64_t present_ = 0;
  std::vector<std::int64_t> numbers_;
};

template <int Dim>
class Saving {
 public:
  Saving(const Scene<Dim>& scene, const Simulation<Dim>& simulation)
      : scene_(scene),
        simulation_(simulation),
        world_(simulation.world()),
        root_(toml::parse(scene.toml)),
        numbers_(world_.states()),
        resolution_(std::pow(10.0, std::floor(std::log10(1e-6 * smallest(scene.world.shapes))))) {}

  std::string text() {
    if (numbers_.present() > most_saved)
      throw std::invalid_argument(
          fmt::format("{} bodies: a scene file must place at most {}", numbers_.present(), most_saved));
    const std::string obstacles = put_obstacles();
    put_sources();
    put_gravity();
    put_events();
    put_run();
    drop_bodies();
    put_shapes();
    const std::string bodies = put_bodies();
    std::string text = heading() + document_text(root_) + shapes_ + obstacles + bodies;
    if (text.size() > max_scene_text)
      throw std::invalid_argument(
          fmt::format("{} bodies make a scene of {} bytes; rule: at most {}, which is some thousand bodies",
                      numbers_.present(), text.size(), max_scene_text));
    return text;
  }

 private:
  static constexpr std::int64_t most_saved = 100'000;

  /// Extent [m].
  static double smallest(const std::vector<Shape<Dim>>& shapes) {
    double extent = 1e3;
    for (const Shape<Dim>& shape : shapes) extent = std::min(extent, shape.extent);
    return extent;
  }

  /// As few digits as the resolution has.
  std::string number(double value) const {
    const int digits = std::max(0, static_cast<int>(std::lround(-std::log10(resolution_))));
    std::string text = fmt::format("{:.{}f}", value, digits);
    if (text.find('.') == std::string::npos) return text + ".0";
    while (text.ends_with('0') && !text.ends_with(".0")) text.pop_back();
    return text == "-0.0" ? "0.0" : text;
  }
  template <class Vector>
  std::string numbers(const Vector& vector) const {
    std::vector<std::string> parts;
    for (const double part : vector) parts.push_back(number(part));
    return toml_array(parts);
  }

  void lost(const std::string& what) { lost_.push_back(what); }

  std::string heading() const {
    std::string text = fmt::format("# {}: the state after {:.6g} s (step {}), saved by talus view.\n", scene_.title,
                                   simulation_.time(), simulation_.frame().step);
    text += "# Not kept:\n";
    for (const std::string& what : lost_) text += fmt::format("# - {}\n", what);
    return text + "\n";
  }

  toml::array* tables(std::string_view key) { return root_[key].as_array(); }

  /// Keeps the [[obstacle]] tables of which all obstacles are left. Of a table that has lost some, returns the others
  /// as text.
  std::string put_obstacles() {
    std::string text;
    toml::array* tables_of = tables("obstacle");
    int first = 0;
    toml::array kept;
    for (std::size_t i = 0; i < scene_.obstacles_of_tables.size(); ++i) {
      const int count = scene_.obstacles_of_tables[i];
      std::vector<int> left;
      for (int k = first; k < first + count; ++k)
        if (world_.has_obstacle(k) || is_to_come(k)) left.push_back(k);
      toml::table& table = *tables_of->get(i)->as_table();
      if (std::ssize(left) == count) {
        note_motion(table, first);
        kept.push_back(table);
      } else {
        if (!left.empty() && table.contains("name"))
          lost(fmt::format("the name of obstacle {}, of which a part is gone", value_text(*table.get("name"))));
        for (const int k : left) text += obstacle_text(world_.obstacle_shape(k), world_.obstacle_pose(k));
      }
      first += count;
    }
    for (std::size_t k = first; k < scene_.world.obstacles.size(); ++k)
      if (!world_.has_obstacle(static_cast<int>(k)))
        lost("the cut of a wall of [pile.boundary] or of a fixed body: it stands again");
    root_.erase("obstacle");
    if (!kept.empty()) root_.insert("obstacle", std::move(kept));
    return text;
  }

  bool is_done(std::size_t event) const {
    return std::ranges::count(simulation_.done_events(), static_cast<int>(event), &DoneEvent::number) > 0;
  }

  /// Whether an event will add an obstacle.
  bool is_to_come(int obstacle) const {
    for (std::size_t i = 0; i < scene_.events.size(); ++i) {
      const Event<Dim>& event = scene_.events[i];
      if (event.action != EventAction::add || !event.obstacle || is_done(i)) continue;
      const ObstacleName& name = scene_.obstacle_names[*event.obstacle];
      if (obstacle >= name.first && obstacle < name.first + name.count) return true;
    }
    return false;
  }

  void note_motion(const toml::table& table, int obstacle) {
    if (table.contains("motion"))
      lost(fmt::format("where obstacle {} is in its motion: it begins again from its first place", obstacle));
  }

  void put_sources() {
    toml::array* tables_of = tables("source");
    source_numbers_.assign(scene_.sources.size(), -1);
    toml::array kept;
    const Emitter<Dim>& emitter = simulation_.emitter();
    for (std::size_t i = 0; i < scene_.sources.size(); ++i) {
      const Source<Dim>& source = emitter.source(static_cast<int>(i));
      const int emitted = emitter.emitted(static_cast<int>(i));
      if (emitted >= source.count) continue;
      toml::table table = *tables_of->get(i)->as_table();
      if (!table.contains("shape")) table.insert("shape", shape_list());
      table.insert_or_assign("count", std::int64_t{source.count - emitted});
      if (!source.waits_for_event)
        table.insert_or_assign("start", std::max(0.0, source.due_time(emitted) - simulation_.time()));
      table.insert_or_assign("rate", source.rate);
      source_numbers_[i] = std::ssize(kept);
      kept.push_back(std::move(table));
      lost(fmt::format("the random rotations and places of the {} bodies of source {} that are still to come",
                       source.count - emitted, i));
      if (emitted % source.bodies_at_once() != 0 || emitted % source.shapes_of_a_size() != 0)
        lost(fmt::format("how far source {} was in its grid and its list of shapes: both begin again", i));
      if (source.sweep_period > 0.0 || source.ride_above > 0.0)
        lost(fmt::format("where the spout of source {} was", i));
    }
    root_.erase("source");
    if (!kept.empty()) root_.insert("source", std::move(kept));
  }

  /// What a source drops that names no shapes.
  toml::array shape_list() const {
    std::vector<std::string> names;
    for (const NamedShape& shape : named_shapes(scene_))
      if (!shape.name.empty() && std::ranges::count(names, shape.base) == 0) names.push_back(shape.base);
    toml::array list;
    for (const std::string& name : names) list.push_back(name);
    return list;
  }

  void put_gravity() {
    const bool changed = std::ranges::any_of(
        simulation_.done_events(), [&](const DoneEvent& done) { return action_of(done) == EventAction::gravity; });
    if (scene_.gravity_motion) lost("where gravity is in its motion: it begins again");
    if (!changed) return;
    toml::array gravity;
    const WorldDescription<Dim> now = world_at(scene_, simulation_.done_events(), simulation_.time());
    for (const double part : now.gravity_vector()) gravity.push_back(part);
    if (!root_.contains("world")) root_.insert("world", toml::table());
    root_["world"].as_table()->insert_or_assign("gravity", std::move(gravity));
  }

  EventAction action_of(const DoneEvent& done) const { return scene_.events[done.number].action; }

  void put_events() {
    toml::array* tables_of = tables("event");
    toml::array kept;
    for (std::size_t i = 0; i < scene_.events.size(); ++i) {
      const Event<Dim>& event = scene_.events[i];
      if (is_done(i)) continue;
      toml::table table = *tables_of->get(i)->as_table();
      if (moved(event, table)) kept.push_back(std::move(table));
    }
    for (const DoneEvent& each : simulation_.done_events()) {
      if (action_of(each) == EventAction::policy) put_policy(scene_.events[each.number].policy);
      if (action_of(each) == EventAction::force) lost(fmt::format("the force of event {}", each.number));
    }
    root_.erase("event");
    if (!kept.empty()) root_.insert("event", std::move(kept));
  }

  void put_policy(const std::string& kind) {
    if (!root_.contains("policy")) root_.insert("policy", toml::table());
    root_["policy"].as_table()->insert_or_assign("kind", kind);
  }

  /// Puts times and numbers of the run into those of the file. False where the event means nothing there.
  bool moved(const Event<Dim>& event, toml::table& table) {
    if (event.time) table.insert_or_assign("time", std::max(0.0, *event.time - simulation_.time()));
    if (event.bodies > 0)
      table.insert_or_assign(
          "bodies", std::max<std::int64_t>(1, event.bodies - simulation_.emitter().emitted() + numbers_.present()));
    if (event.action == EventAction::rate || (event.action == EventAction::add && !event.obstacle)) {
      if (source_numbers_[event.source] < 0) return false;
      table.insert_or_assign("source", source_numbers_[event.source]);
    }
    if (event.action == EventAction::remove && event.obstacle) {
      const int first = scene_.obstacle_names[*event.obstacle].first;
      if (!world_.has_obstacle(first) && !is_to_come(first)) return false;
    }
    if (event.numbers.empty()) return true;
    toml::array bodies;
    for (const double body : event.numbers)
      if (const std::int64_t now = numbers_.of(static_cast<std::int64_t>(body)); now >= 0) bodies.push_back(now);
    if (bodies.empty()) return false;
    table.insert_or_assign("body", std::move(bodies));
    return true;
  }

  void put_run() {
    const std::int64_t left = scene_.run.frames - simulation_.frame().step / scene_.steps_per_frame();
    if (!root_.contains("run")) root_.insert("run", toml::table());
    if (left > 0)
      root_["run"].as_table()->insert_or_assign("frames", left);
    else
      lost("the end of the run, which was reached: it has all its frames again");
    lost("forces in contacts and what the policy has measured, which build up again within some steps");
    lost("the places of piles without `at`, and slopes measured of piles");
    if (!scene_.referred.empty())
      lost(fmt::format("files that the scene names, which must lie beside it: {}", fmt::join(referred(), ", ")));
  }

  std::vector<std::string> referred() const {
    std::vector<std::string> names;
    for (const auto& file : scene_.referred) names.push_back(file.string());
    return names;
  }

  /// Those that move; fixed ones stay.
  void drop_bodies() {
    toml::array kept;
    if (const toml::array* bodies = tables("body"))
      for (const toml::node& body : *bodies)
        if ((*body.as_table())["fixed"].value_or(false)) kept.push_back(*body.as_table());
    root_.erase("body");
    if (!kept.empty()) root_.insert("body", std::move(kept));
  }

  /// Shapes that bodies have now and that the scene gives no name.
  void put_shapes() {
    shape_names_ = named_shapes(scene_);
    const BodyStates<Dim>& states = world_.states();
    for (BodyIndex body = 0; body < states.size(); ++body) {
      NamedShape& shape = shape_names_[states.shape[body]];
      if (states.removed[body] != 0 || !shape.name.empty()) continue;
      shape.name = fmt::format("saved_{}", states.shape[body]);
      shape.own_axes = true;
      shapes_ += shape_text(scene_.world.shapes[states.shape[body]], shape.name);
    }
  }

  std::string put_bodies() const {
    WorldDescription<Dim> now = scene_.world;
    for (std::size_t k = now.obstacles.size(); k-- > 0;) {
      now.obstacles[k].pose = world_.obstacle_pose(static_cast<int>(k));
      if (!world_.has_obstacle(static_cast<int>(k)))
        now.obstacles.erase(now.obstacles.begin() + static_cast<std::ptrdiff_t>(k));
    }
    OverlapCheck<Dim> placed(now);
    const BodyStates<Dim>& states = world_.states();
    std::string text;
    for (BodyIndex body = 0; body < states.size(); ++body)
      if (states.removed[body] == 0) text += body_text(body, placed);
    return text;
  }

  std::string body_text(BodyIndex body, OverlapCheck<Dim>& placed) const {
    const BodyStates<Dim>& states = world_.states();
    const int number_of_shape = states.shape[body];
    const NamedShape& name = shape_names_[number_of_shape];
    const Pose<Dim>& pose = states.pose[body];
    const Shape<Dim>& shape = scene_.world.shapes[number_of_shape];
    const Vec<Dim> origin = name.own_axes ? pose.position : pose * shape.reference;
    std::string text = fmt::format("\n[[body]]\nshape = {}\nposition = {}\n", toml_text(name.name), numbers(origin));
    text += turn_text(pose.rotation);
    if (states.asleep[body] != 0)
      text += "asleep = true\n";
    else
      text += motion_text(states.velocity[body], states.spin[body]);
    const double depth = placed.add(number_of_shape, pose, false, "body").depth;
    if (depth > 0.0) text += fmt::format("overlap = {:.4g}\n", 1.01 * depth + 10.0 * resolution_);
    return text;
  }

  std::string motion_text(const Vec<Dim>& velocity, const Spin<Dim>& spin) const {
    std::string text;
    if (velocity.norm() > 0.0) text += fmt::format("velocity = {}\n", numbers(velocity));
    if (spin.norm() == 0.0) return text;
    if constexpr (Dim == 2)
      return text + fmt::format("spin = {}\n", number(spin[0]));
    else
      return text + fmt::format("spin = {}\n", numbers(spin));
  }

  const Scene<Dim>& scene_;
  const Simulation<Dim>& simulation_;
  const World<Dim>& world_;
  toml::table root_;
  Renumbering numbers_;
  double resolution_ = 1e-6;                  // [m], also of velocities [m/s]; a power of ten
  std::vector<std::int64_t> source_numbers_;  // in the file; -1: nothing is left of it
  std::vector<NamedShape> shape_names_;
  std::string shapes_;
  std::vector<std::string> lost_;
};

}  // namespace

template <int Dim>
std::string saved_scene(const Scene<Dim>& scene, const Simulation<Dim>& simulation) {
  return Saving<Dim>(scene, simulation).text();
}

template std::string saved_scene(const Scene<2>&, const Simulation<2>&);
template std::string saved_scene(const Scene<3>&, const Simulation<3>&);

}  // namespace talus
