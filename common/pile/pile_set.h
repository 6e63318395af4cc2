#pragma once
// All piles of a run and who lies in which layer, kept up from the awake bodies alone.

#include <cstdint>
#include <span>
#include <vector>

#include "common/pile/pile.h"
#include "common/pile/pile_params.h"
#include "common/world/body.h"

namespace talus {

/// Piles with their counts. A body may count in several piles (section 3.5).
template <int Dim>
class PileSet {
 public:
  PileSet(std::vector<PileParams<Dim>> params, const TypicalBody& body);

  /// Piles located so far; those still waiting for their first body to land come into being with locate().
  std::span<const Pile<Dim>> piles() const { return piles_; }
  const TypicalBody& typical_body() const { return body_; }

  /// Whether some pile still waits for the place where the first body lands.
  bool waiting() const { return !unlocated_.empty(); }
  /// Puts the next waiting pile's base at `landing`.
  void locate(const Vec<Dim>& landing, const BodyStates<Dim>& states);

  /// Section 3.2 after a step of `dt` [s]: moves the awake bodies' counts, drifts centres, doubles full piles.
  /// Costs O(awake); a pile that grew or moved is counted anew, which costs O(its bodies) and happens rarely.
  void update(const BodyStates<Dim>& states, std::span<const BodyIndex> awake, double dt);

  /// Bodies that fell asleep or woke since, or left the world.
  void on_slept(BodyIndex body);
  void on_woken(BodyIndex body);
  void on_removed(BodyIndex body);

  /// Layer of a body in a pile, or -1.
  int layer_of(std::size_t pile, BodyIndex body) const;

  /// Whether every count equals one made from scratch; for tests and debug builds.
  bool counts_match(const BodyStates<Dim>& states) const;

 private:
  struct Membership {
    std::int16_t layer = -1;
    bool asleep = false;
  };
  void move(std::size_t pile, BodyIndex body, Membership now);
  void recount(std::size_t pile, const BodyStates<Dim>& states);
  bool drift(std::size_t pile, const BodyStates<Dim>& states, double dt);
  bool grow(std::size_t pile);

  TypicalBody body_;
  std::vector<PileParams<Dim>> params_;             // of the located piles, then of those waiting
  std::vector<PileParams<Dim>> unlocated_;          // in the scene's order
  std::vector<Pile<Dim>> piles_;
  std::vector<std::vector<Membership>> members_;    // [pile][body]
  int steps_since_drift_ = 0;
};

}  // namespace talus
