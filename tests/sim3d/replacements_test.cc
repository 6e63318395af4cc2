// The replacements of Bullet's classes against the packaged Bullet's own path, bit for bit, whatever happens to the
// bodies.

#include <gtest/gtest.h>

#include <random>

#include "common/shape/catalogue.h"
#include "common/simulation/state_hash.h"
#include "common/world/container.h"
#include "common/world/world.h"
#include "sim3d/make_world.h"

namespace talus::replacements_test {
namespace {

/// Options that put Bullet's own classes in the place of the replacements.
constexpr std::array<bool DebugOptions::*, 2> replacements = {&DebugOptions::bullet_compounds,
                                                              &DebugOptions::visit_separate_pairs};

std::unique_ptr<World<3>> make(const WorldDescription<3>& description) { return make_bullet_world(description); }
std::unique_ptr<World<2>> make(const WorldDescription<2>& description) { return make_bullet_planar_world(description); }

/// Bodies of one sequence, and its random choices.
template <int Dim>
class Sequence {
 public:
  explicit Sequence(unsigned seed) : random_(seed) {
    description_.shapes = shapes();
    description_.ground.material.restitution = chance(0.3) ? 0.7 : 0.0;
    description_.solver.friction_directions = Dim == 3 && chance(0.15) ? 1 : 2;
    description_.solver.velocity_iterations = 1 + below(12);
    if (chance(0.5)) description_.solver.kind = engine_solver;
    description_.engine_sleep = !description_.solver.small_steps() && chance(0.4);
    description_.debug.keep_sleepers = chance(0.1);
    if (chance(0.4)) {
      Vec<Dim> size = Vec<Dim>::Constant(3.0);
      size[Dim - 1] = 1.5;
      description_.obstacles = container_walls<Dim>({.inner_size = size, .wall = 0.5}, {}, Material{});
    }
    WorldDescription<Dim> packaged = description_;
    for (const auto field : replacements) {
      packaged.debug.*field = true;
      description_.debug.*field = chance(0.15);
    }
    worlds_ = {make(description_), make(packaged)};
    for (const auto& world : worlds_) world->record_contacts(true);
  }

  /// What differs after that many acts; empty: nothing.
  std::string run(int acts) {
    for (int act = 0; act < acts; ++act) {
      const std::string what = do_something();
      if (state_hash(worlds_[0]->states()) != state_hash(worlds_[1]->states()))
        return "act " + std::to_string(act) + ": " + what;
      if (stopped_) return "";
    }
    return same_contacts() ? "" : "contacts";
  }

 private:
  static std::vector<Shape<Dim>> shapes() {
    Material bouncing;
    bouncing.restitution = 0.6;
    const Vec<Dim> box = Vec<Dim>::Constant(0.6);
    return {make_shape<Dim>("L", l_pieces<Dim>({}), Material{}),
            make_shape<Dim>("ring", ring_pieces<Dim>({}), Material{}),
            make_shape<Dim>("box", box_pieces<Dim>(box), Material{}),
            make_shape<Dim>("ball", ball_pieces<Dim>(0.3), bouncing),
            make_shape<Dim>("capsule", capsule_pieces<Dim>(1.0, 0.2), Material{})};
  }

  bool chance(double share) { return std::uniform_real_distribution<>(0.0, 1.0)(random_) < share; }
  int below(int limit) { return std::uniform_int_distribution<>(0, limit - 1)(random_); }
  double within(double reach) { return std::uniform_real_distribution<>(-reach, reach)(random_); }

  std::string do_something() {
    const int choice = below(20);
    if (choice < 5) {
      add();
      return "add";
    }
    if (choice < 7) {
      freeze(true);
      return "freeze";
    }
    if (choice < 9) {
      freeze(false);
      return "thaw";
    }
    if (choice == 9) {
      remove();
      return "remove";
    }
    step(1 + below(choice == 10 ? 40 : 6));
    return "step";
  }

  /// Often into others, so that deep contacts occur.
  void add() {
    BodyDef<Dim> body;
    body.shape = below(3) > 0 ? 0 : below(static_cast<int>(description_.shapes.size()));
    for (int i = 0; i < Dim; ++i) {
      body.pose.position[i] = within(1.0);
      body.velocity[i] = within(4.0);
    }
    body.pose.position[Dim - 1] += 2.5;
    if constexpr (Dim == 3) {
      body.pose.rotation = Eigen::Quaterniond(within(1.0), within(1.0), within(1.0), 1.0).normalized();
      body.spin = {within(3.0), within(3.0), within(3.0)};
    } else {
      body.pose.rotation = Rotation<2>(within(3.0));
      body.spin[0] = within(3.0);
    }
    for (const auto& world : worlds_) world->add(body);
    present_.push_back(worlds_[0]->states().size() - 1);
  }

  void freeze(bool to_sleep) {
    std::vector<BodyIndex> some;
    for (const BodyIndex body : present_)
      if (chance(0.5)) some.push_back(body);
    for (const auto& world : worlds_) to_sleep ? world->freeze(some) : world->thaw(some);
  }

  void remove() {
    if (present_.empty()) return;
    const auto which = present_.begin() + below(static_cast<int>(present_.size()));
    for (const auto& world : worlds_) world->remove(*which);
    present_.erase(which);
  }

  void step(int steps) {
    for (int i = 0; i < steps && !stopped_; ++i) {
      const bool first = step(*worlds_[0]);
      const bool second = step(*worlds_[1]);
      EXPECT_EQ(first, second);
      stopped_ = !first || !second;
    }
  }

  /// false: the state is no longer finite.
  static bool step(World<Dim>& world) {
    try {
      world.step();
      return true;
    } catch (const NonFiniteState&) {
      return false;
    }
  }

  bool same_contacts() const {
    const auto first = worlds_[0]->contacts();
    const auto second = worlds_[1]->contacts();
    return std::ranges::equal(first, second, [](const Contact<Dim>& a, const Contact<Dim>& b) {
      return a.a == b.a && a.b == b.b && a.point == b.point && a.normal == b.normal &&
             a.normal_impulse == b.normal_impulse && a.friction_impulse == b.friction_impulse && a.depth == b.depth;
    });
  }

  std::mt19937 random_;
  WorldDescription<Dim> description_;
  std::array<std::unique_ptr<World<Dim>>, 2> worlds_;  // with replacements, and Bullet's own path
  std::vector<BodyIndex> present_;
  bool stopped_ = false;
};

template <int Dim>
void expect_same_bits(unsigned first, unsigned last) {
  for (unsigned seed = first; seed < last; ++seed)
    EXPECT_EQ(Sequence<Dim>(seed).run(60), "") << Dim << "D, sequence " << seed;
}

TEST(ReplacementsOfBullet, GiveItsBitsForAnyOrderOfCallsIn3D) { expect_same_bits<3>(0, 150); }
TEST(ReplacementsOfBullet, GiveItsBitsForAnyOrderOfCallsInThePlane) { expect_same_bits<2>(0, 150); }

class LongReplacementsOfBullet : public testing::TestWithParam<unsigned> {};
TEST_P(LongReplacementsOfBullet, GiveItsBitsForAnyOrderOfCallsIn3D) {
  expect_same_bits<3>(GetParam(), GetParam() + 500);
}
TEST_P(LongReplacementsOfBullet, GiveItsBitsForAnyOrderOfCallsInThePlane) {
  expect_same_bits<2>(GetParam(), GetParam() + 500);
}
INSTANTIATE_TEST_SUITE_P(Sequences, LongReplacementsOfBullet, testing::Range(1000U, 6000U, 500U));

}  // namespace
}  // namespace talus::replacements_test
