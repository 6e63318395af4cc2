#include "lcmtypes/moment_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "lcmtypes/contacts_message.h"
#include "lcmtypes/event_log.h"
#include "lcmtypes/log_reader.h"
#include "lcmtypes/obstacles_message.h"
#include "lcmtypes/run_recorder.h"
#include "lcmtypes/shapes_message.h"
#include "lcmtypes/wire.h"
#include "tests/lcmtypes/scratch_file.h"
#include "tests/lcmtypes/still_run.h"

namespace talus::moment_reader_test {
namespace {

constexpr int body_count = 12;

/// The messages of a record of so many steps, two a frame of output.
template <int Dim>
std::vector<LogEvent> recorded(int steps, const Scene<Dim>& scene = still_scene<Dim>(), Observer<Dim>* also = nullptr) {
  const ScratchFile file;
  {
    RunRecorder<Dim> recorder(file.path(), run_info(scene, "still", "none"), scene);
    const auto run = still_run<Dim>(scene, body_count);
    run->add_observer(recorder);
    if (also != nullptr) run->add_observer(*also);
    for (int step = 0; step < steps; ++step) run->step();
    run->end("finished");
  }
  LogReader log(file.path());
  std::vector<LogEvent> events;
  for (LogEvent event; log.next(event);) events.push_back(event);
  return events;
}

bool take(const LogEvent& event, MomentReader& reader) {
  return reader.take(*channel_named(event.channel), event.data);
}

constexpr MomentLimits limits = {.bodies = body_count, .shapes = 2, .obstacles = 1, .events = 0, .from_start = true};

/// The bodies lie as still_run() puts them, with y = 0 in 2D.
template <int Dim>
void expect_moments_of_a_record() {
  MomentReader reader(Dim, limits);
  std::vector<std::int64_t> steps;
  std::int64_t events = 0;
  for (const LogEvent& event : recorded<Dim>(8)) {
    if (!take(event, reader)) continue;
    const Moment& moment = reader.moment();
    // The end tells the last step again, with all its events.
    if (steps.empty() || steps.back() != moment.step) events += std::ssize(moment.events);
    steps.push_back(moment.step);
    EXPECT_DOUBLE_EQ(moment.time, static_cast<double>(moment.step) / 60.0);
    ASSERT_EQ(moment.bodies.size(), body_count);
    const Pose<3> pose = moment.bodies.pose.in_space(10);
    EXPECT_EQ(pose.position.x(), 0.25 * 1 - 1.0);
    EXPECT_EQ(pose.position.y(), 0.0);
    EXPECT_EQ(pose.position.z(), 0.01F);
    EXPECT_EQ(moment.bodies.asleep[10] != 0, moment.step >= 4 && moment.step < 8);
    EXPECT_TRUE(moment.bodies.shows(10));
    EXPECT_EQ(moment.piles.size(), 1U);
    EXPECT_EQ(moment.drift, 0.0);
  }
  EXPECT_EQ(steps, (std::vector<std::int64_t>{2, 4, 6, 8, 8})) << "each frame of output and the end";
  EXPECT_EQ(events, 2 * body_count) << "all fall asleep in step 4 and wake in step 8";
  EXPECT_EQ(static_cast<SleepCause>(reader.moment().bodies.cause[10]), SleepCause::avalanche);
  EXPECT_EQ(reader.slept(), body_count);
  EXPECT_EQ(reader.woken(), body_count);
  EXPECT_EQ(reader.run()->reason, "finished");
  EXPECT_TRUE(reader.has_all_shapes());
  EXPECT_EQ(reader.undecodable(), 0);
  for (const Channel channel : all_channels) EXPECT_EQ(reader.lost(channel), 0) << name_of(channel);
}

TEST(MomentReader, GivesTheMomentsOfARecordInEitherDimension) {
  expect_moments_of_a_record<2>();
  expect_moments_of_a_record<3>();
}

/// Keeps the moments of the frames of output, and of the end.
template <int Dim>
class MomentKeeper final : public Observer<Dim> {
 public:
  void on_frame(const Frame<Dim>& frame) override {
    events_.insert(events_.end(), frame.events.begin(), frame.events.end());
    if (frame.step % 2 != 0) return;
    moments.push_back(moment_of(frame));
    moments.back().events = std::exchange(events_, {});  // those since the frame of output before
  }
  std::vector<Moment> moments;

 private:
  std::vector<SleepEvent> events_;
};

template <int Dim>
void expect_equal(const Moment& told, const Moment& made) {
  EXPECT_EQ(told.step, made.step);
  EXPECT_EQ(told.time, made.time);
  EXPECT_EQ(told.bodies.shape, made.bodies.shape);
  EXPECT_EQ(told.bodies.asleep, made.bodies.asleep);
  EXPECT_EQ(told.bodies.removed, made.bodies.removed);
  for (BodyIndex body = 0; body < made.bodies.size(); ++body)
    EXPECT_TRUE(std::ranges::equal(told.bodies.pose[body], made.bodies.pose[body])) << body;
  EXPECT_EQ(told.events.size(), made.events.size());
  ASSERT_EQ(told.piles.size(), made.piles.size());
  for (std::size_t i = 0; i < made.piles.size(); ++i) {
    EXPECT_EQ(told.piles[i].centre, made.piles[i].centre);
    EXPECT_EQ(told.piles[i].height, made.piles[i].height);
    EXPECT_EQ(told.piles[i].layers.size(), made.piles[i].layers.size());
  }
  EXPECT_EQ(told.kinetic_energy, made.kinetic_energy);
  EXPECT_EQ(told.drift, made.drift);
  EXPECT_EQ(told.moved_obstacle, made.moved_obstacle);
  for (std::size_t i = 0; i < made.moved_obstacle.size(); ++i)
    EXPECT_TRUE(std::ranges::equal(told.obstacle_pose[i], made.obstacle_pose[i])) << i;
}

/// The record of a run with an obstacle that moves, read back, beside the moments that its loop gave.
template <int Dim>
void expect_moments_of_the_loop() {
  Scene<Dim> scene = still_scene<Dim>();
  scene.world.obstacles[0].moves = true;
  const std::vector<Vec<Dim>> shifts = {Vec<Dim>::Zero(), Vec<Dim>::Unit(0)};
  scene.movers = {{.first = 0, .count = 1, .motion = {.times = {0.0, 0.5}, .shifts = shifts}}};
  MomentKeeper<Dim> keeper;
  MomentReader reader(Dim, limits);
  std::size_t read = 0;
  for (const LogEvent& event : recorded<Dim>(8, scene, &keeper)) {
    if (!take(event, reader) || read == keeper.moments.size()) continue;  // the end tells the last one again
    expect_equal<Dim>(reader.moment(), keeper.moments[read++]);
  }
  EXPECT_EQ(read, 4U);
}

TEST(MomentReader, GivesTheMomentsOfTheLoopToTheLastBit) {
  expect_moments_of_the_loop<2>();
  expect_moments_of_the_loop<3>();
}

/// The contacts of a step, told before its poses.
void tell_contacts(std::int64_t step, std::vector<ContactForce<3>> contacts, MomentReader& reader) {
  for (auto& message : to_contacts<3>(contacts)) {
    message.step = step;
    message.seq = step;
    reader.take(message);
  }
}

TEST(MomentReader, HasTheContactsOfTheMomentsStepAndOfBodiesThatAreThere) {
  const std::vector<LogEvent> events = recorded<3>(4);
  MomentReader reader(3, limits);
  for (const LogEvent& event : events) {
    if (event.channel == name_of(Channel::bodies) && reader.moment().step == 0)
      tell_contacts(2, {{.a = 0, .b = body_count}, {.a = 3, .b = 2}, {.a = 4, .b = ground_index}}, reader);
    if (!take(event, reader)) continue;
    const std::vector<ContactForce<3>> contacts = contacts_of<3>(reader.moment());
    if (reader.moment().step > 2) {
      EXPECT_TRUE(contacts.empty()) << "those of an older step";
      continue;
    }
    ASSERT_EQ(contacts.size(), 2U);
    EXPECT_EQ(contacts[0].a, 3);
    EXPECT_EQ(contacts[1].b, ground_index);
  }
}

TEST(MomentReader, GivesStatesOfTheRunsOwnDimension) {
  MomentReader reader(2, limits);
  for (const LogEvent& event : recorded<2>(4)) take(event, reader);
  const BodyStates<2> states = states_of<2>(reader.moment());
  ASSERT_EQ(states.size(), body_count);
  EXPECT_EQ(states.pose[10].position, Vec2(-0.75, 0.01F));
  EXPECT_EQ(states.shape[11], 1);
  EXPECT_EQ(states.asleep[11], 1);
  const std::vector<Pile<3>>& piles = reader.moment().piles;
  ASSERT_EQ(piles.size(), 1U);
  EXPECT_EQ(piles[0].centre, Vec3(0.0, 0.0, 0.0));
  EXPECT_FALSE(piles[0].layers.empty());
}

TEST(MomentReader, CountsEachMessageThatIsMissingAndDoubtsPosesUntilTheyAreToldAgain) {
  MomentReader reader(3, limits);
  bool left_out = false;
  for (const LogEvent& event : recorded<3>(10)) {
    const bool is_frame = event.channel == name_of(Channel::bodies);
    if (is_frame && reader.moment().step == 4 && !left_out) {  // that of step 6, in which no body is awake
      left_out = true;
      continue;
    }
    if (!take(event, reader) || reader.moment().step != 8) continue;
    EXPECT_TRUE(reader.moment().bodies.shows(0)) << "awake again, so the frame has its pose";
    EXPECT_EQ(reader.lost(Channel::bodies), 1);
  }
  EXPECT_TRUE(left_out);
}

TEST(MomentReader, KeepsAPoseInDoubtThatALostFrameMayHaveChanged) {
  MomentReader reader(3, limits);
  int frames = 0;
  for (const LogEvent& event : recorded<3>(8)) {
    // Without step 4, in which all fall asleep, step 6 does not say where they are.
    if (event.channel == name_of(Channel::bodies) && ++frames == 2) continue;
    if (take(event, reader) && reader.moment().step == 6) EXPECT_FALSE(reader.moment().bodies.shows(0));
  }
  EXPECT_EQ(reader.moment().step, 8);
  EXPECT_TRUE(reader.moment().bodies.shows(0));
}

// All fall asleep in step 4, wake in step 8 and fall asleep again in step 12: the second of these messages is lost.
TEST(MomentReader, KnowsNoCauseOverAGapInTheSleepEvents) {
  MomentReader reader(2, limits);
  int sleep_messages = 0;
  for (const LogEvent& event : recorded<2>(14)) {
    if (event.channel == name_of(Channel::sleep) && ++sleep_messages == 2) continue;
    if (!take(event, reader)) continue;
    const Moment& moment = reader.moment();
    if (moment.step == 6) EXPECT_NE(moment.bodies.cause[10], -1);
    if (moment.step >= 8 && moment.step < 12) EXPECT_EQ(moment.bodies.cause[10], -1) << moment.step;
  }
}

TEST(MomentReader, PutsObstaclesWhereTheyHaveMoved) {
  Scene<3> scene = still_scene<3>();
  scene.world.obstacles[0].moves = true;
  scene.movers = {{.first = 0, .count = 1, .motion = {.times = {0.0, 0.5}, .shifts = {Vec3::Zero(), Vec3::UnitZ()}}}};
  MomentReader reader(3, limits);
  for (const LogEvent& event : recorded<3>(60, scene)) take(event, reader);
  const Moment& moment = reader.moment();
  EXPECT_EQ(moment.moved_obstacle, std::vector({0}));
  EXPECT_NEAR(moment.obstacle_pose.pose<3>(0).position.z(), 8.0, 1e-6) << "7 m and the metre of the plan";
}

TEST(MomentReader, KeepsPosesOfManyObstaclesByTheirNumber) {
  MomentReader reader(3, {.bodies = 1, .shapes = 1, .obstacles = 3, .from_start = false});
  MessageEncoder encoder(1);
  WorldDescription<3> world;
  for (int k = 0; k < 3; ++k)
    world.obstacles.push_back({make_shape<3>("wall", box_pieces<3>(Vec3::Constant(1.0)), {}), {}, true});
  const auto pass = [&]<class Message>(std::vector<Message> messages) {
    for (Message& message : messages) {
      const Packet packet = encoder.encode(message, {});
      reader.take(packet.channel, packet.bytes);
    }
  };
  pass(to_shapes<3>(world));
  const auto at = [](double x) { return Pose<3>{.position = Vec3(x, 0.0, 0.0)}; };
  pass(to_obstacles<3>(std::vector<ObstaclePose<3>>{{2, at(2.5)}}));
  pass(to_obstacles<3>(std::vector<ObstaclePose<3>>{{0, at(0.5)}, {1, at(1.5)}}));
  const Moment& moment = reader.moment();
  EXPECT_EQ(moment.moved_obstacle, std::vector({0, 1, 2}));
  for (int k = 0; k < 3; ++k) EXPECT_EQ(moment.obstacle_pose.pose<3>(k).position.x(), k + 0.5);
}

TEST(MomentReader, RefusesWhatTheSceneDoesNotHave) {
  const std::vector<LogEvent> events = recorded<2>(4);
  const auto read = [&](int dimension, MomentLimits allowed) {
    MomentReader reader(dimension, allowed);
    for (const LogEvent& event : events) take(event, reader);
  };
  EXPECT_NO_THROW(read(2, limits));
  EXPECT_THROW(read(3, limits), std::invalid_argument);
  MomentLimits fewer = limits;
  fewer.bodies = body_count - 1;
  EXPECT_THROW(read(2, fewer), std::invalid_argument);
}

TEST(MomentReader, RefusesARunOfAnotherFormatByItsNumberAndVersion) {
  std::vector<LogEvent> events = recorded<2>(4);
  std::vector<std::uint8_t>& bytes = events.front().data;
  bytes[header_bytes + 3] = 9;
  renumber(bytes, 0);
  MomentReader reader(2, limits);
  try {
    take(events.front(), reader);
    FAIL() << "taken";
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("format 9 of talus "), std::string::npos) << text;
    EXPECT_NE(text.find("must be format " + std::to_string(talus_lcm::talus_run::FORMAT)), std::string::npos) << text;
  }
}

TEST(MomentReader, LeavesBodiesOutUntilAllShapesAreKnownWhereNoSceneIs) {
  MomentReader reader(3, {});
  const std::vector<LogEvent> events = recorded<3>(8);
  for (const LogEvent& event : events)
    if (event.channel == name_of(Channel::bodies)) EXPECT_FALSE(take(event, reader));
  EXPECT_EQ(reader.moment().bodies.size(), 0);
  for (const LogEvent& event : events)
    if (event.channel == name_of(Channel::shapes)) take(event, reader);
  EXPECT_TRUE(reader.has_all_shapes());
}

TEST(MomentReader, CountsAMessageThatComesTwiceOnce) {
  MomentReader reader(2, limits);
  for (const LogEvent& event : recorded<2>(8)) {
    take(event, reader);
    if (event.channel == name_of(Channel::sleep)) take(event, reader);
  }
  EXPECT_EQ(reader.slept(), body_count);
  EXPECT_EQ(reader.lost(Channel::sleep), 0);
}

TEST(PoseList, KeepsWholeTurnsOfAPlaneScene) {
  PoseList poses(2);
  poses.resize(2);
  const std::vector<float> turned = {1.0F, 2.0F, 40.0F};
  poses.set(1, turned);
  EXPECT_EQ(poses.pose<2>(1).rotation.angle(), 40.0);
  // Counter-clockwise with x to the right and z up: x turns towards z.
  poses.set(0, std::vector<float>{0.0F, 0.0F, 0.5F});
  const Vec3 x = poses.in_space(0) * Vec3::UnitX();
  EXPECT_NEAR(x.z(), std::sin(0.5), 1e-7);
  EXPECT_EQ(x.y(), 0.0);
}

}  // namespace
}  // namespace talus::moment_reader_test
