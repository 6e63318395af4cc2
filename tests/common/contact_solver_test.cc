// The contact solver alone, on bodies whose contacts are known: spheres, and boxes by their corners.

#include "common/solver/contact_solver.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace talus::contact_solver_test {
namespace {

constexpr float dt = 1.0F / 60.0F;
constexpr float g = 10.0F;

template <int Dim>
VecF<Dim> up() {
  return VecF<Dim>::Unit(Dim - 1);
}

/// A box or ball and where it is. Angles stay small, so its contacts are those of the upright box.
template <int Dim>
struct Thing {
  VecF<Dim> at = VecF<Dim>::Zero();
  SolverBody<Dim> body;
  SpinF<Dim> turn = SpinF<Dim>::Zero();
};

template <int Dim>
SolverBody<Dim> body_of(float mass, float inertia) {
  SolverBody<Dim> body;
  body.inverse_mass = 1.0F / mass;
  body.inverse_inertia = InertiaF<Dim>::Identity() / inertia;
  body.moves = true;
  return body;
}

VecF<2> turned(const SpinF<2>& spin, const VecF<2>& arm) { return spin[0] * VecF<2>(-arm.y(), arm.x()); }
VecF<3> turned(const SpinF<3>& spin, const VecF<3>& arm) { return spin.cross(arm); }

/// Corners of the lower face of a cube of 1 m.
template <int Dim>
std::vector<VecF<Dim>> feet() {
  std::vector<VecF<Dim>> all;
  for (const float x : {-0.5F, 0.5F}) {
    if constexpr (Dim == 2)
      all.push_back({x, -0.5F});
    else
      for (const float y : {-0.5F, 0.5F}) all.push_back({x, y, -0.5F});
  }
  return all;
}

/// Cubes of 1 m one on the other over the ground z = 0, each touching the one below with its corners.
template <int Dim>
class Tower {
 public:
  Tower(const std::vector<float>& masses, SolverLanes lanes, const SolverParams& params = {})
      : params_(params), solver_(lanes) {
    for (std::size_t i = 0; i < masses.size(); ++i)
      things_.push_back(
          {(0.5F + static_cast<float>(i)) * up<Dim>(), body_of<Dim>(masses[i], masses[i] / 6.0F), SpinF<Dim>::Zero()});
  }

  void step(const VecF<Dim>& gravity = -g * up<Dim>()) {
    solver_.start();
    for (const Thing<Dim>& thing : things_) solver_.add(thing.body);
    for (int i = 0; i < std::ssize(things_); ++i) add_contacts(i);
    solver_.solve(params_, gravity, dt);
    for (int i = 0; i < std::ssize(things_); ++i) {
      things_[i].body = solver_.body(i + 1);
      things_[i].at += things_[i].body.way;
      things_[i].turn += things_[i].body.turn;
    }
    for (std::size_t i = 0; i < solver_.points().size(); ++i) kept_[i] = solver_.points()[i];
  }

  std::vector<Thing<Dim>>& things() { return things_; }
  std::span<const ContactPoint<Dim>> points() const { return solver_.points(); }
  float friction = 0.5F;

  /// Impulse of the step between a body and the one below it.
  float load(int upper) const {
    float sum = 0.0F;
    for (const ContactPoint<Dim>& point : points())
      if (point.b == upper + 1) sum += point.normal_sum;
    return sum;
  }

 private:
  void add_contacts(int upper) {
    const Thing<Dim>& above = things_[upper];
    for (const VecF<Dim>& foot : feet<Dim>()) {
      ContactPoint<Dim> point;
      point.a = upper;
      point.b = upper + 1;
      point.arm_b = foot + turned(above.turn, foot);
      const VecF<Dim> at = above.at + point.arm_b;
      float floor = 0.0F;
      if (upper > 0) {
        const Thing<Dim>& below = things_[upper - 1];
        point.arm_a = at - below.at;
        point.normal = (up<Dim>() + turned(below.turn, up<Dim>())).normalized();
        VecF<Dim> top = point.arm_a;
        top[Dim - 1] = 0.5F;
        floor = below.at[Dim - 1] + 0.5F + turned(below.turn, top)[Dim - 1];
      }
      point.gap = at[Dim - 1] - floor;
      point.friction = friction;
      const ContactPoint<Dim>& last = kept_[solver_.points().size()];
      point.normal_impulse = last.normal_impulse;
      point.friction_impulse = last.friction_impulse;
      solver_.add(point);
    }
  }

  SolverParams params_;
  ContactSolver<Dim> solver_;
  std::vector<Thing<Dim>> things_;
  std::map<std::size_t, ContactPoint<Dim>> kept_;
};

template <typename T>
class ContactSolverTest : public testing::Test {
 protected:
  static constexpr int dim = T::value;
  using V = VecF<dim>;

  /// Ball of radius 0.5 that comes down on the ground or on another ball along the last axis; both after one step.
  static std::pair<SolverBody<dim>, SolverBody<dim>> impact(float speed, float restitution, float mass_below) {
    ContactSolver<dim> solver;
    SolverBody<dim> above = body_of<dim>(1.0F, 0.1F);
    above.velocity = -speed * up<dim>();
    const int first = solver.add(above);
    int below = 0;
    if (mass_below > 0.0F) below = solver.add(body_of<dim>(mass_below, 0.1F * mass_below));
    ContactPoint<dim> point;
    point.a = below;
    point.b = first;
    point.arm_b = -0.5F * up<dim>();
    if (below != 0) point.arm_a = 0.5F * up<dim>();
    point.restitution = restitution;
    solver.add(point);
    solver.solve({}, V::Zero(), dt);
    return {solver.body(first), solver.body(below)};
  }
};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(ContactSolverTest, Dimensions);

TYPED_TEST(ContactSolverTest, ABallBouncesOffTheGroundWithItsRestitution) {
  constexpr int D = TypeParam::value;
  for (const float restitution : {0.0F, 0.5F, 1.0F})
    EXPECT_NEAR(this->impact(4.0F, restitution, 0.0F).first.velocity[D - 1], 4.0F * restitution, 1e-5F);
}

// Momentum is kept, and the balls part at e times the speed at which they met: v = (m1 - e m2)/(m1 + m2) u.
TYPED_TEST(ContactSolverTest, AHeadOnImpactOfUnequalBallsIsThatOfNewton) {
  constexpr int D = TypeParam::value;
  for (const float restitution : {0.0F, 0.3F, 1.0F}) {
    const auto [above, below] = this->impact(3.0F, restitution, 4.0F);
    const float common = -3.0F / 5.0F;
    EXPECT_NEAR(above.velocity[D - 1], common + restitution * 3.0F * 4.0F / 5.0F, 1e-5F);
    EXPECT_NEAR(below.velocity[D - 1], common - restitution * 3.0F / 5.0F, 1e-5F);
  }
}

TYPED_TEST(ContactSolverTest, ATowerCarriesTheWeightOfEachOfItsBoxes) {
  constexpr int boxes = 10;
  Tower<TypeParam::value> tower(std::vector<float>(boxes, 2.0F), solver_lanes().back());
  for (int i = 0; i < 600; ++i) tower.step();
  for (int i = 0; i < boxes; ++i) {
    const float weight = 2.0F * g * dt * static_cast<float>(boxes - i);
    EXPECT_NEAR(tower.load(i), weight, 1e-3F * weight);
    EXPECT_LT(tower.things()[i].body.velocity.norm(), 1e-4F);
    EXPECT_LT(tower.things()[i].at.template head<TypeParam::value - 1>().norm(), 1e-3F);
  }
}

// The springs are as stiff as the light bodies let them be, so the column gives way: by 3 cm at a hundred times the
// mass.
TYPED_TEST(ContactSolverTest, LightBoxesCarryOneOfAHundredTimesTheirMass) {
  constexpr int D = TypeParam::value;
  const std::vector<std::vector<float>> columns = {
      {1.0F, 10.0F}, {1.0F, 1.0F, 10.0F}, {1.0F, 100.0F}, {1.0F, 1.0F, 100.0F}};
  for (const std::vector<float>& masses : columns) {
    for (const float shift : {0.0F, 0.01F}) {
      Tower<D> tower(masses, solver_lanes().back());
      for (std::size_t i = 0; i < masses.size(); ++i) tower.things()[i].at[0] = i % 2 == 0 ? shift : -shift;
      for (int i = 0; i < 600; ++i) tower.step();
      const float heavy = masses.back();
      const float weight = g * dt * (heavy + static_cast<float>(masses.size() - 1));
      EXPECT_NEAR(tower.load(0), weight, 1e-3F * weight);
      for (std::size_t i = 0; i < masses.size(); ++i) {
        EXPECT_NEAR(tower.things()[i].at[D - 1], 0.5F + static_cast<float>(i), 3.5e-4F * heavy);
        EXPECT_LT(tower.things()[i].body.velocity.norm(), 1e-4F) << heavy << " kg, body " << i;
        EXPECT_LT(tower.things()[i].turn.norm(), 0.005F);
      }
    }
  }
}

// Gravity of slope tan(a): a box slides once tan(a) exceeds its friction, with the acceleration g (sin a - mu cos a).
TYPED_TEST(ContactSolverTest, ABoxSlidesOnASlopeAboveItsFrictionAngleOnly) {
  constexpr int D = TypeParam::value;
  for (const float slope : {0.45F, 0.6F}) {
    Tower<D> tower({1.0F}, solver_lanes().back());
    const float angle = std::atan(slope);
    VecF<D> gravity = -g * std::cos(angle) * up<D>();
    gravity[0] = g * std::sin(angle);
    for (int i = 0; i < 60; ++i) tower.step(gravity);
    const float expected = std::max(0.0F, 0.5F * g * (std::sin(angle) - 0.5F * std::cos(angle)));
    EXPECT_NEAR(tower.things()[0].at[0], expected, 0.02F * expected + 1e-3F) << slope;
  }
}

// An impact at the friction angle: friction takes mu times the normal momentum, so that a box that lands on the slope
// stops. The passes leave up to a tenth of the tangential speed.
TYPED_TEST(ContactSolverTest, ABoxThatLandsOnASlopeAtItsFrictionAngleStops) {
  constexpr int D = TypeParam::value;
  const float angle = std::atan(0.5F);
  VecF<D> gravity = -g * std::cos(angle) * up<D>();
  gravity[0] = g * std::sin(angle);
  for (const float height : {0.003F, 0.01F, 0.02F, 0.03F}) {
    Tower<D> tower({1.0F}, solver_lanes().back());
    tower.things()[0].at[D - 1] += height;
    const float speed = std::sqrt(2.0F * g * std::cos(angle) * height) * std::tan(angle);  // along the slope
    for (int i = 0; i < 60; ++i) tower.step(gravity);
    EXPECT_LT(tower.things()[0].body.velocity[0], 0.1F * speed) << height;
  }
}

// On the friction angle itself nothing decides; in two directions at once the limit is a cone, not a pyramid.
TEST(ContactSolverTest, FrictionInSpaceIsTheSameInAllDirections) {
  for (const float angle : {0.0F, 0.4F, 0.785F}) {
    ContactSolver<3> solver;
    SolverBody<3> puck = body_of<3>(1.0F, 1e6F);
    puck.velocity = 2.0F * VecF<3>(std::cos(angle), std::sin(angle), 0.0F);
    const int slot = solver.add(puck);
    ContactPoint<3> point;
    point.b = slot;
    point.friction = 0.5F;
    point.normal_impulse = g * dt;
    solver.add(point);
    solver.solve({}, VecF<3>(0.0F, 0.0F, -g), dt);
    EXPECT_NEAR(solver.body(slot).velocity.head<2>().norm(), 2.0F - 0.5F * g * dt, 0.02F * g * dt);
    EXPECT_NEAR(std::atan2(solver.body(slot).velocity.y(), solver.body(slot).velocity.x()), angle, 1e-4F);
  }
}

// A spinning ball under its weight is slowed by the torque arm * m g.
TYPED_TEST(ContactSolverTest, RollingResistanceSlowsASpinByItsArm) {
  constexpr int D = TypeParam::value;
  ContactSolver<D> solver;
  SolverBody<D> ball = body_of<D>(2.0F, 0.5F);
  ball.spin[0] = 3.0F;
  const int slot = solver.add(ball);
  ContactPoint<D> point;
  point.b = slot;
  point.rolling_arm = 0.1F;
  point.normal_impulse = 2.0F * g * dt;
  solver.add(point);
  solver.solve({}, -g * up<D>(), dt);
  EXPECT_NEAR(solver.body(slot).spin[0], 3.0F - 0.1F * 2.0F * g * dt / 0.5F, 1e-3F);
}

// Two contacts of one pair may be grouped otherwise than in the step before, so any of their points may carry a rolling
// impulse. Where nothing presses it holds nothing.
TYPED_TEST(ContactSolverTest, ARollingImpulseThatNothingPressesTurnsNoBody) {
  constexpr int D = TypeParam::value;
  for (int points = 1; points <= 3; ++points) {
    for (int carries = 0; carries < points; ++carries) {
      ContactSolver<D> solver;
      const int slot = solver.add(body_of<D>(2.0F, 0.5F));
      for (int i = 0; i < points; ++i) {
        ContactPoint<D> point;
        point.b = slot;
        point.gap = 1.0F;
        point.rolling_arm = 0.1F;
        if (i == carries) point.rolling_impulse[0] = 5.0F;
        solver.add(point);
      }
      solver.solve({}, VecF<D>::Zero(), dt);
      EXPECT_NEAR(solver.body(slot).spin.norm(), 0.0F, 1e-4F) << points << " points, number " << carries;
    }
  }
}

// Bodies of several pieces have several contacts, which an engine lists among those of others.
TYPED_TEST(ContactSolverTest, CohesionOfAPairDoesNotDependOnTheOrderOfItsContacts) {
  constexpr int D = TypeParam::value;
  for (const std::vector<int>& partners : {std::vector{2, 2, 3}, std::vector{2, 3, 2}}) {
    ContactSolver<D> solver;
    for (int i = 0; i < 3; ++i) solver.add(body_of<D>(2.0F, 0.5F));
    for (const int partner : partners) {
      ContactPoint<D> point;
      point.a = 1;
      point.b = partner;
      point.cohesion = 0.5F;
      solver.add(point);
    }
    solver.solve({}, -g * up<D>(), dt);
    float attraction = 0.0F;
    for (const ContactPoint<D>& point : solver.points())
      if (point.b == 2) attraction += point.attraction;
    EXPECT_NEAR(attraction, 0.5F * 2.0F * g * dt, 1e-5F);
  }
}

TYPED_TEST(ContactSolverTest, ContactsWithSleepersAreAsStiffAsWithTheSameBodiesAwake) {
  constexpr int D = TypeParam::value;
  // An overlap between two bodies at rest parts at the same speed in the first step, shared by their masses.
  const auto parting = [](bool other_moves) {
    ContactSolver<D> solver;
    SolverBody<D> one = body_of<D>(1.0F, 0.1F);
    SolverBody<D> other = one;
    other.moves = other_moves;
    const int a = solver.add(other);
    const int b = solver.add(one);
    ContactPoint<D> point;
    point.a = a;
    point.b = b;
    point.gap = -0.004F;
    point.normal_impulse = 0.0F;
    solver.add(point);
    solver.solve({}, VecF<D>::Zero(), dt);
    return (solver.body(b).way - solver.body(a).way)[D - 1];
  };
  EXPECT_GT(parting(true), 0.0F);
  EXPECT_NEAR(parting(false), parting(true), 0.05F * parting(true));
}

/// A heap of balls that collide at random: all that a step may have in it.
template <int Dim>
std::vector<SolverBody<Dim>> random_step(SolverLanes lanes, int bodies, float gravity,
                                         std::vector<float>* impulses = nullptr, int threads = 1) {
  std::mt19937 random(7);
  const auto number = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random()) / 4294967296.0F;
  };
  const auto vector = [&](float most) {
    VecF<Dim> v;
    for (int i = 0; i < Dim; ++i) v[i] = number(-most, most);
    return v;
  };
  ContactSolver<Dim> solver(lanes);
  solver.share_among(std::make_shared<Team>(threads));
  std::vector<SolverBody<Dim>> result;
  for (int repeat = 0; repeat < 3; ++repeat) {  // memory is used again
    solver.start();
    for (int i = 0; i < bodies; ++i) {
      SolverBody<Dim> body = body_of<Dim>(number(0.5F, 5.0F), number(0.1F, 1.0F));
      body.velocity = vector(5.0F);
      for (int k = 0; k < body.spin.size(); ++k) body.spin[k] = number(-3.0F, 3.0F);
      body.moves = i % 9 != 0;
      if (!body.moves && i % 2 == 0) body.velocity.setZero(), body.spin.setZero();  // the others as obstacles do
      body.position = static_cast<float>(i) / 16.0F * VecF<Dim>::UnitX() + vector(1.0F);
      solver.add(body);
    }
    for (int i = 0; i < 3 * bodies; ++i) {
      ContactPoint<Dim> point;
      point.a = static_cast<int>(number(0.0F, static_cast<float>(bodies)));
      point.b = i % 5 == 0 ? 1 : static_cast<int>(number(1.0F, static_cast<float>(bodies) + 0.99F));
      if (point.a == point.b) continue;
      point.normal = vector(1.0F).normalized();
      point.friction = number(0.0F, 1.0F);
      point.restitution = i % 4 == 0 ? 0.5F : 0.0F;
      point.rolling_arm = i % 3 == 0 ? 0.1F : 0.0F;
      const int corners = 1 + i % (Dim == 2 ? 2 : 4);
      for (int k = 0; k < corners; ++k) {
        point.arm_a = vector(0.5F);
        point.arm_b = point.arm_a;  // the centres are where they need to be
        point.gap = number(-0.03F, 0.01F);
        point.normal_impulse = number(0.0F, 0.5F);
        point.friction_impulse = vector(0.1F);
        solver.add(point);
      }
    }
    solver.solve({}, gravity * up<Dim>(), dt);
  }
  for (int i = 1; i <= bodies; ++i) result.push_back(solver.body(i));
  if (impulses != nullptr)
    for (const ContactPoint<Dim>& point : solver.points()) {
      impulses->push_back(point.normal_sum);
      impulses->push_back(point.friction_sum.norm());
      impulses->push_back(point.normal_impulse);
    }
  return result;
}

TYPED_TEST(ContactSolverTest, AllLanesGiveTheSameBits) {
  constexpr int D = TypeParam::value;
  for (const int bodies : {3, 40, 300}) {
    std::vector<float> expected;
    const auto plain = random_step<D>(SolverLanes::plain, bodies, -g, &expected);
    for (const SolverLanes lanes : solver_lanes()) {
      std::vector<float> impulses;
      const auto other = random_step<D>(lanes, bodies, -g, &impulses);
      ASSERT_EQ(impulses.size(), expected.size());
      for (std::size_t i = 0; i < impulses.size(); ++i)
        ASSERT_EQ(std::bit_cast<std::uint32_t>(impulses[i]), std::bit_cast<std::uint32_t>(expected[i]));
      for (int i = 0; i < bodies; ++i) {
        ASSERT_EQ(plain[i].velocity, other[i].velocity);
        ASSERT_EQ(plain[i].spin, other[i].spin);
        ASSERT_EQ(plain[i].way, other[i].way);
        ASSERT_EQ(plain[i].turn, other[i].turn);
      }
    }
  }
}

// Of 40 bodies all are of one region, of 3,000 eight share the contacts.
TYPED_TEST(ContactSolverTest, AnyNumberOfThreadsGivesTheSameBits) {
  constexpr int D = TypeParam::value;
  for (const int bodies : {40, 3000}) {
    const auto expected = random_step<D>(solver_lanes().back(), bodies, -g);
    for (const int threads : {2, 3, 8}) {
      const auto other = random_step<D>(solver_lanes().back(), bodies, -g, nullptr, threads);
      for (int i = 0; i < bodies; ++i) {
        ASSERT_EQ(expected[i].velocity, other[i].velocity) << i << " of " << bodies << ", " << threads << " threads";
        ASSERT_EQ(expected[i].spin, other[i].spin);
        ASSERT_EQ(expected[i].way, other[i].way);
        ASSERT_EQ(expected[i].turn, other[i].turn);
      }
    }
  }
}

// In one region, and over the borders of several.
TYPED_TEST(ContactSolverTest, BodiesAmongThemselvesKeepTheirMomentum) {
  constexpr int D = TypeParam::value;
  for (const int bodies : {6, 900}) {
    ContactSolver<D> solver;
    Vec<D> before = Vec<D>::Zero();
    for (int i = 0; i < bodies; ++i) {
      SolverBody<D> body = body_of<D>(1.0F + static_cast<float>(i % 6), 1.0F);
      body.velocity = (i % 2 == 0 ? -2.0F : 3.0F) * up<D>();
      body.velocity[0] = static_cast<float>(i % 6) - 2.0F;
      body.position[0] = static_cast<float>(i);
      before += (body.velocity / body.inverse_mass).template cast<double>();
      solver.add(body);
    }
    for (int i = 1; i < bodies; ++i) {
      ContactPoint<D> point;
      point.a = i;
      point.b = i + 1;
      point.arm_a = 0.5F * up<D>();
      point.arm_b = -0.5F * up<D>();
      point.friction = 0.4F;
      point.restitution = 0.3F;
      point.gap = -0.02F;
      solver.add(point);
    }
    solver.solve({}, VecF<D>::Zero(), dt);
    Vec<D> after = Vec<D>::Zero();
    for (int i = 1; i <= bodies; ++i)
      after += (solver.body(i).velocity / solver.body(i).inverse_mass).template cast<double>();
    // 21 kg at 3 m/s, some hundred roundings, for each six bodies.
    EXPECT_LT((after - before).norm(), 1e-4 * bodies / 6.0) << bodies << " bodies";
  }
}

// A box of restitution 0 that falls flat must lie still: a spring that carried the impulse of the impact on would throw
// it up again.
TYPED_TEST(ContactSolverTest, AnImpactIsNotThrownBack) {
  constexpr int D = TypeParam::value;
  Tower<D> tower({1.0F}, solver_lanes().back());
  tower.things()[0].at[D - 1] = 0.51F;
  tower.things()[0].body.velocity = -10.0F * up<D>();
  float fastest = -1.0F;
  for (int i = 0; i < 60; ++i) {
    tower.step();
    fastest = std::max(fastest, tower.things()[0].body.velocity[D - 1]);
  }
  EXPECT_LT(fastest, 0.1F);
  EXPECT_NEAR(tower.things()[0].at[D - 1], 0.5F, 0.002F);
}

}  // namespace
}  // namespace talus::contact_solver_test
