// A world in which no body is ever frozen against Box2D used by hand.

#include <box2d/box2d.h>
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "tests/sim2d/heap.h"

namespace talus::plain_engine_test {
namespace {

constexpr int bodies = 60;
constexpr int columns = 6;

/// The scene as one would write it without talus; only the L's numbers are ours.
class PlainHeap {
 public:
  explicit PlainHeap(const WorldDescription<2>& description) : engine_(b2Vec2(0.0F, -9.81F)) {
    engine_.SetAllowSleeping(description.engine_sleep);
    b2BodyDef ground;
    b2EdgeShape line;
    line.SetTwoSided({-2e4F, 0.0F}, {2e4F, 0.0F});
    engine_.CreateBody(&ground)->CreateFixture(&fixture(line));
    std::mt19937 random(1);
    for (int i = 0; i < bodies; ++i) add(l_in_stack(i, columns, random), description.shapes[0]);
  }

  void step() { engine_.Step(static_cast<float>(1.0 / 60.0), 10, 4); }
  const std::vector<b2Body*>& all() const { return bodies_; }

 private:
  b2FixtureDef& fixture(const b2Shape& shape) {
    fixture_.shape = &shape;
    fixture_.friction = 0.5F;
    fixture_.restitution = 0.0F;
    fixture_.restitutionThreshold = 0.5F;
    return fixture_;
  }

  void add(const BodyDef<2>& body, const Shape<2>& shape) {
    b2BodyDef def;
    def.type = b2_dynamicBody;
    def.position.Set(static_cast<float>(body.pose.position.x()), static_cast<float>(body.pose.position.y()));
    def.angle = static_cast<float>(body.pose.rotation.angle());
    b2Body* made = engine_.CreateBody(&def);
    for (const Piece<2>& piece : shape.pieces) {
      const auto& box = std::get<BoxPiece<2>>(piece);
      b2PolygonShape polygon;
      polygon.SetAsBox(static_cast<float>(box.half.x()), static_cast<float>(box.half.y()),
                       {static_cast<float>(box.pose.position.x()), static_cast<float>(box.pose.position.y())}, 0.0F);
      made->CreateFixture(&fixture(polygon));
    }
    const b2MassData mass{static_cast<float>(shape.mass), {0.0F, 0.0F}, static_cast<float>(shape.inertia(0, 0))};
    made->SetMassData(&mass);
    bodies_.push_back(made);
  }

  b2World engine_;
  b2FixtureDef fixture_;
  std::vector<b2Body*> bodies_;
};

/// Position, angle, velocity and spin of every body, as the bits of Box2D's floats.
std::vector<float> bits(const std::vector<b2Body*>& all) {
  std::vector<float> out;
  for (const b2Body* body : all) {
    out.insert(out.end(), {body->GetPosition().x, body->GetPosition().y, body->GetAngle(), body->GetLinearVelocity().x,
                           body->GetLinearVelocity().y, body->GetAngularVelocity()});
  }
  return out;
}

std::vector<float> bits(const BodyStates<2>& states) {
  std::vector<float> out;
  for (std::size_t i = 0; i < states.pose.size(); ++i) {
    for (const double value :
         {states.pose[i].position.x(), states.pose[i].position.y(), states.pose[i].rotation.angle(),
          states.velocity[i].x(), states.velocity[i].y(), states.spin[i][0]}) {
      out.push_back(static_cast<float>(value));
    }
  }
  return out;
}

bool same(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

class NothingFrozen : public testing::TestWithParam<bool> {};

TEST_P(NothingFrozen, MovesBitForBitAsBox2DByHand) {
  WorldDescription<2> description = l_world();
  description.solver.kind = engine_solver;
  description.engine_sleep = GetParam();
  const auto world = make_box2d_world(description);
  add_stack(*world, bodies, columns);
  PlainHeap plain(description);
  for (int step = 0; step < 600; ++step) {
    world->step();
    plain.step();
    ASSERT_TRUE(same(bits(world->states()), bits(plain.all()))) << "step " << step;
  }
}

TEST_P(NothingFrozen, IsNotChangedByRecordingContacts) {
  WorldDescription<2> description = l_world();
  description.solver.kind = engine_solver;
  description.engine_sleep = GetParam();
  const auto observed = make_box2d_world(description);
  const auto alone = make_box2d_world(description);
  observed->record_contacts(true);
  add_stack(*observed, bodies, columns);
  add_stack(*alone, bodies, columns);
  for (int step = 0; step < 300; ++step) {
    observed->step();
    alone->step();
  }
  EXPECT_TRUE(same(bits(observed->states()), bits(alone->states())));
}

INSTANTIATE_TEST_SUITE_P(EngineSleep, NothingFrozen, testing::Bool());

}  // namespace
}  // namespace talus::plain_engine_test
