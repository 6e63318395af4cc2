#pragma once
// The loop.

#include <memory>
#include <vector>

#include "common/policy/sleep_policy.h"
#include "common/scene/scene.h"
#include "common/simulation/emitter.h"
#include "common/simulation/observer.h"

namespace talus {

/// One run of a scene in a world of its own.
template <int Dim>
class Simulation {
 public:
  /// `world` must be new and made from scene.world.
  Simulation(const Scene<Dim>& scene, std::unique_ptr<World<Dim>> world, std::unique_ptr<SleepPolicy<Dim>> policy);

  /// Observers are called in the order added and must outlive the simulation. With none, nothing is prepared for them.
  void add_observer(Observer<Dim>& observer) { observers_.push_back(&observer); }

  /// One step: emit due bodies, step the world, recount the piles, ask the policy, apply its two lists.
  void step();

  /// Tells the observers that the run is over.
  void end(std::string_view reason);

  /// Adds a body by hand, freezes, thaws or removes with cause `user`; sleepers near a removed body wake.
  BodyIndex add(const BodyDef<Dim>& body);
  void remove(BodyIndex body);
  void thaw_all();

  Frame<Dim> frame();
  const World<Dim>& world() const { return *world_; }
  const PileSet<Dim>& piles() const { return piles_; }
  const Emitter<Dim>& emitter() const { return emitter_; }

 private:
  void locate_piles();
  void apply();
  void note_engine_sleep();
  bool piles_needed() const { return policy_->decides() || !observers_.empty(); }

  std::unique_ptr<World<Dim>> world_;
  std::unique_ptr<SleepPolicy<Dim>> policy_;
  Emitter<Dim> emitter_;
  PileSet<Dim> piles_;
  std::vector<Observer<Dim>*> observers_;
  Decision decision_;
  std::vector<SleepEvent> events_;
  std::vector<std::uint8_t> asleep_before_;  // engine's own sleeping only
  PhaseTimes phases_;
  double dt_;
  std::int64_t step_ = 0;
  bool engine_sleep_;
};

}  // namespace talus
