#include "tools/record/record_stream.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "common/scene/read_scene.h"
#include "common/text/printable.h"
#include "lcmtypes/decode.h"
#include "lcmtypes/log_reader.h"
#include "lcmtypes/translate.h"
#include "tools/picture/framing.h"
#include "tools/record/recorded_run.h"
#include "tools/record/state_reader.h"
#include "tools/view/frame_stream.h"
#include "tools/view/page.h"
#include "tools/view/run_head.h"

namespace talus {
namespace {

/// Messages of a record become blocks, one for each frame of output.
template <int Dim>
class RecordEncoder {
 public:
  explicit RecordEncoder(const Scene<Dim>& scene)
      : scene_(scene),
        quantum_(quantum_of(scene)),
        states_(static_cast<int>(scene.bodies_asked()), static_cast<int>(scene.world.shapes.size())),
        encoder_(quantum_) {}

  void take(const LogEvent& event) {
    if (event.channel == name_of(Channel::run)) decode_and_take<talus_lcm::talus_run_v1>(event);
    if (event.channel == name_of(Channel::sleep)) decode_and_take<talus_lcm::talus_sleep_v1>(event);
    if (event.channel == name_of(Channel::piles)) decode_and_take<talus_lcm::talus_piles_v1>(event);
    if (event.channel == name_of(Channel::stats)) decode_and_take<talus_lcm::talus_stats_v2>(event);
    if (event.channel == name_of(Channel::bodies)) decode_and_take<talus_lcm::talus_bodies_v1>(event);
  }

  bool empty() const { return blocks_.empty(); }

  /// Head and blocks. `damaged`: bytes of the record that are no message.
  std::string finish(const std::string& name, std::uint64_t damaged) {
    texts_.name = name;
    texts_.seed = scene_.seed;
    if (damaged > 0 || undecodable_ > 0)
      texts_.damage =
          fmt::format("{} damaged bytes and {} messages not decodable: frames may be missing", damaged, undecodable_);
    const PictureInput<Dim> end = {
        scene_.world.shapes, states_.states(), piles_, scene_.world.obstacles, scene_.world.ground, "", ""};
    const Framing<Dim> framing = framing_of(end);
    return stream_bytes(run_head(scene_, texts_, quantum_, framing.box), blocks_);
  }

 private:
  template <class Message>
  void decode_and_take(const LogEvent& event) {
    Message message;
    if (decode<Message>(event.data, message).empty())
      take(message);
    else
      ++undecodable_;
  }

  void take(const talus_lcm::talus_run_v1& message) {
    texts_.backend = printable(message.backend);
    texts_.policy = printable(message.policy);
    texts_.version = printable(message.version);
    texts_.reason = printable(message.reason);
  }

  void take(const talus_lcm::talus_sleep_v1& message) {
    for (const SleepEvent& event : events_of(message)) {
      states_.note_event(event.body);
      events_.push_back(event);
    }
  }

  void take(const talus_lcm::talus_piles_v1& message) {
    if (message.part == 0) piles_.clear();
    for (const talus_lcm::talus_pile_v1& pile : message.piles) piles_.push_back(to_pile<Dim>(pile));
  }

  void take(const talus_lcm::talus_stats_v2& message) {
    kinetic_energy_ = message.kinetic_energy;
    warnings_ = warnings_of(message);
  }

  void take(const talus_lcm::talus_bodies_v1& message) {
    if (!states_.take(message) || states_.step() <= last_step_) return;
    last_step_ = states_.step();
    blocks_ += encoder_.encode({.step = last_step_,
                                .states = states_.states(),
                                .events = events_,
                                .piles = piles_,
                                .warnings = warnings_,
                                .kinetic_energy = kinetic_energy_});
    events_.clear();
  }

  const Scene<Dim>& scene_;
  Quantum quantum_;
  StateReader<Dim> states_;
  FrameEncoder<Dim> encoder_;
  RunTexts texts_;
  std::vector<SleepEvent> events_;  // since the last frame
  std::vector<Pile<Dim>> piles_;
  std::vector<Warning> warnings_;
  double kinetic_energy_ = 0.0;
  std::int64_t last_step_ = 0;
  std::int64_t undecodable_ = 0;
  std::string blocks_;
};

}  // namespace

std::string record_stream(const std::filesystem::path& folder) {
  const AnyScene scene = scene_of_run(folder);
  LogReader log((folder / "run.lcm").string());
  return std::visit(
      [&]<int Dim>(const Scene<Dim>& of_dimension) {
        RecordEncoder<Dim> encoder(of_dimension);
        for (LogEvent event; log.next(event);) encoder.take(event);
        if (encoder.empty()) throw no_frame(folder, log.damage().bytes);
        return encoder.finish(name_of_run(folder), log.damage().bytes);
      },
      scene);
}

}  // namespace talus
