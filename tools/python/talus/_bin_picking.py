"""Parts that are taken out of a bin one by one."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._simulation import Simulation


class BinPicking:
    """Settled parts of a scene, and what the pile does when one is taken out.

    The calls are those of an environment of gymnasium, which is not needed. An action is the number of the part to take
    out. The reward is 1 for a part that was there, else 0. The observation is a dict of arrays with a row for each part
    that the scene ever had, zeros for those to come: `poses` (as Simulation.poses), `present` and `asleep` (bool).
    An episode is terminated when no part is left, and truncated when the pile does not settle within `settle_time` [s].
    """

    def __init__(self, scene: str, parts: int, settle_time: float = 30.0, set: dict[str, Any] | None = None) -> None:
        """`scene`: as of Simulation, with `parts` parts. Its own end does not count."""
        self._scene = scene
        self._parts = parts
        self._settle_time = settle_time
        self._set = {**(set or {}), "run.until": "frames", "run.frames": 10**7}
        self._simulation: Simulation | None = None

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
        """Pours the parts anew and lets them settle. seed: None: that of the scene, each time. options: none are read."""
        self._simulation = Simulation(self._scene, seed=seed, set=self._set)
        settled = self._settle()
        return self._observation(), {"settled": settled, "time": self._simulation.time}

    def step(self, action: int) -> tuple[dict[str, np.ndarray], float, bool, bool, dict[str, Any]]:
        """Takes a part out and lets the others settle. `info` has how far each part moved [m]. ValueError before
        reset()."""
        if self._simulation is None:
            raise ValueError("step() before reset()")
        before = self._observation()
        there = 0 <= action < self._parts and bool(before["present"][action])
        settled = True
        if there:
            self._simulation.remove(int(action))
            settled = self._settle()
        after = self._observation()
        axes = self._simulation.dimension
        moved = np.linalg.norm(after["poses"][:, :axes] - before["poses"][:, :axes], axis=1)
        info = {"settled": settled, "time": self._simulation.time, "moved": moved}
        return after, float(there), not after["present"].any(), not settled, info

    def _settle(self) -> bool:
        """Steps until all parts have come and those that are left sleep."""
        end = self._simulation.time + self._settle_time
        while self._simulation.time < end:
            self._simulation.step(10)
            present = self._simulation.present()
            if len(present) >= self._parts and self._simulation.asleep()[present].all():
                return True
        return False

    def _observation(self) -> dict[str, np.ndarray]:
        poses = self._simulation.poses()
        count = min(len(poses), self._parts)
        observation = {
            "poses": np.zeros((self._parts, poses.shape[1])),
            "present": np.zeros(self._parts, dtype=bool),
            "asleep": np.zeros(self._parts, dtype=bool),
        }
        observation["poses"][:count] = poses[:count]
        observation["present"][:count] = self._simulation.present()[:count]
        observation["asleep"][:count] = self._simulation.asleep()[:count]
        return observation
