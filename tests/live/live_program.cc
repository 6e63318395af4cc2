// What the tests of the live view start: a run of a small pile with record and telemetry, the monitor, and a look into
// a log.

#include <arpa/inet.h>
#include <fmt/core.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "common/shape/catalogue.h"
#include "common/simulation/make_policy.h"
#include "common/simulation/simulation.h"
#include "common/simulation/state_hash.h"
#include "lcmtypes/live_link.h"
#include "lcmtypes/log_reader.h"
#include "lcmtypes/publisher.h"
#include "lcmtypes/run_recorder.h"
#include "sim2d/make_world.h"
#include "tools/commands/commands.h"

namespace talus {
namespace {

struct Options {
  std::string url;
  std::string record;
  int frames = 90;
  bool paced = false;   // as fast as real time
  bool silent = false;  // without telemetry
};

Scene<2> small_pile(const Options& options) {
  Scene<2> scene;
  scene.world.shapes = {make_shape<2>("l", l_pieces<2>({}), {})};
  scene.sources.resize(1);
  scene.sources[0].count = 60;
  scene.sources[0].rate = 40.0;
  scene.sources[0].position = Vec2(0.0, 4.0);
  scene.sources[0].spread = Vec2(4.0, 2.0);
  scene.piles.emplace_back().at = Vec2::Zero();
  scene.run.frames = options.frames;
  return scene;
}

/// Prints the hash of the last state.
void run(const Options& options) {
  const Scene<2> scene = small_pile(options);
  const RunInfo info = run_info(scene, "small_pile", "box2d");
  RunRecorder<2> recorder(options.record, info, scene, {.flush_interval = 0.1});
  Simulation<2> simulation(scene, make_box2d_world(scene.world), make_policy<2>(scene));
  simulation.add_observer(recorder);
  std::unique_ptr<Publisher<2>> publisher;
  if (!options.silent) {
    publisher = std::make_unique<Publisher<2>>(info, PublisherParams{.url = options.url, .piles_rate = 0.0});
    publisher->set_world(scene.world);
    simulation.add_observer(*publisher);
  }
  const auto begin = std::chrono::steady_clock::now();
  for (std::int64_t step = 0; step < scene.steps(); ++step) {
    simulation.step();
    if (options.paced) std::this_thread::sleep_until(begin + std::chrono::duration<double>(simulation.time()));
  }
  simulation.end("finished");
  fmt::print("{:016x}\n", state_hash(simulation.world().states()));
}

/// Prints how many events a log has on each channel, and the bytes that are damaged.
void count(const std::string& path) {
  LogReader reader(path);
  std::map<std::string, int> events;
  for (LogEvent event; reader.next(event);) ++events[event.channel];
  for (const auto& [channel, number] : events) fmt::print("{} {}\n", channel, number);
  fmt::print("damaged {}\n", reader.damage().bytes);
}

using Bytes = std::vector<std::uint8_t>;

void append(Bytes& bytes, std::uint64_t number, int size) {
  for (int i = size - 1; i >= 0; --i) bytes.push_back(static_cast<std::uint8_t>(number >> (8 * i)));
}

/// A fragment of a message as LCM sends it (magic LC03): number, size of the message, where it belongs, which of how
/// many it is.
Bytes fragment(std::uint32_t offset, std::uint16_t index, const std::string& payload) {
  Bytes bytes;
  for (const std::uint32_t field : {0x4c433033U, 1U, 100'000U, offset}) append(bytes, field, 4);
  append(bytes, index, 2);
  append(bytes, 2, 2);
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  return bytes;
}

/// Sends pairs of fragments, the second of which belongs far outside of its message: LCM 1.3.1 writes there.
void forge(int port, int pairs) {
  const int descriptor = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in group{};
  group.sin_family = AF_INET;
  group.sin_port = htons(static_cast<std::uint16_t>(port));
  inet_pton(AF_INET, "239.255.76.67", &group.sin_addr);
  const int ttl = 0;
  setsockopt(descriptor, IPPROTO_IP, IP_MULTICAST_TTL, &ttl, sizeof ttl);
  const std::string first = std::string("TALUS_RUN") + '\0' + std::string(1000, 'x');
  constexpr std::array offsets = {99'999U, 0x7fffffffU, 0xfffffff0U, 200'000U};
  for (int i = 0; i < pairs; ++i) {
    const std::uint32_t outside = offsets[static_cast<std::size_t>(i) % offsets.size()];
    for (const Bytes& bytes : {fragment(0, 0, first), fragment(outside, 1, std::string(1400, 'y'))})
      sendto(descriptor, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&group), sizeof group);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  close(descriptor);
}

std::atomic<bool> interrupted = false;

int socket_in_group(int port, sockaddr_in& group) {
  const int descriptor = socket(AF_INET, SOCK_DGRAM, 0);
  group = {};
  group.sin_family = AF_INET;
  group.sin_port = htons(static_cast<std::uint16_t>(port));
  inet_pton(AF_INET, "239.255.76.67", &group.sin_addr);
  const int on = 1;
  const int buffer = 4 << 20;
  setsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  setsockopt(descriptor, SOL_SOCKET, SO_RCVBUF, &buffer, sizeof buffer);
  bind(descriptor, reinterpret_cast<const sockaddr*>(&group), sizeof group);
  const ip_mreq membership{group.sin_addr, {htonl(INADDR_ANY)}};
  setsockopt(descriptor, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership);
  const timeval wait{0, 20'000};
  setsockopt(descriptor, SOL_SOCKET, SO_RCVTIMEO, &wait, sizeof wait);
  return descriptor;
}

/// Hands the packets of one port to another until SIGTERM: of a hundred one is dropped, two come twice, two come after
/// the next one. TALUS_RUN is spared: the end of a run is said only once. Prints how many of each.
void relay(int from, int to) {
  std::signal(SIGTERM, [](int) { interrupted = true; });
  sockaddr_in here{};
  sockaddr_in there{};
  const int descriptor = socket_in_group(from, here);
  socket_in_group(to, there);
  const int ttl = 0;
  setsockopt(descriptor, IPPROTO_IP, IP_MULTICAST_TTL, &ttl, sizeof ttl);
  const auto pass = [&](const Bytes& bytes) {
    if (!bytes.empty())
      sendto(descriptor, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&there), sizeof there);
  };
  std::map<std::string, int> counts;
  std::mt19937 chance(1);  // NOLINT(cert-msc51-cpp): the same each time
  Bytes held;
  while (!interrupted) {
    Bytes bytes(65'536);
    const ssize_t size = recv(descriptor, bytes.data(), bytes.size(), 0);
    bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto fate = text.find("TALUS_RUN") == std::string_view::npos ? chance() % 100 : 99U;
    if (!bytes.empty() && fate == 0) {
      ++counts["dropped"];
      continue;
    }
    if (held.empty() && (fate == 3 || fate == 4)) {
      held = std::move(bytes);
      ++counts["late"];
      continue;
    }
    pass(bytes);
    if (fate == 1 || fate == 2) {
      pass(bytes);
      ++counts["doubled"];
    }
    pass(std::exchange(held, {}));
  }
  for (const auto& [what, number] : counts) fmt::print("{} {}\n", what, number);
}

/// Publishes statistics of so many runs that do not exist, one message each.
void invent(const std::string& url, int runs) {
  const LiveLink link = open_live_link(url);
  for (int id = 1; id <= runs; ++id) {
    talus_lcm::talus_stats message{};
    const Packet packet = MessageEncoder(id).encode(message, {});
    link.lcm->publish(name_of(packet.channel), packet.bytes.data(), static_cast<unsigned int>(packet.bytes.size()));
  }
}

}  // namespace
}  // namespace talus

int main(int argc, char** argv) {
  CLI::App app;
  int exit_code = talus::exit_codes::success;
  talus::add_monitor_command(app, exit_code);
  talus::Options options;
  CLI::App* run = app.add_subcommand("run");
  run->add_option("--lcm-url", options.url);
  run->add_option("--record", options.record)->required();
  run->add_option("--frames", options.frames);
  run->add_flag("--paced", options.paced);
  run->add_flag("--silent", options.silent);
  run->callback([&] { talus::run(options); });
  std::string log;
  CLI::App* count = app.add_subcommand("count");
  count->add_option("log", log)->required();
  count->callback([&] { talus::count(log); });
  int port = 0;
  int number = 1;
  CLI::App* forge = app.add_subcommand("forge");
  forge->add_option("port", port)->required();
  forge->add_option("pairs", number);
  forge->callback([&] { talus::forge(port, number); });
  int to = 0;
  CLI::App* relay = app.add_subcommand("relay");
  relay->add_option("from", port)->required();
  relay->add_option("to", to)->required();
  relay->callback([&] { talus::relay(port, to); });
  CLI::App* invent = app.add_subcommand("invent");
  invent->add_option("--lcm-url", options.url);
  invent->add_option("runs", number);
  invent->callback([&] { talus::invent(options.url, number); });
  try {
    CLI11_PARSE(app, argc, argv);
  } catch (const std::invalid_argument& refused) {
    fmt::print(stderr, "{}\n", refused.what());
    return talus::exit_codes::bad_input;
  }
  return exit_code;
}
