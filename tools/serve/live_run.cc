#include "tools/serve/live_run.h"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "common/scene/scene.h"
#include "common/text/printable.h"
#include "lcmtypes/decode.h"
#include "lcmtypes/run_info.h"
#include "lcmtypes/translate.h"
#include "tools/monitor/run_view.h"
#include "tools/output/json_text.h"
#include "tools/picture/framing.h"
#include "tools/record/state_reader.h"
#include "tools/view/frame_stream.h"
#include "tools/view/merge_blocks.h"
#include "tools/view/run_head.h"

namespace talus {
namespace {

using Json = nlohmann::ordered_json;
using talus_lcm::talus_bodies_v1;
using talus_lcm::talus_event_v2;
using talus_lcm::talus_obstacles_v1;
using talus_lcm::talus_piles_v2;
using talus_lcm::talus_run_v1;
using talus_lcm::talus_shapes_v1;
using talus_lcm::talus_sleep_v1;
using talus_lcm::talus_stats_v2;

// These bound what a forged message costs.
constexpr int most_live_bodies = 1'000'000;
constexpr int most_live_events = 10'000;
constexpr std::size_t most_waiting_events = 1'000'000;  // for a frame
constexpr auto silence = std::chrono::seconds(2);

/// Of each channel on which messages came or were lost: its name, how many came, how many were lost.
Json channels_json(const RunView& heard) {
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
  Assembly(const talus_run_v1& run, PageHub& hub, const std::int64_t& undecodable)
      : run_(run), hub_(hub), undecodable_(undecodable) {}
  virtual ~Assembly() = default;

  bool is_of(std::int64_t run_id) const { return run_.run_id == run_id; }
  bool ended() const { return run_.phase == talus_run_v1::END; }

  /// Counts a message. Each must be counted before it is taken.
  template <class Message>
  void count(const Message& message) {
    heard_.take(message);
  }

  void take(const talus_run_v1& message) {
    run_ = message;
    show_status();
  }
  void take(const talus_stats_v2& message) {
    stats_ = message;
    warnings_ = warnings_of(message);
    show_status();
  }
  void take(const talus_sleep_v1& message) {
    std::vector<SleepEvent> events = events_of(message);
    std::erase_if(events, [](const SleepEvent& event) { return event.body >= most_live_bodies; });
    for (const SleepEvent& event : events) note_event(event.body);
    if (events_.size() + events.size() > most_waiting_events) events_.clear();
    events_.insert(events_.end(), events.begin(), events.end());
  }
  virtual void take(const talus_shapes_v1& message) = 0;
  virtual void take(const talus_piles_v2& message) = 0;
  virtual void take(const talus_bodies_v1& message) = 0;
  virtual void take(const talus_event_v2& message) = 0;
  virtual void take(const talus_obstacles_v1& message) = 0;
  void take(const talus_lcm::talus_scene_v1& /*of records*/) {}

 protected:
  virtual void note_event(BodyIndex body) = 0;

  void show_status() {
    const std::string reason = ended() && run_.reason != "finished" ? printable(run_.reason) : "";
    Json status = status_json(reason, ended(), printable(run_.policy), stats_.step, stats_.ms_step,
                              stats_.timed != 0 ? stats_.real_time_factor : 0.0);
    status["channels"] = channels_json(heard_);
    status["undecodable"] = undecodable_;
    status["slept"] = heard_.slept();
    status["woken"] = heard_.woken();
    hub_.set_status(json_text(status));
  }

  talus_run_v1 run_;
  talus_stats_v2 stats_{};
  std::vector<Warning> warnings_;
  std::vector<SleepEvent> events_;  // since the last frame
  PageHub& hub_;

 private:
  RunView heard_;
  const std::int64_t& undecodable_;  // messages of all runs
};

namespace {

template <int Dim>
class AssemblyOf final : public LiveRun::Assembly {
 public:
  using Assembly::Assembly;

  /// A shape that is not known yet begins the run again. Of an obstacle that moves the message has the present pose.
  void take(const talus_shapes_v1& message) override {
    if (message.dimension != Dim) return;
    auto& known = message.obstacle != 0 ? obstacles_ : shapes_;
    const auto before = known.find(message.index);
    const bool news = before == known.end() || before->second.values != message.values;
    if (!news && message.obstacle != 0 && !std::ranges::equal(message.pose, before->second.pose))
      moved_[message.index] = pose_of<Dim>(message);
    known[message.index] = message;
    if (!news) return;
    if (message.obstacle != 0)
      tell_head();
    else
      form_.reset();
  }

  /// Only of obstacles that are known: a forged message can name any number of others.
  void take(const talus_obstacles_v1& message) override {
    for (const ObstaclePose<Dim>& each : poses_of<Dim>(message))
      if (obstacles_.contains(each.obstacle)) moved_[each.obstacle] = each.pose;
  }

  void take(const talus_piles_v2& message) override {
    if (message.part == 0) piles_.clear();
    for (const talus_lcm::talus_pile_v2& pile : message.piles) piles_.push_back(to_pile<Dim>(pile));
  }

  /// All events are sent each second, so a text comes late only where messages were lost.
  void take(const talus_event_v2& message) override {
    if (message.number >= most_live_events) return;
    const auto [known, news] = texts_.try_emplace(message.number, message);
    if (news) tell_head();
    if (message.happened_step >= 0 && (news || known->second.happened_step < 0))
      done_events_.push_back({message.number, message.happened_time});
    known->second = message;
  }

  void take(const talus_bodies_v1& message) override {
    if (!states_ && !all_shapes()) return;
    if (!states_) states_.emplace(most_live_bodies, shapes_.begin()->second.total);
    if (!states_->take(message)) return;
    if (!form_ && !begin()) return;
    std::vector<ObstaclePose<Dim>> moved;
    for (const auto& [obstacle, pose] : moved_) moved.push_back({obstacle, pose});
    const double ms = stats_.timed != 0 ? stats_.ms_step : -1.0;
    hub_.publish({.step = states_->step(),
                  .block = encoder_->encode({.step = states_->step(),
                                             .states = states_->states(),
                                             .events = events_,
                                             .piles = piles_,
                                             .warnings = warnings_,
                                             .kinetic_energy = stats_.kinetic_energy,
                                             .scene_events = done_events_,
                                             .drift_estimate = drift_estimate(),
                                             .obstacles = moved,
                                             .ms_per_step = ms}),
                  .contacts = {}});
    events_.clear();
  }

 private:
  void note_event(BodyIndex body) override {
    if (states_) states_->note_event(body);
  }

  double drift_estimate() const { return stats_.run_id == run_.run_id ? stats_.drift_estimate : -1.0; }

  static bool complete(const std::map<int, talus_shapes_v1>& known) {
    return known.empty() || static_cast<int>(known.size()) == known.begin()->second.total;
  }
  bool all_shapes() const { return !shapes_.empty() && complete(shapes_) && complete(obstacles_); }

  /// Begins the run for the pages; false where shapes are missing still.
  bool begin() {
    if (!all_shapes()) return false;
    const Scene<Dim> scene = known_scene();
    form_ = frame_form(scene);
    encoder_.emplace(form_);
    hub_.begin(head_of(scene), merge_blocks<Dim>);
    return true;
  }

  /// More is known of a run that has begun.
  void tell_head() {
    if (form_ && all_shapes()) hub_.set_head(head_of(known_scene()));
  }

  Scene<Dim> known_scene() const {
    Scene<Dim> scene;
    scene.title = printable(run_.scene);
    scene.seed = static_cast<std::uint64_t>(run_.seed);
    scene.world.dt = run_.dt;
    scene.world.gravity = run_.gravity;
    scene.world.ground.present = run_.ground != 0;
    scene.world.ground.height = run_.ground_height;
    for (const auto& [index, message] : shapes_) scene.world.shapes.push_back(to_shape<Dim>(message));
    for (const auto& [index, message] : obstacles_)
      scene.world.obstacles.push_back({to_shape<Dim>(message), pose_of<Dim>(message)});
    return scene;
  }

  std::string head_of(const Scene<Dim>& scene) const {
    const PictureInput<Dim> now = {
        scene.world.shapes, states_->states(), piles_, scene.world.obstacles, scene.world.ground, "", ""};
    const RunTexts texts = {.name = short_id(run_.run_id),
                            .backend = printable(run_.backend),
                            .policy = printable(run_.policy),
                            .version = printable(run_.version),
                            .seed = scene.seed};
    Json head = run_head(scene, texts, form_->quantum, framing_of(now).box);
    head["kind"] = "head";
    head["steps"] = run_.steps;
    head["steps_per_frame"] = nullptr;  // frames come as they are sent
    head["events"] = events_json();
    head["tolerance"] = nullptr;  // not in the messages
    return json_text(head);
  }

  /// By number; those not heard of are null.
  Json events_json() const {
    Json events = Json::array();
    for (const auto& [number, message] : texts_) {
      while (std::ssize(events) < number) events.push_back(nullptr);
      events.push_back({{"text", printable(message.text)}, {"removes", message.removed}});
    }
    return events;
  }

  std::map<int, talus_shapes_v1> shapes_;     // by index
  std::map<int, talus_shapes_v1> obstacles_;  // by index
  std::map<int, Pose<Dim>> moved_;            // the last poses of those that have moved
  std::map<int, talus_event_v2> texts_;       // events of the scene, by number
  std::vector<DoneEvent> done_events_;        // as heard
  std::vector<Pile<Dim>> piles_;
  std::optional<StateReader<Dim>> states_;      // once the shapes are known
  std::shared_ptr<const FrameForm<Dim>> form_;  // null: the run has not begun for the pages
  std::optional<FrameEncoder<Dim>> encoder_;
};

std::unique_ptr<LiveRun::Assembly> assemble(const talus_run_v1& run, PageHub& hub, const std::int64_t& undecodable) {
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
  if constexpr (std::is_same_v<Message, talus_run_v1>) {
    const bool free = assembly_ == nullptr || assembly_->ended() || now - heard_ > silence;
    if (!followed && free && message.phase != talus_run_v1::END) assembly_ = assemble(message, hub_, undecodable_);
  }
  if (assembly_ == nullptr || !assembly_->is_of(message.run_id)) return;
  heard_ = now;
  assembly_->count(message);
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
