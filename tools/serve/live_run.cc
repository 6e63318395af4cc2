#include "tools/serve/live_run.h"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "common/moment/moment.h"
#include "common/scene/scene.h"
#include "common/text/printable.h"
#include "lcmtypes/moment_reader.h"
#include "lcmtypes/run_info.h"
#include "lcmtypes/shapes_message.h"
#include "lcmtypes/wire.h"
#include "tools/output/json_text.h"
#include "tools/picture/framing.h"
#include "tools/view/frame_stream.h"
#include "tools/view/merge_blocks.h"
#include "tools/view/run_head.h"

namespace talus {
namespace {

using Json = nlohmann::ordered_json;
using talus_lcm::talus_event;
using talus_lcm::talus_run;
using talus_lcm::talus_sleep;
using talus_lcm::talus_stats;

constexpr auto silence = std::chrono::seconds(2);

/// Of each channel on which messages came or were lost: its name, how many came, how many were lost.
Json channels_json(const MomentReader& heard) {
  Json channels = Json::array();
  for (const Channel channel : all_channels)
    if (heard.received(channel) > 0 || heard.lost(channel) > 0)
      channels.push_back({name_of(channel), heard.received(channel), heard.lost(channel)});
  return channels;
}

Json status_json(const std::string& reason, bool finished, const std::string& policy, std::int64_t step, double ms,
                 double factor) {
  return {{"kind", "status"},
          {"live", true},
          {"running", !finished && reason.empty()},
          {"finished", finished},
          {"reason", reason},
          {"pace", 0},
          {"policy", policy},
          {"policies", {policy}},
          {"step", step},
          {"ms_per_step", ms},
          {"real_time_factor", factor}};
}

}  // namespace

/// What has been heard of the run that is followed.
class LiveRun::Assembly {
 public:
  Assembly(const talus_run& run, PageHub& hub, const std::int64_t& undecodable)
      : reader_(run.dimension, {}), run_id_(run.run_id), hub_(hub), undecodable_(undecodable) {
    reader_.take(run);
  }
  virtual ~Assembly() = default;

  bool is_of(std::int64_t run_id) const { return run_id_ == run_id; }
  bool ended() const { return run().phase == talus_run::END; }
  bool is_restart(const talus_run& message) const { return reader_.is_restart(message); }

  template <class Message>
  void take(const Message& message) {
    if (reader_.take(message) && reader_.has_all_shapes()) show(reader_);
    if constexpr (std::is_same_v<Message, talus_run> || std::is_same_v<Message, talus_stats>) show_status();
  }

 protected:
  const talus_run& run() const { return *reader_.run(); }
  /// A whole moment of which all shapes are known.
  virtual void show(const MomentReader& reader) = 0;
  PageHub& hub() { return hub_; }

 private:
  void show_status() {
    const std::string reason = ended() && run().reason != "finished" ? printable(run().reason) : "";
    const talus_stats stats = reader_.stats().value_or(talus_stats{});
    Json status = status_json(reason, ended(), printable(run().policy), stats.step, stats.ms_step,
                              stats.timed != 0 ? stats.real_time_factor : 0.0);
    status["channels"] = channels_json(reader_);
    status["undecodable"] = undecodable_;
    status["slept"] = reader_.slept();
    status["woken"] = reader_.woken();
    hub_.set_status(json_text(status));
  }

  MomentReader reader_;
  std::int64_t run_id_;
  PageHub& hub_;
  const std::int64_t& undecodable_;  // messages of all runs
};

namespace {

template <int Dim>
class AssemblyOf final : public LiveRun::Assembly {
 public:
  using Assembly::Assembly;

 private:
  /// A shape that was not known yet begins the run again. An obstacle or a text that comes late tells the pages more of
  /// the same run.
  void show(const MomentReader& reader) override {
    const Moment& moment = reader.moment();
    const BodyStates<Dim> states = states_of<Dim>(moment);
    const std::vector<Pile<Dim>> piles = piles_of<Dim>(moment);
    if (form_ == nullptr || shape_form_ != reader.shape_form()) {
      const Scene<Dim> scene = known_scene(reader);
      form_ = frame_form(scene);
      encoder_.emplace(form_);
      shown_events_ = 0;
      hub().begin(head_of(reader, scene, states, piles), merge_blocks<Dim>);
    } else if (told_form_ != reader.form()) {
      hub().set_head(head_of(reader, known_scene(reader), states, piles));
    }
    shape_form_ = reader.shape_form();
    told_form_ = reader.form();
    if (moment.step != shown_step_) shown_events_ = 0;
    const std::vector<ObstaclePose<Dim>> obstacles = obstacles_of<Dim>(moment);
    const talus_stats stats = reader.stats().value_or(talus_stats{});
    hub().publish({.step = moment.step,
                   .block = encoder_->encode({.step = moment.step,
                                              .states = states,
                                              .events = std::span(moment.events).subspan(shown_events_),
                                              .piles = piles,
                                              .warnings = moment.warnings,
                                              .kinetic_energy = moment.kinetic_energy,
                                              .scene_events = moment.done,
                                              .drift_estimate = moment.drift.value_or(-1.0),
                                              .obstacles = obstacles,
                                              .ms_per_step = stats.timed != 0 ? stats.ms_step : -1.0}),
                   .contacts = {}});
    shown_step_ = moment.step;
    shown_events_ = moment.events.size();
  }

  Scene<Dim> known_scene(const MomentReader& reader) const {
    Scene<Dim> scene;
    scene.title = printable(run().scene);
    scene.seed = static_cast<std::uint64_t>(run().seed);
    scene.world.dt = run().dt;
    scene.world.ground.present = run().ground != 0;
    scene.world.ground.height = run().ground_height;
    for (const auto& [index, message] : reader.shapes()) scene.world.shapes.push_back(to_shape<Dim>(message));
    for (const auto& [index, message] : reader.obstacles())
      scene.world.obstacles.push_back({to_shape<Dim>(message), pose_of<Dim>(message)});
    return scene;
  }

  std::string head_of(const MomentReader& reader, const Scene<Dim>& scene, const BodyStates<Dim>& states,
                      const std::vector<Pile<Dim>>& piles) const {
    const PictureInput<Dim> now = {scene.world.shapes, states, piles, scene.world.obstacles,
                                   scene.world.ground, "",     ""};
    const RunTexts texts = {.name = short_id(run().run_id),
                            .backend = printable(run().backend),
                            .policy = printable(run().policy),
                            .version = printable(run().version),
                            .seed = scene.seed};
    Json head = run_head(scene, texts, form_->quantum, framing_of(now).box);
    head["kind"] = "head";
    head["steps"] = run().steps;
    head["steps_per_frame"] = nullptr;  // frames come as they are sent
    head["events"] = events_json(reader.events());
    head["tolerance"] = run().tolerance >= 0.0 ? Json(run().tolerance) : Json();
    return json_text(head);
  }

  /// By number; those not heard of are null.
  static Json events_json(const std::map<int, talus_event>& known) {
    Json events = Json::array();
    for (const auto& [number, message] : known) {
      while (std::ssize(events) < number) events.push_back(nullptr);
      events.push_back({{"text", printable(message.text)}, {"removes", message.removed}});
    }
    return events;
  }

  std::shared_ptr<const FrameForm<Dim>> form_;  // null: the run has not begun for the pages
  std::optional<FrameEncoder<Dim>> encoder_;
  std::int64_t shape_form_ = 0;  // of the run as it was begun
  std::int64_t told_form_ = 0;   // of the head that pages have
  std::int64_t shown_step_ = -1;
  std::size_t shown_events_ = 0;  // of that step
};

std::unique_ptr<LiveRun::Assembly> assemble(const talus_run& run, PageHub& hub, const std::int64_t& undecodable) {
  if (run.dimension == 2) return std::make_unique<AssemblyOf<2>>(run, hub, undecodable);
  return std::make_unique<AssemblyOf<3>>(run, hub, undecodable);
}

}  // namespace

LiveRun::LiveRun(PageHub& hub, const std::string& waiting) : hub_(hub) {
  hub_.set_status(json_text(status_json(waiting, false, "", 0, 0.0, 0.0)));
}

LiveRun::~LiveRun() = default;

template <class Message>
void LiveRun::hear(const Datagram& datagram, Message& message, Clock::time_point now) {
  if (!decode(datagram.bytes, message).empty()) {
    ++undecodable_;
    return;
  }
  const bool followed = assembly_ != nullptr && assembly_->is_of(message.run_id);
  if constexpr (std::is_same_v<Message, talus_run>) {
    const bool free = assembly_ == nullptr || assembly_->ended() || now - heard_ > silence;
    const bool anew = followed ? assembly_->is_restart(message) : free && message.phase != talus_run::END;
    if (anew) assembly_ = assemble(message, hub_, undecodable_);
  }
  if (assembly_ == nullptr || !assembly_->is_of(message.run_id)) return;
  heard_ = now;
  try {
    assembly_->take(message);
  } catch (const std::invalid_argument&) {  // a body of a shape that is not there, a shape without a volume
    ++undecodable_;
  }
}

void LiveRun::hear(const Datagram& datagram, Clock::time_point now) {
  with_message_of(datagram.channel, [&](auto message) { this->hear(datagram, message, now); });
}

}  // namespace talus
