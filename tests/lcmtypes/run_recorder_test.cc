#include "lcmtypes/run_recorder.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>
#include <map>

#include "lcmtypes/log_reader.h"
#include "lcmtypes/wire.h"
#include "tests/lcmtypes/scratch_file.h"
#include "tests/lcmtypes/still_run.h"

namespace talus::run_recorder_test {
namespace {

using talus_lcm::talus_bodies;
using talus_lcm::talus_run;
using talus_lcm::talus_sleep;
using talus_lcm::talus_stats;

/// Records `steps` steps of 12 bodies.
template <int Dim>
void record(const std::string& path, int steps, const RecorderParams& params = {},
            const Scene<Dim>& scene = still_scene<Dim>()) {
  RunRecorder<Dim> recorder(path, run_info(scene, "still", "none"), scene, params);
  const auto run = still_run<Dim>(scene, 12);
  run->add_observer(recorder);
  for (int step = 0; step < steps; ++step) run->step();
  run->end("finished");
}

struct Record {
  std::vector<LogEvent> events;
  LogDamage damage;
  std::map<std::string, int> count;

  template <class Message>
  std::vector<Message> all() const {
    std::vector<Message> messages;
    for (const LogEvent& event : events) {
      if (event.channel != name_of(channel_of<Message>)) continue;
      EXPECT_EQ(decode(event.data, messages.emplace_back()), "");
    }
    return messages;
  }
};

Record read(const std::string& path) {
  LogReader reader(path);
  Record record;
  for (LogEvent event; reader.next(event);) {
    ++record.count[event.channel];
    record.events.push_back(event);
  }
  record.damage = reader.damage();
  return record;
}

TEST(RunRecorder, WritesProgramSceneAndReasonOfTheEnd) {
  const ScratchFile file;
  record<2>(file.path(), 120);
  const auto runs = read(file.path()).all<talus_run>();
  ASSERT_EQ(runs.size(), 4U);  // begin, two seconds at 60 steps each, end
  EXPECT_EQ(runs.front().phase, talus_run::BEGIN);
  EXPECT_EQ(runs.front().scene, "still");
  EXPECT_EQ(runs[1].phase, talus_run::ALIVE);
  EXPECT_EQ(runs.back().phase, talus_run::END);
  EXPECT_EQ(runs.back().reason, "finished");
  EXPECT_EQ(runs.back().step, 120);
}

TEST(RunRecorder, WritesEachFrameOfOutputAndEachStepsEvents) {
  const ScratchFile file;
  record<3>(file.path(), 120);
  Record record = read(file.path());
  EXPECT_EQ(record.damage.bytes, 0U);
  EXPECT_EQ(record.count["TALUS_SHAPES"], 3);
  EXPECT_EQ(record.count["TALUS_PILES"], 60 + 1);  // two steps a frame; once more at the end
  EXPECT_EQ(record.count["TALUS_STATS"], 60 + 1);
  EXPECT_EQ(record.count["TALUS_BODIES"], 60 + 1);
  EXPECT_EQ(record.count["TALUS_SLEEP"], 30);  // every fourth step
  for (const auto& sleep : record.all<talus_sleep>()) {
    EXPECT_EQ(sleep.event_count, 12);
    EXPECT_EQ(sleep.step % 4, 0);
    EXPECT_DOUBLE_EQ(sleep.sim_time, static_cast<double>(sleep.step) / 60.0);
    EXPECT_EQ(sleep.woke[0], sleep.step % 8 == 0 ? 1 : 0);
  }
}

TEST(RunRecorder, TellsWhereObstaclesAreInEachFrameInWhichTheyMove) {
  const ScratchFile file;
  Scene<3> scene = still_scene<3>();
  scene.world.obstacles[0].moves = true;
  scene.movers = {{.first = 0, .count = 1, .motion = {.times = {0.0, 0.5}, .shifts = {Vec3::Zero(), Vec3::UnitZ()}}}};
  record<3>(file.path(), 120, {}, scene);
  const auto messages = read(file.path()).all<talus_lcm::talus_obstacles>();
  std::int64_t step = 0;
  for (const auto& message : messages) {
    ASSERT_EQ(message.obstacle, std::vector<std::int32_t>{0});
    if (message.step <= 30) EXPECT_EQ(message.step, step += 2) << "two steps a frame";
    EXPECT_NEAR(message.poses[2], 7.0 + std::min(1.0, 2.0 * message.sim_time), 1e-6);
  }
  EXPECT_EQ(step, 30);
  EXPECT_LT(messages.size(), 20U) << "later only with key frames";
}

TEST(RunRecorder, TellsInItsFirstFrameWhereAnObstacleIsThatMovesLater) {
  const ScratchFile file;
  Scene<3> scene = still_scene<3>();
  scene.world.obstacles[0].moves = true;
  scene.movers = {{.first = 0, .count = 1, .motion = {.times = {1.0, 1.5}, .shifts = {Vec3::Zero(), Vec3::UnitZ()}}}};
  record<3>(file.path(), 70, {}, scene);
  const auto messages = read(file.path()).all<talus_lcm::talus_obstacles>();
  ASSERT_GE(messages.size(), 2U);
  EXPECT_EQ(messages[0].step, 2);
  EXPECT_EQ(messages[0].poses[2], 7.0F);
  EXPECT_GT(messages[1].step, 50) << "with a key frame, or when it moves";
}

TEST(RunRecorder, TellsTheLastPoseOfABodyThatFellAsleep) {
  const ScratchFile file;
  record<2>(file.path(), 8);
  const auto bodies = read(file.path()).all<talus_bodies>();
  ASSERT_EQ(bodies.size(), 5U);         // steps 2, 4, 6, 8 and the end
  EXPECT_EQ(bodies[1].body_count, 12);  // step 4: all asleep since this step
  EXPECT_EQ(bodies[1].asleep[0], 1);
  EXPECT_EQ(bodies[2].body_count, 0);   // step 6: all asleep, nothing new
  EXPECT_EQ(bodies[3].body_count, 12);  // step 8: all awake
  EXPECT_EQ(bodies[4].key_frame, 1);
}

// 12 bodies, all awake for the first four of every eight steps: each second brings 15 times as many poses as there are
// bodies, so a key frame is due at each; with no body awake a key frame has nothing to tell.
TEST(RunRecorder, WritesAKeyFrameOnlyAfterAsManyPosesOfMovingBodies) {
  const ScratchFile lively;
  record<2>(lively.path(), 180);
  std::vector<std::int64_t> steps;
  for (const auto& bodies : read(lively.path()).all<talus_bodies>())
    if (bodies.key_frame != 0) steps.push_back(bodies.step);
  EXPECT_EQ(steps, (std::vector<std::int64_t>{60, 120, 180, 180}));

  const ScratchFile calm;
  {
    const Scene<2> scene = still_scene<2>();
    RunRecorder<2> recorder(calm.path(), run_info(scene, "still", "none"), scene, {.key_frame_interval = 1.0 / 30.0});
    const auto run = still_run<2>(scene, 12);
    run->add_observer(recorder);
    for (int step = 0; step < 24; ++step) run->step();
    run->end("finished");
  }
  std::int64_t moving = 0;
  for (const auto& bodies : read(calm.path()).all<talus_bodies>()) {
    if (bodies.key_frame == 0) {
      moving += bodies.body_count;
      continue;
    }
    EXPECT_TRUE(moving >= 12 || bodies.step == 24) << "step " << bodies.step;
    moving = 0;
  }
}

TEST(RunRecorder, StampsWithSimulatedTimeSoThatPlayersKeepThePace) {
  const ScratchFile file;
  record<2>(file.path(), 120);
  const Record record = read(file.path());
  std::int64_t last = -1;
  for (const LogEvent& event : record.events) {
    EXPECT_GE(event.timestamp, last + 100);  // never a burst
    last = event.timestamp;
  }
  for (const auto& stats : record.all<talus_stats>())
    EXPECT_NEAR(static_cast<double>(stats.utime), 1e6 * stats.sim_time, 1500.0);  // a frame's few messages, 100 us each
}

TEST(RunRecorder, WritesTheSameBytesForTheSameRun) {
  const ScratchFile first;
  const ScratchFile second;
  record<3>(first.path(), 100);
  record<3>(second.path(), 100, {.flush_interval = 0.0});
  EXPECT_FALSE(first.read().empty());
  EXPECT_EQ(first.read(), second.read());
}

TEST(RunRecorder, RefusesBadParameters) {
  const ScratchFile file;
  EXPECT_THROW(record<2>(file.path(), 1, {.flush_interval = -1.0}), std::invalid_argument);
  EXPECT_THROW(record<2>(file.path(), 1, {.key_frame_interval = 0.0}), std::invalid_argument);
  EXPECT_THROW(record<2>("/no/such/folder/run.lcm", 1), std::system_error);
}

// kill -9 in the middle of writing: all up to the last flush is there, and the rest does no harm.
TEST(RunRecorder, LeavesAReadableRecordWhenKilled) {
  const ScratchFile file;
  const pid_t child = fork();
  if (child == 0) {
    const Scene<2> scene = still_scene<2>();
    RunRecorder<2> recorder(file.path(), run_info(scene, "still", "none"), scene, {.flush_interval = 0.0});
    const auto run = still_run<2>(scene, 12);
    run->add_observer(recorder);
    for (int step = 0; step < 200; ++step) run->step();
    raise(SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  const Record record = read(file.path());
  EXPECT_EQ(record.damage.bytes, 0U);  // flushed after each step
  const auto bodies = record.all<talus_bodies>();
  ASSERT_FALSE(bodies.empty());
  EXPECT_EQ(bodies.back().step, 200);
}

}  // namespace
}  // namespace talus::run_recorder_test
