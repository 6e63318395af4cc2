#pragma once
// Bodies that pass a gate.

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "common/scene/instruments.h"
#include "common/world/world.h"

namespace talus {

/// Counts the bodies whose centre of mass passes a gate, both ways. A body has passed once it is 0.05 D beyond: what
/// trembles in the gate does not count, what bounces back is counted once each way.
template <int Dim>
class GateCounter {
 public:
  /// `extent`: D [m].
  GateCounter(const GateParams<Dim>& params, double extent);

  /// After each step of `dt`, which ended at `time` [s]. Looks at awake bodies only.
  void update(const World<Dim>& world, double time, double dt);

  /// A time without passage, with bodies before the gate.
  struct Jam {
    double from = 0.0;              // the last passage before it, or when bodies came before the gate after that [s]
    std::optional<double> to = {};  // the next one, or when no body was left there; none: still jammed [s]
  };

  std::int64_t forward() const { return forward_; }
  std::int64_t backward() const { return backward_; }
  std::int64_t net() const { return forward_ - backward_; }
  /// Times of the first and the last passage [s].
  std::optional<double> first() const { return first_; }
  std::optional<double> last() const { return last_; }
  /// Net passages per second from the first to the last, of which the first begins the time; none with fewer than two.
  std::optional<double> rate() const;
  const std::vector<Jam>& jams() const { return jams_; }
  bool jammed() const { return !jams_.empty() && !jams_.back().to; }

 private:
  /// Of a body that has crossed and is not clear of the gate yet.
  struct Crossing {
    int net = 0;  // forward less backward
    double time = 0.0;
  };

  void follow(BodyIndex body, const Vec<Dim>& at, double time, double dt);
  void count(const Crossing& crossing);
  void watch_for_jam(const World<Dim>& world, double time);
  bool covers(const Vec<Dim>& point) const;
  bool any_before(const World<Dim>& world) const;

  GateParams<Dim> params_;
  Vec<Dim> centre_;
  Vec<Dim> forward_axis_;  // unit
  double reach_ = 0.0;     // from the centre to any point of the gate at most [m]
  double extent_;
  std::vector<Vec<Dim>> last_place_;  // by body
  std::map<BodyIndex, Crossing> crossing_;
  std::int64_t forward_ = 0;
  std::int64_t backward_ = 0;
  std::optional<double> first_;
  std::optional<double> last_;
  std::vector<Jam> jams_;
  double waiting_since_ = 0.0;  // with bodies before the gate [s]
  double next_look_ = 0.0;      // for these [s]
};

}  // namespace talus
