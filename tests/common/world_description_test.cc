// The table of inputs that one engine swallows and the other dies of: all are refused before either sees them.

#include "common/world/world_description.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "common/pile/pile_fields.h"
#include "common/scene/policy_fields.h"
#include "common/scene/scene.h"
#include "common/scene/scene_fields.h"
#include "common/shape/catalogue.h"
#include "common/shape/shape_fields.h"
#include "common/world/world_fields.h"

namespace talus::world_description_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

template <int Dim>
WorldDescription<Dim> sound_world() {
  WorldDescription<Dim> world;
  world.shapes = {make_shape<Dim>("l", l_pieces<Dim>({}), {})};
  return world;
}

// What is thrown names the field and says what the value must be.
void expect_refused(const std::function<void()>& call, const std::string& field) {
  try {
    call();
    ADD_FAILURE() << field << " was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(field), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("must be"), std::string::npos) << error.what();
  }
}

template <typename T>
class WorldDescriptionTest : public testing::Test {
 protected:
  static constexpr int dimension = T::value;
  void refuse_world(const std::string& field, const std::function<void(WorldDescription<dimension>&)>& spoil) {
    WorldDescription<dimension> world = sound_world<dimension>();
    spoil(world);
    expect_refused([&] { check(world); }, field);
  }
  void refuse_body(const std::string& field, const std::function<void(BodyDef<dimension>&)>& spoil) {
    BodyDef<dimension> body;
    spoil(body);
    expect_refused([&] { check(body, sound_world<dimension>()); }, field);
  }
  void refuse_pieces(const std::string& field, std::vector<Piece<dimension>> pieces) {
    expect_refused([&] { make_shape<dimension>("bad", pieces, {}); }, field);
    expect_refused([&] { make_shape<dimension>("bad", pieces, {}); }, "'bad'");
  }
};

using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(WorldDescriptionTest, Dimensions);

TYPED_TEST(WorldDescriptionTest, ASoundWorldAndBodyAreAccepted) {
  constexpr int dim = TypeParam::value;
  EXPECT_NO_THROW(check(sound_world<dim>()));
  EXPECT_NO_THROW(check(BodyDef<dim>{}, sound_world<dim>()));
}

TYPED_TEST(WorldDescriptionTest, ATimeStepOutsideItsRangeIsRefused) {
  for (const double dt : {0.0, -0.01, nan, infinity, 1.0 / 15.0})
    this->refuse_world("world.steps_per_second", [&](auto& world) { world.dt = dt; });
}

TYPED_TEST(WorldDescriptionTest, TheEnginesOwnSleepNeedsItsOwnSolver) {
  this->refuse_world("world.solver.kind", [](auto& world) {
    world.solver.kind = "small_steps";
    world.engine_sleep = true;
  });
}

TYPED_TEST(WorldDescriptionTest, GravityGroundAndSolverMustBeInRange) {
  for (const double gravity : {nan, infinity, -9.81})
    this->refuse_world("world.gravity", [&](auto& world) { world.gravity = gravity; });
  this->refuse_world("world.ground.height", [](auto& world) { world.ground.height = nan; });
  this->refuse_world("world.ground.material.friction", [](auto& world) { world.ground.material.friction = -0.1; });
  this->refuse_world("sub_steps", [](auto& world) { world.solver.sub_steps = 0; });
  this->refuse_world("world.solver.kind", [](auto& world) { world.solver.kind = "exact"; });
  this->refuse_world("velocity_iterations", [](auto& world) { world.solver.velocity_iterations = 0; });
  this->refuse_world("position_iterations", [](auto& world) { world.solver.position_iterations = 1001; });
  this->refuse_world("friction_directions", [](auto& world) { world.solver.friction_directions = 3; });
  this->refuse_world("restitution_threshold", [](auto& world) { world.solver.restitution_threshold = nan; });
}

TYPED_TEST(WorldDescriptionTest, AMaterialOutsideItsRangeIsRefused) {
  for (const double density : {0.0, -1.0, nan, infinity})
    this->refuse_world("material.density", [&](auto& world) { world.shapes[0].material.density = density; });
  for (const double friction : {-0.1, nan, infinity})
    this->refuse_world("material.friction", [&](auto& world) { world.shapes[0].material.friction = friction; });
  for (const double restitution : {-0.1, 1.1, nan}) {
    this->refuse_world("material.restitution",
                       [&](auto& world) { world.shapes[0].material.restitution = restitution; });
  }
}

TYPED_TEST(WorldDescriptionTest, AShapeThatMakeShapeDidNotMakeIsRefused) {
  this->refuse_world("pieces.size", [](auto& world) { world.shapes[0].pieces.clear(); });
  this->refuse_world("mass", [](auto& world) { world.shapes[0].mass = 0.0; });
  this->refuse_world("inertia", [](auto& world) { world.shapes[0].inertia.setZero(); });
}

TYPED_TEST(WorldDescriptionTest, APieceThinnerThanAContactsSkinIsRefused) {
  constexpr int dim = TypeParam::value;
  Vec<dim> thin = Vec<dim>::Ones();
  thin[dim - 1] = dim == 2 ? 0.004 : 0.04;
  this->refuse_world("width",
                     [&](auto& world) { world.shapes[0] = make_shape<dim>("thin", box_pieces<dim>(thin), {}); });
  this->refuse_world("width", [&](auto& world) {
    world.obstacles.push_back({make_shape<dim>("thin", box_pieces<dim>(thin), {}), {}});
  });
}

TYPED_TEST(WorldDescriptionTest, MassesMoreThanAHundredfoldApartAreRefused) {
  constexpr int dim = TypeParam::value;
  const Vec<dim> one = Vec<dim>::Ones();
  this->refuse_world("mass of shape 'heavy'", [&](auto& world) {
    world.shapes = {make_shape<dim>("heavy", box_pieces<dim>(one), {.density = 1010.0}),
                    make_shape<dim>("light", box_pieces<dim>(one), {.density = 10.0})};
  });
}

TYPED_TEST(WorldDescriptionTest, AnObstaclesPoseMustBeSound) {
  constexpr int dim = TypeParam::value;
  this->refuse_world("obstacles[0].pose.position[0]", [](auto& world) {
    Obstacle<dim> wall = {world.shapes[0], {}};
    wall.pose.position[0] = nan;
    world.obstacles.push_back(wall);
  });
}

TYPED_TEST(WorldDescriptionTest, ABodysStateMustBeFiniteAndWithinTheEnginesLimits) {
  for (const double value : {nan, infinity, -infinity, 1.1e4})
    this->refuse_body("body.pose.position[1]", [&](auto& body) { body.pose.position[1] = value; });
  for (const double value : {nan, infinity, 1000.0}) {
    this->refuse_body("body.velocity", [&](auto& body) { body.velocity[0] = value; });
    this->refuse_body("body.spin", [&](auto& body) { body.spin[0] = value; });
  }
  this->refuse_body("body.shape", [](auto& body) { body.shape = 1; });
  this->refuse_body("body.shape", [](auto& body) { body.shape = -1; });
}

TEST(WorldDescriptionInSpace, ARotationNotOfLengthOneIsRefused) {
  const WorldDescription<3> world = sound_world<3>();
  BodyDef<3> body;
  for (const double w : {0.0, 2.0, nan}) {
    body.pose.rotation.w() = w;
    expect_refused([&] { check(body, world); }, "body.pose.rotation");
  }
}

TEST(WorldDescriptionInThePlane, ARotationThatIsNotFiniteIsRefused) {
  BodyDef<2> body;
  body.pose.rotation.angle() = nan;
  expect_refused([&] { check(body, sound_world<2>()); }, "body.pose.rotation");
}

TYPED_TEST(WorldDescriptionTest, PiecesWithoutVolumeAreRefused) {
  constexpr int dim = TypeParam::value;
  for (const double size : {0.0, -0.5, nan, infinity}) {
    BoxPiece<dim> box;
    box.half[0] = size;
    this->refuse_pieces("pieces[0].half[0]", {box});
    this->refuse_pieces("pieces[0].radius", {HullPiece<dim>{{Vec<dim>::Zero()}, size}});
    this->refuse_pieces("pieces[0].radius", {HullPiece<dim>{{Vec<dim>::Zero(), Vec<dim>::Ones()}, size}});
  }
  this->refuse_pieces("pieces[0] distance", {HullPiece<dim>{{Vec<dim>::Zero(), Vec<dim>::Zero()}, 1.0}});
  this->refuse_pieces("pieces[0].corners.size = 0", {HullPiece<dim>{}});
  this->refuse_pieces("pieces.size", {});
}

TYPED_TEST(WorldDescriptionTest, APolygonOrPolyhedronWithARadiusIsRefused) {
  constexpr int dim = TypeParam::value;
  HullPiece<dim> simplex{{Vec<dim>::Zero()}, 0.1};
  for (int axis = 0; axis < dim; ++axis) simplex.corners.push_back(Vec<dim>::Unit(axis));
  this->refuse_pieces("pieces[0].radius = 0.1", {simplex});
}

TEST(PolygonCorners, ThatMakeNoConvexPolygonAreRefused) {
  const auto refuse = [](const std::vector<Vec2>& corners, const std::string& field) {
    expect_refused([&] { hull_pieces<2>(corners); }, field);
  };
  std::vector<Vec2> nine;
  for (int i = 0; i < 9; ++i) nine.push_back({std::cos(i * 0.69), std::sin(i * 0.69)});
  refuse(nine, "corners.size = 9");
  refuse({{0.0, 0.0}, {1.0, 0.0}}, "corners.size = 2");
  refuse({{0.0, 0.0}, {1.0, 1.0}, {2.0, 2.0}}, "corners[");
  refuse({{1.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}}, "corners[");
  refuse({{0.0, 0.0}, {1.0, 0.0}, {nan, 1.0}}, "corners[2][0]");
  refuse({{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.4}, {0.4, 0.4}, {0.4, 1.0}, {0.0, 1.0}}, "corners[");  // an L
  // A five-pointed star turns left at every corner, but goes round twice.
  refuse({{1.0, 0.0}, {-0.81, 0.59}, {0.31, -0.95}, {0.31, 0.95}, {-0.81, -0.59}}, "corners[");
}

TEST(PolygonCorners, MayGoEitherWayRound) {
  const std::vector<Vec2> clockwise = {{0.0, 0.0}, {0.0, 1.0}, {1.0, 0.0}};
  EXPECT_DOUBLE_EQ(mass_properties(hull_pieces<2>(clockwise)[0]).volume, 0.5);
}

TEST(HullCorners, ThatSpanNoVolumeAreRefused) {
  const auto refuse = [](const std::vector<Vec3>& corners, const std::string& field) {
    expect_refused([&] { hull_pieces<3>(corners); }, field);
  };
  refuse({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}, "corners.size = 3");
  refuse({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {1.0, 1.0, 0.0}, {0.3, 0.2, 0.0}}, "corners thickness");
  refuse({{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {2.0, 2.0, 2.0}, {3.0, 3.0, 3.0}}, "corners thickness");
  refuse({{1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}}, "corners thickness");
  refuse({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, nan}}, "corners[3][2]");
}

TEST(LParameters, ThatMakeNoLAreRefused) {
  expect_refused([] { l_pieces<2>({.arm_x = 0.4}); }, "l.arm_x");
  expect_refused([] { l_pieces<3>({.arm_z = nan}); }, "l.arm_z");
  expect_refused([] { l_pieces<3>({.thickness = 0.0}); }, "l.thickness");
  expect_refused([] { l_pieces<3>({.depth = -1.0}); }, "l.depth");
  expect_refused([] { capsule_pieces<2>(1.0, 0.5); }, "capsule.length");
}

TEST(DeclaredFields, AreRefusedWithFieldValueAndRule) {
  AdaptiveParams params;
  params.rest_period_surface = 0.01;
  try {
    check_fields(params, adaptive_fields, "policy.adaptive");
    FAIL() << "was accepted";
  } catch (const InvalidValue& invalid) {
    EXPECT_EQ(invalid.field(), "policy.adaptive.rest_period_surface");
    EXPECT_EQ(invalid.value(), "0.01");
    EXPECT_EQ(invalid.rule(), "must be at least 0.16 and at most 1000") << "the lower end is rest_period_deep";
  }
  PolicyParams policy;
  policy.kind = "papper";
  expect_refused([&] { check_fields(policy, policy_fields, "policy"); },
                 "policy.kind = \"papper\": must be one of full, engine");
  policy.paper.avalanche_density = {0.8, -1.0};
  expect_refused([&] { check_fields(policy.paper, paper_fields, "policy"); }, "policy.avalanche_density[1] = -1");
  PileParams<2> pile;
  pile.alpha = 2.0;
  expect_refused([&] { check_fields(pile, pile_fields<2>, "pile[0]"); }, "pile[0].alpha_deg = 114.591559026165");
}

TEST(DeclaredFields, HaveDefaultsWithinTheirRanges) {
  EXPECT_NO_THROW(check_fields(AdaptiveParams{}, adaptive_fields, ""));
  EXPECT_NO_THROW(check_fields(PaperParams{}, paper_fields, ""));
  EXPECT_NO_THROW(check_fields(PileParams<3>{}, pile_fields<3>, ""));
  EXPECT_NO_THROW(check_fields(Source<3>{}, source_fields<3>, ""));
  EXPECT_NO_THROW(check_fields(RunParams{}, run_fields, ""));
  EXPECT_NO_THROW(check_fields(SolverParams{}, solver_fields, ""));
}

}  // namespace
}  // namespace talus::world_description_test
