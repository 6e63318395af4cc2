#include "tools/serve/shown_run.h"

#include <utility>

#include "common/simulation/simulation.h"
#include "common/text/printable.h"
#include "common/world/energy.h"
#include "tools/run/backends.h"
#include "tools/run/make_simulation.h"
#include "tools/run/version.h"
#include "tools/view/frame_stream.h"
#include "tools/view/run_head.h"

namespace talus {
namespace {

template <int Dim>
class StreamWriter final : public BlockWriter {
 public:
  explicit StreamWriter(const Quantum& quantum) : encoder(quantum) {}
  FrameEncoder<Dim> encoder;
};

template <int Dim>
class StateCopy final : public Snapshot {
 public:
  StateCopy(const Frame<Dim>& frame, const Quantum& quantum, std::shared_ptr<const std::string> head)
      : quantum_(quantum),
        head_(std::move(head)),
        step_(frame.step),
        piles_(frame.piles.piles().begin(), frame.piles.piles().end()),
        warnings_(frame.warnings.begin(), frame.warnings.end()),
        kinetic_energy_(kinetic_energy(frame.world)) {
    const BodyStates<Dim>& states = frame.world.states();
    states_.shape = states.shape;
    states_.pose = states.pose;
    states_.asleep = states.asleep;
    states_.removed = states.removed;
  }

  std::shared_ptr<const std::string> head() const override { return head_; }
  std::int64_t step() const override { return step_; }
  std::unique_ptr<BlockWriter> make_writer() const override { return std::make_unique<StreamWriter<Dim>>(quantum_); }
  std::string block(BlockWriter& writer, std::span<const SleepEvent> events) const override {
    return dynamic_cast<StreamWriter<Dim>&>(writer).encoder.encode({.step = step_,
                                                                    .states = states_,
                                                                    .events = events,
                                                                    .piles = piles_,
                                                                    .warnings = warnings_,
                                                                    .kinetic_energy = kinetic_energy_});
  }

 private:
  Quantum quantum_;
  std::shared_ptr<const std::string> head_;
  std::int64_t step_;
  BodyStates<Dim> states_;  // without velocities
  std::vector<Pile<Dim>> piles_;
  std::vector<Warning> warnings_;
  double kinetic_energy_;
};

/// Keeps the events of the last step; with an observer a simulation counts piles and looks for warnings.
template <int Dim>
class LastEvents final : public Observer<Dim> {
 public:
  void on_frame(const Frame<Dim>& frame) override { events.assign(frame.events.begin(), frame.events.end()); }
  std::vector<SleepEvent> events;
};

template <int Dim>
class SimulatedScene final : public ShownRun {
 public:
  SimulatedScene(const Scene<Dim>& scene, const std::string& backend, const std::string& name)
      : dt_(scene.world.dt),
        steps_(scene.steps()),
        quantum_(quantum_of(scene)),
        head_(std::make_shared<std::string>(head_of(scene, backend, name))),
        simulation_(make_simulation(scene, backend)) {
    simulation_.add_observer(events_);
  }

  void step() override { simulation_.step(); }
  bool finished() const override { return simulation_.frame().step >= steps_; }
  double dt() const override { return dt_; }
  std::span<const SleepEvent> events() const override { return events_.events; }
  std::shared_ptr<const Snapshot> snapshot() const override {
    return std::make_shared<StateCopy<Dim>>(simulation_.frame(), quantum_, head_);
  }

 private:
  std::string head_of(const Scene<Dim>& scene, const std::string& backend, const std::string& name) const {
    const RunTexts texts = {.name = printable(name),
                            .backend = backend,
                            .policy = scene.policy.kind,
                            .version = version_text(),
                            .seed = scene.seed};
    nlohmann::ordered_json head = run_head(scene, texts, quantum_, box_of(scene));
    head["kind"] = "head";
    return head.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
  }

  double dt_;
  std::int64_t steps_;
  Quantum quantum_;
  std::shared_ptr<const std::string> head_;
  LastEvents<Dim> events_;
  Simulation<Dim> simulation_;
};

}  // namespace

std::unique_ptr<ShownRun> show_run(const AnyScene& scene, const std::string& backend, const std::string& name) {
  return std::visit(
      [&]<int Dim>(const Scene<Dim>& of_dimension) -> std::unique_ptr<ShownRun> {
        const std::vector<std::string> engines = backends(Dim);
        const std::string& engine = backend.empty() && !engines.empty() ? engines.front() : backend;
        return std::make_unique<SimulatedScene<Dim>>(of_dimension, engine, name);
      },
      scene);
}

}  // namespace talus
