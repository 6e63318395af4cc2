#pragma once
// Which bodies sleep where.

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "common/math/grid.h"
#include "common/world/body.h"

namespace talus {

/// Whether a sleeping body waits for a stability check.
enum class Standing : std::uint8_t {
  settled,    // no: a check left it where it lies, or it sleeps by the user's request
  unchecked,  // yes: only a check under load has left it where it lies
  fresh,      // yes: no check has left it where it lies
};

/// The sleeping bodies by vertical column, counted from the bodies that fell asleep, woke or left the world, as
/// SleepPolicy::note() tells them, and from nothing else. A body is taken out of the column into which it was put.
template <int Dim>
class SleepLedger {
 public:
  using Columns = Grid<Dim - 1>;
  using Column = typename Columns::Cell;
  /// Sleeping bodies of a column.
  struct Count {
    int sleeping = 0;
    int unchecked = 0;  // of these, the ones that wait for a check
    int fresh = 0;      // of these, the ones that no check has seen there, less those of before the last settle()

    /// One body more (1) or less (-1). Those that settle() no longer counts do not come back as less.
    void add(Standing standing, int one);
    bool operator==(const Count&) const = default;
  };

  /// `width` of a column [m] > 0.
  explicit SleepLedger(double width) : columns_(width) {}

  const Columns& columns() const { return columns_; }
  /// Columns with sleeping bodies.
  const std::map<Column, Count>& counts() const { return counts_; }
  Count count(const Column& column) const;
  /// Whether a body sleeps and waits for no check.
  bool settled(BodyIndex body) const;
  /// Bodies that wait for a check.
  int unchecked() const { return unchecked_; }

  /// A body fell asleep at `position` [m]. No effect on a body that sleeps.
  void put_in(BodyIndex body, const Vec<Dim>& position, Standing standing);
  /// A sleeping body woke or left the world. No effect on other bodies.
  void take_out(BodyIndex body);
  /// No body of the column counts as fresh from now on.
  void settle(const Column& column);

  /// Whether the columns hold the bodies that sleep in `states`, each in its place. Costs O(all bodies).
  bool matches(const BodyStates<Dim>& states) const;

 private:
  struct Sleeper {
    Column column{};
    Standing standing = Standing::settled;
  };

  Columns columns_;
  std::vector<std::optional<Sleeper>> sleepers_;  // [body]
  std::map<Column, Count> counts_;
  int unchecked_ = 0;  // in all columns
};

}  // namespace talus
