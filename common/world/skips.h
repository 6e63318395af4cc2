#pragma once
// What a step leaves out.

namespace talus {

/// Work that a step leaves out since it would change nothing. Each can be put back, to measure what it saves
/// (`talus bench skips`); a run then gives the same bits, only later, but for `continuous`.
struct Skips {
  bool idle = true;      // the engine's step while nobody is awake. Off: a microsecond or two a step
  bool sleepers = true;  // sleepers in the lists that the engine walks. Off: some nanoseconds a sleeper and step
  bool counts = true;    // counting sleepers anew. Off: some ten nanoseconds a sleeper, pile and step
  bool contacts =
      true;  // gathering contacts that nobody asks for. Off: 5 to 15 % of a full run; `adaptive` asks anyway
  bool continuous = true;  // continuous collision of slow bodies. Off: other bits, and a tenth more time in Box2D
};

}  // namespace talus
