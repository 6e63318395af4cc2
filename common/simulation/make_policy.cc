#include "common/simulation/make_policy.h"

#include "common/policy/adaptive/adaptive_policy.h"
#include "common/policy/paper_policy.h"
#include "common/scene/policy_fields.h"
#include "common/scene/scene_fields.h"
#include "common/scene/typical_body.h"

namespace talus {

template <int Dim>
std::unique_ptr<SleepPolicy<Dim>> make_policy(const Scene<Dim>& scene) {
  const PolicyParams& params = scene.policy;
  check_fields(params, policy_fields, "policy");
  if (params.kind == "paper") {
    check_fields(params.paper, paper_fields, "policy");
    return std::make_unique<PaperPolicy<Dim>>(params.paper, scene.world);
  }
  if (params.kind == "adaptive") {
    check_fields(params.adaptive, adaptive_fields, "policy.adaptive");
    return std::make_unique<AdaptivePolicy<Dim>>(params.adaptive, scene.world, typical_body(scene));
  }
  return std::make_unique<NoPolicy<Dim>>();  // full and engine
}

template std::unique_ptr<SleepPolicy<2>> make_policy(const Scene<2>&);
template std::unique_ptr<SleepPolicy<3>> make_policy(const Scene<3>&);

}  // namespace talus
