#include "common/simulation/make_policy.h"

#include <stdexcept>

#include "common/policy/adaptive/adaptive_policy.h"
#include "common/policy/paper_policy.h"
#include "common/scene/typical_body.h"

namespace talus {

template <int Dim>
std::unique_ptr<SleepPolicy<Dim>> make_policy(const Scene<Dim>& scene) {
  const PolicyParams& params = scene.policy;
  if (params.kind == "full" || params.kind == "engine") return std::make_unique<NoPolicy<Dim>>();
  if (params.kind == "paper") return std::make_unique<PaperPolicy<Dim>>(params.paper, scene.world);
  if (params.kind == "adaptive") {
    return std::make_unique<AdaptivePolicy<Dim>>(params.adaptive, scene.world, typical_body(scene));
  }
  throw std::invalid_argument("policy.kind = \"" + params.kind + "\": must be full, engine, paper or adaptive");
}

template std::unique_ptr<SleepPolicy<2>> make_policy(const Scene<2>&);
template std::unique_ptr<SleepPolicy<3>> make_policy(const Scene<3>&);

}  // namespace talus
