// A run of another process, put together from its messages for the pages.

#include "tools/serve/live_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <condition_variable>
#include <lcm/lcm-cpp.hpp>
#include <mutex>
#include <nlohmann/json.hpp>
#include <sstream>

#include "lcmtypes/log_reader.h"
#include "lcmtypes/moment_reader.h"
#include "lcmtypes/publisher.h"
#include "tests/lcmtypes/still_run.h"

namespace talus::live_run_test {
namespace {

using Json = nlohmann::json;

/// What a page is sent.
class Socket final : public PageSocket {
 public:
  bool send_text(std::string_view text) override {
    const std::lock_guard lock(mutex_);
    texts_.push_back(Json::parse(text));
    changed_.notify_all();
    return true;
  }
  bool send_bytes(std::string_view bytes) override {
    const std::lock_guard lock(mutex_);
    log_ += bytes;
    changed_.notify_all();
    return true;
  }

  /// The last text of a kind for which `holds`, within five seconds; else null.
  template <class Holds>
  Json text(const std::string& kind, const Holds& holds) {
    std::unique_lock lock(mutex_);
    Json found;
    changed_.wait_for(lock, std::chrono::seconds(5), [&] {
      const auto is_wanted = [&](const Json& text) { return text["kind"] == kind && holds(text); };
      const auto last = std::find_if(texts_.rbegin(), texts_.rend(), is_wanted);
      if (last != texts_.rend()) found = *last;
      return last != texts_.rend();
    });
    return found;
  }
  /// The first moments that come, as log events; empty: none within five seconds.
  std::string log() {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::seconds(5), [&] { return !log_.empty(); });
    return log_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Json> texts_;
  std::string log_;
};

/// The messages of a run of so many steps.
template <int Dim>
std::vector<Datagram> messages_of_a_run(int steps) {
  struct Ear {
    std::vector<Datagram> heard;
    void hear(const lcm::ReceiveBuffer* buffer, const std::string& name) {
      const auto channel = std::find(channel_names.begin(), channel_names.end(), name) - channel_names.begin();
      const auto* bytes = static_cast<const std::uint8_t*>(buffer->data);
      heard.push_back({static_cast<Channel>(channel), {bytes, bytes + buffer->data_size}});
    }
  } ear;
  lcm::LCM lcm("memq://");
  lcm.subscribe("TALUS_.*", &Ear::hear, &ear);
  Scene<Dim> scene = still_scene<Dim>();
  scene.obstacle_names = {{"gate", 0, 1}};
  scene.events.resize(2);
  scene.events[0].action = EventAction::wake;
  scene.events[0].time = 10 * scene.world.dt;
  scene.events[1].action = EventAction::remove;
  scene.events[1].obstacle = 0;
  scene.events[1].time = 1e3;
  Publisher<Dim> publisher(run_info(scene, "still", "none"), {.piles_rate = 0.0, .bodies_rate = 1000.0}, lcm);
  publisher.set_world(scene.world);
  publisher.set_scene(scene);
  const auto run = still_run<Dim>(scene, 12);
  run->add_observer(publisher);
  for (int step = 0; step < steps; ++step) run->step();
  run->end("finished");
  while (lcm.handleTimeout(50) > 0) {
  }
  return ear.heard;
}

/// What a page puts together.
template <int Dim>
MomentReader moments_of(const std::string& log) {
  MomentReader moments(Dim, {});
  LogReader reader(std::make_unique<std::istringstream>(log));
  for (LogEvent event; reader.next(event);) moments.take(*channel_named(event.channel), event.data);
  EXPECT_EQ(reader.damage().bytes, 0U);
  EXPECT_EQ(moments.undecodable(), 0);
  return moments;
}

template <int Dim>
void expect_shown() {
  Socket socket;  // must stay until the hub's threads have ended
  PageHub hub;
  LiveRun live(hub, "waiting for a run on nowhere");
  hub.add(socket);
  const auto any = [](const Json&) { return true; };
  EXPECT_EQ(socket.text("status", any)["reason"], "waiting for a run on nowhere");
  const std::vector<Datagram> messages = messages_of_a_run<Dim>(40);
  for (const Datagram& message : messages) live.hear(message);
  EXPECT_EQ(live.undecodable(), 0);
  ASSERT_FALSE(socket.text("begin", any).is_null());
  const MomentReader heard = moments_of<Dim>(socket.log());
  EXPECT_EQ(heard.run().value().title, "bodies that stand still");
  EXPECT_EQ(heard.run().value().dimension, Dim);
  EXPECT_TRUE(heard.has_all_shapes());
  EXPECT_EQ(heard.shapes().size(), 2U);
  EXPECT_EQ(heard.obstacles().at(0).pose[0], 7.0);
  ASSERT_EQ(heard.events().size(), 2U);
  EXPECT_EQ(heard.events().at(0).text, "wake all bodies");
  EXPECT_EQ(heard.events().at(1).text, "remove obstacle gate");
  EXPECT_EQ(heard.events().at(1).obstacle, std::vector<std::int32_t>{0});
  EXPECT_EQ(heard.moment().bodies.size(), 12);
  const Json end = socket.text("status", [](const Json& status) { return status["finished"].get<bool>(); });
  EXPECT_EQ(end["live"], true);
  EXPECT_EQ(end["running"], false);
}

TEST(LiveRun, ShowsPagesTheShapesStatesAndEndOfARun) {
  expect_shown<2>();
  expect_shown<3>();
}

TEST(LiveRun, StartsLateWithTheShapesThatAreSentAgain) {
  Socket socket;  // must stay until the hub's threads have ended
  PageHub hub;
  LiveRun live(hub, "waiting");
  hub.add(socket);
  const std::vector<Datagram> messages = messages_of_a_run<3>(40);
  // A receiver that comes late has the identity of the run and what is sent at its end.
  live.hear(messages.front());
  for (std::size_t i = messages.size() / 2; i < messages.size(); ++i) live.hear(messages[i]);
  EXPECT_EQ(moments_of<3>(socket.log()).moment().bodies.size(), 12);
}

TEST(LiveRun, LeavesOutWhatIsDamaged) {
  PageHub hub;
  LiveRun live(hub, "waiting");
  std::vector<Datagram> messages = messages_of_a_run<2>(40);
  for (Datagram& message : messages) {
    message.bytes[message.bytes.size() / 2] ^= 1;
    live.hear(message);
  }
  EXPECT_EQ(live.undecodable(), static_cast<std::int64_t>(messages.size()));
}

}  // namespace
}  // namespace talus::live_run_test
