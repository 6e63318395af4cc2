#include "lcmtypes/scanner.h"

// The layouts of the .lcm files, field by field: a count is followed by as many entries as it says.

namespace talus {
namespace {

using talus_lcm::talus_bodies_v1;
using talus_lcm::talus_pile_v1;
using talus_lcm::talus_piles_v1;
using talus_lcm::talus_run_v1;
using talus_lcm::talus_shapes_v1;
using talus_lcm::talus_sleep_v1;
using talus_lcm::talus_stats_v1;
using talus_lcm::talus_stats_v2;

void scan(Scanner& scanner, const talus_run_v1*) {
  scanner.skip(1);                        // phase
  for (int text = 0; text < 6; ++text) {  // reason, scene, backend, policy, version, units
    scanner.text();
  }
  scanner.skip(8 + 4 + 8 + 8 + 8 + 1 + 8);  // seed, dimension, dt, steps, gravity, ground, ground_height
  const std::size_t channels = scanner.count();
  for (std::size_t i = 0; i < channels && !scanner.failed(); ++i) {
    scanner.text();
  }
  scanner.array(channels, 8);  // sent
}

void scan(Scanner& scanner, const talus_pile_v1*) {
  scanner.skip((3 + 6) * 8);  // centre, alpha, structure_size, lift, height, radius, occupation_ratio
  scanner.skip(2 * 4);        // merged_into, layer_total
  const std::size_t layers = scanner.count();
  scanner.array(layers, 5 * 4 + 2 * 4);
}

void scan(Scanner& scanner, const talus_piles_v1*) {
  scanner.skip(4 * 4);  // part, parts, first_pile, pile_total
  const std::size_t piles = scanner.count();
  for (std::size_t i = 0; i < piles && !scanner.failed(); ++i) {
    scan(scanner, static_cast<const talus_pile_v1*>(nullptr));
  }
}

void scan(Scanner& scanner, const talus_sleep_v1*) {
  scanner.skip(2 * 4);  // part, parts
  const std::size_t events = scanner.count();
  scanner.array(events, 3 * 4 + 2 * 1 + 4);  // body, pile, layer, woke, cause, score
}

void scan(Scanner& scanner, const talus_stats_v1*) {
  scanner.skip(3 * 4 + 8 + 1);   // awake, asleep, contacts, kinetic_energy, timed
  scanner.skip(10 * 4 + 2 * 8);  // nine times, real_time_factor, queued_bytes, dropped
}

void scan(Scanner& scanner, const talus_stats_v2*) {
  scanner.skip(3 * 4 + 8 + 2 * 4);  // awake, asleep, contacts, kinetic_energy, asked, appeared
  const std::size_t warnings = scanner.count();
  scanner.array(warnings, 1 + 8 + 4 + 8 + 8);  // kind, step, body, bodies, value
  scanner.skip(1 + 10 * 4 + 2 * 8);            // timed, nine times, real_time_factor, queued_bytes, dropped
}

void scan(Scanner& scanner, const talus_bodies_v1*) {
  scanner.skip(1 + 3 * 4);  // key_frame, part, parts, dimension
  const std::size_t bodies = scanner.count();
  scanner.array(bodies, 4 + 2 + 1);  // body, shape, asleep
  const std::size_t values = scanner.count();
  scanner.array(values, 4);  // poses
}

void scan(Scanner& scanner, const talus_shapes_v1*) {
  scanner.skip(1 + 2 * 4);        // obstacle, index, total
  scanner.text();                 // name
  scanner.skip(4 + (7 + 3) * 8);  // dimension, pose, density, friction, restitution
  const std::size_t pieces = scanner.count();
  scanner.array(pieces, 1 + 4);  // kind, length
  const std::size_t values = scanner.count();
  scanner.array(values, 8);
}

}  // namespace

template <class Message>
bool counts_fit(std::span<const std::uint8_t> bytes) {
  Scanner scanner(bytes);
  scanner.skip(header_bytes);
  scan(scanner, static_cast<const Message*>(nullptr));
  scanner.skip(checksum_bytes);
  return scanner.at_end();
}

template bool counts_fit<talus_run_v1>(std::span<const std::uint8_t>);
template bool counts_fit<talus_piles_v1>(std::span<const std::uint8_t>);
template bool counts_fit<talus_sleep_v1>(std::span<const std::uint8_t>);
template bool counts_fit<talus_stats_v1>(std::span<const std::uint8_t>);
template bool counts_fit<talus_stats_v2>(std::span<const std::uint8_t>);
template bool counts_fit<talus_bodies_v1>(std::span<const std::uint8_t>);
template bool counts_fit<talus_shapes_v1>(std::span<const std::uint8_t>);

}  // namespace talus
