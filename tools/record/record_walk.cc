#include "tools/record/record_walk.h"

#include "lcmtypes/decode.h"
#include "lcmtypes/translate.h"
#include "tools/record/state_reader.h"

namespace talus {
namespace {

template <int Dim>
class Walk {
 public:
  Walk(const Scene<Dim>& scene, const std::function<void(const RecordedFrame<Dim>&)>& visit)
      : dt_(scene.world.dt),
        states_(static_cast<int>(scene.bodies_asked()), static_cast<int>(scene.world.shapes.size())),
        visit_(visit) {}

  void take(const LogEvent& event) {
    if (event.channel == name_of(Channel::sleep)) decode_and_take<talus_lcm::talus_sleep_v1>(event);
    if (event.channel == name_of(Channel::bodies)) decode_and_take<talus_lcm::talus_bodies_v1>(event);
  }

  std::int64_t undecodable() const { return undecodable_; }

 private:
  template <class Message>
  void decode_and_take(const LogEvent& event) {
    Message message;
    if (decode<Message>(event.data, message).empty())
      take(message);
    else
      ++undecodable_;
  }

  void take(const talus_lcm::talus_sleep_v1& message) {
    for (const SleepEvent& event : events_of(message)) {
      states_.note_event(event.body);
      events_.push_back(event);
    }
  }

  void take(const talus_lcm::talus_bodies_v1& message) {
    if (!states_.take(message) || states_.step() <= last_step_) return;
    last_step_ = states_.step();
    cause_.resize(states_.states().size(), -1);
    for (const SleepEvent& event : events_)
      if (event.body < states_.states().size()) cause_[event.body] = static_cast<std::int8_t>(event.cause);
    visit_({.step = last_step_,
            .time = dt_ * static_cast<double>(last_step_),
            .states = states_.states(),
            .unknown = states_.unknown(),
            .cause = cause_,
            .events = events_});
    events_.clear();
  }

  double dt_;
  StateReader<Dim> states_;
  const std::function<void(const RecordedFrame<Dim>&)>& visit_;
  std::vector<SleepEvent> events_;  // since the last frame
  std::vector<std::int8_t> cause_;
  std::int64_t last_step_ = 0;
  std::int64_t undecodable_ = 0;
};

}  // namespace

template <int Dim>
WalkDamage walk_record(const Scene<Dim>& scene, LogReader& log,
                       const std::function<void(const RecordedFrame<Dim>&)>& visit) {
  Walk<Dim> walk(scene, visit);
  for (LogEvent event; log.next(event);) walk.take(event);
  return {log.damage().bytes, walk.undecodable()};
}

template WalkDamage walk_record(const Scene<2>&, LogReader&, const std::function<void(const RecordedFrame<2>&)>&);
template WalkDamage walk_record(const Scene<3>&, LogReader&, const std::function<void(const RecordedFrame<3>&)>&);

}  // namespace talus
