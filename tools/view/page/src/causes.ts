// Why bodies fall asleep and wake.

interface Cause {
  name: string;
  /// Why it fell asleep, and why it woke.
  slept: string;
  woke: string;
}

/// By the number that TALUS_SLEEP has; null where no cause has it.
export const causes: (Cause | null)[] = [
  { name: "score", slept: "its score of density, depth and speed is above the threshold", woke: "" },
  { name: "rest", slept: "it was at rest for long enough, and supported", woke: "" },
  { name: "avalanche", slept: "", woke: "its pile has an overfull layer, or its pile or a part of it is too steep" },
  { name: "momentum", slept: "", woke: "an impact on it or on its pile" },
  { name: "lost support", slept: "", woke: "its support moved away" },
  null,
  null,
  { name: "engine", slept: "the engine's own rule", woke: "the engine's own rule" },
  { name: "user", slept: "an event of the scene, or by hand", woke: "an event of the scene, gravity or an obstacle that moves, or by hand" },
  { name: "check", slept: "", woke: "its region is checked for stability" },
  { name: "motion", slept: "", woke: "forces move it" },
];
