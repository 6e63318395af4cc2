#pragma once
// A step of a Box2D world in which Box2D detects contacts and the common solver solves them.

#include <box2d/box2d.h>

#include <compare>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "common/solver/contact_solver.h"
#include "common/solver/drift.h"
#include "common/solver/pair_resistance.h"
#include "common/solver/ring.h"
#include "common/world/world.h"
#include "sim2d/body_template.h"
#include "sim2d/collision.h"
#include "sim2d/contacts_ahead.h"
#include "sim2d/tag.h"
#include "sim2d/warm_start.h"

namespace talus::box2d {

/// What the solver is given of a world, besides what Box2D keeps.
struct StepInput {
  std::span<const BodyIndex> awake;
  const BodyStates<2>& states;              // of the start of the step
  std::span<const BodyTemplate> templates;  // by shape
  std::span<b2Body* const> obstacles;       // null: removed
  std::span<const Vec<2>> belts;            // by number: velocity of the surface [m/s]; empty: no belt
  std::span<const Push<2>> pushes;
  std::span<const Image> images;  // by body

  /// Of a side of a contact, where it is an image.
  BodyIndex original(BodyIndex side) const { return side < 0 ? side : images[side].of; }
};

/// Box2D keeps its bodies, broad phase, narrow phase and manifolds, in which the impulses are carried from step to
/// step. Sleepers are in the solver with their mass, see SolverBody.
class SmallSteps {
 public:
  /// `ring`: of the sleeping bodies, none where they feel nothing; outlives this.
  SmallSteps(const WorldDescription<2>& description, std::optional<Ring<2>>& ring);

  /// Moves the awake bodies and the moving obstacles by half of the coming step, where step() detects their contacts.
  void drift(std::span<b2Body* const> bodies, const StepInput& input);
  /// Called in place of b2World::Step(), after drift() and after Box2D has found all new pairs.
  EngineTimes step(b2World& world, const StepInput& input, std::span<b2Body* const> bodies);

  void share_among(const std::shared_ptr<Team>& team) {
    team_ = team;
    solver_.share_among(team);
  }

  /// With a ring: awake bodies fall asleep. To be called before their bodies in Box2D are destroyed, and after Box2D
  /// has found all new pairs.
  void freeze(b2World& world, const StepInput& input, std::span<const BodyIndex> bodies, std::span<b2Body* const> from);
  /// With a ring: a body wakes. Returns its velocity and its displacement; the impulses of its contacts go to `warm`.
  SolverBody<2> thaw(BodyIndex body, WarmStart& warm);

  /// Appends the contacts of the last step, sorted by their bodies and pieces. Each is listed once: that of two awake
  /// bodies under the one with the lower index.
  void gather(const BodyStates<2>& states, std::vector<Contact<2>>& out) const;

 private:
  /// Where a point of the solver comes from.
  struct Source {
    Tag a{};
    Tag b{};
    b2Contact* contact = nullptr;  // null: found ahead
    int number = 0;                // of the manifold's point
  };
  /// A contact point with what gather() sorts by: its bodies, of which `a` is awake, then their pieces.
  struct Listed {
    std::int64_t bodies = 0;  // a, then b
    std::int64_t pieces = 0;  // of b, then of a
    std::uint32_t source = 0;
    bool swapped = false;  // the source has the bodies in the other order
    auto operator<=>(const Listed&) const = default;
  };
  /// A rolling impulse, from the last step to the next.
  struct Rolling {
    Tag low{};
    Tag high{};
    float impulse = 0.0F;  // on the owner of `high` [N m s]
    std::pair<Tag, Tag> pair() const { return {low, high}; }
  };
  /// What two sides have moved by, since the start of the step, when their contact is found.
  struct Motions {
    StepMotion<2> a;
    StepMotion<2> b;
  };
  struct Fixtures {
    b2Fixture* a = nullptr;
    b2Fixture* b = nullptr;
    float friction = 0.0F;
    float restitution = 0.0F;
    b2Contact* contact = nullptr;
  };

  /// A contact point that may begin within the step; its slots are those of what moves.
  struct Ahead {
    Tag a{};
    Tag b{};
    int number = 0;  // among the points of its pair
    ContactPoint<2> point;
  };

  void expect_motion(b2World& world, const StepInput& input, std::span<b2Body* const> bodies);
  bool passes_unseen(b2World& world, const StepInput& input, std::span<b2Body* const> bodies);
  static bool is_buried(b2Contact& contact);
  void add_bodies(const StepInput& input, std::span<b2Body* const> bodies);
  void keep(b2Contact& contact, const StepInput& input);
  void keep_near(b2World& world, const StepInput& input, b2Body& body);
  void keep(const Fixtures& pair, const b2Manifold& manifold, const b2WorldManifold& place, const StepInput& input);
  int slot_of(BodyIndex owner, const VecF<2>& normal, const StepInput& input);
  b2Vec2 start_of(b2Fixture& fixture, const BodyStates<2>& states) const;
  void add_points_ahead(const StepInput& input);
  void add_contacts(const StepInput& input);
  static Fixtures fixtures_of(b2Contact& contact);
  static Fixtures unknown_pair(b2Fixture& a, b2Fixture& b);
  std::span<const ContactPoint<2>> points_of(const Fixtures& pair, const b2Manifold& manifold,
                                             const b2WorldManifold& place, const StepInput& input,
                                             const Motions& moved);
  void add_rolling_impulse(const Fixtures& pair, ContactPoint<2>& point) const;
  int moving_slot(BodyIndex owner) const;
  Mover mover_of(b2Fixture& fixture) const;
  void find_ahead(b2World& world, const StepInput& input, b2Body& body, bool first);
  void find_around(b2World& world, const Mover& mover, float margin);
  bool is_known(b2Fixture& one, b2Fixture& other) const;
  void add_ahead(const Meeting& met, const StepInput& input);
  void add_ground_ahead(const StepInput& input, b2Body& body);
  void add_ahead(Tag a, Tag b, ContactPoint<2> point, const b2Body& body_b);
  StepMotion<2> drift_of(BodyIndex owner) const;
  void write_impulses();
  void move_bodies(const StepInput& input, std::span<b2Body* const> bodies) const;

  std::optional<Ring<2>>& ring_;
  SolverParams params_;
  float dt_;
  FastBodies<2> fast_;
  PairResistance<2> resistance_;
  Drift<2> drift_;
  ContactSolver<2> solver_;
  Collision collision_;
  std::shared_ptr<Team> team_ = std::make_shared<Team>(1);
  std::vector<Ahead> ahead_;
  std::vector<std::size_t> first_of_;       // by slot of an awake body, from 1 on: its number among the awake
  std::vector<Source> sources_;             // by point
  std::vector<int> slots_;                  // by body; 0: not in this step yet
  std::vector<BodyIndex> sleepers_;         // in this step
  std::vector<int> obstacle_slots_;         // by number
  std::vector<Rolling> rolling_;            // of the last step, sorted
  BodyIndex detected_ = 0;                  // number of bodies that collision detection has seen
  std::vector<b2Fixture*> found_;           // scratch
  std::vector<Meeting> found_near_;         // scratch
  std::vector<ContactPoint<2>> points_;     // scratch
  std::vector<SleepingPoint<2>> released_;  // scratch
  mutable std::vector<Listed> ordered_;     // scratch
};

}  // namespace talus::box2d
