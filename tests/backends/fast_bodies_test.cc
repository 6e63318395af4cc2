// Bodies so fast that they could get past each other within a step, on every engine.

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "common/measure/support.h"
#include "common/scene/read_scene.h"
#include "common/simulation/simulation.h"
#include "tests/backends/backend.h"

namespace talus::fast_bodies_test {
namespace {

/// Fixture: boards of 0.1 m (shape 0), balls of 0.3 m and 14 times their density (shape 1) and rods of 4 m (shape 2),
/// without gravity and ground.
template <typename Backend>
class FastBody : public ::testing::Test {
 protected:
  static constexpr int dimension = Backend::dim;
  using V = Vec<dimension>;

  static WorldDescription<dimension> description() {
    const Material material{.friction = 0.5, .restitution = 0.0};
    Material heavy = material;
    heavy.density *= 14.0;
    WorldDescription<dimension> world;
    world.gravity = 0.0;
    world.ground.present = false;
    V board = V::Ones();
    board[0] = 0.1;
    V rod = V::Constant(0.2);
    rod[dimension - 1] = 4.0;
    world.shapes.push_back(make_shape<dimension>("board", box_pieces<dimension>(board), material));
    world.shapes.push_back(make_shape<dimension>("ball", ball_pieces<dimension>(0.15), heavy));
    world.shapes.push_back(make_shape<dimension>("rod", box_pieces<dimension>(rod), material));
    return world;
  }

  /// A body at this place along x, in a row of its own.
  static BodyDef<dimension> at(int shape, double x, int row, double speed = 0.0) {
    BodyDef<dimension> body;
    body.shape = shape;
    body.pose.position = x * V::Unit(0) + up<dimension>(8.0 * row);
    body.velocity = speed * V::Unit(0);
    return body;
  }
  static double x(const World<dimension>& world, BodyIndex body) { return world.states().pose[body].position[0]; }
  static double speed(const World<dimension>& world, BodyIndex body) { return world.states().velocity[body][0]; }
  static void run(World<dimension>& world, int steps) {
    for (int i = 0; i < steps; ++i) world.step();
  }
};
TYPED_TEST_SUITE(FastBody, Backends, BackendName);

constexpr std::array speeds = {5.0, 10.0, 15.0, 20.0, 30.0, 40.0, 60.0, 80.0, 110.0};
constexpr int phases = 10;  // places within a step at which the two meet

TYPED_TEST(FastBody, MeetsALooseBoardAtEverySpeedAndMoment) {
  auto world = TypeParam::make(this->description());
  int row = 0;
  for (const double speed : speeds) {
    for (int phase = 0; phase < phases; ++phase, ++row) {
      world->add(this->at(0, 0.0, row));
      world->add(this->at(1, -2.0 - phase * speed / 60.0 / phases, row, speed));
    }
  }
  this->run(*world, 60);
  for (BodyIndex board = 0; board < 2 * row; board += 2) {
    const double speed = speeds[board / 2 / phases];
    // Without restitution the two go on as one; at 5 m/s, sunk in, the ball may still be pushed back a little.
    EXPECT_GT(this->speed(*world, board), 0.2 * speed) << "board " << board / 2 << ", ball of " << speed << " m/s";
    EXPECT_LT(this->x(*world, board + 1), this->x(*world, board)) << speed << " m/s";
  }
}

TYPED_TEST(FastBody, StopsAtASleepingBoard) {
  auto world = TypeParam::make(this->description());
  std::vector<BodyIndex> boards;
  int row = 0;
  for (const double speed : speeds) {
    for (int phase = 0; phase < phases; ++phase, ++row) {
      boards.push_back(world->add(this->at(0, 0.0, row)));
      world->add(this->at(1, -2.0 - phase * speed / 60.0 / phases, row, speed));
    }
  }
  world->freeze(boards);
  this->run(*world, 60);
  for (const BodyIndex board : boards) EXPECT_LT(this->x(*world, board + 1), 0.0) << "board " << board / 2;
}

TYPED_TEST(FastBody, MeetsOneThatIsAsFast) {
  auto world = TypeParam::make(this->description());
  int row = 0;
  for (const double speed : speeds) {
    for (int phase = 0; phase < phases; ++phase, ++row) {
      world->add(this->at(1, 2.0 + phase * speed / 60.0 / phases, row, -speed));
      world->add(this->at(1, -2.0, row, speed));
    }
  }
  this->run(*world, 60);
  for (BodyIndex ball = 0; ball < 2 * row; ball += 2) {
    EXPECT_LT(this->x(*world, ball + 1), this->x(*world, ball)) << speeds[ball / 2 / phases] << " m/s";
    EXPECT_NEAR(this->speed(*world, ball), 0.0, 1.0) << "equal masses without restitution stop each other";
  }
}

// The board that is struck becomes fast within the step, and so meets the next one.
TYPED_TEST(FastBody, DrivesABoardIntoTheNext) {
  auto world = TypeParam::make(this->description());
  int row = 0;
  for (const double speed : speeds) {
    for (int phase = 0; phase < phases; ++phase, ++row) {
      world->add(this->at(1, -2.0 - phase * speed / 60.0 / phases, row, speed));
      world->add(this->at(0, 0.0, row));
      world->add(this->at(0, 0.5, row));
    }
  }
  this->run(*world, 60);
  for (BodyIndex ball = 0; ball < 3 * row; ball += 3) {
    const double speed = speeds[ball / 3 / phases];
    EXPECT_LT(this->x(*world, ball + 1), this->x(*world, ball + 2)) << speed << " m/s, phase " << ball / 3 % phases;
    EXPECT_GT(this->speed(*world, ball + 2), 0.2 * speed) << speed << " m/s, phase " << ball / 3 % phases;
  }
}

TYPED_TEST(FastBody, StaysBetweenTwoBoards) {
  auto world = TypeParam::make(this->description());
  int row = 0;
  for (const double speed : speeds) {
    for (int phase = 0; phase < phases; ++phase, ++row) {
      world->add(this->at(0, -1.0, row));
      world->add(this->at(1, 0.05 * phase, row, speed));
      world->add(this->at(0, 1.0, row));
    }
  }
  this->run(*world, 60);
  for (BodyIndex board = 0; board < 3 * row; board += 3) {
    EXPECT_LT(this->x(*world, board), this->x(*world, board + 1)) << "board " << board / 3;
    EXPECT_LT(this->x(*world, board + 1), this->x(*world, board + 2)) << "board " << board / 3;
  }
}

TYPED_TEST(FastBody, OfARodThatSpinsStrikesABallAtItsTip) {
  constexpr int dim = TypeParam::dim;
  constexpr std::array spins = {5.0, 10.0, 20.0, 30.0, 40.0, 60.0, 80.0};
  auto world = TypeParam::make(this->description());
  int row = 0;
  for (const double spin : spins) {
    for (int phase = 0; phase < phases; ++phase, ++row) {
      BodyDef<dim> rod = this->at(2, 0.0, row);
      rod.pose.rotation = tilted<dim>(phase * spin / 60.0 / phases);
      rod.spin[dim == 2 ? 0 : 1] = dim == 2 ? spin : -spin;
      world->add(rod);
      world->add(this->at(1, -1.7, row));
    }
  }
  this->run(*world, 60);
  int missed = 0;
  for (BodyIndex rod = 0; rod < 2 * row; rod += 2) missed += world->states().velocity[rod + 1].norm() > 0.1 ? 0 : 1;
  EXPECT_EQ(missed, 0);
}

template <typename Backend>
using FastBodyUnderSmallSteps = FastBody<Backend>;
TYPED_TEST_SUITE(FastBodyUnderSmallSteps, SmallStepsBackends, BackendName);

// Contacts of what is fast are found where it will be, not by the nearest points of the start.
TYPED_TEST(FastBodyUnderSmallSteps, IsNotTurnedByWhatItPasses) {
  constexpr double beside = 0.5 + 0.15 + 0.05;  // the ball's radius and 5 cm from the board's edge
  auto world = TypeParam::make(this->description());
  int row = 0;
  for (const double speed : speeds) {
    for (int phase = 0; phase < phases; ++phase, ++row) {
      world->add(this->at(0, 0.0, row));
      BodyDef<TypeParam::dim> ball = this->at(1, -2.0 - phase * speed / 60.0 / phases, row, speed);
      ball.pose.position += up<TypeParam::dim>(beside);
      world->add(ball);
    }
  }
  this->run(*world, 60);
  for (BodyIndex ball = 1; ball < 2 * row; ball += 2)
    EXPECT_NEAR(height<TypeParam::dim>(world->states().velocity[ball]), 0.0, 1e-3) << speeds[ball / 2 / phases];
}

// A heavy ball drives the boards into each other, each within the step in which it is struck.
TYPED_TEST(FastBodyUnderSmallSteps, KeepsARowOfBoardsInOrder) {
  constexpr int boards = 5;
  auto world = TypeParam::make(this->description());
  int row = 0;
  for (const double speed : speeds) {
    for (int phase = 0; phase < phases; ++phase, ++row) {
      world->add(this->at(1, -2.0 - phase * speed / 60.0 / phases, row, speed));
      for (int board = 0; board < boards; ++board) world->add(this->at(0, 0.3 * board, row));
    }
  }
  this->run(*world, 60);
  int out_of_order = 0;
  for (BodyIndex ball = 0; ball < (boards + 1) * row; ball += boards + 1) {
    bool ordered = true;
    for (BodyIndex body = ball; body < ball + boards; ++body)
      ordered = ordered && this->x(*world, body) < this->x(*world, body + 1);
    out_of_order += ordered ? 0 : 1;
  }
  // Where the ball goes further in a sub-step than a board is thick, some boards change sides.
  EXPECT_LE(out_of_order, 7) << "of " << row;
}

// Also where contacts were found after the last solve of a step. Two boards are pressed together meanwhile.
TYPED_TEST(FastBodyUnderSmallSteps, TellsTheImpulsesThatChangeItsVelocity) {
  constexpr int dim = TypeParam::dim;
  constexpr int boards = 5;
  const WorldDescription<dim> description = this->description();
  auto world = TypeParam::make(description);
  world->record_contacts(true);
  int row = 0;
  for (const double speed : speeds) {
    for (int phase = 0; phase < phases; ++phase, ++row) {
      world->add(this->at(1, -2.0 - phase * speed / 60.0 / phases, row, speed));
      for (int board = 0; board < boards; ++board) world->add(this->at(0, 0.3 * board, row));
    }
  }
  const std::array<BodyIndex, 2> pressed = {world->add(this->at(0, 0.0, row)), world->add(this->at(0, 0.1, row))};
  const Vec<dim> force = 1000.0 * Vec<dim>::Unit(0);
  for (int step = 0; step < 30; ++step) {
    world->push(pressed[0], force);
    world->push(pressed[1], -force);
    std::vector<Vec<dim>> momentum;  // by body, what the contacts have not changed
    const auto mass = [&](BodyIndex body) { return description.shapes[world->states().shape[body]].mass; };
    for (BodyIndex body = 0; body < world->states().size(); ++body)
      momentum.push_back(-mass(body) * world->states().velocity[body]);
    world->step();
    for (BodyIndex body = 0; body < world->states().size(); ++body)
      momentum[body] += mass(body) * world->states().velocity[body];
    momentum[pressed[0]] -= force / 60.0;
    momentum[pressed[1]] += force / 60.0;
    for (const Contact<dim>& contact : world->contacts()) {
      const Vec<dim> impulse = contact.normal_impulse * contact.normal + contact.friction_impulse;
      momentum[contact.a] -= impulse;
      momentum[contact.b] += impulse;
    }
    for (BodyIndex body = 0; body < world->states().size(); ++body)
      ASSERT_LT(momentum[body].norm(), 1e-4 * 110.0 * mass(0))
          << "single precision; body " << body << ", step " << step;
  }
}

// Sticks fall on the ground at all angles: the end that comes down last is as fast as the one that struck first.
TYPED_TEST(FastBodyUnderSmallSteps, DoesNotSinkIntoTheGround) {
  constexpr int dim = TypeParam::dim;
  WorldDescription<dim> description = this->description();
  description.gravity = 9.81;
  description.ground.present = true;
  auto world = TypeParam::make(description);
  int sticks = 0;
  for (const double speed : speeds) {
    for (int angle = 0; angle < phases; ++angle, ++sticks) {
      BodyDef<dim> stick = this->at(2, 8.0 * sticks - 3000.0, 0);
      stick.pose.position += up<dim>(5.0 + angle * speed / 60.0 / phases);
      stick.pose.rotation = tilted<dim>(0.3 * angle);
      stick.velocity = up<dim>(-speed);
      world->add(stick);
    }
  }
  std::vector<double> depths(sticks, 0.0);
  for (int step = 0; step < 120; ++step) {
    world->step();
    for (const Touch& touch : touching_pairs<dim>(description, world->states(), 0.05))
      if (touch.b == ground_index && depths[touch.a] == 0.0) depths[touch.a] = std::max(0.0, -touch.distance);
  }
  for (int stick = 0; stick < sticks; ++stick)
    EXPECT_GT(height<dim>(world->states().pose[stick].position), 0.0) << speeds[stick / phases] << " m/s";
  // Found once they overlap, sticks would start half a step's way deep: 0.3 m on average.
  EXPECT_LT(std::accumulate(depths.begin(), depths.end(), 0.0) / sticks, 0.06);
}

// Bodies that a policy wakes before they are struck.
TYPED_TEST(FastBody, DoesNotPassASleeperThatThePolicyWakes) {
  constexpr int dim = TypeParam::dim;
  std::string text = fmt::format(
      "title = \"Boards\"\ndimension = {}\nworld.gravity = 0\nground.present = false\npolicy.kind = \"adaptive\"\n"
      "shape.board = {{kind = \"box\", size = {}}}\nshape.ball = {{kind = \"ball\", radius = 0.15, density = 2000}}\n",
      dim, dim == 2 ? "[0.1, 1]" : "[0.1, 1, 1]");
  int row = 0;
  const auto place = [](double x, int at_row) {
    return dim == 2 ? fmt::format("[{}, {}]", x, 4 * at_row) : fmt::format("[{}, 0, {}]", x, 4 * at_row);
  };
  for (const double speed : speeds)
    for (int phase = 0; phase < phases; ++phase, ++row)
      text += fmt::format(
          "[[body]]\nshape = \"board\"\nposition = {}\nasleep = true\n"
          "[[body]]\nshape = \"ball\"\nposition = {}\nvelocity = [{}, 0{}]\n",
          place(0.0, row), place(-2.0 - phase * speed / 60.0 / phases, row), speed, dim == 2 ? "" : ", 0");
  const auto scene = std::get<Scene<dim>>(parse_scene(text, "text"));
  auto simulation = simulation_on<TypeParam>(scene);
  for (int step = 0; step < 60; ++step) simulation.step();
  const World<dim>& world = simulation.world();
  for (BodyIndex board = 0; board < 2 * row; board += 2) {
    EXPECT_LT(this->x(world, board + 1), this->x(world, board)) << "board " << board / 2;
    EXPECT_GT(this->x(world, board), 0.0) << "board " << board / 2;
  }
}

}  // namespace
}  // namespace talus::fast_bodies_test
