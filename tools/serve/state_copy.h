#pragma once
// A state in memory of its own, as pages are sent it.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/serve/shown_run.h"
#include "tools/view/contact_stream.h"
#include "tools/view/frame_stream.h"

namespace talus {

template <int Dim>
class StreamWriter final : public BlockWriter {
 public:
  explicit StreamWriter(std::shared_ptr<const FrameForm<Dim>> form) : encoder(std::move(form)) {}
  FrameEncoder<Dim> encoder;
};

template <int Dim>
class StateCopy final : public Snapshot {
 public:
  /// Copies all of `frame` but its events.
  StateCopy(const ViewFrame<Dim>& frame, std::shared_ptr<const FrameForm<Dim>> form,
            std::shared_ptr<const std::string> head)
      : form_(std::move(form)),
        head_(std::move(head)),
        step_(frame.step),
        piles_(frame.piles.begin(), frame.piles.end()),
        warnings_(frame.warnings.begin(), frame.warnings.end()),
        kinetic_energy_(frame.kinetic_energy),
        scene_events_(frame.scene_events.begin(), frame.scene_events.end()),
        drift_estimate_(frame.drift_estimate),
        obstacles_(frame.obstacles.begin(), frame.obstacles.end()) {
    states_.shape = frame.states.shape;
    states_.pose = frame.states.pose;
    states_.asleep = frame.states.asleep;
    states_.removed = frame.states.removed;
  }

  std::shared_ptr<const std::string> head() const override { return head_; }
  std::int64_t step() const override { return step_; }
  void set_contacts(std::vector<ShownContact<Dim>> contacts) { contacts_ = std::move(contacts); }
  std::unique_ptr<BlockWriter> make_writer() const override { return std::make_unique<StreamWriter<Dim>>(form_); }
  std::string block(BlockWriter& writer, std::span<const SleepEvent> events) const override {
    return dynamic_cast<StreamWriter<Dim>&>(writer).encoder.encode({.step = step_,
                                                                    .states = states_,
                                                                    .events = events,
                                                                    .piles = piles_,
                                                                    .warnings = warnings_,
                                                                    .kinetic_energy = kinetic_energy_,
                                                                    .scene_events = scene_events_,
                                                                    .drift_estimate = drift_estimate_,
                                                                    .obstacles = obstacles_});
  }
  std::string contacts() const override {
    return contacts_ ? encode_contacts<Dim>(*contacts_, form_->quantum) : std::string();
  }

 private:
  std::shared_ptr<const FrameForm<Dim>> form_;
  std::shared_ptr<const std::string> head_;
  std::int64_t step_;
  BodyStates<Dim> states_;  // without velocities
  std::vector<Pile<Dim>> piles_;
  std::vector<Warning> warnings_;
  double kinetic_energy_;
  std::vector<DoneEvent> scene_events_;
  double drift_estimate_;
  std::vector<ObstaclePose<Dim>> obstacles_;
  std::optional<std::vector<ShownContact<Dim>>> contacts_;
};

}  // namespace talus
