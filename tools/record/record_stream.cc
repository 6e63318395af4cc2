#include "tools/record/record_stream.h"

#include <fmt/format.h>

#include <vector>

#include "common/scene/read_scene.h"
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
  RunTexts texts = {name, walk.run.backend, walk.run.policy, walk.run.version, seed, walk.run.reason};
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
  BodyStates<Dim> last;
  std::vector<Pile<Dim>> piles;
  const WalkResult walk = walk_record<Dim>(scene, log, [&](const RecordedFrame<Dim>& frame) {
    const auto obstacles = moving_poses(scene.world.obstacles, scene.movers, frame.time);
    blocks += encoder.encode({.step = frame.step,
                              .states = frame.states,
                              .events = frame.events,
                              .piles = frame.piles,
                              .warnings = frame.warnings,
                              .kinetic_energy = frame.kinetic_energy,
                              .scene_events = frame.scene_events,
                              .drift_estimate = frame.drift_estimate,
                              .obstacles = obstacles});
    last = frame.states;
    piles.assign(frame.piles.begin(), frame.piles.end());
  });
  if (blocks.empty()) throw no_frame(folder, walk.damage.bytes);
  const PictureInput<Dim> end = {scene.world.shapes, last, piles, scene.world.obstacles, scene.world.ground, "", ""};
  const RunTexts texts = texts_of(name_of_run(folder), scene.seed, walk);
  return stream_bytes(run_head(scene, texts, form->quantum, framing_of(end).box), blocks);
}

}  // namespace

std::string record_stream(const std::filesystem::path& folder) {
  const AnyScene scene = scene_of_run(folder);
  return std::visit([&](const auto& of_dimension) { return stream_of(of_dimension, folder); }, scene);
}

}  // namespace talus
