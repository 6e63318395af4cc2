#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numbers>

#include "common/policy/paper_policy.h"
#include "lcmtypes/bodies_message.h"
#include "lcmtypes/contacts_message.h"
#include "lcmtypes/event_message.h"
#include "lcmtypes/instruments_message.h"
#include "lcmtypes/piles_message.h"
#include "lcmtypes/run_message.h"
#include "lcmtypes/scene_message.h"
#include "lcmtypes/shapes_message.h"
#include "lcmtypes/sleep_message.h"
#include "lcmtypes/stats_message.h"
#include "lcmtypes/wire.h"
#include "tests/lcmtypes/still_run.h"

namespace talus::messages_test {
namespace {

using talus_lcm::talus_pile;
using talus_lcm::talus_shapes;
using talus_lcm::talus_sleep;
using talus_lcm::talus_stats;

template <class Message>
void expect_sendable(std::vector<Message>& messages) {
  MessageEncoder encoder(1);
  for (std::size_t i = 0; i < messages.size(); ++i) {
    const Packet packet = encoder.encode(messages[i], {});
    ASSERT_LE(packet.bytes.size(), max_message_bytes);
    Message decoded;
    ASSERT_EQ(decode(packet.bytes, decoded), "");
    ASSERT_EQ(decoded.seq, static_cast<std::int64_t>(i));
    ASSERT_EQ(decoded.part, static_cast<std::int32_t>(i));
    ASSERT_EQ(decoded.parts, static_cast<std::int32_t>(messages.size()));
  }
}

TEST(PilesMessage, SaysWhatThePileHolds) {
  Pile<3> pile =
      in_space(make_pile<2>(Vec2(3.0, 1.0), 0.8, 100.0, {.bounding_volume = 0.5, .extent = 1.0, .mass = 1.0}));
  pile.layers[0].count = 7;
  pile.layers[0].sleeping = 5;
  const auto messages = to_piles(std::span(&pile, 1));
  ASSERT_EQ(messages.size(), 1U);
  ASSERT_EQ(messages[0].piles.size(), 1U);
  const talus_pile& told = messages[0].piles[0];
  EXPECT_EQ(told.centre[0], 3.0);
  EXPECT_EQ(told.centre[1], 0.0);
  EXPECT_EQ(told.centre[2], 1.0);
  EXPECT_EQ(told.alpha, 0.8);
  EXPECT_EQ(told.structure_size, 100.0);
  EXPECT_EQ(told.occupation_ratio, pile.occupation_ratio());
  ASSERT_EQ(told.layers.size(), pile.layers.size());
  EXPECT_EQ(told.layers[0].count, 7);
  EXPECT_EQ(told.layers[0].sleeping, 5);
  EXPECT_EQ(told.layers[0].density, static_cast<float>(7.0 / pile.layers[0].capacity));
}

TEST(PilesMessage, HasTheThresholdsOfThePolicyForEachLayer) {
  Pile<3> pile = in_space(make_pile<2>(Vec2::Zero(), 0.8, 100.0, {}));
  PaperParams params;
  params.tau = 0.4;
  params.avalanche_density = {0.75, 0.875};
  const PaperPolicy<2> paper(params, {});
  set_thresholds<2>(paper, pile.layers);
  const auto of_paper = to_piles(std::span(&pile, 1));
  const auto& layers = of_paper[0].piles[0].layers;
  ASSERT_GT(layers.size(), 2U);
  EXPECT_EQ(layers[0].wake_density, 0.75F);
  EXPECT_EQ(layers[2].wake_density, 0.875F) << "the last one holds for all above";
  EXPECT_EQ(layers[1].sleep_density, 0.4F) << "the other factors of the score are at most 1";
  EXPECT_EQ(pile_of(of_paper[0].piles[0]).layers[2].thresholds.wake, 0.875);
  const NoPolicy<2> none;
  set_thresholds<2>(none, pile.layers);
  const auto of_none = to_piles(std::span(&pile, 1));
  EXPECT_EQ(of_none[0].piles[0].layers[0].wake_density, -1.0F);
}

TEST(EventMessage, SaysWhatTheEventRemovesAndWhenItHappened) {
  Scene<2> scene = still_scene<2>();
  scene.obstacle_names = {{"gate", 0, 1}};
  scene.events.resize(2);
  scene.events[0].action = EventAction::wake;
  scene.events[1].action = EventAction::remove;
  scene.events[1].obstacle = 0;
  const auto messages = to_events(scene);
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_EQ(messages[1].number, 1);
  EXPECT_EQ(messages[1].total, 2);
  EXPECT_EQ(messages[1].text, "remove obstacle gate");
  EXPECT_EQ(messages[1].obstacle, std::vector<std::int32_t>{0});
  EXPECT_EQ(messages[1].happened_step, -1);
  EXPECT_TRUE(messages[0].obstacle.empty());
}

TEST(PilesMessage, ComesInPartsWhenPilesAreMany) {
  const std::vector<Pile<3>> piles(500, make_pile<3>(Vec3::Zero(), 0.8, 5000.0, {}));
  auto messages = to_piles(piles);
  EXPECT_GT(messages.size(), 1U);
  std::int32_t piles_told = 0;
  for (const auto& message : messages) {
    EXPECT_EQ(message.first_pile, piles_told);
    piles_told += message.pile_count;
    EXPECT_EQ(message.pile_total, 500);
  }
  EXPECT_EQ(piles_told, 500);
  expect_sendable(messages);
}

TEST(PilesMessage, TellsTheLowestLayersOfAPileWithThousands) {
  Pile<3> pile;
  pile.structure_size = 20000.0;
  pile.layers.resize(5000, {.top = 1.0, .radius = 1.0, .capacity = 4.0, .count = 2});
  auto messages = to_piles(std::span(&pile, 1));
  EXPECT_EQ(messages[0].piles[0].layer_total, 5000);
  EXPECT_EQ(messages[0].piles[0].layer_count, 1024);
  expect_sendable(messages);
}

RC_GTEST_PROP(SleepMessage, CarriesAllEventsInOrderInSmallMessages, ()) {
  const auto number = *rc::gen::inRange<std::size_t>(0, 12000);
  std::vector<SleepEvent> events(number);
  for (std::size_t i = 0; i < number; ++i)
    events[i] = {.body = static_cast<BodyIndex>(i), .layer = 3, .woke = i % 3 == 0, .cause = SleepCause::lost_support};
  auto messages = to_sleep(events);
  RC_ASSERT(messages.empty() == events.empty());
  BodyIndex next = 0;
  for (const auto& message : messages) {
    for (std::size_t i = 0; i < message.body.size(); ++i, ++next) {
      RC_ASSERT(message.body[i] == next);
      RC_ASSERT(message.woke[i] == (next % 3 == 0 ? 1 : 0));
      RC_ASSERT(message.cause[i] == talus_sleep::LOST_SUPPORT);
    }
  }
  RC_ASSERT(next == static_cast<BodyIndex>(number));
  expect_sendable(messages);
}

TEST(SleepMessage, NumbersCausesAsTheCoreDoes) {
  EXPECT_EQ(talus_sleep::SCORE, static_cast<int>(SleepCause::score));
  EXPECT_EQ(talus_sleep::REST, static_cast<int>(SleepCause::rest));
  EXPECT_EQ(talus_sleep::AVALANCHE, static_cast<int>(SleepCause::avalanche));
  EXPECT_EQ(talus_sleep::CHECK, static_cast<int>(SleepCause::check));
  EXPECT_EQ(talus_sleep::MOTION, static_cast<int>(SleepCause::motion));
  EXPECT_EQ(talus_sleep::MOMENTUM, static_cast<int>(SleepCause::momentum));
  EXPECT_EQ(talus_sleep::LOST_SUPPORT, static_cast<int>(SleepCause::lost_support));
  EXPECT_EQ(talus_sleep::ENGINE, static_cast<int>(SleepCause::engine));
  EXPECT_EQ(talus_sleep::USER, static_cast<int>(SleepCause::user));
}

TEST(BodiesMessage, CarriesAHundredThousandBodiesInSmallMessages) {
  StillWorld<3> world(still_scene<3>().world);
  for (int i = 0; i < 100'000; ++i) world.add({.pose = {.position = Vec3(0.0625 * i, 2.0, 3.0)}});
  auto messages = to_bodies<3>(world.states(), world.awake(), true);
  BodyIndex next = 0;
  for (const auto& message : messages) {
    for (std::size_t i = 0; i < message.body.size(); ++i, ++next) {
      ASSERT_EQ(message.body[i], next);
      ASSERT_EQ(message.poses[7 * i], 0.0625F * static_cast<float>(next));
      ASSERT_EQ(message.poses[7 * i + 3], 1.0F);  // w of no rotation
    }
  }
  EXPECT_EQ(next, 100'000);
  expect_sendable(messages);
}

// A cube of 1 m and 1,000 kg: 1/2 m v^2 + 1/2 I w^2 with I = m a^2 / 6. A long box spinning about its own long axis,
// which a rotation by 90 degrees has turned from x to z: I = m (b^2 + c^2) / 12.
TEST(StatsMessage, GivesTheKineticEnergy) {
  WorldDescription<3> description;
  description.shapes = {make_shape<3>("cube", box_pieces<3>(Vec3(1, 1, 1)), {}),
                        make_shape<3>("bar", box_pieces<3>(Vec3(4, 1, 0.5)), {})};
  StillWorld<3> world(description);
  world.add({.shape = 0, .pose = {}, .velocity = Vec3(3, 0, 4), .spin = Vec3(0, 6, 0)});
  const Rotation<3> x_to_z(Eigen::AngleAxisd(-0.5 * std::numbers::pi, Vec3::UnitY()));
  world.add(
      {.shape = 1, .pose = {.position = {}, .rotation = x_to_z}, .velocity = Vec3::Zero(), .spin = Vec3(0, 0, 2)});
  const PileSet<3> piles({}, {});
  const auto stats = to_stats<3>(Frame<3>{.world = world, .piles = piles, .events = {}, .phases = {}});
  const double cube = 0.5 * 1000 * 25 + 0.5 * (1000.0 / 6) * 36;
  const double bar = 0.5 * (2000 * (1 + 0.25) / 12) * 4;
  EXPECT_NEAR(stats.kinetic_energy, cube + bar, 1e-6);  // rounding of a sum near 2e4
  EXPECT_EQ(stats.awake, 2);
  EXPECT_EQ(stats.asleep, 0);
}

TEST(StatsMessage, CountsNeitherRemovedBodiesNorSleepersTwice) {
  const Scene<2> scene = still_scene<2>();
  StillWorld<2> world(scene.world);
  for (int i = 0; i < 10; ++i) world.add({});
  world.freeze(std::vector<BodyIndex>{0, 1, 2});
  world.remove(1);
  world.remove(9);
  const PileSet<2> piles({}, {});
  const auto stats = to_stats<2>(Frame<2>{.world = world, .piles = piles, .events = {}, .phases = {}});
  EXPECT_EQ(stats.awake, 6);
  EXPECT_EQ(stats.asleep, 2);
}

TEST(StatsMessage, CarriesEveryWarningThereAndBack) {
  const Scene<2> scene = still_scene<2>();
  StillWorld<2> world(scene.world);
  world.add({});
  const PileSet<2> piles({}, {});
  const std::vector<Warning> warnings = {
      {.kind = WarningKind::energy, .step = 7, .body = 3, .bodies = 12, .value = 1.5},
      {.kind = WarningKind::not_appeared, .step = 9, .body = -1, .bodies = 4, .value = 4.0}};
  auto stats = to_stats<2>(
      Frame<2>{.world = world, .piles = piles, .events = {}, .phases = {}, .warnings = warnings, .bodies_planned = 5});
  MessageEncoder encoder(1);
  talus_stats decoded;
  ASSERT_EQ(decode(encoder.encode(stats, {}).bytes, decoded), "");
  EXPECT_EQ(decoded.planned, 5);
  EXPECT_EQ(decoded.appeared, 1);
  const std::vector<Warning> told = warnings_of(decoded);
  ASSERT_EQ(told.size(), 2U);
  for (std::size_t i = 0; i < told.size(); ++i) {
    EXPECT_EQ(told[i].kind, warnings[i].kind);
    EXPECT_EQ(told[i].step, warnings[i].step);
    EXPECT_EQ(told[i].body, warnings[i].body);
    EXPECT_EQ(told[i].bodies, warnings[i].bodies);
    EXPECT_EQ(told[i].value, warnings[i].value);
  }
}

/// A policy that expects its sleeping bodies to move by one metre.
class OneMetrePolicy final : public SleepPolicy<2> {
 public:
  std::optional<DriftEstimate> drift_estimate(const World<2>& /*world*/) const override {
    return DriftEstimate{.drift = 1.0, .checked_share = 0.25};
  }
  void decide(const Frame<2>& /*frame*/, Decision<2>& /*decision*/) override {}
};

TEST(StatsMessage, CarriesTheEstimateOfDriftInExtentsOfTheTypicalBody) {
  const Scene<2> scene = still_scene<2>();
  StillWorld<2> world(scene.world);
  const TypicalBody typical{.bounding_volume = 0.5, .extent = 2.0, .mass = 1.0};
  const PileSet<2> piles({}, typical);
  const OneMetrePolicy policy;
  auto stats = to_stats<2>(Frame<2>{.world = world, .piles = piles, .events = {}, .phases = {}, .policy = &policy});
  MessageEncoder encoder(1);
  talus_stats decoded;
  ASSERT_EQ(decode(encoder.encode(stats, {}).bytes, decoded), "");
  EXPECT_EQ(decoded.drift_estimate, 0.5);
  EXPECT_EQ(decoded.checked_share, 0.25);
}

TEST(StatsMessage, CarriesWhatTheProbeOfTheLastStateFoundInThePlaceOfThePolicysEstimate) {
  const Scene<2> scene = still_scene<2>();
  StillWorld<2> world(scene.world);
  const PileSet<2> piles({}, {.bounding_volume = 0.5, .extent = 2.0, .mass = 1.0});
  const OneMetrePolicy policy;
  const auto stats = to_stats<2>(
      Frame<2>{.world = world, .piles = piles, .events = {}, .phases = {}, .policy = &policy, .probed_drift = 0.125});
  EXPECT_EQ(stats.drift_estimate, 0.125);
  EXPECT_EQ(stats.checked_share, 1.0) << "a probe wakes all bodies";
}

TEST(StatsMessage, HasNoEstimateOfDriftWithoutAPolicyThatMakesOne) {
  const Scene<2> scene = still_scene<2>();
  StillWorld<2> world(scene.world);
  const PileSet<2> piles({}, {});
  EXPECT_EQ(to_stats<2>(Frame<2>{.world = world, .piles = piles, .events = {}, .phases = {}}).drift_estimate, -1.0);
}

TEST(StatsMessage, CarriesTheOverlap) {
  const Scene<2> scene = still_scene<2>();
  StillWorld<2> world(scene.world);
  const PileSet<2> piles({}, {});
  auto stats = to_stats<2>(Frame<2>{
      .world = world, .piles = piles, .events = {}, .phases = {}, .overlap = {.deepest = 0.25, .share = 0.125}});
  MessageEncoder encoder(1);
  talus_stats decoded;
  ASSERT_EQ(decode(encoder.encode(stats, {}).bytes, decoded), "");
  EXPECT_EQ(decoded.overlap, 0.25);
  EXPECT_EQ(decoded.overlap_share, 0.125);
}

// Box2D counts turns and Bullet does not.
TEST(BodiesMessage, HasAnglesOfAtMostHalfATurn) {
  BodyStates<2> states;
  states.shape = {0};
  states.pose = {{Vec2(1.0, 2.0), Rotation<2>(7.0)}};
  states.velocity = {Vec2::Zero()};
  states.spin = {Spin<2>::Zero()};
  states.asleep = {0};
  states.removed = {0};
  const auto messages = to_bodies<2>(states, std::vector<BodyIndex>{0}, true);
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_FLOAT_EQ(messages[0].poses[2], 7.0F - 2.0F * std::numbers::pi_v<float>);
}

TEST(StatsMessage, NumbersKindsOfWarningAsTheCoreDoes) {
  EXPECT_EQ(talus_stats::BELOW_GROUND, static_cast<int>(WarningKind::below_ground));
  EXPECT_EQ(talus_stats::OUTSIDE_WORLD, static_cast<int>(WarningKind::outside_world));
  EXPECT_EQ(talus_stats::ENERGY, static_cast<int>(WarningKind::energy));
  EXPECT_EQ(talus_stats::SPEED_LIMIT, static_cast<int>(WarningKind::speed_limit));
  EXPECT_EQ(talus_stats::SPIN_LIMIT, static_cast<int>(WarningKind::spin_limit));
  EXPECT_EQ(talus_stats::NOT_APPEARED, static_cast<int>(WarningKind::not_appeared));
  EXPECT_EQ(talus_stats::OVERLAP, static_cast<int>(WarningKind::overlap));
  EXPECT_EQ(talus_stats::PASSED, static_cast<int>(WarningKind::passed));
}

TEST(ShapesMessage, CarriesEveryPieceAndTheObstacles) {
  const auto messages = to_shapes<3>(still_scene<3>().world);
  ASSERT_EQ(messages.size(), 3U);
  EXPECT_EQ(messages[0].name, "l");
  EXPECT_EQ(messages[0].piece_count, 2);
  EXPECT_EQ(messages[1].kind, std::vector<std::int8_t>{talus_shapes::BALL});
  EXPECT_EQ(messages[1].values, (std::vector<double>{0, 0, 0, 0.5}));
  EXPECT_EQ(messages[2].obstacle, 1);
  EXPECT_EQ(messages[2].pose[0], 7.0);
}

/// What an engine, a measure or a picture reads of a shape, bit for bit.
template <int Dim>
void expect_same_shape(const Shape<Dim>& read, const Shape<Dim>& sent) {
  EXPECT_EQ(read.name, sent.name);
  EXPECT_EQ(read.colour, sent.colour);
  EXPECT_EQ(read.pieces.size(), sent.pieces.size());
  EXPECT_EQ(read.material.density, sent.material.density);
  EXPECT_EQ(read.material.friction, sent.material.friction);
  EXPECT_EQ(read.material.restitution, sent.material.restitution);
  EXPECT_EQ(read.material.rolling_friction, sent.material.rolling_friction);
  EXPECT_EQ(read.volume, sent.volume);
  EXPECT_EQ(read.mass, sent.mass);
  EXPECT_EQ(read.inertia, sent.inertia);
  EXPECT_EQ(read.bounds.min(), sent.bounds.min());
  EXPECT_EQ(read.bounds.max(), sent.bounds.max());
}

// The second shape is a body of two densities, whose mass and inertia do not follow from its pieces.
template <int Dim>
void expect_shapes_there_and_back() {
  const Material rough{.density = 700.0, .friction = 0.3, .restitution = 0.1, .rolling_friction = 0.05};
  const Shape<Dim> light = make_shape<Dim>("light", ball_pieces<Dim>(0.3), rough);
  const Shape<Dim> heavy = make_shape<Dim>("heavy", box_pieces<Dim>(Vec<Dim>::Constant(0.4)), {.density = 3000.0});
  Pose<Dim> aside;
  aside.position[0] = 0.6;
  WorldDescription<Dim> world;
  world.shapes = {make_shape<Dim>("capsule", capsule_pieces<Dim>(1.0, 0.2), rough),
                  make_compound<Dim>("two", {{light, {}}, {heavy, aside}}, rough)};
  world.shapes[0].colour = "#12abEF";
  const auto messages = to_shapes<Dim>(world);
  MessageEncoder encoder(1);
  for (std::size_t i = 0; i < messages.size(); ++i) {
    talus_shapes sent = messages[i];
    talus_shapes decoded;
    ASSERT_EQ(decode(encoder.encode(sent, {}).bytes, decoded), "");
    expect_same_shape<Dim>(to_shape<Dim>(decoded), world.shapes[i]);
  }
}

TEST(ShapesMessage, CarriesAllThatABodyIsMadeOfThereAndBack) {
  expect_shapes_there_and_back<2>();
  expect_shapes_there_and_back<3>();
}

TEST(RunMessage, CarriesAllThatTheWorldIsMadeWith) {
  Scene<2> scene = still_scene<2>();
  scene.world.gravity = 4.0;
  scene.world.down = Vec2(0.6, -0.8);
  scene.world.ground.height = -2.0;
  scene.world.ground.material.friction = 0.25;
  scene.world.periodic_x = Vec2(-3.0, 7.0);
  scene.world.solver.kind = small_steps_solver;
  scene.world.solver.sub_steps = 6;
  scene.world.solver.velocity_iterations = 37;
  scene.policy.kind = "adaptive";
  scene.policy.adaptive.tolerance = 0.125;
  const MessageEncoder encoder(1);
  const auto message = to_run(run_info(scene, "", ""), talus_lcm::talus_run::ALIVE, "", {}, encoder);
  EXPECT_EQ(message.format, talus_lcm::talus_run::FORMAT);
  EXPECT_EQ(message.tolerance, 0.125);
  EXPECT_DOUBLE_EQ(message.gravity[0], 2.4);
  EXPECT_EQ(message.gravity[1], 0.0);
  EXPECT_DOUBLE_EQ(message.gravity[2], -3.2);
  EXPECT_EQ(message.ground_height, -2.0);
  EXPECT_EQ(message.ground_friction, 0.25);
  EXPECT_EQ(Vec3(message.side), Vec3(-3.0, 0.0, 0.0));
  EXPECT_EQ(Vec3(message.period), Vec3(10.0, 0.0, 0.0));
  EXPECT_EQ(message.solver, "small_steps");
  EXPECT_EQ(message.sub_steps, 6);
  EXPECT_EQ(message.velocity_iterations, 37);
  scene.policy.kind = "full";
  EXPECT_EQ(to_run(run_info(scene, "", ""), 0, "", {}, encoder).tolerance, -1.0);
}

TEST(ShapesMessage, RefusesAShapeTooLargeForAMessage) {
  WorldDescription<2> world;
  world.shapes.resize(1);
  world.shapes[0].pieces.assign(3000, BoxPiece<2>{});
  EXPECT_THROW(to_shapes<2>(world), std::invalid_argument);
}

TEST(SceneFiles, ComeInPartsThatMakeTheWhole) {
  Scene<2> scene = still_scene<2>();
  EXPECT_TRUE(to_scene_files(scene).empty()) << "it was made by a program";
  scene.toml = std::string(100'000, 'a') + "\n\xC3\xA4";
  auto messages = to_scene_files(scene);
  ASSERT_EQ(messages.size(), 3U);
  std::string text;
  for (const auto& message : messages) {
    EXPECT_EQ(message.file, "scene.toml");
    text += message.text;
  }
  EXPECT_EQ(text, scene.toml);
  expect_sendable(messages);
}

TEST(ContactsMessage, CarriesPointsAndForcesThereAndBackInSpace) {
  std::vector<ContactForce<2>> contacts(5000);
  for (BodyIndex i = 0; i < 5000; ++i)
    contacts[i] = {i, first_obstacle - i, {i, 2.0}, {3.0, 0.25 * i}, {-5.0, 6.0}, i % 3 == 0};
  auto messages = to_contacts<2>(contacts);
  EXPECT_GT(messages.size(), 1U);
  expect_sendable(messages);
  std::vector<ContactForce<3>> read;
  for (const auto& message : messages) append_contacts(message, read);
  ASSERT_EQ(read.size(), contacts.size());
  for (BodyIndex i = 0; i < 5000; ++i) {
    EXPECT_EQ(read[i].a, i);
    EXPECT_EQ(read[i].b, first_obstacle - i);
    EXPECT_EQ(read[i].point, Vec3(i, 0.0, 2.0));
    EXPECT_EQ(read[i].normal_force, Vec3(3.0, 0.0, 0.25 * i));
    EXPECT_EQ(read[i].friction_force, Vec3(-5.0, 0.0, 6.0));
    EXPECT_EQ(read[i].kept, i % 3 == 0);
  }
}

TEST(ContactsMessage, SaysThatThereAreNone) {
  const auto messages = to_contacts<3>({});
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_EQ(messages[0].contact_count, 0);
}

TEST(InstrumentsMessage, HasTheFormAndTheReadingsOfEachInstrument) {
  Scene<3> scene = still_scene<3>();
  scene.instruments.gates = {{.name = "round", .centre = {1.0, 2.0, 3.0}, .radius = 2.0},
                             {.name = "flat", .corners = {{0.0, 0.0, 1.0}, {2.0, 0.0, 1.0}, {0.0, 4.0, 1.0}}}};
  scene.instruments.regions = {{.name = "ball", .centre = Vec3(0.0, 0.0, 5.0), .radius = 4.0},
                               {.name = "slice", .layer = {1.0, 2.0}}};
  scene.instruments.loads = {{.name = "all", .on_ground = true, .obstacles = {0}}};
  scene.obstacle_names = {{.name = "wall", .first = 0, .count = 1}};
  const InstrumentMeters<3> meters(scene);
  const auto messages = to_instruments(meters, scene.obstacle_names);
  ASSERT_EQ(messages.size(), 1U);
  const talus_lcm::talus_instruments& message = messages[0];
  ASSERT_EQ(message.gate_count, 2);
  for (std::size_t i = 0; i < message.gates[0].outline.size(); i += 3) {
    const Vec3 corner(message.gates[0].outline[i], message.gates[0].outline[i + 1], message.gates[0].outline[i + 2]);
    EXPECT_NEAR((corner - Vec3(1.0, 2.0, 3.0)).norm(), 2.0, 1e-6);
    EXPECT_NEAR(corner.z(), 3.0, 1e-6);
  }
  EXPECT_EQ(message.gates[1].outline, (std::vector<float>{0, 0, 1, 2, 0, 1, 2, 4, 1, 0, 4, 1}));
  ASSERT_EQ(message.region_count, 2);
  EXPECT_EQ(message.regions[0].kind, talus_lcm::talus_region::BALL);
  EXPECT_EQ(message.regions[0].low[2], 5.0);
  EXPECT_EQ(message.regions[0].high[0], 4.0);
  EXPECT_EQ(message.regions[0].packing, -1.0) << "not known before the first frame";
  EXPECT_EQ(message.regions[0].slope, -1.0) << "nor is this";
  EXPECT_EQ(message.regions[1].kind, talus_lcm::talus_region::LAYER);
  ASSERT_EQ(message.load_count, 1);
  EXPECT_EQ(message.loads[0].obstacle, (std::vector<std::int32_t>{-1, 0}));
  EXPECT_EQ(message.loads[0].known, 0) << "no step yet";
}

TEST(InstrumentsMessage, OfMoreThanFitOneComesInSeveral) {
  Scene<2> scene = still_scene<2>();
  for (int i = 0; i < 2000; ++i)
    scene.instruments.gates.push_back({.name = "gate " + std::to_string(i), .corners = {{0.0, 1.0}, {1.0, 1.0}}});
  const InstrumentMeters<2> meters(scene);
  auto messages = to_instruments(meters, scene.obstacle_names);
  ASSERT_GT(messages.size(), 1U);
  MessageEncoder encoder(1);
  int gates = 0;
  for (talus_lcm::talus_instruments& message : messages) {
    gates += message.gate_count;
    EXPECT_EQ(message.parts, static_cast<std::int32_t>(messages.size()));
    EXPECT_LE(encoder.encode(message, {0, 1, 0.5}).bytes.size(), max_message_bytes);
  }
  EXPECT_EQ(gates, 2000);
}

}  // namespace
}  // namespace talus::messages_test
