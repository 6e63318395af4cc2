#include "tools/record/record_stream.h"

#include <fmt/format.h>

#include <vector>

#include "common/scene/read_scene.h"
#include "common/text/printable.h"
#include "lcmtypes/log_reader.h"
#include "tools/picture/framing.h"
#include "tools/record/record_file.h"
#include "tools/record/record_walk.h"
#include "tools/record/recorded_run.h"
#include "tools/view/frame_stream.h"
#include "tools/view/page.h"
#include "tools/view/run_head.h"

namespace talus {
namespace {

RunTexts texts_of(const std::string& name, std::uint64_t seed, const WalkResult& walk) {
  RunTexts texts = {name, printable(walk.run.backend), printable(walk.run.policy), printable(walk.run.version),
                    seed, printable(walk.run.reason)};
  if (!walk.damage.none())
    texts.damage = fmt::format("{} damaged bytes and {} messages not decodable: frames may be missing",
                               walk.damage.bytes, walk.damage.undecodable);
  return texts;
}

template <int Dim>
std::string stream_of(const Scene<Dim>& scene, const std::filesystem::path& folder) {
  LogReader log(record_file(folder).string());
  const auto form = frame_form(scene);
  FrameEncoder<Dim> encoder(form);
  std::string blocks;
  const WalkResult walk = walk_record<Dim>(scene, log, folder, [&](const Moment& moment) {
    const BodyStates<Dim> states = states_of<Dim>(moment);
    const std::vector<Pile<Dim>> piles = piles_of<Dim>(moment);
    const auto obstacles = moving_poses(scene.world.obstacles, scene.movers, moment.time);
    blocks += encoder.encode({.step = moment.step,
                              .states = states,
                              .events = moment.events,
                              .piles = piles,
                              .warnings = moment.warnings,
                              .kinetic_energy = moment.kinetic_energy,
                              .scene_events = moment.done,
                              .drift_estimate = moment.drift.value_or(-1.0),
                              .obstacles = obstacles});
  });
  if (blocks.empty()) throw no_frame(folder, walk.damage.bytes);
  const BodyStates<Dim> states = states_of<Dim>(walk.last);
  const std::vector<Pile<Dim>> piles = piles_of<Dim>(walk.last);
  const PictureInput<Dim> end = {scene.world.shapes, states, piles, scene.world.obstacles, scene.world.ground, "", ""};
  const RunTexts texts = texts_of(name_of_run(folder), scene.seed, walk);
  return stream_bytes(run_head(scene, texts, form->quantum, framing_of(end).box), blocks);
}

}  // namespace

std::string record_stream(const std::filesystem::path& folder) {
  const AnyScene scene = scene_of_run(folder);
  return std::visit([&](const auto& of_dimension) { return stream_of(of_dimension, folder); }, scene);
}

}  // namespace talus
