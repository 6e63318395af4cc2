#pragma once
// Control of a pile's slope by damping.

#include <cstdint>
#include <optional>
#include <vector>

#include "common/policy/adaptive/rule.h"

namespace talus {

/// Keeps each pile with `control_slope` at its slope alpha (section 3.1: "set by the user"). Friction cannot do
/// that: bodies that fall on a steep pile knock it down, and what they knock off rolls away. So bodies in contact are
/// damped, by a proportional-integral-derivative controller of the pile's measured slope:
///
///     damping = clamp(k_p e + I, 0, max),  dI/dt = k_i e,  0 <= I <= max
///
/// with e the slope that will be missing if the pile sinks on for the time T at its present rate. A pile steeper than
/// alpha by more than I / k_p that does not sink is not damped.
template <int Dim>
class SlopeController {
 public:
  explicit SlopeController(const RuleSetup<Dim>& setup);

  /// Damps bodies for one step. A body belongs to its nearest pile. Costs O(contacts) and, ten times a second, O(all
  /// bodies); nothing without a controlled pile.
  void update(const RuleInput<Dim>& in, RuleOutput<Dim>& out);

 private:
  /// The controller's state for one pile.
  struct Control {
    double integral = 0.0;        // I [1/s]
    double damping = 0.0;         // rate at which bodies lose velocity [1/s]
    std::optional<double> slope;  // as last measured [rad]
  };
  /// An awake body in contact that belongs to a controlled pile.
  struct Touching {
    BodyIndex body = 0;
    std::size_t pile = 0;
  };

  /// The controller's coefficients in one gravity.
  struct Gains {
    double proportional = 0.0;  // k_p [1/(s rad)]
    double integral = 0.0;      // k_i [1/(s^2 rad)]
    double derivative = 0.0;    // T [s]
    double max_damping = 0.0;   // [1/s]
  };

  Gains gains_in(const World<Dim>& world) const;
  void find_touching(const RuleInput<Dim>& in);
  void update_damping(const RuleInput<Dim>& in, std::size_t pile, const Gains& gains);
  void collect_positions(const RuleInput<Dim>& in, std::size_t pile);
  void damp(const BodyStates<Dim>& states, RuleOutput<Dim>& out) const;

  double dt_;                        // [s]
  std::int64_t steps_between_;       // two measurements
  double extent_;                    // D [m]
  double proportional_gain_;         // [sqrt(g/D)]
  double integral_gain_;             // [g/D]
  double max_damping_;               // [sqrt(g/D)]
  std::vector<Control> controls_;    // [pile]
  std::vector<Touching> touching_;   // scratch, ascending
  std::vector<BodyIndex> bodies_;    // scratch
  std::vector<Vec<Dim>> positions_;  // scratch: of bodies, relative to the middle of their pile's base [m]
};

}  // namespace talus
