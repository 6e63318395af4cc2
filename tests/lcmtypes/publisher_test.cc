#include "lcmtypes/publisher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <set>

#include "common/simulation/state_hash.h"
#include "lcmtypes/wire.h"
#include "tests/lcmtypes/still_run.h"

namespace talus::publisher_test {
namespace {

using talus_lcm::talus_bodies;
using talus_lcm::talus_piles;
using talus_lcm::talus_run;
using talus_lcm::talus_shapes;
using talus_lcm::talus_sleep;
using talus_lcm::talus_stats;

/// Keeps all messages of one LCM object's own memory queue.
class Ear {
 public:
  explicit Ear(lcm::LCM& lcm) : lcm_(lcm) { lcm.subscribe("TALUS_.*", &Ear::hear, this); }

  /// Everything that has been sent.
  void listen() {
    while (lcm_.handleTimeout(50) > 0) {
    }
  }
  template <class Message>
  std::vector<Message> all() const {
    std::vector<Message> messages;
    const auto found = packets_.find(name_of(channel_of<Message>));
    if (found == packets_.end()) return messages;
    for (const auto& bytes : found->second) EXPECT_EQ(decode(bytes, messages.emplace_back()), "");
    return messages;
  }

 private:
  void hear(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
    const auto* data = static_cast<const std::uint8_t*>(buffer->data);
    packets_[channel].emplace_back(data, data + buffer->data_size);
  }
  lcm::LCM& lcm_;
  std::map<std::string, std::vector<std::vector<std::uint8_t>>> packets_;
};

/// Publishes `steps` steps of 12 bodies on a memory queue.
template <int Dim>
class PublishedRun {
 public:
  explicit PublishedRun(int steps, const PublisherParams& params = {.piles_rate = 0.0}) : ear(lcm_) {
    const Scene<Dim> scene = still_scene<Dim>();
    Publisher<Dim> publisher(run_info(scene, "still", "none"), params, lcm_);
    publisher.set_world(scene.world);
    const auto run = still_run<Dim>(scene, 12);
    run->add_observer(publisher);
    for (int step = 0; step < steps; ++step) run->step();
    run->end("finished");
    dropped = publisher.dropped();
    hash = state_hash(run->world().states());
    ear.listen();
  }

 private:
  lcm::LCM lcm_{"memq://"};

 public:
  Ear ear;
  std::int64_t dropped = 0;
  std::uint64_t hash = 0;
};

TEST(Publisher, SendsSceneStepsAndReasonOfTheEnd) {
  const PublishedRun<2> run(10);
  const auto messages = run.ear.all<talus_run>();
  ASSERT_GE(messages.size(), 2U);
  EXPECT_EQ(messages.front().phase, talus_run::BEGIN);
  EXPECT_EQ(messages.front().scene, "still");
  EXPECT_EQ(messages.front().steps, 120);
  EXPECT_EQ(messages.front().channels.size(), 6U);
  EXPECT_EQ(messages.back().phase, talus_run::END);
  EXPECT_EQ(messages.back().reason, "finished");
  EXPECT_EQ(messages.back().sent[1], static_cast<std::int64_t>(run.ear.all<talus_piles>().size()));
}

TEST(Publisher, SendsPilesOfEveryStepWhenAsked) {
  const PublishedRun<3> run(40);
  const auto piles = run.ear.all<talus_piles>();
  ASSERT_EQ(piles.size(), 41U);  // and once more at the end
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(piles[i].step, static_cast<std::int64_t>(i) + 1);
    EXPECT_EQ(piles[i].seq, static_cast<std::int64_t>(i));
    EXPECT_EQ(piles[i].run_id, piles[0].run_id);
  }
}

TEST(Publisher, KeepsToTheRateOfWallTime) {
  const PublishedRun<2> run(2000, {.piles_rate = 10.0});  // far more than 10 steps in a tenth of a second
  EXPECT_LT(run.ear.all<talus_piles>().size(), 200U);
  EXPECT_GE(run.ear.all<talus_piles>().size(), 2U);
}

TEST(Publisher, SendsEverySleepEvent) {
  const PublishedRun<2> run(40);
  const auto sleep = run.ear.all<talus_sleep>();
  ASSERT_EQ(sleep.size(), 10U);
  for (const auto& message : sleep) {
    EXPECT_EQ(message.event_count, 12);
    EXPECT_EQ(message.cause[0], message.woke[0] != 0 ? talus_sleep::AVALANCHE : talus_sleep::SCORE);
    EXPECT_EQ(message.score[0], 0.625F);
  }
}

TEST(Publisher, SendsStatisticsWithWallTimes) {
  const PublishedRun<2> run(100);
  const auto stats = run.ear.all<talus_stats>();
  ASSERT_GE(stats.size(), 2U);
  EXPECT_EQ(stats.back().awake + stats.back().asleep, 12);
  EXPECT_EQ(stats.back().timed, 1);
  EXPECT_GT(stats.back().real_time_factor, 0.0F);
  EXPECT_GT(stats.back().ms_observe, 0.0F);
}

TEST(Publisher, SendsPosesAtTheirRateAndAllOfThemWithinTwoSecondsAndAtTheEnd) {
  PublishedRun<3> run(2000, {.piles_rate = 10.0, .bodies_rate = 1000.0});
  const auto bodies = run.ear.all<talus_bodies>();
  ASSERT_GE(bodies.size(), 2U);
  std::set<std::int32_t> named;
  for (const auto& message : bodies) {
    EXPECT_EQ(message.dimension, 3);
    if (message.key_frame == 0) named.insert(message.body.begin(), message.body.end());
  }
  EXPECT_EQ(named.size(), 12U) << "bodies at rest come in turn";
  EXPECT_EQ(bodies.back().key_frame, 1);
  EXPECT_EQ(bodies.back().step, 2000);
  EXPECT_EQ(bodies.back().body_count, 12);
  EXPECT_GE(run.ear.all<talus_shapes>().size(), 2U) << "at the first step, and at the end";
}

TEST(Publisher, NamesAllBodiesOnceOneHasLeft) {
  lcm::LCM lcm("memq://");
  Ear ear(lcm);
  const Scene<2> scene = still_scene<2>();
  Publisher<2> publisher(run_info(scene, "still", "none"), {.bodies_rate = 1000.0}, lcm);
  publisher.set_world(scene.world);
  const auto run = still_run<2>(scene, 12);
  run->add_observer(publisher);
  run->step();
  run->remove(3);
  const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(200);
  while (std::chrono::steady_clock::now() < until) run->step();
  const std::int64_t last = run->frame().step;
  run->end("finished");
  ear.listen();
  const auto bodies = ear.all<talus_bodies>();
  const auto key_frame = std::ranges::find(bodies, 1, &talus_bodies::key_frame);
  ASSERT_NE(key_frame, bodies.end());
  EXPECT_LT(key_frame->step, last) << "before the end, which has one too";
  EXPECT_EQ(key_frame->body_count, 11);
  EXPECT_EQ(std::ranges::count(key_frame->body, 3), 0);
}

TEST(Publisher, SendsWhereObstaclesAreAsLongAsTheyMove) {
  lcm::LCM lcm("memq://");
  Ear ear(lcm);
  Scene<2> scene = still_scene<2>();
  scene.world.obstacles[0].moves = true;
  const double end = 10.5 * scene.world.dt;
  scene.movers = {{.first = 0, .count = 1, .motion = {.times = {0.0, end}, .shifts = {{0.0, 0.0}, {end, 0.0}}}}};
  Publisher<2> publisher(run_info(scene, "still", "none"), {.piles_rate = 0.0, .bodies_rate = 1e6}, lcm);
  publisher.set_world(scene.world);
  publisher.set_scene(scene);
  const auto run = still_run<2>(scene, 3);
  run->add_observer(publisher);
  for (int step = 0; step < 30; ++step) run->step();
  run->end("finished");
  ear.listen();
  const auto messages = ear.all<talus_lcm::talus_obstacles>();
  ASSERT_FALSE(messages.empty());
  EXPECT_GE(messages.back().step, 11);
  for (const auto& message : messages) {
    ASSERT_EQ(message.obstacle, std::vector<std::int32_t>{0});
    EXPECT_NEAR(message.poses[0], 7.0 + std::min(end, message.sim_time), 1e-6);
  }
  EXPECT_LE(std::count_if(messages.begin(), messages.end(), [](const auto& message) { return message.step > 11; }), 1);
  const std::vector<std::string> channels = ear.all<talus_run>().back().channels;
  EXPECT_NE(std::find(channels.begin(), channels.end(), "TALUS_OBSTACLES"), channels.end());
}

TEST(Publisher, SendsNoPosesAtRateZero) {
  const PublishedRun<2> run(40, {.bodies_rate = 0.0});
  EXPECT_TRUE(run.ear.all<talus_bodies>().empty());
  EXPECT_TRUE(run.ear.all<talus_shapes>().empty());
}

TEST(Publisher, LeavesTheRunAsItIs) {
  const Scene<2> scene = still_scene<2>();
  const auto alone = still_run<2>(scene, 12);
  for (int step = 0; step < 50; ++step) alone->step();
  EXPECT_EQ(PublishedRun<2>(50).hash, state_hash(alone->world().states()));
}

// The thread sends at most one message in 0.1 ms, so a run with two messages a step and no limit on their rates fills
// the queue.
TEST(Publisher, DropsRatherThanWaitsAndSaysSo) {
  const PublishedRun<2> run(20'000, {.piles_rate = 0.0, .bodies_rate = 1e6, .queue_bytes = 1U << 20U});
  EXPECT_GT(run.dropped, 0);
  const auto piles = run.ear.all<talus_piles>();
  EXPECT_LT(piles.size(), 20'000U);
  const auto stats = run.ear.all<talus_stats>();
  EXPECT_TRUE(std::any_of(stats.begin(), stats.end(), [](const auto& s) { return s.dropped > 0; }));
}

TEST(Publisher, RefusesBadParameters) {
  EXPECT_THROW(PublishedRun<2>(1, {.piles_rate = -1.0}), std::invalid_argument);
  EXPECT_THROW(PublishedRun<2>(1, {.piles_rate = std::nan("")}), std::invalid_argument);
  EXPECT_THROW(PublishedRun<2>(1, {.bodies_rate = -1.0}), std::invalid_argument);
  EXPECT_THROW(PublishedRun<2>(1, {.queue_bytes = 10}), std::invalid_argument);
}

}  // namespace
}  // namespace talus::publisher_test
