#include "tools/serve/shown_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "common/measure/contact_forces.h"
#include "common/simulation/simulation.h"
#include "common/text/printable.h"
#include "lcmtypes/event_log.h"
#include "lcmtypes/moment_writer.h"
#include "tools/output/json_text.h"
#include "tools/output/output.h"
#include "tools/run/backends.h"
#include "tools/run/make_simulation.h"
#include "tools/run/measured_drift.h"
#include "tools/run/version.h"
#include "tools/serve/body_account.h"
#include "tools/serve/free_place.h"
#include "tools/serve/saved_scene.h"

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

/// Gathers the messages of a frame as log events.
class MessageBuffer final : public MessageSink {
 public:
  std::int64_t stamp(double time) override { return std::llround(1e6 * time); }
  void put(Packet packet) override { append_event(events_, 0, packet.utime, packet.channel, packet.bytes); }
  std::string take() { return std::exchange(events_, {}); }

 private:
  std::string events_;
};

/// Writes down what happens in each step; with an observer a simulation counts piles and looks for warnings.
template <int Dim>
class StepWriter final : public Observer<Dim> {
 public:
  explicit StepWriter(MomentWriter<Dim>& writer) : writer_(writer) {}
  void on_frame(const Frame<Dim>& frame) override {
    writer_.events(frame);
    phases_ += frame.phases;
    ++steps_;
    body_steps_ += static_cast<double>(frame.world.awake().size());
  }
  double body_steps() const { return body_steps_; }

  /// The numbers of a frame, with the mean wall times of the steps since the last call.
  talus_lcm::talus_stats stats(const Frame<Dim>& frame) {
    talus_lcm::talus_stats message = to_stats<Dim>(frame);
    if (steps_ == 0) return message;
    message.timed = 1;
    set_phase_times(std::exchange(phases_, {}), std::exchange(steps_, 0), message);
    return message;
  }

 private:
  MomentWriter<Dim>& writer_;
  PhaseTimes phases_;
  std::int64_t steps_ = 0;
  double body_steps_ = 0.0;  // of awake bodies, since the start
};

/// What a scene without bodies shows: its obstacles, sources and first bodies, and the origin.
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

template <int Dim>
class SimulatedScene final : public ShownRun {
 public:
  SimulatedScene(const Scene<Dim>& scene, const std::string& backend, const std::string& name)
      : scene_(scene),
        backend_(backend),
        writer_(info_of(scene, name, backend), 0, messages_),
        steps_(writer_),
        meters_(scene),
        simulation_(make_simulation(scene, backend)) {
    writer_.set_world(scene.world);
    writer_.set_scene(scene);
    writer_.set_instruments(meters_);
    writer_.set_contacts(contacts_);
    writer_.run(talus_lcm::talus_run::BEGIN, {}, 0, 0.0);
    writer_.shapes();
    if (!scene.instruments.empty()) simulation_.add_observer(meters_);
    simulation_.add_observer(steps_);
    contacts_.record(scene.run.contacts, simulation_.world());
    simulation_.add_observer(contacts_);
  }

  void step() override { simulation_.step(); }
  bool finished() const override { return simulation_.finished(); }
  bool at_rest() const override { return simulation_.at_rest(); }

  void probe_drift(const std::function<bool()>& stop) override {
    probe_end_drift<Dim>(simulation_, scene_, backend_, steps_.body_steps(), stop);
  }

  bool is_output() const override { return simulation_.frame().step % scene_.steps_per_frame() == 0; }
  double dt() const override { return scene_.world.dt; }
  std::string beginning() const override {
    const Box<Dim> box = box_of(scene_);
    const auto corner = [](const Vec<Dim>& point) { return std::vector<double>(point.begin(), point.end()); };
    return json_text({{"kind", "begin"}, {"box", {corner(box.min()), corner(box.max())}}});
  }

  /// The first frame and that after a body was taken away by hand name all bodies.
  ShownFrame frame() override {
    const Frame<Dim> frame = simulation_.frame();
    const bool all = std::exchange(all_due_, false) || writer_.owes_key_frame();
    writer_.piles(frame);
    writer_.stats(steps_.stats(frame), frame);
    writer_.instruments(frame);
    writer_.obstacles(frame, all);
    writer_.contacts(frame);
    all ? void(writer_.all_bodies(frame)) : void(writer_.bodies(frame));
    return {.step = frame.step, .block = messages_.take()};
  }

  void show_contacts(bool show) override { contacts_.record(show || scene_.run.contacts, simulation_.world()); }

  std::string account(std::int64_t body) const override {
    return json_text(body_account<Dim>(simulation_, scene_, contacts_.of(simulation_.world()), body));
  }

  std::string kick(std::int64_t body, std::span<const double> velocity) override {
    if (!present(body)) return no_body(body);
    constexpr double fastest = 1000.0;  // [m/s]; the engine's own limit is lower
    const auto allowed = [](double part) { return std::abs(part) <= fastest; };
    if (velocity.size() != Dim || !std::ranges::all_of(velocity, allowed))
      return fmt::format("velocity: must be {} numbers of {} to {}", Dim, -fastest, fastest);
    Event<Dim> event;
    event.action = EventAction::kick;
    event.numbers = {static_cast<double>(body)};
    for (int axis = 0; axis < Dim; ++axis) event.velocity[axis] = velocity[axis];
    simulation_.do_event(event);
    return {};
  }

  std::string remove(std::int64_t body) override {
    if (!present(body)) return no_body(body);
    simulation_.remove(static_cast<BodyIndex>(body));
    all_due_ = true;
    return {};
  }

  std::string pull(std::int64_t body, std::span<const double> point, std::span<const double> target) override {
    if (!present(body)) return no_body(body);
    const auto index = static_cast<BodyIndex>(body);
    const double reach = bounding_radius(simulation_.world().shape_of(index));
    const std::optional<Vec<Dim>> from = vector_of(point, 1.01 * reach);
    const std::optional<Vec<Dim>> to = vector_of(target, farthest_place());
    if (!from) return fmt::format("point: must be {} numbers, within the body", Dim);
    if (!to) return fmt::format("to: must be {} numbers of -{} to {}", Dim, farthest_place(), farthest_place());
    simulation_.pull({.body = index, .point = *from, .target = *to});
    return {};
  }

  void release() override { simulation_.release(); }

  std::string add(const std::string& shape, std::span<const double> position) override {
    const auto& shapes = scene_.world.shapes;
    const auto found = std::ranges::find(shapes, shape, &Shape<Dim>::name);
    if (found == shapes.end()) return fmt::format("shape: the scene has none named '{}'", printable(shape));
    const std::optional<Vec<Dim>> at = vector_of(position, farthest_place());
    if (!at) return fmt::format("position: must be {} numbers of -{} to {}", Dim, farthest_place(), farthest_place());
    const int number = static_cast<int>(found - shapes.begin());
    const std::optional<Vec<Dim>> place = free_place(simulation_.world(), fixed_supports(scene_), number, *at);
    if (!place) return "position: must have a free place above it";
    simulation_.add({.shape = number, .pose = {.position = *place}});
    return {};
  }

  /// Pages are told of it as of an event of the scene, with a number after those of the scene's own.
  std::string cut(std::int64_t obstacle) override {
    if (obstacle < 0 || obstacle >= std::ssize(scene_.world.obstacles) ||
        !simulation_.world().has_obstacle(static_cast<int>(obstacle)))
      return fmt::format("obstacle {}: is not in the world", obstacle);
    simulation_.cut_obstacle(static_cast<int>(obstacle));
    const auto own = static_cast<std::int32_t>(scene_.events.size());
    talus_lcm::talus_event event{};
    event.number = own + static_cast<std::int32_t>(obstacle);
    event.total = own + static_cast<std::int32_t>(scene_.world.obstacles.size());
    event.action = to_string(EventAction::remove);
    event.text = fmt::format("obstacle {} cut away by hand", obstacle);
    event.obstacle_count = 1;
    event.obstacle = {static_cast<std::int32_t>(obstacle)};
    writer_.event(event, simulation_.frame());
    return {};
  }

  std::string saved() const override { return saved_scene(scene_, simulation_); }

 private:
  /// None where these are not as many numbers as axes, each at most `limit` in size.
  static std::optional<Vec<Dim>> vector_of(std::span<const double> numbers, double limit) {
    const auto allowed = [&](double number) { return std::abs(number) <= limit; };
    if (numbers.size() != Dim || !std::ranges::all_of(numbers, allowed)) return std::nullopt;
    return Vec<Dim>(Eigen::Map<const Vec<Dim>>(numbers.data()));
  }

  bool present(std::int64_t body) const {
    const BodyStates<Dim>& states = simulation_.world().states();
    return body >= 0 && body < states.size() && states.removed[body] == 0;
  }
  static std::string no_body(std::int64_t body) { return fmt::format("body {}: is not in the world", body); }

  static RunInfo info_of(const Scene<Dim>& scene, const std::string& name, const std::string& backend) {
    RunInfo info = run_info(scene, printable(name), backend);
    info.version = version_text();
    return info;
  }

  Scene<Dim> scene_;
  std::string backend_;
  MessageBuffer messages_;
  MomentWriter<Dim> writer_;
  StepWriter<Dim> steps_;
  bool all_due_ = true;  // the next frame must name all bodies
  ContactForces<Dim> contacts_;
  InstrumentMeters<Dim> meters_;
  Simulation<Dim> simulation_;
};

}  // namespace

std::unique_ptr<ShownRun> show_run(const AnyScene& scene, const std::string& backend, const std::filesystem::path& file,
                                   bool force) {
  return std::visit(
      [&]<int Dim>(const Scene<Dim>& of_dimension) -> std::unique_ptr<ShownRun> {
        const std::string engine = backend_for(backend, Dim);
        print_scene_warnings(check_window(of_dimension, engine, file, force), scene_warnings(of_dimension, engine));
        return std::make_unique<SimulatedScene<Dim>>(of_dimension, engine, file.stem().string());
      },
      scene);
}

}  // namespace talus
