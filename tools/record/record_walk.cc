#include "tools/record/record_walk.h"

#include <utility>

#include "common/text/printable.h"
#include "lcmtypes/decode.h"
#include "lcmtypes/translate.h"
#include "tools/record/record_file.h"
#include "tools/record/state_reader.h"

namespace talus {
namespace {

template <int Dim>
class Walk {
 public:
  Walk(const Scene<Dim>& scene, const std::function<void(const RecordedFrame<Dim>&)>& visit)
      : dt_(scene.world.dt),
        states_(static_cast<int>(scene.bodies_planned()), static_cast<int>(scene.world.shapes.size())),
        visit_(visit) {}

  void take(const LogEvent& event) {
    if (const auto channel = channel_named(event.channel))
      with_message_of(*channel, [&](auto message) { decode_and_take(event, message); });
  }

  /// Visits the frame of the last step once all messages of that step have been taken: the end of a run says some
  /// things of it again.
  void show() {
    if (!std::exchange(complete_, false)) return;
    cause_.resize(states_.states().size(), -1);
    for (const SleepEvent& event : events_)
      if (event.body < states_.states().size()) cause_[event.body] = static_cast<std::int8_t>(event.cause);
    visit_({.step = last_step_,
            .time = dt_ * static_cast<double>(last_step_),
            .states = states_.states(),
            .unknown = states_.unknown(),
            .cause = cause_,
            .events = events_,
            .piles = piles_,
            .warnings = warnings_,
            .kinetic_energy = kinetic_energy_,
            .drift_estimate = drift_estimate_,
            .scene_events = scene_events_});
    events_.clear();
  }

  std::int64_t undecodable() const { return undecodable_; }
  const RecordedIdentity& run() const { return run_; }

 private:
  template <class Message>
  void decode_and_take(const LogEvent& event, Message& message) {
    if constexpr (requires { this->take(message); }) {
      if (!decode(event.data, message).empty()) {
        ++undecodable_;
        return;
      }
      if (message.step != last_step_) show();
      take(message);
    }
  }

  void take(const talus_lcm::talus_run_v1& message) {
    run_ = {printable(message.backend), printable(message.policy), printable(message.version),
            printable(message.reason)};
  }

  void take(const talus_lcm::talus_piles_v2& message) {
    if (message.part == 0) piles_.clear();
    for (const talus_lcm::talus_pile_v2& pile : message.piles) piles_.push_back(to_pile<Dim>(pile));
  }

  void take(const talus_lcm::talus_stats_v2& message) {
    kinetic_energy_ = message.kinetic_energy;
    drift_estimate_ = message.drift_estimate;
    warnings_ = warnings_of(message);
  }

  void take(const talus_lcm::talus_sleep_v1& message) {
    for (const SleepEvent& event : events_of(message)) {
      states_.note_event(event.body);
      events_.push_back(event);
    }
  }

  void take(const talus_lcm::talus_event_v2& message) {
    scene_events_.push_back({message.number, message.sim_time - dt_});
  }

  void take(const talus_lcm::talus_bodies_v1& message) {
    if (!states_.take(message) || states_.step() <= last_step_) return;
    last_step_ = states_.step();
    complete_ = true;
  }

  double dt_;
  StateReader<Dim> states_;
  const std::function<void(const RecordedFrame<Dim>&)>& visit_;
  std::vector<SleepEvent> events_;  // since the last frame
  std::vector<DoneEvent> scene_events_;
  std::vector<std::int8_t> cause_;
  RecordedIdentity run_;
  std::vector<Pile<Dim>> piles_;
  std::vector<Warning> warnings_;
  double kinetic_energy_ = 0.0;
  double drift_estimate_ = -1.0;
  std::int64_t last_step_ = 0;
  bool complete_ = false;  // the state of that step, which was not visited yet
  std::int64_t undecodable_ = 0;
};

}  // namespace

template <int Dim>
WalkResult walk_record(const Scene<Dim>& scene, LogReader& log,
                       const std::function<void(const RecordedFrame<Dim>&)>& visit) {
  Walk<Dim> walk(scene, visit);
  OneRun run;
  for (LogEvent event; log.next(event);) {
    run.see(event, "run.lcm");
    walk.take(event);
  }
  walk.show();
  return {{log.damage().bytes, walk.undecodable()}, walk.run()};
}

template WalkResult walk_record(const Scene<2>&, LogReader&, const std::function<void(const RecordedFrame<2>&)>&);
template WalkResult walk_record(const Scene<3>&, LogReader&, const std::function<void(const RecordedFrame<3>&)>&);

}  // namespace talus
