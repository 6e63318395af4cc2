#include "common/solver/regions.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/world/team.h"

namespace talus {
namespace {

constexpr int bodies_of_a_region = bodies_to_share / 2;  // at least
constexpr int bins = 1024;
constexpr float deviations = 3.0F;  // bodies farther from the middle are in the outermost bins [standard deviations]

}  // namespace

template <int Dim>
void Regions<Dim>::divide(std::span<const SolverBody<Dim>> bodies) {
  const auto moving = static_cast<int>(std::ranges::count_if(bodies, &SolverBody<Dim>::moves));
  count_ = std::clamp(moving / bodies_of_a_region, 1, most);
  region_.assign(bodies.size(), 0);
  if (count_ == 1) return;
  VecF<Dim> sum = VecF<Dim>::Zero();
  VecF<Dim> squares = VecF<Dim>::Zero();
  for (const SolverBody<Dim>& body : bodies) {
    if (!body.moves) continue;
    sum += body.position;
    squares += body.position.cwiseAbs2();
  }
  const VecF<Dim> mean = sum / static_cast<float>(moving);
  const VecF<Dim> variance = squares / static_cast<float>(moving) - mean.cwiseAbs2();
  Eigen::Index axis = 0;
  const float width = deviations * std::sqrt(std::max(variance.maxCoeff(&axis), 0.0F));
  const auto bin_of = [&](const SolverBody<Dim>& body) {
    const float share = width > 0.0F ? (body.position[axis] - mean[axis]) / width : 0.0F;  // -1 to 1
    return static_cast<int>(std::clamp(0.5F * (share + 1.0F), 0.0F, 1.0F) * static_cast<float>(bins - 1));
  };
  std::array<int, bins> up_to{};  // bodies in this bin and below
  for (const SolverBody<Dim>& body : bodies)
    if (body.moves) ++up_to[bin_of(body)];
  for (int i = 1; i < bins; ++i) up_to[i] += up_to[i - 1];
  for (std::size_t slot = 0; slot < bodies.size(); ++slot)
    if (bodies[slot].moves) region_[slot] = std::min(count_ - 1, (up_to[bin_of(bodies[slot])] - 1) * count_ / moving);
}

template class Regions<2>;
template class Regions<3>;

}  // namespace talus
