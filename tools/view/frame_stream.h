#pragma once
// States of a run as the browser page reads them: one block of bytes for each frame.

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/pile/pile.h"
#include "common/policy/sleep_event.h"
#include "common/scene/happened.h"
#include "common/scene/scene.h"
#include "common/world/body.h"
#include "common/world/motion.h"
#include "common/world/warning.h"

namespace talus {

/// Steps in which a page's poses are counted.
struct Quantum {
  double position = 1e-3;            // [m] > 0
  double angle = 0.75e-3;            // [rad] of a rotation in 2D
  double quaternion = 1.0 / 4096.0;  // of a quaternion's components, in 3D
};

/// Positions to a thousandth of the smallest shape's extent: less than a pixel on a screen full of one body.
template <int Dim>
Quantum quantum_of(const Scene<Dim>& scene);

/// What of a scene frames are written from.
template <int Dim>
struct FrameForm {
  Quantum quantum = {};
  std::vector<Shape<Dim>> shapes = {};  // none: no slope is measured, and no body is hidden
  std::optional<double> ground = {};    // its height [m]
};

template <int Dim>
std::shared_ptr<const FrameForm<Dim>> frame_form(const Scene<Dim>& scene);

/// One state to show. Everything referred to must outlive the call.
template <int Dim>
struct ViewFrame {
  std::int64_t step = 0;
  const BodyStates<Dim>& states;
  std::span<const SleepEvent> events = {};  // since the frame before, in order
  std::span<const Pile<Dim>> piles = {};
  std::span<const Warning> warnings = {};             // all so far
  double kinetic_energy = 0.0;                        // [J]
  std::span<const DoneEvent> scene_events = {};       // all so far
  double drift_estimate = -1.0;                       // of the sleeping bodies [D]; -1: not known
  std::span<const ObstaclePose<Dim>> obstacles = {};  // of those that move, all
  double ms_per_step = -1.0;                          // wall time of a step; -1: not known
};

/// Writes frames as differences from the frame before: only what changed takes room, a sleeping body none. The first
/// frame of an encoder is the whole state. The same frames give the same bytes.
///
/// A block is a sequence of numbers: `u` unsigned with seven bits a byte, low bits first, `s` signed in zigzag over
/// `u`, `f` a float of four bytes, low byte first. A list of bodies is their number (u) and the distance of each from
/// the one before (u), counted from -1.
///
///     u step; u number of new bodies; u shape of each
///     list of removed bodies; list of bodies that fell asleep or woke; list of bodies that became hidden
///     (hidden_bodies.h) or can be seen again; list of bodies with another pose, none of them hidden,
///     s change of each component of the pose, component by component
///         (2D: x, z, angle; 3D: x, y, z, quaternion w, x, y, z), in quanta
///     u number of events; of each: u body, u steps before this one, u cause * 2 + woke, u pile + 1, u layer + 1, f
///     score u number of piles; u number of those that changed; of each: u number; u numbers of its form, 0 where that
///         is as before: f centre, f slope, f lift, f height, f radius, of each layer f bottom, f top, f radius,
///         f capacity, f density up to which no body falls asleep, f density above which the pile wakes, both below 0
///         where the policy has none; u twice the layers, of each s count and s sleepers where a form is given, else
///         s change of them
///     f kinetic energy; f estimate of drift [D], f slope measured of the largest pile [rad], f wall time of a step
///         [ms], -1 where not known
///     u number of warnings that changed; of each: u kind, u step of the first, u bytes of its text, the text
///     u number of events of the scene since the frame before; of each: u number, f time
///     list of obstacles with another pose, s change of each component, component by component, as of bodies; an
///     obstacle that is not named before is where the head has it, and changes from a pose of zeros
template <int Dim>
class FrameEncoder {
 public:
  explicit FrameEncoder(std::shared_ptr<const FrameForm<Dim>> form) : form_(std::move(form)) {}

  std::string encode(const ViewFrame<Dim>& frame);

 private:
  static constexpr int components = Dim == 2 ? 3 : 7;
  using Counts = std::array<std::int32_t, components>;
  /// State of a body as the page has it.
  struct Known {
    Counts pose = {};
    std::uint8_t asleep = 0;
    std::uint8_t removed = 0;
    std::uint8_t hidden = 0;
  };
  struct KnownPile {
    std::vector<float> form;
    std::vector<std::int32_t> counts;  // of each layer bodies, sleepers
  };

  Counts counted(const Pose<Dim>& pose, const Counts& before) const;
  void write_bodies(const BodyStates<Dim>& states);
  void write_hidden(const BodyStates<Dim>& states);
  void write_poses(const BodyStates<Dim>& states);
  bool rests(BodyIndex body, const Pose<Dim>& pose) const;
  double slope_of(const ViewFrame<Dim>& frame) const;
  void write_events(const ViewFrame<Dim>& frame);
  void write_piles(std::span<const Pile<Dim>> piles);
  void write_pile(int number, const Pile<Dim>& pile, KnownPile& known);
  void write_warnings(std::span<const Warning> warnings);

  void write_obstacles(std::span<const ObstaclePose<Dim>> obstacles);

  void write_changes(std::span<const int> numbers, std::span<const Counts> changes);
  void write_list(std::span<const int> numbers);

  std::shared_ptr<const FrameForm<Dim>> form_;
  std::int64_t frames_ = 0;
  double slope_ = -1.0;             // measured last [rad]
  BodyIndex bodies_at_update_ = 0;  // when it was last found what is hidden
  std::vector<Known> known_;
  std::vector<KnownPile> known_piles_;
  std::map<WarningKind, std::string> known_warnings_;  // their texts
  std::size_t known_scene_events_ = 0;
  std::map<int, Counts> known_obstacles_;  // their poses, by number
  std::string block_;
};

}  // namespace talus
