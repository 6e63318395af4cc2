#pragma once
// All piles of a run, with the bodies in their layers: counting, growth, drift, slope and merging.

#include <cstdint>
#include <span>
#include <vector>

#include "common/pile/pile.h"
#include "common/pile/pile_counts.h"
#include "common/pile/pile_params.h"
#include "common/world/body.h"

namespace talus {

/// Piles with their counts. A body may count in several piles (section 3.5).
template <int Dim>
class PileSet {
 public:
  /// `count_flying`: of piles that do not say it themselves.
  PileSet(std::vector<PileParams<Dim>> params, const TypicalBody& body, bool count_flying = true);

  /// Another value for the piles that do not say it themselves; recounts them.
  void count_flying(bool flying, const BodyStates<Dim>& states);

  /// The piles that have a place. The others get theirs by place().
  std::span<const Pile<Dim>> piles() const { return piles_; }
  const TypicalBody& typical_body() const { return body_; }

  /// Whether a pile waits for the place where the first body lands.
  bool has_unplaced() const { return !unplaced_.empty(); }
  /// Puts the base of the next pile without a place at `landing` [m].
  void place(const Vec<Dim>& landing, const BodyStates<Dim>& states);

  /// Whether note_contacts() must be called before update(): some pile counts only bodies that have touched something.
  bool needs_contacts() const;
  /// Notes which bodies have touched something.
  void note_contacts(std::span<const Contact<Dim>> contacts, const BodyStates<Dim>& states);

  /// Whether note_contacts() or note_touch() has told that the body touched something.
  bool has_touched(BodyIndex body) const { return body < std::ssize(has_touched_) && has_touched_[body] != 0; }
  /// A body has touched something.
  void note_touch(const BodyStates<Dim>& states, BodyIndex body);
  /// The number of a body is now that of another one, or the body was put elsewhere.
  void forget(BodyIndex body);

  /// Section 3.2, after a step of `dt` [s]: recounts the awake bodies and doubles full piles; at each
  /// `slow_update_interval` also drifts centres, measures slopes that are not given, and merges piles (3.5). Costs
  /// O(awake), nothing while all bodies sleep: then centres stay where they are. A pile that grew or moved is recounted
  /// in O(all bodies), which is rare. `times`: of the engine over those of the world (UnitScale).
  void update(const BodyStates<Dim>& states, std::span<const BodyIndex> awake, double dt, double times = 1.0);

  /// Recounts every body, to the same result. Costs O(all bodies).
  void recount_all(const BodyStates<Dim>& states);

  /// Recounts one body, after it fell asleep, woke or was removed.
  void recount_body(const BodyStates<Dim>& states, BodyIndex body);

  /// Layer of a body in a pile, or -1.
  int layer_of(std::size_t pile, BodyIndex body) const { return records_[pile].counts.layer_of(body); }

  /// Whether every count equals one made from the beginning; for tests and debug builds. Costs O(all bodies).
  bool counts_match(const BodyStates<Dim>& states) const;

 private:
  /// What belongs to one pile beside its public geometry and counts.
  struct Record {
    PileParams<Dim> params{};
    PileCounts<Dim> counts{};
    int last_count = 0;      // bodies at the last slow update
    int measured_count = 0;  // bodies when the slope was measured last, where none is given
    int near_updates = 0;    // slow updates in a row at which another pile's centre was near
  };

  void add_pile(const PileParams<Dim>& params, const Vec<Dim>& centre);
  bool counts_flying(const PileParams<Dim>& params) const { return params.count_flying.value_or(count_flying_); }
  bool needs_contacts(const PileParams<Dim>& params) const;
  CountedAs<Dim> counted_now(std::size_t pile, const BodyStates<Dim>& states, BodyIndex body) const;
  void recount(std::size_t pile, const BodyStates<Dim>& states);
  void replace(std::size_t pile, Pile<Dim> structure, const BodyStates<Dim>& states);
  void grow(std::size_t pile, const BodyStates<Dim>& states);
  void update_slowly(const BodyStates<Dim>& states, double time);
  void drift(std::size_t pile, const BodyStates<Dim>& states, double time);
  void update_slope(std::size_t pile, const BodyStates<Dim>& states);
  void merge_near(const BodyStates<Dim>& states);
  bool may_merge(std::size_t a, std::size_t b) const;
  void merge(std::size_t kept, std::size_t gone, const BodyStates<Dim>& states);

  TypicalBody body_;
  std::vector<PileParams<Dim>> unplaced_;  // in the scene's order
  std::vector<Pile<Dim>> piles_;
  std::vector<Record> records_;         // beside piles_
  std::int64_t since_slow_update_ = 0;  // calls of update()
  bool count_flying_;
  std::vector<std::uint8_t> has_touched_;  // [body] something; kept only where a pile needs contacts
};

}  // namespace talus
