#pragma once
// What the avalanches of a run did.

#include <cstdint>
#include <vector>

#include "common/policy/observer.h"

namespace talus {

/// One avalanche of section 3.4: the bodies of a pile that it woke, until they are quiet.
struct Avalanche {
  std::int64_t step = 0;  // at which it began
  int pile = 0;           // number of the pile
  int layer = 0;          // the pile's densest layer then
  double density = 0.0;   // of that layer
  int woken = 0;          // bodies
  double seconds = -1.0;  // until none of them was faster than `quiet_speed`; -1: it lasted to the run's end
  double mean_way = 0.0;  // from where a body woke to where it was then [m]
  double longest_way = 0.0;
};

/// Keeps one record for each avalanche. Costs O(bodies woken) a step while one lasts, nothing otherwise.
template <int Dim>
class AvalancheWatch final : public Observer<Dim> {
 public:
  /// `quiet_speed` [m/s] > 0.
  AvalancheWatch(double dt, double quiet_speed) : dt_(dt), quiet_speed_(quiet_speed) {}

  void on_frame(const Frame<Dim>& frame) override;
  void on_end(const Frame<Dim>& last, std::string_view reason) override;

  /// In the order of their ends; all of them once the run has ended.
  const std::vector<Avalanche>& records() const { return records_; }

 private:
  struct Lasting {
    Avalanche record{};
    std::vector<BodyIndex> bodies{};
    std::vector<Vec<Dim>> from{};  // where they woke
  };

  void begin(const Frame<Dim>& frame);
  bool quiet(const Lasting& lasting, const BodyStates<Dim>& states) const;
  void end(Lasting& lasting, const World<Dim>& world);

  double dt_;
  double quiet_speed_;
  std::vector<Lasting> lasting_;
  std::vector<Avalanche> records_;
};

}  // namespace talus
