#include "tools/record/recorded_run.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "common/scene/read_scene.h"
#include "lcmtypes/decode.h"
#include "lcmtypes/log_reader.h"
#include "tools/record/state_reader.h"

namespace talus {

namespace {

template <class Message>
Message decoded(const LogEvent& event) {
  Message message;
  const std::string_view wrong = decode<Message>(event.data, message);
  if (!wrong.empty()) throw std::invalid_argument(fmt::format("run.lcm, event {}: {}", event.number, wrong));
  return message;
}

template <int Dim>
int bodies_of(const Scene<Dim>& scene) {
  int bodies = 0;
  for (const Source<Dim>& source : scene.sources) bodies += source.count;
  return bodies;
}

template <int Dim>
class RunReader {
 public:
  explicit RunReader(const Scene<Dim>& scene)
      : run_(scene), states_(bodies_of(scene), static_cast<int>(scene.world.shapes.size())) {}

  void take(const LogEvent& event) {
    if (event.channel == name_of(Channel::run)) take(decoded<talus_lcm::talus_run_v1>(event));
    if (event.channel == name_of(Channel::sleep)) take(decoded<talus_lcm::talus_sleep_v1>(event));
    if (event.channel == name_of(Channel::bodies)) take(decoded<talus_lcm::talus_bodies_v1>(event));
  }

  RecordedRun<Dim> finish() {
    run_.last = states_.states_with_velocities(run_.scene.world.dt);
    run_.last_step = states_.step();
    return std::move(run_);
  }

 private:
  void take(const talus_lcm::talus_run_v1& message) {
    if (message.dimension != Dim) {
      throw std::invalid_argument(
          fmt::format("run.lcm is of a run in {}D: must be {}D as scene.toml", message.dimension, Dim));
    }
    run_.backend = message.backend;
    run_.policy = message.policy;
    run_.reason = message.reason;
  }

  void take(const talus_lcm::talus_sleep_v1& message) {
    for (std::size_t i = 0; i < message.body.size(); ++i) {
      run_.events.push_back({.step = message.step,
                             .body = message.body[i],
                             .pile = message.pile[i],
                             .layer = message.layer[i],
                             .woke = message.woke[i] != 0,
                             .cause = static_cast<SleepCause>(message.cause[i]),
                             .score = message.score[i]});
    }
  }

  void take(const talus_lcm::talus_bodies_v1& message) {
    if (!states_.take(message)) return;
    const std::int64_t step = states_.step();
    const bool again = run_.frames.frames() > 0 && step <= run_.frames.step(run_.frames.frames() - 1);
    if (step % run_.frames.steps_per_frame() == 0 && !again) run_.frames.append(states_.states(), step);
  }

  RecordedRun<Dim> run_;
  StateReader<Dim> states_;
};

}  // namespace

AnyRecordedRun read_run(const std::filesystem::path& folder) {
  for (const char* name : {"scene.toml", "run.lcm"}) {
    if (std::filesystem::is_regular_file(folder / name)) continue;
    throw std::invalid_argument(
        fmt::format("{}: must be a folder that `talus run` left, but it has no {}", folder.string(), name));
  }
  const AnyScene scene = read_scene(folder / "scene.toml");
  return std::visit(
      [&]<int Dim>(const Scene<Dim>& of_dimension) -> AnyRecordedRun {
        RunReader<Dim> reader(of_dimension);
        LogReader log((folder / "run.lcm").string());
        for (LogEvent event; log.next(event);) reader.take(event);
        RecordedRun<Dim> run = reader.finish();
        run.name = folder.filename().empty() ? folder.parent_path().filename().string() : folder.filename().string();
        run.damaged_bytes = log.damage().bytes;
        return run;
      },
      scene);
}

}  // namespace talus
