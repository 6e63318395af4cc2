#pragma once
// All piles of a run and who lies in which layer, kept up from the awake bodies alone.

#include <array>
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

  /// Whether some pile counts only who has touched something; it must then be told the contacts before update().
  bool needs_contacts() const { return needs_contacts_; }
  void land(std::span<const Contact<Dim>> contacts, const BodyStates<Dim>& states);

  /// Section 3.2 after a step of `dt` [s]: moves the awake bodies' counts, drifts centres, measures the slopes that are
  /// not given, merges piles (3.5), doubles full ones. Costs O(awake), nothing while nobody is: centres then stay where
  /// they are. A pile that grew or moved is counted anew, which costs O(all bodies) and is rare.
  void update(const BodyStates<Dim>& states, std::span<const BodyIndex> awake, double dt);

  /// Counts everybody anew, to the same result. Costs O(all bodies).
  void count_anew(const BodyStates<Dim>& states);

  /// Counts a body anew that fell asleep, woke or left the world.
  void refresh(const BodyStates<Dim>& states, BodyIndex body);

  /// Layer of a body in a pile, or -1.
  int layer_of(std::size_t pile, BodyIndex body) const;

  /// Whether every count equals one made from scratch; for tests and debug builds.
  bool counts_match(const BodyStates<Dim>& states) const;

 private:
  static constexpr double fixed_point = 65536.0;  // steps per metre: 15 micrometres, and 1e4 m still fits 32 bits
  static constexpr int steps_between_looks = 30;  // at what changes slowly

  /// How a body is counted in one pile, so that it can be uncounted exactly.
  struct Membership {
    std::int16_t layer = -1;
    bool asleep = false;
    std::array<std::int32_t, Dim - 1> at{};  // horizontal position in steps of 1/65536 m: integers add up exactly
  };
  /// One pile's bookkeeping beside its public counts.
  struct Ledger {
    PileParams<Dim> params{};
    std::vector<Membership> members{};        // by body
    std::array<std::int64_t, Dim - 1> sum{};  // of Membership::at over the pile's bodies
    int count = 0;                            // of the pile's bodies
    int count_at_look = 0;                    // the count when its slope was looked at last
    int measured_count = 0;                   // at which its slope was measured last, where none is given
    int near_looks = 0;                       // looks in a row at which another pile's centre was near
  };

  void add_pile(const PileParams<Dim>& params, const Vec<Dim>& centre);
  Membership membership(std::size_t pile, const BodyStates<Dim>& states, BodyIndex body) const;
  void count(std::size_t pile, BodyIndex body, const Membership& now);
  void add(std::size_t pile, const Membership& member, int sign);
  void recount(std::size_t pile, const BodyStates<Dim>& states);
  void replace(std::size_t pile, Pile<Dim> structure, const BodyStates<Dim>& states);
  void grow(std::size_t pile, const BodyStates<Dim>& states);
  void look_around(const BodyStates<Dim>& states, double dt);
  void find_slope(std::size_t pile, const BodyStates<Dim>& states);
  void drift(std::size_t pile, const BodyStates<Dim>& states, double dt);
  void merge_near(const BodyStates<Dim>& states);
  bool may_merge(std::size_t a, std::size_t b) const;
  void merge(std::size_t kept, std::size_t gone, const BodyStates<Dim>& states);

  TypicalBody body_;
  std::vector<PileParams<Dim>> unlocated_;  // in the scene's order
  std::vector<Pile<Dim>> piles_;
  std::vector<Ledger> ledgers_;  // beside piles_
  int steps_to_look_;            // until centres are looked at again
  bool needs_contacts_ = false;
  std::vector<std::uint8_t> landed_;  // [body] has touched something; kept only where flights or slopes are asked for
};

}  // namespace talus
