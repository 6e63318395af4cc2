// The messages of two moments as one, where the history of a run has too many.

#include "tools/serve/merge_messages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <sstream>
#include <utility>

#include "lcmtypes/event_log.h"
#include "lcmtypes/log_reader.h"
#include "lcmtypes/moment_reader.h"
#include "lcmtypes/moment_writer.h"
#include "tests/lcmtypes/still_run.h"

namespace talus::merge_messages_test {
namespace {

class Buffer final : public MessageSink {
 public:
  std::int64_t stamp(double /*time*/) override { return 0; }
  void put(Packet packet) override { append_event(log, 0, packet.utime, packet.channel, packet.bytes); }
  std::string log;
};

/// The events of each of so many moments of a run in which all bodies fall asleep and wake in turn, and body 1 is taken
/// away before the last but one.
template <int Dim>
std::vector<std::string> moments(int count, int bodies) {
  struct Events final : Observer<Dim> {
    explicit Events(MomentWriter<Dim>& to) : writer(to) {}
    void on_frame(const Frame<Dim>& frame) override { writer.events(frame); }
    MomentWriter<Dim>& writer;
  };
  Buffer buffer;
  const Scene<Dim> scene = still_scene<Dim>();
  MomentWriter<Dim> writer(run_info(scene, "still", "none"), 1, buffer);
  writer.set_world(scene.world);
  Events events(writer);
  const auto run = still_run<Dim>(scene, bodies);
  ContactForces<Dim> contacts;
  contacts.record(true, run->world());
  writer.set_contacts(contacts);
  run->add_observer(contacts);
  run->add_observer(events);
  writer.run(talus_lcm::talus_run::BEGIN, {}, 0, 0.0);
  writer.shapes();
  std::vector<std::string> logs;
  for (int moment = 0; moment < count; ++moment) {
    for (int step = 0; step < 3; ++step) run->step();
    const bool removes = moment == count - 2;
    if (removes) run->remove(1);
    writer.piles(run->frame());
    writer.stats(run->frame());
    writer.contacts(run->frame());
    if (moment == 0 || removes)
      writer.all_bodies(run->frame());
    else
      writer.bodies(run->frame());
    logs.push_back(std::exchange(buffer.log, {}));
  }
  return logs;
}

/// The last moment of a log, and the number of those before.
struct Outcome {
  Moment last;
  int moments = 0;
  std::int64_t events = 0;
  std::int64_t contacts = 0;  // messages
};

template <int Dim>
Outcome read(const std::string& log) {
  MomentReader moments(Dim, {});
  Outcome outcome{Moment(Dim)};
  LogReader reader(std::make_unique<std::istringstream>(log));
  for (LogEvent event; reader.next(event);)
    if (moments.take(*channel_named(event.channel), event.data)) ++outcome.moments;
  EXPECT_EQ(reader.damage().bytes, 0U);
  EXPECT_EQ(moments.undecodable(), 0);
  outcome.last = moments.moment();
  outcome.contacts = moments.received(Channel::contacts);
  outcome.events = moments.slept() + moments.woken();
  return outcome;
}

template <int Dim>
void expect_same_state(int bodies) {
  const std::vector<std::string> all = moments<Dim>(6, bodies);
  std::string apart;
  for (const std::string& each : all) apart += each;
  const Outcome expected = read<Dim>(apart);
  ASSERT_EQ(expected.moments, 6);
  ASSERT_EQ(expected.last.bodies.removed[1], 1);
  // From the front, as a history that thins itself merges, and all but the first into one.
  std::string merged = all[1];
  for (std::size_t i = 2; i < all.size(); ++i) merged = merge_messages(merged, all[i]);
  const Outcome outcome = read<Dim>(all[0] + merged);
  EXPECT_EQ(outcome.moments, 2);
  EXPECT_EQ(outcome.contacts, 2) << "the newest of what was merged";
  EXPECT_EQ(outcome.events, expected.events) << "what happened in any of them";
  EXPECT_EQ(outcome.last.step, expected.last.step);
  EXPECT_EQ(outcome.last.bodies.shape, expected.last.bodies.shape);
  EXPECT_EQ(outcome.last.bodies.removed, expected.last.bodies.removed);
  for (BodyIndex body = 0; body < expected.last.bodies.size(); ++body) {
    if (expected.last.bodies.removed[body] == 0)
      EXPECT_EQ(outcome.last.bodies.asleep[body], expected.last.bodies.asleep[body]) << body;
    EXPECT_TRUE(std::ranges::equal(outcome.last.bodies.pose[body], expected.last.bodies.pose[body])) << body;
  }
  EXPECT_LT(all[0].size() + merged.size(), apart.size());
}

TEST(MergeMessages, BringsAReaderToTheSameStateWithEveryEvent) {
  expect_same_state<2>(12);
  expect_same_state<3>(12);
}

TEST(MergeMessages, SplitsThePosesOfManyBodies) { expect_same_state<3>(4000); }

}  // namespace
}  // namespace talus::merge_messages_test
