// Frames as the browser page reads them, decoded here from their description in tools/view/frame_stream.h.

#include "tools/view/frame_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <random>

#include "common/shape/catalogue.h"
#include "tools/view/hidden_bodies.h"
#include "tools/view/merge_blocks.h"
#include "tools/view/stream_numbers.h"

namespace talus::frame_stream_test {
namespace {

template <int Dim>
struct Decoded {
  static constexpr int components = Dim == 2 ? 3 : 7;
  std::uint64_t step = 0;
  std::vector<std::array<double, components>> pose;  // in quanta
  std::vector<std::uint64_t> shape;
  std::vector<int> asleep;
  std::vector<int> removed;
  std::vector<int> hidden;
  std::vector<SleepEvent> events;  // of the last block
  std::vector<std::vector<std::int64_t>> counts;
  float kinetic_energy = 0.0F;
  float drift_estimate = 0.0F;
  float slope = 0.0F;
  float ms_per_step = 0.0F;
  std::map<std::uint64_t, std::string> warnings;
  std::vector<DoneEvent> scene_events;
  std::map<std::uint64_t, std::array<double, components>> obstacles;  // their poses, in quanta
};

template <int Dim>
class Decoder {
 public:
  void take(const std::string& block) {
    reader_ = StreamReader(block);
    state.step = number();
    for (std::uint64_t left = number(); left > 0; --left) {
      state.shape.push_back(0);
      state.pose.emplace_back();
      state.asleep.push_back(0);
      state.removed.push_back(0);
      state.hidden.push_back(0);
      fresh_.push_back(state.shape.size() - 1);
    }
    for (const std::size_t body : fresh_) state.shape[body] = number();
    fresh_.clear();
    for (const std::uint64_t body : list()) state.removed[body] ^= 1;
    for (const std::uint64_t body : list()) state.asleep[body] ^= 1;
    for (const std::uint64_t body : list()) state.hidden[body] ^= 1;
    const std::vector<std::uint64_t> moved = list();
    for (int i = 0; i < Decoded<Dim>::components; ++i)
      for (const std::uint64_t body : moved) state.pose[body][i] += static_cast<double>(difference());
    take_events();
    take_piles();
    state.kinetic_energy = real();
    state.drift_estimate = real();
    state.slope = real();
    state.ms_per_step = real();
    for (std::uint64_t left = number(); left > 0; --left) {
      const std::uint64_t kind = number();
      number();
      state.warnings[kind] = reader_.text(number());
    }
    for (std::uint64_t left = number(); left > 0; --left) {
      const int event = static_cast<int>(number());
      state.scene_events.push_back({event, real()});
    }
    const std::vector<std::uint64_t> moved_obstacles = list();
    for (int i = 0; i < Decoded<Dim>::components; ++i)
      for (const std::uint64_t obstacle : moved_obstacles)
        state.obstacles[obstacle][i] += static_cast<double>(difference());
    EXPECT_TRUE(reader_.done()) << "a block ends where its description says";
  }

  Decoded<Dim> state;

 private:
  void take_events() {
    state.events.clear();
    for (std::uint64_t left = number(); left > 0; --left) {
      SleepEvent event;
      event.body = static_cast<BodyIndex>(number());
      event.step = static_cast<std::int64_t>(state.step - number());
      const std::uint64_t code = number();
      event.woke = code % 2 == 1;
      event.cause = static_cast<SleepCause>(code / 2);
      event.pile = static_cast<int>(number()) - 1;
      event.layer = static_cast<int>(number()) - 1;
      event.score = real();
      state.events.push_back(event);
    }
  }

  void take_piles() {
    state.counts.resize(number());
    for (std::uint64_t left = number(); left > 0; --left) {
      std::vector<std::int64_t>& counts = state.counts[number()];
      const std::uint64_t form = number();
      for (std::uint64_t i = 0; i < form; ++i) real();
      const std::uint64_t size = number();
      if (form > 0) counts.assign(size, 0);
      EXPECT_EQ(counts.size(), size);
      for (std::int64_t& count : counts) count += difference();
    }
  }

  std::uint64_t number() { return reader_.number(); }
  std::int64_t difference() { return reader_.difference(); }
  float real() { return reader_.real(); }

  std::vector<std::uint64_t> list() {
    std::vector<std::uint64_t> bodies(number());
    std::uint64_t body = static_cast<std::uint64_t>(-1);
    for (std::uint64_t& each : bodies) each = body += number();
    return bodies;
  }

  StreamReader reader_{""};
  std::vector<std::size_t> fresh_;
};

template <int Dim>
void add_body(BodyStates<Dim>& states, const Pose<Dim>& pose) {
  states.shape.push_back(states.size() % 3);
  states.pose.push_back(pose);
  states.velocity.push_back(Vec<Dim>::Zero());
  states.spin.push_back(Spin<Dim>::Zero());
  states.asleep.push_back(0);
  states.removed.push_back(0);
}

TEST(FrameStream, PosesInThePlaneAreWithinHalfAQuantum) {
  const Quantum quantum;
  FrameEncoder<2> encoder(std::make_shared<FrameForm<2>>(FrameForm<2>{quantum}));
  Decoder<2> decoder;
  BodyStates<2> states;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-20.0, 20.0);
  for (int frame = 1; frame <= 50; ++frame) {
    add_body<2>(states, {{any(random), any(random)}, Rotation<2>(any(random))});
    for (Pose<2>& pose : states.pose) pose = {{any(random), any(random)}, Rotation<2>(any(random))};
    decoder.take(encoder.encode({.step = frame, .states = states}));
    for (BodyIndex body = 0; body < states.size(); ++body) {
      const auto& seen = decoder.state.pose[body];
      EXPECT_NEAR(seen[0] * quantum.position, states.pose[body].position.x(), 0.51 * quantum.position);
      EXPECT_NEAR(seen[1] * quantum.position, states.pose[body].position.y(), 0.51 * quantum.position);
      const Rotation<2> off(seen[2] * quantum.angle - states.pose[body].rotation.angle());
      EXPECT_NEAR(off.smallestAngle(), 0.0, 0.51 * quantum.angle);
    }
  }
}

TEST(FrameStream, RotationsInSpaceAreWithinAQuantum) {
  const Quantum quantum;
  FrameEncoder<3> encoder(std::make_shared<FrameForm<3>>(FrameForm<3>{quantum}));
  Decoder<3> decoder;
  BodyStates<3> states;
  add_body<3>(states, {Vec3(1.0, 2.0, 3.0), Rotation<3>::Identity()});
  std::srand(1);
  for (int frame = 1; frame <= 200; ++frame) {
    states.pose[0].rotation = Rotation<3>(Eigen::Quaterniond::UnitRandom());
    decoder.take(encoder.encode({.step = frame, .states = states}));
    const auto& seen = decoder.state.pose[0];
    Rotation<3> q(seen[3], seen[4], seen[5], seen[6]);
    q.normalize();
    EXPECT_LT(q.angularDistance(states.pose[0].rotation), 2.5 * quantum.quaternion);
  }
}

TEST(FrameStream, WhatDoesNotChangeTakesNoRoom) {
  FrameEncoder<2> encoder(std::make_shared<FrameForm<2>>());
  BodyStates<2> states;
  for (int i = 0; i < 1000; ++i) add_body<2>(states, {{0.1 * i, 1.0}, Rotation<2>(0.0)});
  EXPECT_GT(encoder.encode({.step = 1, .states = states}).size(), 1000U);
  EXPECT_LT(encoder.encode({.step = 2, .states = states}).size(), 30U);
}

TEST(FrameStream, SleepRemovalEventsAndWarningsArrive) {
  FrameEncoder<2> encoder(std::make_shared<FrameForm<2>>());
  Decoder<2> decoder;
  BodyStates<2> states;
  for (int i = 0; i < 3; ++i) add_body<2>(states, {{1.0 * i, 1.0}, Rotation<2>(0.0)});
  decoder.take(encoder.encode({.step = 1, .states = states}));
  states.asleep[1] = 1;
  states.removed[2] = 1;
  const std::vector<SleepEvent> events = {
      {.step = 5, .body = 1, .pile = 0, .layer = -1, .cause = SleepCause::rest, .score = 0.5}};
  const std::vector<Warning> warnings = {{.kind = WarningKind::energy, .step = 4, .bodies = 1, .value = 2.0}};
  decoder.take(
      encoder.encode({.step = 7, .states = states, .events = events, .warnings = warnings, .kinetic_energy = 2.5}));
  EXPECT_EQ(decoder.state.asleep, (std::vector<int>{0, 1, 0}));
  EXPECT_EQ(decoder.state.removed, (std::vector<int>{0, 0, 1}));
  EXPECT_EQ(decoder.state.shape, (std::vector<std::uint64_t>{0, 1, 2}));
  ASSERT_EQ(decoder.state.events.size(), 1U);
  EXPECT_EQ(decoder.state.events[0].step, 5);
  EXPECT_EQ(decoder.state.events[0].body, 1);
  EXPECT_EQ(decoder.state.events[0].cause, SleepCause::rest);
  EXPECT_EQ(decoder.state.events[0].layer, -1);
  EXPECT_FLOAT_EQ(decoder.state.kinetic_energy, 2.5F);
  EXPECT_EQ(decoder.state.warnings.at(2), account(warnings[0]));
  decoder.take(encoder.encode({.step = 8, .states = states, .warnings = warnings}));
  EXPECT_TRUE(decoder.state.events.empty());
}

TEST(FrameStream, EventsOfTheSceneComeOnce) {
  FrameEncoder<2> encoder(std::make_shared<FrameForm<2>>());
  Decoder<2> decoder;
  const BodyStates<2> states;
  const std::vector<DoneEvent> done = {{2, 1.5}, {0, 2.0}};
  decoder.take(encoder.encode({.step = 1, .states = states}));
  EXPECT_TRUE(decoder.state.scene_events.empty());
  decoder.take(encoder.encode({.step = 2, .states = states, .scene_events = std::span(done).first(1)}));
  decoder.take(encoder.encode({.step = 3, .states = states, .scene_events = done}));
  ASSERT_EQ(decoder.state.scene_events.size(), 2U);
  EXPECT_EQ(decoder.state.scene_events[0].number, 2);
  EXPECT_FLOAT_EQ(static_cast<float>(decoder.state.scene_events[0].time), 1.5F);
  EXPECT_EQ(decoder.state.scene_events[1].number, 0);
}

TEST(FrameStream, ObstaclesThatMoveArriveAndThoseThatStandTakeNoRoom) {
  Decoder<2> decoder;
  const auto form = std::make_shared<FrameForm<2>>();
  FrameEncoder<2> encoder(form);
  std::vector<ObstaclePose<2>> obstacles = {{3, {{1.0, -2.0}, Rotation<2>(0.5)}}, {7, {{0.0, 0.0}, Rotation<2>(0.0)}}};
  const BodyStates<2> none;
  decoder.take(encoder.encode({.step = 1, .states = none, .obstacles = obstacles}));
  EXPECT_EQ(decoder.state.obstacles.size(), 2U);
  const std::size_t still = encoder.encode({.step = 2, .states = none, .obstacles = obstacles}).size();
  obstacles[0].pose = {{1.5, -2.0}, Rotation<2>(0.5 + 4.0 * std::numbers::pi)};
  const std::string block = encoder.encode({.step = 3, .states = none, .obstacles = obstacles});
  EXPECT_GT(block.size(), still);
  decoder.take(block);
  const auto& seen = decoder.state.obstacles.at(3);
  EXPECT_NEAR(seen[0] * form->quantum.position, 1.5, form->quantum.position);
  EXPECT_NEAR(seen[1] * form->quantum.position, -2.0, form->quantum.position);
  EXPECT_NEAR(seen[2] * form->quantum.angle, 0.5, form->quantum.angle) << "whole turns are left out";
}

TEST(FrameStream, LayersCountAsThePilesDo) {
  FrameEncoder<2> encoder(std::make_shared<FrameForm<2>>());
  Decoder<2> decoder;
  const BodyStates<2> states;
  std::vector<Pile<2>> piles = {make_pile<2>(Vec2::Zero(), 0.6, 50.0, {.bounding_volume = 1.0, .extent = 1.4})};
  ASSERT_GT(piles[0].layers.size(), 1U);
  for (int frame = 1; frame < 5; ++frame) {
    piles[0].layers[0].count = 7 * frame % 5;
    piles[0].layers[1].sleeping = frame;
    if (frame == 3) piles[0] = make_pile<2>(Vec2::Zero(), 0.6, 200.0, {.bounding_volume = 1.0, .extent = 1.4});
    decoder.take(encoder.encode({.step = frame, .states = states, .piles = piles}));
    ASSERT_EQ(decoder.state.counts.at(0).size(), 2 * piles[0].layers.size());
    for (std::size_t i = 0; i < piles[0].layers.size(); ++i) {
      EXPECT_EQ(decoder.state.counts[0][2 * i], piles[0].layers[i].count);
      EXPECT_EQ(decoder.state.counts[0][2 * i + 1], piles[0].layers[i].sleeping);
    }
  }
}

/// A run of which everything changes: bodies come, move, sleep, wake and go, the pile grows and shrinks and goes,
/// obstacles move, events and warnings happen.
template <int Dim>
class EventfulRun {
 public:
  std::string next() {
    ++step_;
    std::vector<SleepEvent> events;
    for (BodyIndex body = 0; body < states_.size(); ++body) {
      if (happens(3)) states_.pose[body].position = any_place();
      if (happens(3)) states_.pose[body].rotation = any_rotation();
      if (happens(10)) states_.removed[body] = 1;
      if (!happens(4) || states_.removed[body] != 0) continue;
      states_.asleep[body] ^= 1;
      events.push_back({.step = step_, .body = body, .woke = states_.asleep[body] == 0, .score = 0.25});
    }
    if (happens(2)) add_body<Dim>(states_, {any_place(), any_rotation()});
    if (happens(5)) piles_.clear();
    if (happens(2))
      piles_ = {
          make_pile<Dim>(Vec<Dim>::Zero(), 0.6, happens(2) ? 20.0 : 300.0, {.bounding_volume = 1.0, .extent = 1.4})};
    for (Pile<Dim>& pile : piles_)
      for (Layer& layer : pile.layers) layer.count = static_cast<int>(random_() % 9);
    if (happens(6)) scene_events_.push_back({static_cast<int>(scene_events_.size()), 0.5 * static_cast<double>(step_)});
    warnings_ = {{.kind = WarningKind::energy, .step = 1, .bodies = 1, .value = happens(2) ? 1.0 : 2.0}};
    if (happens(2)) obstacles_ = {{3, {any_place(), any_rotation()}}};
    return encoder_.encode({.step = step_,
                            .states = states_,
                            .events = events,
                            .piles = piles_,
                            .warnings = warnings_,
                            .kinetic_energy = static_cast<double>(step_),
                            .scene_events = scene_events_,
                            .drift_estimate = 0.5,
                            .obstacles = obstacles_,
                            .ms_per_step = 2.0 * static_cast<double>(step_)});
  }

 private:
  bool happens(int one_in) { return random_() % one_in == 0; }
  double any() { return std::uniform_real_distribution<double>(-9.0, 9.0)(random_); }
  Vec<Dim> any_place() {
    return Vec<Dim>::NullaryExpr([this] { return any(); });
  }
  Rotation<Dim> any_rotation() {
    if constexpr (Dim == 2)
      return Rotation<2>(any());
    else
      return Rotation<3>(any(), any(), any(), any()).normalized();
  }

  std::mt19937 random_{7};
  std::int64_t step_ = 0;
  FrameEncoder<Dim> encoder_{std::make_shared<FrameForm<Dim>>()};
  BodyStates<Dim> states_;
  std::vector<Pile<Dim>> piles_;
  std::vector<DoneEvent> scene_events_;
  std::vector<Warning> warnings_;
  std::vector<ObstaclePose<Dim>> obstacles_;
};

/// Blocks merged in any grouping bring a page to the same states, and tell it of all that happened.
template <int Dim>
void expect_merged_blocks_to_do_what_both_do() {
  EventfulRun<Dim> run;
  Decoder<Dim> all;
  Decoder<Dim> some;
  std::mt19937 random(5);
  std::vector<SleepEvent> events_of_all;
  std::string waiting;
  for (int frame = 0; frame < 400; ++frame) {
    const std::string block = run.next();
    all.take(block);
    events_of_all.insert(events_of_all.end(), all.state.events.begin(), all.state.events.end());
    waiting = waiting.empty() ? block : merge_blocks<Dim>(waiting, block);
    if (random() % 3 != 0) continue;
    some.take(waiting);
    waiting.clear();
    EXPECT_EQ(some.state.step, all.state.step);
    EXPECT_EQ(some.state.pose, all.state.pose);
    EXPECT_EQ(some.state.shape, all.state.shape);
    EXPECT_EQ(some.state.asleep, all.state.asleep);
    EXPECT_EQ(some.state.removed, all.state.removed);
    EXPECT_EQ(some.state.counts, all.state.counts);
    EXPECT_EQ(some.state.warnings, all.state.warnings);
    EXPECT_EQ(some.state.obstacles, all.state.obstacles);
    EXPECT_EQ(some.state.scene_events.size(), all.state.scene_events.size());
    EXPECT_EQ(some.state.ms_per_step, all.state.ms_per_step);
    ASSERT_EQ(some.state.events.size(), events_of_all.size());
    for (std::size_t i = 0; i < events_of_all.size(); ++i) {
      EXPECT_EQ(some.state.events[i].step, events_of_all[i].step);
      EXPECT_EQ(some.state.events[i].body, events_of_all[i].body);
      EXPECT_EQ(some.state.events[i].woke, events_of_all[i].woke);
    }
    events_of_all.clear();
  }
}

TEST(FrameStream, MergedBlocksDoWhatBothDo) {
  expect_merged_blocks_to_do_what_both_do<2>();
  expect_merged_blocks_to_do_what_both_do<3>();
}

/// A cube of cubes, `edge` along each axis, that all sleep.
struct CubeOfCubes {
  explicit CubeOfCubes(int edge) {
    for (int i = 0; i < edge * edge * edge; ++i) {
      add_body<3>(states, {.position = Vec3(i % edge, i / edge % edge, i / (edge * edge))});
      states.shape.back() = 0;
      states.asleep.back() = 1;
    }
    form->shapes = {make_shape<3>("cube", box_pieces<3>(Vec3::Ones()), {})};
  }
  BodyStates<3> states;
  std::shared_ptr<FrameForm<3>> form = std::make_shared<FrameForm<3>>();
};

// A cell is sqrt(3) wide, so that a body may lie three cells from the outside with four bodies before it.
TEST(HiddenBodies, AreThoseThatOthersEncloseOnAllSides) {
  constexpr int edge = 30;
  const CubeOfCubes pile(edge);
  const std::vector<std::uint8_t> hidden = hidden_bodies<3>(pile.form->shapes, pile.states, std::nullopt);
  int number = 0;
  for (int body = 0; body < edge * edge * edge; ++body) {
    const Vec3& at = pile.states.pose[body].position;
    const double from_outside = std::min(at.minCoeff(), edge - 1 - at.maxCoeff());
    if (from_outside < 3.0) EXPECT_EQ(hidden[body], 0) << "body " << body << " may be seen";
    if (from_outside > 6.0) EXPECT_EQ(hidden[body], 1) << "body " << body << " is deep inside";
    number += hidden[body];
  }
  EXPECT_GT(number, 17 * 17 * 17);
}

TEST(HiddenBodies, AreNoneAroundAHollowAndNoneThatAreAwake) {
  constexpr int edge = 30;
  CubeOfCubes pile(edge);
  const Vec3 middle = Vec3::Constant(0.5 * (edge - 1));
  for (BodyIndex body = 0; body < pile.states.size(); ++body)
    if ((pile.states.pose[body].position - middle).cwiseAbs().maxCoeff() < 2.5) pile.states.removed[body] = 1;
  for (BodyIndex body = 0; body < pile.states.size(); body += 1000) pile.states.asleep[body] = 0;
  const std::vector<std::uint8_t> hidden = hidden_bodies<3>(pile.form->shapes, pile.states, std::nullopt);
  for (BodyIndex body = 0; body < pile.states.size(); ++body) {
    const double from_hollow = (pile.states.pose[body].position - middle).cwiseAbs().maxCoeff() - 2.5;
    if (from_hollow < 3.0 || pile.states.asleep[body] == 0) EXPECT_EQ(hidden[body], 0) << "body " << body;
  }
  EXPECT_GT(std::count(hidden.begin(), hidden.end(), 1), 0);
}

TEST(HiddenBodies, AreThoseOnTheGroundTooWhereItIsOneBeneathThem) {
  constexpr int edge = 30;
  const CubeOfCubes pile(edge);
  const int beneath = edge * 15 + 15;  // in the lowest layer
  EXPECT_EQ(hidden_bodies<3>(pile.form->shapes, pile.states, std::nullopt)[beneath], 0);
  const std::vector<std::uint8_t> hidden = hidden_bodies<3>(pile.form->shapes, pile.states, -0.5);
  EXPECT_EQ(hidden[beneath], 1);
  EXPECT_EQ(hidden[0], 0) << "in a corner";
}

TEST(HiddenBodies, AreNoneInSmallPilesAndInThePlane) {
  const CubeOfCubes small(20);
  EXPECT_EQ(std::ranges::count(hidden_bodies<3>(small.form->shapes, small.states, std::nullopt), 1), 0);
  BodyStates<2> plane;
  for (int i = 0; i < 40'000; ++i) add_body<2>(plane, {.position = Vec2(i % 200, i / 200)});
  std::ranges::fill(plane.asleep, 1);
  const std::vector shapes = {make_shape<2>("square", box_pieces<2>(Vec2::Ones()), {})};
  EXPECT_EQ(std::ranges::count(hidden_bodies<2>(shapes, plane, std::nullopt), 1), 0);
}

TEST(FrameStream, SendsThePoseOfAHiddenBodyOnceItCanBeSeen) {
  constexpr int edge = 30;
  CubeOfCubes pile(edge);
  const int inside = edge * edge * 15 + edge * 15 + 15;
  FrameEncoder<3> encoder(pile.form);
  Decoder<3> decoder;
  decoder.take(encoder.encode({.step = 1, .states = pile.states}));
  EXPECT_EQ(decoder.state.hidden[inside], 1);
  EXPECT_EQ(decoder.state.asleep[inside], 1) << "it is counted";
  EXPECT_EQ(decoder.state.pose[inside][0], 0.0) << "not sent";
  EXPECT_EQ(decoder.state.hidden[0], 0);
  pile.states.asleep[inside] = 0;
  decoder.take(encoder.encode({.step = 2, .states = pile.states}));
  EXPECT_EQ(decoder.state.hidden[inside], 0) << "at once, since it is awake";
  EXPECT_EQ(decoder.state.pose[inside][0], 15000.0) << "in thousandths";
}

}  // namespace
}  // namespace talus::frame_stream_test
