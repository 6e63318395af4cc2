#pragma once
// One real message of each kind, and more than one where a frame needs parts.

#include <vector>

#include "common/moment/moment.h"
#include "lcmtypes/bodies_message.h"
#include "lcmtypes/contacts_message.h"
#include "lcmtypes/obstacles_message.h"
#include "lcmtypes/piles_message.h"
#include "lcmtypes/run_message.h"
#include "lcmtypes/shapes_message.h"
#include "lcmtypes/sleep_message.h"
#include "lcmtypes/stats_message.h"
#include "lcmtypes/wire.h"
#include "tests/lcmtypes/still_run.h"

namespace talus {

/// All messages that a run of so many bodies gives at the step where all have fallen asleep.
template <int Dim>
std::vector<Packet> sample_packets(int bodies) {
  const Scene<Dim> scene = still_scene<Dim>();
  const auto run = still_run<Dim>(scene, bodies);
  struct Nothing final : Observer<Dim> {
    void on_frame(const Frame<Dim>&) override {}
  } nothing;
  run->add_observer(nothing);
  for (int step = 0; step < 4; ++step) run->step();
  const Frame<Dim> frame = run->frame();
  const BodyStates<Dim>& states = frame.world.states();
  std::vector<BodyIndex> all(states.shape.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<BodyIndex>(i);

  MessageEncoder encoder(42);
  std::vector<Packet> packets;
  const auto encode = [&](auto messages) {
    for (auto& message : messages) packets.push_back(encoder.encode(message, {1000, frame.step, frame.time}));
  };
  constexpr Channel channels[] = {Channel::run, Channel::piles};
  encode(std::vector{to_run(run_info(scene, "still", "none"), talus_lcm::talus_run::ALIVE, "", channels, encoder)});
  encode(to_piles(piles_in_space(frame)));
  encode(to_sleep(frame.events));
  encode(std::vector{to_stats<Dim>(frame)});
  encode(to_bodies<Dim>(states, all, true));
  encode(to_shapes<Dim>(scene.world));
  talus_lcm::talus_event event{};
  event.number = 3;
  event.total = 4;
  event.action = "remove";
  event.text = "remove all bodies";
  encode(std::vector{event});
  talus_lcm::talus_scene file{};
  file.file = "scene.toml";
  file.parts = 1;
  file.text = "title = \"still\"\n";
  encode(std::vector{file});
  const std::vector<ObstaclePose<Dim>> moved = {{0, scene.world.obstacles[0].pose}};
  encode(to_obstacles<Dim>(moved));
  const std::vector<ContactForce<Dim>> contacts(2 * states.shape.size(), {.b = first_obstacle, .kept = true});
  encode(to_contacts<Dim>(contacts));
  return packets;
}

}  // namespace talus
