#include "lcmtypes/translate.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numbers>
#include <numeric>

#include "common/policy/paper_policy.h"
#include "lcmtypes/decode.h"
#include "tests/lcmtypes/still_run.h"

namespace talus::translate_test {
namespace {

using talus_lcm::talus_pile_v2;
using talus_lcm::talus_shapes_v1;
using talus_lcm::talus_sleep_v1;
using talus_lcm::talus_stats_v2;

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
  Pile<2> pile = make_pile<2>(Vec2(3.0, 1.0), 0.8, 100.0, {.bounding_volume = 0.5, .extent = 1.0, .mass = 1.0});
  pile.layers[0].count = 7;
  pile.layers[0].sleeping = 5;
  const auto messages = to_piles<2>(std::span(&pile, 1));
  ASSERT_EQ(messages.size(), 1U);
  ASSERT_EQ(messages[0].piles.size(), 1U);
  const talus_pile_v2& told = messages[0].piles[0];
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
  const Pile<2> pile = make_pile<2>(Vec2::Zero(), 0.8, 100.0, {});
  PaperParams params;
  params.tau = 0.4;
  params.avalanche_density = {0.75, 0.875};
  const PaperPolicy<2> paper(params, {});
  const auto of_paper = to_piles<2>(std::span(&pile, 1), &paper);
  const auto& layers = of_paper[0].piles[0].layers;
  ASSERT_GT(layers.size(), 2U);
  EXPECT_EQ(layers[0].wake_density, 0.75F);
  EXPECT_EQ(layers[2].wake_density, 0.875F) << "the last one holds for all above";
  EXPECT_EQ(layers[1].sleep_density, 0.4F) << "the other factors of the score are at most 1";
  EXPECT_EQ(to_pile<2>(of_paper[0].piles[0]).layers[2].thresholds.wake, 0.875);
  const NoPolicy<2> none;
  const auto of_none = to_piles<2>(std::span(&pile, 1), &none);
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
  EXPECT_EQ(messages[1].removed, std::vector<std::int32_t>{0});
  EXPECT_EQ(messages[1].happened_step, -1);
  EXPECT_TRUE(messages[0].removed.empty());
}

TEST(PilesMessage, ComesInPartsWhenPilesAreMany) {
  const std::vector<Pile<3>> piles(500, make_pile<3>(Vec3::Zero(), 0.8, 5000.0, {}));
  auto messages = to_piles<3>(piles);
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
  Pile<2> pile;
  pile.structure_size = 20000.0;
  pile.layers.resize(5000, {.top = 1.0, .radius = 1.0, .capacity = 4.0, .count = 2});
  auto messages = to_piles<2>(std::span(&pile, 1));
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
      RC_ASSERT(message.cause[i] == talus_sleep_v1::LOST_SUPPORT);
    }
  }
  RC_ASSERT(next == static_cast<BodyIndex>(number));
  expect_sendable(messages);
}

TEST(SleepMessage, NumbersCausesAsTheCoreDoes) {
  EXPECT_EQ(talus_sleep_v1::SCORE, static_cast<int>(SleepCause::score));
  EXPECT_EQ(talus_sleep_v1::REST, static_cast<int>(SleepCause::rest));
  EXPECT_EQ(talus_sleep_v1::AVALANCHE, static_cast<int>(SleepCause::avalanche));
  EXPECT_EQ(talus_sleep_v1::CHECK, static_cast<int>(SleepCause::check));
  EXPECT_EQ(talus_sleep_v1::MOMENTUM, static_cast<int>(SleepCause::momentum));
  EXPECT_EQ(talus_sleep_v1::LOST_SUPPORT, static_cast<int>(SleepCause::lost_support));
  EXPECT_EQ(talus_sleep_v1::ENGINE, static_cast<int>(SleepCause::engine));
  EXPECT_EQ(talus_sleep_v1::USER, static_cast<int>(SleepCause::user));
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
  talus_stats_v2 decoded;
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
  talus_stats_v2 decoded;
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
  talus_stats_v2 decoded;
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
  EXPECT_EQ(talus_stats_v2::BELOW_GROUND, static_cast<int>(WarningKind::below_ground));
  EXPECT_EQ(talus_stats_v2::OUTSIDE_WORLD, static_cast<int>(WarningKind::outside_world));
  EXPECT_EQ(talus_stats_v2::ENERGY, static_cast<int>(WarningKind::energy));
  EXPECT_EQ(talus_stats_v2::SPEED_LIMIT, static_cast<int>(WarningKind::speed_limit));
  EXPECT_EQ(talus_stats_v2::SPIN_LIMIT, static_cast<int>(WarningKind::spin_limit));
  EXPECT_EQ(talus_stats_v2::NOT_APPEARED, static_cast<int>(WarningKind::not_appeared));
  EXPECT_EQ(talus_stats_v2::OVERLAP, static_cast<int>(WarningKind::overlap));
}

TEST(ShapesMessage, CarriesEveryPieceAndTheObstacles) {
  const auto messages = to_shapes<3>(still_scene<3>().world);
  ASSERT_EQ(messages.size(), 3U);
  EXPECT_EQ(messages[0].name, "l");
  EXPECT_EQ(messages[0].piece_count, 2);
  EXPECT_EQ(messages[1].kind, std::vector<std::int8_t>{talus_shapes_v1::BALL});
  EXPECT_EQ(messages[1].values, (std::vector<double>{0, 0, 0, 0.5}));
  EXPECT_EQ(messages[2].obstacle, 1);
  EXPECT_EQ(messages[2].pose[0], 7.0);
}

TEST(ObstaclesMessage, CarriesPosesThereAndBack) {
  std::vector<ObstaclePose<3>> poses;
  for (int k = 0; k < 5000; ++k)
    poses.push_back({2 * k, {{0.5 * k, -1.0, 2.0}, Rotation<3>(Eigen::AngleAxisd(0.001 * k, Vec3::UnitY()))}});
  std::vector<ObstaclePose<3>> read;
  MessageEncoder encoder(1);
  for (talus_lcm::talus_obstacles_v1& message : to_obstacles<3>(poses)) {
    talus_lcm::talus_obstacles_v1 decoded;
    EXPECT_EQ(decode(encoder.encode(message, {0, 6, 0.5}).bytes, decoded), "");
    EXPECT_TRUE(poses_of<2>(decoded).empty());
    for (const ObstaclePose<3>& each : poses_of<3>(decoded)) read.push_back(each);
  }
  ASSERT_EQ(read.size(), poses.size());
  EXPECT_EQ(read[4999].obstacle, 9998);
  EXPECT_EQ(read[4999].pose.position, poses[4999].pose.position);
  EXPECT_NEAR(read[4999].pose.rotation.angularDistance(poses[4999].pose.rotation), 0.0, 1e-3);
  EXPECT_TRUE(to_obstacles<3>({}).empty());
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

}  // namespace
}  // namespace talus::translate_test
