// Why bodies fall asleep and wake.

import type { Rgb } from "./head";

interface Cause {
  /// Why it fell asleep, and why it woke.
  slept?: string;
  woke?: string;
  /// None: that of a sleeping body.
  colour?: Rgb;
}

/// By name.
export const causes: Record<string, Cause> = {
  score: { slept: "its score of density, depth and speed is above the threshold", colour: [0.2, 0.42, 0.72] },
  rest: { slept: "it was at rest for long enough, and supported" },
  avalanche: { woke: "its pile has an overfull layer, or its pile or a part of it is too steep", colour: [0.85, 0.2, 0.15] },
  momentum: { woke: "an impact on it or on its pile", colour: [0.95, 0.5, 0.1] },
  "lost support": { woke: "its support moved away", colour: [0.75, 0.3, 0.75] },
  engine: { slept: "the engine's own rule", woke: "the engine's own rule", colour: [0.2, 0.58, 0.5] },
  user: { slept: "an event of the scene, or by hand", woke: "an event of the scene, gravity or an obstacle that moves, or by hand", colour: [0.95, 0.8, 0.2] },
  check: { woke: "its region is checked for stability", colour: [0.45, 0.7, 0.95] },
  motion: { woke: "forces move it", colour: [0.85, 0.45, 0.6] },
};
