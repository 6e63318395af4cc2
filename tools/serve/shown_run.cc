#include "tools/serve/shown_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "common/simulation/simulation.h"
#include "common/text/printable.h"
#include "common/world/energy.h"
#include "tools/run/backends.h"
#include "tools/run/make_simulation.h"
#include "tools/run/measured_drift.h"
#include "tools/run/version.h"
#include "tools/serve/body_account.h"
#include "tools/serve/contact_memory.h"
#include "tools/serve/free_place.h"
#include "tools/serve/saved_scene.h"
#include "tools/view/contact_stream.h"
#include "tools/view/frame_stream.h"
#include "tools/view/merge_blocks.h"
#include "tools/view/run_head.h"

namespace talus {
namespace {

/// Keeps what happened since the last frame for the pages; with an observer a simulation counts piles and looks for
/// warnings.
template <int Dim>
class SinceShown final : public Observer<Dim> {
 public:
  void on_frame(const Frame<Dim>& frame) override {
    events.insert(events.end(), frame.events.begin(), frame.events.end());
    body_steps += static_cast<double>(frame.world.awake().size());
  }
  std::vector<SleepEvent> events;
  double body_steps = 0.0;  // of awake bodies, since the start
};

template <int Dim>
class SimulatedScene final : public ShownRun {
 public:
  SimulatedScene(const Scene<Dim>& scene, const std::string& backend, const std::string& name)
      : scene_(scene),
        backend_(backend),
        form_(frame_form(scene)),
        head_(head_of(scene, backend, name)),
        encoder_(form_),
        contacts_(scene.world.dt),
        simulation_(make_simulation(scene, backend)) {
    simulation_.add_observer(since_);
    simulation_.add_observer(contacts_);
  }

  void step() override {
    simulation_.step();
    for (const auto done = simulation_.done_events(); known_events_ < done.size(); ++known_events_)
      happened_.push_back(done[known_events_]);
  }
  bool finished() const override { return simulation_.finished(); }
  bool at_rest() const override { return simulation_.at_rest(); }

  void probe_drift(const std::function<bool()>& stop) override {
    if (scene_.policy.tolerance().value_or(0.0) <= 0.0) return;
    const auto probe = probe_end_drift<Dim>(simulation_, scene_, backend_, probe_allowance(since_.body_steps), stop);
    if (probe) simulation_.set_probed_drift(probe->expected());
  }

  std::int64_t step_number() const override { return simulation_.frame().step; }
  bool is_output() const override { return step_number() % scene_.steps_per_frame() == 0; }
  double dt() const override { return scene_.world.dt; }
  const std::string& head() const override { return head_; }
  FrameHistory::Merge merge() const override { return merge_blocks<Dim>; }

  ShownFrame frame(double ms_per_step) override {
    const Frame<Dim> frame = simulation_.frame();
    std::vector<Pile<Dim>> piles(frame.piles.piles().begin(), frame.piles.piles().end());
    for (Pile<Dim>& pile : piles) set_thresholds<Dim>(*frame.policy, pile.layers);
    const auto obstacles = moving_poses(scene_.world.obstacles, scene_.movers, frame.time);
    const std::optional<ToldDrift> drift = told_drift(frame);
    ShownFrame shown = {.step = frame.step,
                        .block = encoder_.encode({.step = frame.step,
                                                  .states = frame.world.states(),
                                                  .events = since_.events,
                                                  .piles = piles,
                                                  .warnings = frame.warnings,
                                                  .kinetic_energy = kinetic_energy(frame.world),
                                                  .scene_events = happened_,
                                                  .drift_estimate = drift ? drift->drift : -1.0,
                                                  .obstacles = obstacles,
                                                  .ms_per_step = ms_per_step})};
    since_.events.clear();
    if (contacts_.needs_contacts())
      shown.contacts = encode_contacts<Dim>(contacts_.contacts(frame.world), form_->quantum);
    return shown;
  }

  void show_contacts(bool show) override { contacts_.want(show, simulation_.world()); }

  std::string account(std::int64_t body) const override {
    const std::vector<ShownContact<Dim>> contacts = contacts_.contacts(simulation_.world());
    return body_account<Dim>(simulation_, scene_, contacts, body)
        .dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
  }

  std::string kick(std::int64_t body, std::span<const double> velocity) override {
    if (!present(body)) return no_body(body);
    constexpr double fastest = 1000.0;  // [m/s]; the engine's own limit is lower
    const auto allowed = [](double part) { return std::abs(part) <= fastest; };
    if (velocity.size() != Dim || !std::ranges::all_of(velocity, allowed))
      return fmt::format("velocity: must be {} numbers of -1000 to 1000", Dim);
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
    return {};
  }

  std::string pull(std::int64_t body, std::span<const double> point, std::span<const double> target) override {
    if (!present(body)) return no_body(body);
    const auto index = static_cast<BodyIndex>(body);
    const double reach = bounding_radius(simulation_.world().shape_of(index));
    const std::optional<Vec<Dim>> from = vector_of(point, 1.01 * reach);
    const std::optional<Vec<Dim>> to = vector_of(target, farthest_place);
    if (!from) return fmt::format("point: must be {} numbers, within the body", Dim);
    if (!to) return fmt::format("to: must be {} numbers of -{} to {}", Dim, farthest_place, farthest_place);
    simulation_.pull({.body = index, .point = *from, .target = *to});
    return {};
  }

  void release() override { simulation_.release(); }

  std::string add(const std::string& shape, std::span<const double> position) override {
    const auto& shapes = scene_.world.shapes;
    const auto found = std::ranges::find(shapes, shape, &Shape<Dim>::name);
    if (found == shapes.end()) return fmt::format("shape: the scene has none named '{}'", printable(shape));
    const std::optional<Vec<Dim>> at = vector_of(position, farthest_place);
    if (!at) return fmt::format("position: must be {} numbers of -{} to {}", Dim, farthest_place, farthest_place);
    const int number = static_cast<int>(found - shapes.begin());
    const std::optional<Vec<Dim>> place = free_place(simulation_.world(), fixed_supports(scene_), number, *at);
    if (!place) return "position: must have a free place above it";
    simulation_.add({.shape = number, .pose = {.position = *place}});
    return {};
  }

  /// Pages are told of it as of an event of the scene.
  std::string cut(std::int64_t obstacle) override {
    if (obstacle < 0 || obstacle >= std::ssize(scene_.world.obstacles) ||
        !simulation_.world().has_obstacle(static_cast<int>(obstacle)))
      return fmt::format("obstacle {}: is not in the world", obstacle);
    simulation_.cut_obstacle(static_cast<int>(obstacle));
    happened_.push_back({static_cast<int>(std::ssize(scene_.events) + obstacle), simulation_.time() - scene_.world.dt});
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

  std::string head_of(const Scene<Dim>& scene, const std::string& backend, const std::string& name) const {
    const RunTexts texts = {.name = printable(name),
                            .backend = backend,
                            .policy = scene.policy.kind,
                            .version = version_text(),
                            .seed = scene.seed};
    nlohmann::ordered_json head = run_head(scene, texts, form_->quantum, box_of(scene));
    head["kind"] = "head";
    for (std::size_t k = 0; k < scene.world.obstacles.size(); ++k)
      head["events"].push_back({{"text", fmt::format("obstacle {} cut away by hand", k)}, {"removes", {k}}});
    return head.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
  }

  Scene<Dim> scene_;
  std::string backend_;
  std::shared_ptr<const FrameForm<Dim>> form_;
  std::string head_;
  FrameEncoder<Dim> encoder_;
  SinceShown<Dim> since_;
  std::vector<DoneEvent> happened_;  // events of the scene, and after their numbers obstacles that were cut
  std::size_t known_events_ = 0;     // of the simulation
  ContactMemory<Dim> contacts_;
  Simulation<Dim> simulation_;
};

}  // namespace

std::unique_ptr<ShownRun> show_run(const AnyScene& scene, const std::string& backend, const std::filesystem::path& file,
                                   bool force) {
  return std::visit(
      [&]<int Dim>(const Scene<Dim>& of_dimension) -> std::unique_ptr<ShownRun> {
        const std::vector<std::string> engines = backends(Dim);
        const std::string& engine = backend.empty() && !engines.empty() ? engines.front() : backend;
        print_scene_warnings(check_window(of_dimension, engine, file, force), scene_warnings(of_dimension, engine));
        return std::make_unique<SimulatedScene<Dim>>(of_dimension, engine, file.stem().string());
      },
      scene);
}

}  // namespace talus
