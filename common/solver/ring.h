#pragma once
// Sleeping bodies that feel forces.

#include <span>
#include <vector>

#include "common/solver/contact_solver.h"
#include "common/solver/sleeping_contacts.h"
#include "common/world/sleep_ring.h"

namespace talus {

/// The sleeping bodies that take part in the contact solve: those that touch an awake body or a moving obstacle, and
/// those up to SleepRing::rings contacts away. They are solved with their mass, the contact points of when they fell
/// asleep and the impulses that held them. So an impact passes on in the same step, as far as it moves bodies; a load
/// or a friction force reaches the next ring in the next step, and the loss of a support acts at once. The engine does
/// not move them: each keeps the velocity and the displacement that the solve gives it here, and is to wake when they
/// are too large. A sleeping body that has itself become faster than `still_speed` counts as moving, so the ring goes
/// as far as the motion does.
///
/// Bodies beyond are immovable. One that loses a contact point, or on which the forces have changed since its last
/// solve, is solved for a while, until it moves or all forces balance. Where nothing moves the ring is empty and costs
/// nothing.
template <int Dim>
class Ring {
 public:
  explicit Ring(const SleepRing& params) : params_(params) {}

  // Between two steps.

  /// A body falls asleep. `state`: its mass and its velocity; `reach`: from its centre to any point of it at most [m].
  void put_to_sleep(BodyIndex body, const SolverBody<Dim>& state, float reach);
  /// A contact point of a body that has fallen asleep, unless the other body is awake; also where the two may touch
  /// later, with gaps up to reach().
  void keep(const SleepingPoint<Dim>& point) { contacts_.keep(point); }
  /// A body wakes. Returns its velocity, and as `way` and `turn` its displacement; its points go to `released`.
  SolverBody<Dim> wake(BodyIndex body, std::vector<SleepingPoint<Dim>>& released);
  /// A body, awake or asleep, or an obstacle leaves the world.
  void forget(BodyIndex side);
  /// Whether a body sleeps here.
  bool has(BodyIndex body) const { return body >= 0 && body < std::ssize(sleepers_) && sleepers_[body].asleep; }
  /// Appends the contacts of the bodies that sleep here with `side`, see World::sleeping_contacts().
  /// `impulse_unit`: of the points' impulses [N s].
  void append_contacts(BodyIndex side, const BodyStates<Dim>& states, double impulse_unit,
                       std::vector<Contact<Dim>>& out) const;
  /// How far two bodies come together in their sleep at most, before one of them wakes [m].
  float reach() const;
  /// Whether a body sleeps here and has a contact point with a body that does too, or with an obstacle.
  bool touch(BodyIndex body, BodyIndex side) const;

  // Within a step.

  /// Whether no sleeping body would be solved if nothing is awake. `moving`: the obstacles that move in the step.
  bool idle(std::span<const BodyIndex> moving) const;
  void start();
  /// In place of start() when the same step is solved again.
  void start_again();
  /// After the solve under `gravity` [m/s^2]: whether an impact has reached bodies that were immovable in it. Solved
  /// again, the step has these and more around them in the ring.
  bool widen(const ContactSolver<Dim>& solver, float gravity);
  /// The slot of a body that sleeps here and touches one that is awake.
  int join(BodyIndex body, ContactSolver<Dim>& solver);
  /// Adds the other bodies of the ring, and the contact points between sleeping bodies. To be called after all awake
  /// bodies and their points have been added. `obstacle_slots`: by number; 0 of those that do not move.
  void extend(ContactSolver<Dim>& solver, std::span<const int> obstacle_slots);
  /// Displacement of a body since it fell asleep here; zero for any other body, the ground and obstacles.
  StepMotion<Dim> shift(BodyIndex body) const;
  /// After the solve of a step of `dt` [s] under `gravity` [m/s^2].
  void read(const ContactSolver<Dim>& solver, float gravity, float dt);

  /// Bodies that are to wake after the last step, ascending.
  std::span<const BodyIndex> stirred() const { return stirred_; }
  /// Those that were solved in the last step.
  std::span<const BodyIndex> members() const { return members_; }

 private:
  struct Sleeper {
    SolverBody<Dim> body;  // `way` and `turn`: since it fell asleep
    float reach = 0.0F;
    bool asleep = false;
    int left = -1;                           // contacts by which the ring goes on from it; -1: not in the ring
    int slot = 0;                            // 0: not in the solver in this step
    int hold = 0;                            // steps for which it stays once it is not reached any more; below 0: none
    float tried = 0.0F;                      // time in which it was solved since it fell asleep [sqrt(D/g)]
    VecF<Dim> unsolved = VecF<Dim>::Zero();  // impulses of its points, less those when it was last solved [N s]
    VecF<Dim> struck = VecF<Dim>::Zero();    // the same of an immovable one, over the whole of this step [N s]
  };

  void disturb(BodyIndex body);
  void enter(BodyIndex body, int left, ContactSolver<Dim>& solver);
  void enter_partners(BodyIndex side, int left, ContactSolver<Dim>& solver);
  void hold_back(ContactSolver<Dim>& solver);
  bool is_on_trial(BodyIndex body) const;
  void let_go();
  void add_points(BodyIndex body, ContactSolver<Dim>& solver, std::span<const int> obstacle_slots);
  int slot_of(BodyIndex side, ContactSolver<Dim>& solver, std::span<const int> obstacle_slots);
  static float far_of(const Sleeper& sleeper);
  float still_speed(float gravity) const;
  Contact<Dim> contact_of(const SleepingPoint<Dim>& point, BodyIndex side, const BodyStates<Dim>& states,
                          double impulse_unit) const;
  void read_points(const ContactSolver<Dim>& solver, float distance);
  void add_unsolved(const SleepingPoint<Dim>& before, const ContactPoint<Dim>& solved);
  void disturb_unbalanced(float impulse_of_unit_mass);

  SleepRing params_;
  SleepingContacts<Dim> contacts_;
  std::vector<Sleeper> sleepers_;   // by body
  std::vector<BodyIndex> members_;  // of the ring in this step
  std::vector<BodyIndex> before_;   // in the step before, and those that have fallen asleep since
  std::vector<BodyIndex> entered_;  // those from which the ring goes on, in the order in which it reached them
  std::vector<BodyIndex> border_;   // immovable bodies in the solver in this step
  std::vector<BodyIndex> touched_;  // by awake bodies in this step
  std::vector<BodyIndex> last_touched_;
  std::vector<BodyIndex> disturbed_;  // have lost a point since the last step, or are unbalanced
  std::vector<BodyIndex> struck_;     // by an impact in this step, when they were immovable
  int beyond_struck_ = 0;             // contacts by which the ring goes on from those
  std::vector<BodyIndex> unsolved_;   // bodies that may have an `unsolved` impulse, each once
  std::vector<std::uint8_t> listed_;  // [body] whether it is in unsolved_
  std::vector<BodyIndex> moving_;     // sleepers that count as moving
  std::vector<BodyIndex> stirred_;
  std::vector<int> points_;          // in the solver, in their order; the first of them is number first_point_
  std::vector<std::uint8_t> added_;  // [number of a point] whether it is in the solver in this step
  std::size_t first_point_ = 0;
  float slowest_obstacle_ = 0.0F;             // of those that move and touch sleepers [m/s]; 0: none
  std::vector<SleepingPoint<Dim>> released_;  // scratch
};

}  // namespace talus
