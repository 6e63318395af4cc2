#pragma once
// What the full-screen monitor shows, as characters.

#include <cstdint>

#include "tools/monitor/heard.h"
#include "tools/monitor/sheet.h"

namespace talus {

enum class Page : std::uint8_t { overview, layers, events, instruments, runs, alerts, help };

/// What the user chose to see.
struct Choice {
  Page page = Page::overview;
  std::int64_t run = 0;  // number; of no run: the first one
  int pile = 0;          // place among the piles of the run
  int filter = 0;        // of sleep events: 0 all, 1 woke, 2 fell asleep, from 3 on a cause
  int first_row = 0;     // of a page that is longer than the screen
  bool held = false;     // the screen is not redrawn
};

/// What a key did.
enum class Effect : std::uint8_t { redraw, quit };

/// Numbers of special keys; others are those of their characters.
namespace keys {
inline constexpr int up = 0x110000;
inline constexpr int down = 0x110001;
inline constexpr int escape = 27;
}  // namespace keys

/// Changes the choice as the key says.
Effect obey(int key, const Heard& heard, Choice& choice);

/// The page that is chosen. Before a run is heard: the address that is listened to.
void draw(const Heard& heard, const Choice& choice, Sheet& sheet);

}  // namespace talus
