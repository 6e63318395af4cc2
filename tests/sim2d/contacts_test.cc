// Box2D's contacts as ours.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/sim2d/heap.h"

namespace talus::contacts_test {
namespace {

TEST(Contacts, ComeOnceEachInTheOrderOfBodies) {
  const auto world = make_box2d_world(l_world());
  add_stack(*world, 40, 6);
  world->record_contacts(true);
  run(*world, 300);
  const auto contacts = world->contacts();
  ASSERT_GT(contacts.size(), 40U);
  EXPECT_TRUE(std::ranges::is_sorted(contacts, {}, [](const Contact<2>& c) { return std::pair(c.a, c.b); }));
  for (const Contact<2>& contact : contacts) {
    EXPECT_TRUE(contact.b < 0 || contact.a < contact.b);
    EXPECT_NEAR(contact.normal.norm(), 1.0, 1e-5);
    EXPECT_GE(contact.normal_impulse, 0.0);
  }
}

// Continuous collision stops the ball on the plate after the solver; its impulse is in no manifold.
TEST(Contacts, TellTheImpulseOfAFastImpactOnASleeper) {
  WorldDescription<2> description;
  description.gravity = 0.0;
  description.shapes = {make_shape<2>("plate", box_pieces<2>({2.0, 0.02}), Material{}),
                        make_shape<2>("ball", ball_pieces<2>(0.2), Material{})};
  description.ground.present = false;
  const auto world = make_box2d_world(description);
  world->add({0, {}, Vec2::Zero(), Spin<2>::Zero()});
  world->freeze(std::vector<BodyIndex>{0});
  world->add({1, {{0.0, 1.5}, Rotation<2>(0.0)}, {0.0, -60.0}, Spin<2>::Zero()});
  world->record_contacts(true);
  double impulse = 0.0;
  double approach = 0.0;
  for (int step = 0; step < 5; ++step) {
    world->step();
    for (const Contact<2>& contact : world->contacts()) {
      impulse += contact.normal_impulse;
      approach = std::max(approach, contact.approach_speed);
      EXPECT_EQ(contact.a, 1);
      EXPECT_EQ(contact.b, 0);
      EXPECT_GT(contact.normal.y(), 0.99);
    }
  }
  const double momentum = description.shapes[1].mass * 60.0;
  EXPECT_NEAR(impulse, momentum, 1e-3 * momentum);  // single precision and an impact slightly off the centre
  EXPECT_NEAR(approach, 60.0, 0.1);
}

TEST(Contacts, NameTheObstacle) {
  WorldDescription<2> description = l_world();
  description.ground.present = false;
  const Shape<2> block = make_shape<2>("block", box_pieces<2>({4.0, 1.0}), Material{});
  description.obstacles = {{block, {{-5.0, 0.0}, Rotation<2>(0.0)}}, {block, {{5.0, 0.0}, Rotation<2>(0.0)}}};
  const auto world = make_box2d_world(description);
  world->add({0, {{5.0, 1.5}, Rotation<2>(0.0)}, Vec2::Zero(), Spin<2>::Zero()});
  world->record_contacts(true);
  run(*world, 120);
  ASSERT_FALSE(world->contacts().empty());
  for (const Contact<2>& contact : world->contacts()) {
    EXPECT_EQ(contact.b, first_obstacle - 1);
    EXPECT_NEAR(contact.depth, 0.0, 1e-3);
  }
}

TEST(Contacts, OfTheLastStepStayWhenBodiesFreezeAfterIt) {
  const auto world = make_box2d_world(l_world());
  add_stack(*world, 20, 5);
  world->record_contacts(true);
  run(*world, 200);
  world->freeze(awake_of(*world));
  EXPECT_GT(world->contacts().size(), 20U);
  world->step();
  EXPECT_TRUE(world->contacts().empty());
}

}  // namespace
}  // namespace talus::contacts_test
