#include "lcmtypes/piles_message.h"

#include <algorithm>

#include "lcmtypes/message.h"

namespace talus {

using talus_lcm::talus_layer;
using talus_lcm::talus_pile;
using talus_lcm::talus_piles;

namespace {

constexpr std::size_t layer_bytes = fixed_bytes(layout<talus_layer>);
constexpr std::size_t pile_bytes = fixed_bytes(layout<talus_pile>);  // without its layers
static_assert(pile_bytes + max_layers * layer_bytes <= room<talus_piles>);

// A layer of almost no volume at the apex, with a stream of bodies above it, reaches thousands.
constexpr float max_density = 1e9F;

talus_layer to_layer(const Layer& layer) {
  talus_layer message{};
  message.bottom = static_cast<float>(layer.bottom);
  message.top = static_cast<float>(layer.top);
  message.radius = static_cast<float>(std::max(0.0, layer.radius));
  message.capacity = static_cast<float>(layer.capacity);
  message.density = static_cast<float>(layer.density());
  message.sleep_density = static_cast<float>(layer.thresholds.sleep);
  message.wake_density = static_cast<float>(layer.thresholds.wake);
  message.count = layer.count;
  message.sleeping = layer.sleeping;
  return message;
}

talus_pile to_pile(const Pile<3>& pile) {
  talus_pile message{};
  std::copy(pile.centre.begin(), pile.centre.end(), message.centre);
  message.alpha = pile.alpha;
  message.structure_size = pile.structure_size;
  message.lift = pile.lift;
  message.height = pile.height;
  message.radius = pile.radius;
  message.occupation_ratio = pile.occupation_ratio();
  message.merged_into = pile.merged_into;
  message.layer_total = static_cast<std::int32_t>(pile.layers.size());
  for (const Layer& layer : std::span(pile.layers).first(std::min(pile.layers.size(), max_layers)))
    message.layers.push_back(to_layer(layer));
  message.layer_count = static_cast<std::int32_t>(message.layers.size());
  return message;
}

bool threshold_holds(double threshold) { return threshold >= 0.0 || threshold == -1.0; }

bool layer_holds(const talus_layer& layer) {
  return threshold_holds(layer.sleep_density) && threshold_holds(layer.wake_density) && layer.bottom >= 0 &&
         layer.top >= 0 && layer.radius >= 0 && layer.capacity >= 0 && layer.density >= 0 &&
         layer.density <= max_density && layer.sleeping >= 0 && layer.sleeping <= layer.count;
}

bool pile_holds(const talus_pile& pile) {
  return pile.structure_size >= 0 && pile.lift >= 0 && pile.height >= 0 && pile.radius >= 0 &&
         pile.occupation_ratio >= 0 && pile.merged_into >= -1 && pile.layer_count <= pile.layer_total &&
         std::all_of(pile.layers.begin(), pile.layers.end(), layer_holds);
}

}  // namespace

std::vector<talus_piles> to_piles(std::span<const Pile<3>> piles) {
  std::vector<talus_piles> messages(1);
  std::size_t used = 0;
  for (std::size_t i = 0; i < piles.size(); ++i) {
    talus_pile pile = to_pile(piles[i]);
    const std::size_t bytes = pile_bytes + pile.layers.size() * layer_bytes;
    if (used + bytes > room<talus_piles>) {
      messages.emplace_back().first_pile = static_cast<std::int32_t>(i);
      used = 0;
    }
    used += bytes;
    messages.back().piles.push_back(std::move(pile));
  }
  for (talus_piles& message : messages) {
    message.pile_total = static_cast<std::int32_t>(piles.size());
    message.pile_count = static_cast<std::int32_t>(message.piles.size());
  }
  return numbered(std::move(messages));
}

Pile<3> pile_of(const talus_pile& message) {
  Pile<3> pile;
  pile.centre = {message.centre[0], message.centre[1], message.centre[2]};
  pile.alpha = message.alpha;
  pile.structure_size = message.structure_size;
  pile.lift = message.lift;
  pile.height = message.height;
  pile.radius = message.radius;
  pile.merged_into = message.merged_into;
  for (const talus_layer& layer : message.layers) {
    pile.layers.push_back({.bottom = layer.bottom,
                           .top = layer.top,
                           .radius = layer.radius,
                           .capacity = layer.capacity,
                           .count = layer.count,
                           .sleeping = layer.sleeping,
                           .thresholds = {.sleep = layer.sleep_density, .wake = layer.wake_density}});
  }
  return pile;
}

std::string_view range_fault(const talus_piles& m) {
  if (!header_holds(m) || !parts_hold(m)) return "header out of range";
  if (m.first_pile < 0 || std::int64_t{m.first_pile} + m.pile_count > m.pile_total) return "piles out of range";
  if (!std::all_of(m.piles.begin(), m.piles.end(), pile_holds)) return "pile out of range";
  return {};
}

}  // namespace talus
