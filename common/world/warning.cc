#include "common/world/warning.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace talus {
namespace {

constexpr std::array<std::string_view, 9> kind_names = {"below_ground", "outside_world", "energy",
                                                        "speed_limit",  "spin_limit",    "not_appeared",
                                                        "overlap",      "passed",        "drift"};

/// What is the case, with the value.
std::string finding(const Warning& warning) {
  switch (warning.kind) {
    case WarningKind::below_ground:
      return fmt::format("the centre is {:.3g} m below the ground", warning.value);
    case WarningKind::outside_world:
      return fmt::format("a coordinate is {:.6g} m, outside of the range of positions", warning.value);
    case WarningKind::energy:
      return fmt::format("{:.3g} J more than sources, gravity and policy gave", warning.value);
    case WarningKind::speed_limit:
      return fmt::format("the speed is {:.4g} m/s, at the engine's limit", warning.value);
    case WarningKind::spin_limit:
      return fmt::format("the spin is {:.4g} rad/s, at the engine's limit", warning.value);
    case WarningKind::not_appeared:
      return fmt::format("{:.0f} bodies that were due never appeared: their source found no free place", warning.value);
    case WarningKind::overlap:
      return fmt::format("the overlap with a body, the ground or an obstacle is {:.2g} D and lasts", warning.value);
    case WarningKind::passed:
      return fmt::format("in a step of {:.2g} m it got through another body or an obstacle, or deep into it",
                         warning.value);
    case WarningKind::drift:
      return fmt::format("once woken, the sleeping bodies move by {:.2g} D on average, farther than the tolerance",
                         warning.value);
  }
  return {};
}

std::string_view remedy(WarningKind kind) {
  switch (kind) {
    case WarningKind::below_ground:
      return "raise world.steps_per_second, or lower world.gravity";
    case WarningKind::outside_world:
      return "give the scene a ground, or walls that the bodies cannot leave";
    case WarningKind::energy:
      return "lower restitution, or raise world.solver.restitution_threshold or world.steps_per_second";
    case WarningKind::speed_limit:
      return "lower the fall or the source's velocity, or raise world.steps_per_second";
    case WarningKind::spin_limit:
      return "raise world.steps_per_second or the size of the bodies";
    case WarningKind::not_appeared:
      return "raise the source's position or spread, or set ride_above";
    case WarningKind::overlap:
      return "raise world.steps_per_second, or lower the fall or the depth of the pile";
    case WarningKind::passed:
      return "raise world.steps_per_second, or lower the speeds of fast and the density of heavy bodies";
    case WarningKind::drift:
      return "lower policy.adaptive.tolerance, or simulate for longer so that the bodies come to rest";
  }
  return {};
}

}  // namespace

std::string_view to_string(WarningKind kind) { return kind_names[static_cast<std::size_t>(kind)]; }

std::string advice(const Warning& warning) {
  const std::string body = warning.body < 0 ? "" : fmt::format(", body {}", warning.body);
  return fmt::format("step {}{}: {}; {}", warning.step, body, finding(warning), remedy(warning.kind));
}

std::string account(const Warning& warning) {
  if (warning.kind == WarningKind::not_appeared || warning.kind == WarningKind::drift) return finding(warning);
  if (warning.kind == WarningKind::energy) return fmt::format("since step {} {}", warning.step, finding(warning));
  return fmt::format("{} {} since step {}, at worst {}", warning.bodies, warning.bodies == 1 ? "body" : "bodies",
                     warning.step, finding(warning));
}

Warning* WarningList::find(WarningKind kind) {
  const auto known = std::ranges::find(warnings_, kind, &Warning::kind);
  return known == warnings_.end() ? nullptr : &*known;
}

void WarningList::note(WarningKind kind, BodyIndex body, std::int64_t step, double value) {
  if (find(kind) == nullptr) warnings_.push_back({.kind = kind, .step = step, .body = body});
  Warning& known = *find(kind);
  if (std::ssize(seen_) <= body) seen_.resize(body + 1, 0);
  const auto bit = static_cast<std::uint8_t>(1U << static_cast<unsigned>(kind));
  if ((seen_[body] & bit) == 0) ++known.bodies;
  seen_[body] |= bit;
  known.value = std::max(known.value, value);
}

}  // namespace talus
