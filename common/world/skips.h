#pragma once
// What a step leaves out.

#include <array>
#include <string_view>

namespace talus {

/// Work that a step leaves out since it would change nothing, and work of Bullet's that a step does in a shorter way.
/// Each can be put back, to measure what it saves (`talus bench skips`); a run then gives the same bits, only later,
/// but for `continuous`.
struct Skips {
  bool idle = true;  // the engine's step while nobody is awake. Off: 0.1 ns a sleeper and step in Box2D, 1 us in Bullet
  bool sleepers = true;    // sleepers in the lists that the engine walks. Off: some nanoseconds a sleeper and step
  bool counts = true;      // counting sleepers anew. Off: some ten nanoseconds a sleeper, pile and step
  bool contacts = true;    // gathering contacts that nobody asks for. Off: 5 to 15 % of a full run, not of `adaptive`
  bool flight = true;      // collision of bodies in flight with the ground, in Bullet. Off: 0.25 us a body and step
  bool continuous = true;  // continuous collision of slow bodies. Off: other bits, and a tenth more time in Box2D
  bool islands = true;     // Bullet only: contacts sorted by keys at hand, empty ones left out (sim3d/bullet/islands.h)
  bool rows = true;        // Bullet only: packed constraint rows (sim3d/bullet/rows.h)
  bool levels = true;      // Bullet only, needs `rows`: independent rows side by side (sim3d/bullet/row_order.h)
  bool row_setup = true;   // Bullet only, needs `rows`: rows made from points (sim3d/bullet/row_setup.h)
  bool places = true;      // Bullet only: places and boxes of pieces kept (sim3d/bullet/placed_pieces.h)
  bool idle_pairs = true;  // Bullet only, needs `places`: pairs apart are not visited (sim3d/bullet/idle_pairs.h)
};

/// A switch by the name that it has in scene files.
struct Skip {
  std::string_view name;
  bool Skips::*field;
  bool exact;  // whether switching it off gives the same bits
};

inline constexpr std::array<Skip, 12> all_skips = {{
    {"idle", &Skips::idle, true},
    {"sleepers", &Skips::sleepers, true},
    {"counts", &Skips::counts, true},
    {"contacts", &Skips::contacts, true},
    {"flight", &Skips::flight, true},
    {"continuous", &Skips::continuous, false},
    {"islands", &Skips::islands, true},
    {"rows", &Skips::rows, true},
    {"levels", &Skips::levels, true},
    {"row_setup", &Skips::row_setup, true},
    {"places", &Skips::places, true},
    {"idle_pairs", &Skips::idle_pairs, true},
}};

}  // namespace talus
