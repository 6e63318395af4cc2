#include "lcmtypes/instruments_message.h"

#include <algorithm>
#include <numbers>

#include "lcmtypes/message.h"

namespace talus {

using talus_lcm::talus_gate;
using talus_lcm::talus_instruments;
using talus_lcm::talus_load;
using talus_lcm::talus_region;

namespace {

// Of a message, so that no single gate, region or load fills it.
constexpr std::size_t most_obstacles = 10'000;

void append(const Vec<2>& point, std::vector<float>& values) {
  values.insert(values.end(), {static_cast<float>(point.x()), 0.0F, static_cast<float>(point.y())});
}
void append(const Vec<3>& point, std::vector<float>& values) {
  for (const double each : point) values.push_back(static_cast<float>(each));
}

template <int Dim>
void put(const Vec<Dim>& point, double (&to)[3]) {
  to[0] = point[0];
  to[1] = Dim == 3 ? point[1] : 0.0;
  to[2] = point[Dim - 1];
}

std::vector<Vec<2>> outline(const GateParams<2>& gate) { return gate.corners; }

std::vector<Vec<3>> outline(const GateParams<3>& gate) {
  if (!gate.corners.empty())
    return {gate.corners[0], gate.corners[1], gate.corners[1] + gate.corners[2] - gate.corners[0], gate.corners[2]};
  constexpr int corners = 32;
  const Vec3 axis = gate.normal.normalized();
  const Vec3 side = gate.radius * axis.unitOrthogonal();
  std::vector<Vec3> points;
  for (int i = 0; i < corners; ++i)
    points.push_back(gate.centre + Eigen::AngleAxisd(2.0 * std::numbers::pi * i / corners, axis) * side);
  return points;
}

template <int Dim>
talus_gate to_gate(const GateParams<Dim>& params, const GateCounter<Dim>& gate) {
  talus_gate message{};
  message.name = clipped(params.name);
  message.forward = gate.forward();
  message.backward = gate.backward();
  message.jammed = static_cast<std::int8_t>(gate.jammed());
  for (const Vec<Dim>& corner : outline(params)) append(corner, message.outline);
  message.value_count = static_cast<std::int32_t>(message.outline.size());
  return message;
}

template <int Dim>
talus_region to_region(const RegionParams<Dim>& params, const RegionReading& reading) {
  talus_region message{};
  message.name = clipped(params.name);
  message.kind = talus_region::BOX;
  if (params.centre) {
    message.kind = talus_region::BALL;
    put<Dim>(*params.centre, message.low);
    std::ranges::fill(message.high, params.radius);
  } else if (!params.layer.empty()) {
    message.kind = talus_region::LAYER;
    message.low[2] = params.layer[0];
    message.high[2] = params.layer[1];
  } else {
    put<Dim>(params.box[0], message.low);
    put<Dim>(params.box[1], message.high);
  }
  message.bodies = reading.bodies;
  message.packing = reading.packing.value_or(-1.0);
  message.mean_speed = reading.mean_speed;
  message.kinetic_energy = reading.kinetic_energy;
  message.slope = reading.surface.value ? reading.surface.value->angle : -1.0;
  return message;
}

template <int Dim>
talus_load to_load(const LoadParams<Dim>& params, const LoadMeter<Dim>& load,
                   const std::vector<ObstacleName>& obstacles) {
  talus_load message{};
  message.name = clipped(params.name);
  const LoadSpan<Dim>& span = load.frame();
  message.known = static_cast<std::int8_t>(span.known && span.steps > 0);
  if (message.known != 0) {
    put<Dim>(span.mean.template head<Dim>(), message.force);
    if constexpr (Dim == 2)
      message.torque[1] = span.mean[2];
    else
      put<3>(span.mean.template tail<3>(), message.torque);
  }
  if (params.on_ground) message.obstacle.push_back(-1);
  for (const int name : params.obstacles)
    for (int k = 0; k < obstacles[name].count && message.obstacle.size() < most_obstacles; ++k)
      message.obstacle.push_back(obstacles[name].first + k);
  message.obstacle_count = static_cast<std::int32_t>(message.obstacle.size());
  return message;
}

/// Fills messages one after the other.
class Filler {
 public:
  template <class Item>
  void add(Item item, std::size_t bytes, std::vector<Item> talus_instruments::*list) {
    if (used_ + bytes > room<talus_instruments>) {
      messages_.emplace_back();
      used_ = 0;
    }
    used_ += bytes;
    (messages_.back().*list).push_back(std::move(item));
  }
  std::vector<talus_instruments> take() {
    for (talus_instruments& message : messages_) {
      message.gate_count = static_cast<std::int32_t>(message.gates.size());
      message.region_count = static_cast<std::int32_t>(message.regions.size());
      message.load_count = static_cast<std::int32_t>(message.loads.size());
    }
    return numbered(std::move(messages_));
  }

 private:
  std::vector<talus_instruments> messages_ = std::vector<talus_instruments>(1);
  std::size_t used_ = 0;
};

bool gate_holds(const talus_gate& gate) { return gate.forward >= 0 && gate.backward >= 0 && gate.value_count % 3 == 0; }

bool region_holds(const talus_region& region) {
  return region.kind >= talus_region::BOX && region.kind <= talus_region::LAYER && region.bodies >= 0;
}

bool load_holds(const talus_load& load) { return std::ranges::all_of(load.obstacle, is_index_or_none); }

}  // namespace

template <int Dim>
std::vector<talus_instruments> to_instruments(const InstrumentMeters<Dim>& meters,
                                              const std::vector<ObstacleName>& obstacles) {
  const Instruments<Dim>& params = meters.instruments();
  Filler filler;
  for (std::size_t i = 0; i < params.gates.size(); ++i) {
    talus_gate gate = to_gate(params.gates[i], meters.gates()[i]);
    const std::size_t bytes = 64 + gate.name.size() + sizeof(float) * gate.outline.size();
    filler.add(std::move(gate), bytes, &talus_instruments::gates);
  }
  for (std::size_t i = 0; i < params.regions.size(); ++i) {
    talus_region region = to_region(params.regions[i], meters.regions()[i]);
    const std::size_t bytes = 128 + region.name.size();
    filler.add(std::move(region), bytes, &talus_instruments::regions);
  }
  for (std::size_t i = 0; i < params.loads.size(); ++i) {
    talus_load load = to_load(params.loads[i], meters.loads()[i], obstacles);
    const std::size_t bytes = 128 + load.name.size() + sizeof(std::int32_t) * load.obstacle.size();
    filler.add(std::move(load), bytes, &talus_instruments::loads);
  }
  return filler.take();
}

std::string_view range_fault(const talus_instruments& m) {
  if (!header_holds(m) || !parts_hold(m)) return "header out of range";
  if (!std::ranges::all_of(m.gates, gate_holds)) return "gate out of range";
  if (!std::ranges::all_of(m.regions, region_holds)) return "region out of range";
  if (!std::ranges::all_of(m.loads, load_holds)) return "load out of range";
  return {};
}

template std::vector<talus_instruments> to_instruments(const InstrumentMeters<2>&, const std::vector<ObstacleName>&);
template std::vector<talus_instruments> to_instruments(const InstrumentMeters<3>&, const std::vector<ObstacleName>&);

}  // namespace talus
