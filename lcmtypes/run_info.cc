#include "lcmtypes/run_info.h"

#include <fmt/core.h>
#include <talus/version.h>
#include <unistd.h>

#include <chrono>
#include <string_view>

#include "common/math/hash.h"
#include "common/math/in_space.h"

namespace talus {
namespace {

/// The lowest 62 bits of its hash: ids are positive, and differences of two do not overflow.
std::int64_t id_of(std::string_view text) {
  Fnv1a hash;
  hash.add(text);
  return static_cast<std::int64_t>(hash.value() & 0x3FFFFFFFFFFFFFFFU);
}

std::string settings(const RunInfo& info) {
  return fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}", info.scene, info.backend, info.solver.kind, info.policy,
                     info.seed, info.dimension, info.dt, info.steps);
}

}  // namespace

template <int Dim>
RunInfo run_info(const Scene<Dim>& scene, const std::string& scene_name, const std::string& backend) {
  return {.scene = scene_name,
          .title = scene.title,
          .backend = backend,
          .policy = scene.policy.kind,
          .version = TALUS_VERSION,
          .seed = scene.seed,
          .dimension = Dim,
          .dt = scene.world.dt,
          .steps = scene.steps(),
          .tolerance = scene.policy.tolerance(),
          .score_threshold = scene.policy.kind == "paper" ? std::optional(scene.policy.paper.tau) : std::nullopt,
          .gravity = in_space(scene.world.gravity_vector()),
          .ground = scene.world.ground,
          .sides = {in_space(scene.world.periodic().low), in_space(scene.world.periodic().period)},
          .solver = scene.world.solver};
}

template RunInfo run_info(const Scene<2>&, const std::string&, const std::string&);
template RunInfo run_info(const Scene<3>&, const std::string&, const std::string&);

std::int64_t record_id(const RunInfo& info) { return id_of(settings(info)); }

std::int64_t live_id(const RunInfo& info) {
  const auto now = std::chrono::system_clock::now().time_since_epoch().count();
  return id_of(fmt::format("{}\n{}\n{}", settings(info), now, getpid()));
}

std::string short_id(std::int64_t run_id) {
  return fmt::format("{:08x}", static_cast<std::uint64_t>(run_id) & 0xFFFFFFFFU);
}

}  // namespace talus
