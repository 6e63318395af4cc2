#include "common/measure/avalanches.h"

#include <algorithm>

namespace talus {

template <int Dim>
void AvalancheWatch<Dim>::on_frame(const Frame<Dim>& frame) {
  const BodyStates<Dim>& states = frame.world.states();
  for (Lasting& lasting : lasting_) {
    if (!quiet(lasting, states)) continue;
    lasting.record.seconds = static_cast<double>(frame.step - lasting.record.step) * dt_;
    end(lasting, frame.world);
  }
  std::erase_if(lasting_, [](const Lasting& lasting) { return lasting.record.seconds >= 0.0; });
  begin(frame);
}

template <int Dim>
void AvalancheWatch<Dim>::begin(const Frame<Dim>& frame) {
  const auto piles = frame.piles.piles();
  for (std::size_t p = 0; p < piles.size(); ++p) {
    Lasting fresh;
    for (const SleepEvent& event : frame.events) {
      if (!event.woke || event.cause != SleepCause::avalanche || event.pile != static_cast<int>(p)) continue;
      fresh.bodies.push_back(event.body);
      fresh.from.push_back(frame.world.states().pose[event.body].position);
    }
    if (fresh.bodies.empty()) continue;
    const auto densest = std::max_element(piles[p].layers.begin(), piles[p].layers.end(),
                                          [](const Layer& l, const Layer& r) { return l.density() < r.density(); });
    fresh.record.step = frame.step;
    fresh.record.pile = static_cast<int>(p);
    fresh.record.layer = static_cast<int>(densest - piles[p].layers.begin());
    fresh.record.density = densest->density();
    fresh.record.woken = static_cast<int>(fresh.bodies.size());
    lasting_.push_back(std::move(fresh));
  }
}

/// Bodies move from the step after their waking on.
template <int Dim>
bool AvalancheWatch<Dim>::quiet(const Lasting& lasting, const BodyStates<Dim>& states) const {
  return std::all_of(lasting.bodies.begin(), lasting.bodies.end(), [&](BodyIndex body) {
    return states.removed[body] != 0 || states.velocity[body].norm() <= quiet_speed_;
  });
}

template <int Dim>
void AvalancheWatch<Dim>::end(Lasting& lasting, const World<Dim>& world) {
  double sum = 0.0;
  for (std::size_t i = 0; i < lasting.bodies.size(); ++i) {
    const double way = (world.pose_near(lasting.bodies[i], lasting.from[i]).position - lasting.from[i]).norm();
    sum += way;
    lasting.record.longest_way = std::max(lasting.record.longest_way, way);
  }
  lasting.record.mean_way = sum / static_cast<double>(lasting.bodies.size());
  records_.push_back(lasting.record);
}

template <int Dim>
void AvalancheWatch<Dim>::on_end(const Frame<Dim>& last, std::string_view) {
  for (Lasting& lasting : lasting_) end(lasting, last.world);
  lasting_.clear();
}

template class AvalancheWatch<2>;
template class AvalancheWatch<3>;

}  // namespace talus
