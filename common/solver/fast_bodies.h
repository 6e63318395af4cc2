#pragma once
// Bodies so fast that a contact must be known before it begins.

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "common/solver/contact_solver.h"
#include "common/world/world_description.h"

namespace talus {

/// How far two pieces are apart.
template <int Dim>
struct PieceGap {
  float distance = 0.0F;                 // [m]; where they overlap, 0 or less
  VecF<Dim> normal = VecF<Dim>::Zero();  // unit, from the first to the second
};

/// The share of a step after which two pieces are nearer than `near` [m], by conservative advancement (Mirtich 1996):
/// no advance is longer than their gap. None: they do not get so near within the step. `turns`: way of the farthest
/// points of both around their centres, together at most [m]. `gap_at`: their gap after a share of the step.
template <int Dim>
std::optional<float> first_touch(const StepMotion<Dim>& a, const StepMotion<Dim>& b, float turns, float near,
                                 const std::function<PieceGap<Dim>(float)>& gap_at);

/// A step is solved again when a body that was struck in it gets past something out of its expected reach: a chain of
/// so many may be struck in a step.
inline constexpr int most_solves = 8;

/// The awake body that has a slot of the solver, and its images, which come after it in `bodies`. `firsts`: by slot,
/// from 1 on, the number of the body there.
template <typename Body>
std::span<Body* const> bodies_at(int slot, std::span<const std::size_t> firsts, std::span<Body* const> bodies) {
  const std::size_t first = firsts[slot - 1];
  const std::size_t next = slot < std::ssize(firsts) ? firsts[slot] : bodies.size();
  return bodies.subspan(first, next - first);
}

/// Finds the bodies of which a point goes further in a step than half of the thinnest piece of all: contacts found
/// at the end of such a step would begin deep, or be missed. An engine finds the contacts of these where they will be
/// (first_touch()) and adds them to the solver before it solves. What is struck in the step may become fast in it: then
/// the engine finds its contacts too and solves the step again.
template <int Dim>
class FastBodies {
 public:
  explicit FastBodies(const WorldDescription<Dim>& description);

  /// The awake bodies are in the solver, in the slots from 1 to `bodies`: found() are those that are fast by their
  /// velocity.
  void expect(const ContactSolver<Dim>& solver, int bodies, float dt);
  /// The step is solved: found() are the bodies that have left the path on which they were expected by more than half
  /// of the thinnest piece, beyond which they might be pushed to the other side.
  void follow(const ContactSolver<Dim>& solver);
  /// Slots, ascending.
  std::span<const int> found() const { return found_; }

  /// Displacement of a body before its contacts are detected: half of its motion in the step; zero if the body is fast
  /// or hardly moves.
  StepMotion<Dim> drift(const StepMotion<Dim>& motion) const { return drift(motion, reach_); }
  /// The same of an obstacle, by its number.
  StepMotion<Dim> drift_of_obstacle(int number, const StepMotion<Dim>& motion) const {
    return drift(motion, obstacle_reaches_[number]);
  }

  /// Of an awake body, as far as it is known.
  const StepMotion<Dim>& motion(int slot) const { return expected_[slot - 1]; }
  bool is_fast(int slot) const { return is_fast(motion(slot)); }
  /// Whether its way in the step is more than half of the way from which on a body counts as fast.
  bool is_half_fast(int slot) const { return way_of(motion(slot)) > 0.5F * limit_; }
  /// Way of its farthest point around its centre at most [m].
  float turn(const StepMotion<Dim>& motion) const { return reach_ * motion.turn.norm(); }
  float turn_of_obstacle(int number, const StepMotion<Dim>& motion) const {
    return obstacle_reaches_[number] * motion.turn.norm();
  }
  /// The longest way of any point of an awake body [m].
  float longest() const { return longest_; }

  /// How far two bodies may come together in a step without a contact known before [m].
  float limit() const { return limit_; }
  /// Contacts of different corners are further apart than this [m].
  float corner() const { return 0.5F * limit_; }
  /// So near a contact is known well: the smaller, the more gaps a search takes [m].
  float near() const { return 0.25F * limit_; }
  /// Whether the solved step presses the bodies of this point further into each other than contacts may begin.
  bool passes(const ContactSolver<Dim>& solver, const ContactPoint<Dim>& point) const;
  /// Appends a point of the ground (slot 0) and the body (`slot`) for each corner that the step takes below the ground,
  /// without what PairResistance adds.
  /// `buried`: also for those that are there already.
  void meet_ground(int slot, int shape, const Pose<Dim>& pose, bool buried,
                   std::vector<ContactPoint<Dim>>& found) const;

 private:
  /// A corner of a piece, from the centre of mass, with the piece's radius around it [m].
  struct Corner {
    Vec<Dim> place = Vec<Dim>::Zero();
    double radius = 0.0;
  };
  StepMotion<Dim> drift(const StepMotion<Dim>& motion, float reach) const;
  static float way_of(const StepMotion<Dim>& motion, float reach) {
    return motion.way.norm() + reach * motion.turn.norm();
  }
  float way_of(const StepMotion<Dim>& motion) const { return way_of(motion, reach_); }
  bool is_fast(const StepMotion<Dim>& motion) const { return way_of(motion) > limit_; }
  float stray(const StepMotion<Dim>& moved, const StepMotion<Dim>& expected) const;

  Ground ground_;
  std::vector<Material> materials_;           // by shape
  std::vector<std::vector<Corner>> corners_;  // by shape
  float reach_ = 0.0F;                        // from a body's centre to any point of it at most, over all shapes [m]
  std::vector<float> obstacle_reaches_;       // by number: from its centre to any point of it at most [m]
  float limit_ = 0.0F;                        // [m]
  float longest_ = 0.0F;
  std::vector<StepMotion<Dim>> expected_;  // by slot, less 1
  std::vector<int> found_;
};

}  // namespace talus
