#pragma once
// Would the sleeping bodies of a region stay where they are if they were awake?

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "common/math/grid.h"
#include "common/policy/rest/rest_criterion.h"
#include "common/policy/rest/rule.h"
#include "common/policy/wake_rules/sleep_ledger.h"

namespace talus {

/// The rest criterion judges one body over a short time, so it accepts a slope that fails slowly, late or as a whole.
/// Therefore a region whose bodies have fallen asleep is checked once it is quiet: all of its bodies wake and are held
/// awake until they have come to rest together. Parts of it are released as they come to rest: a block of space is when
/// its bodies and those in the blocks around it have so little speed that they would move less than the tolerance, on
/// average, within a fixed horizon, which is shorter if they slow down. Where the check leaves a body it counts as
/// checked, until it falls asleep farther from there than the tolerance or in another gravity.
///
/// A region is a set of connected vertical columns with unchecked sleeping bodies, and the columns around these. It is
/// quiet when no body moves in contact with another one. While bodies are on their way to a first contact, a check also
/// waits until it has enough unchecked bodies to be worth its cost. When no more arrive, some bodies may move, since a
/// slope that slides slowly as a whole would otherwise delay its own check.
///
/// A pour that never pauses leaves no region quiet. There a region is checked although it moves as soon as enough of
/// its sleeping bodies have not been checked where they lie, and its surface is steeper than the lowest friction of a
/// body in it holds by itself. Such a loaded check is short: it lets the heap follow its load, but proves nothing, so
/// the region is checked again once it is quiet.
template <int Dim>
class StabilityChecks {
 public:
  explicit StabilityChecks(const RuleSetup<Dim>& setup);

  /// A body fell asleep. Whether it waits for a check where it lies; settled without checks.
  Standing note_asleep(const World<Dim>& world, BodyIndex body);

  /// Whether a check may begin although all bodies sleep. update() must be called then.
  bool may_begin(const SleepLedger<Dim>& sleepers) const { return may_begin_ && sleepers.unchecked() > 0; }

  /// Whether an awake body takes part in a check and must stay awake.
  bool holds(BodyIndex body) const;

  /// Distance [m] that a sleeping body is expected to move once woken, from the motion around it at the end of the
  /// check that left it; none where no check did.
  std::optional<double> expected_motion(BodyIndex body) const;
  /// [m]
  double tolerance() const { return tolerance_; }

  /// Of a body that a check has left: the motion expected of it then. Of the others: the mean distance that bodies
  /// moved which a check woke, over the last few hundred. None without checks, before the first, and while more than a
  /// twentieth of the bodies are awake in contact, since the sleeping ones beside them may follow. Costs
  /// O(bodies + contacts).
  std::optional<DriftEstimate> drift_estimate(const World<Dim>& world) const;

  /// As SleepPolicy::forget().
  void forget(BodyIndex body);

  /// Releases what has come to rest and begins the checks that are due. Costs O(awake + contacts + unchecked columns) a
  /// few times in sqrt(D / g), and a box query for each column that is checked.
  void update(const RuleInput<Dim>& in, const RestCriterion<Dim>& rest, SleepLedger<Dim>& sleepers,
              RuleOutput<Dim>& out);

 private:
  using Columns = typename SleepLedger<Dim>::Columns;
  using Column = typename Columns::Cell;
  using Count = typename SleepLedger<Dim>::Count;
  using Blocks = Grid<Dim>;
  using Block = typename Blocks::Cell;

  /// A body that a check holds awake, and where the last sample found it.
  struct Member {
    BodyIndex body = 0;
    Pose<Dim> sample{};
    double moved = 0.0;                // between the two samples before [m]
    std::optional<Pose<Dim>> slept{};  // where the check woke it
  };
  /// Where a check left a body.
  struct Release {
    Pose<Dim> pose{};
    double expected = 0.0;                // motion from there on, mean over the blocks around [m]
    bool loaded = false;                  // by a loaded check
    Vec<Dim> gravity = Vec<Dim>::Zero();  // in which it was checked [m/s^2]
  };
  struct Check {
    std::vector<Member> members;
    std::int64_t begun = 0;    // step
    std::int64_t sampled = 0;  // step of the last sample
    bool loaded = false;       // begun while the region moved
  };
  /// Times in one gravity, in steps where not said.
  struct Times {
    double rest = 0.0;        // [s] at rest, after which an awake body no longer counts as moving
    std::int64_t sample = 1;  // between two samples of the displacement
    std::int64_t shortest_check = 1;
    std::int64_t longest_check = 1;
    std::int64_t longest_loaded = 1;  // check
    std::int64_t arrival = 1;         // without arrivals after which a check need not wait
  };
  /// Displacements of bodies.
  struct Motion {
    double sum = 0.0;     // since the last sample [m]
    double before = 0.0;  // between the two samples before [m]
    int bodies = 0;

    double mean() const { return sum / bodies; }
    void add(const Motion& other) {
      sum += other.sum;
      before += other.before;
      bodies += other.bodies;
    }
  };
  /// Columns that one check covers.
  struct Region {
    std::vector<Column> columns;
    Count sleepers;  // of all columns
    int moving = 0;  // bodies that move in contact with others
    bool under_check = false;
  };

  /// Sleeping bodies of a column.
  struct Surface {
    double top = std::numeric_limits<double>::lowest();         // height of the highest [m]
    double friction = std::numeric_limits<double>::infinity();  // lowest of them
  };

  Times times_in(const World<Dim>& world) const;
  bool has_passed(const Check& check, const Motion& near, std::int64_t lasted) const;
  void release_resting(const RuleInput<Dim>& in, Check& check);
  Motion motion_around(const std::map<Block, Motion>& motion, const Block& block) const;
  void release(const RuleInput<Dim>& in, const Member& member, const Release& release);
  void observe_motion(const RuleInput<Dim>& in, const RestCriterion<Dim>& rest);
  Region take_region(const SleepLedger<Dim>& sleepers, std::set<Column>& waiting) const;
  bool expects_arrivals(std::int64_t step) const { return step - last_arrival_ <= times_.arrival; }
  bool is_quiet(const Region& region, std::int64_t step) const;
  bool is_loaded(const Region& region, std::int64_t step) const;
  bool is_steep(const RuleInput<Dim>& in, const Region& region);
  std::optional<Surface> surface_of(const RuleInput<Dim>& in, const Column& column);
  void begin(const RuleInput<Dim>& in, const Region& region, bool loaded, RuleOutput<Dim>& out);

  Columns columns_;
  Blocks blocks_;
  double tolerance_;                             // [m]; 0: no checks
  double extent_;                                // D [m]
  Times times_;                                  // in the gravity of the last update()
  double loaded_share_;                          // of the sleeping bodies that are fresh when a loaded check begins
  bool may_begin_ = false;                       // false once a sample has found that no check is to come
  std::vector<Check> checks_;                    // under way
  std::vector<std::uint8_t> held_;               // [body]
  std::vector<std::uint8_t> arrived_;            // [body] whether it has touched anything
  std::vector<std::optional<Release>> checked_;  // [body] by the last check, unless it fell asleep elsewhere
  double found_ = 0.0;                           // distance that woken bodies moved in checks, moving average [m]
  std::int64_t found_count_ = 0;                 // bodies in it
  std::int64_t last_arrival_ = 0;                // last step in which a body was on its way to its first contact
  std::map<Column, int> moving_;                 // scratch: bodies that move in contact with others, by column
  std::set<Column> under_check_;                 // scratch
  std::vector<std::uint8_t> contact_;            // scratch [body], all 0 between calls
  std::vector<BodyIndex> near_;                  // scratch
};

}  // namespace talus
