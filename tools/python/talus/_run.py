"""Runs to their end."""

from __future__ import annotations

import os
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

import numpy as np

from ._scene import Scene, Values, open_scene


@dataclass(frozen=True, eq=False, repr=False)
class Result:
    """The end of a run of n bodies, in the order in which they appeared. What talus.run() returns."""

    dimension: int  #: 2 or 3
    seed: int
    time: float  #: simulated [s]
    step_count: int  #: steps done
    at_rest: bool  #: whether the run ended since the world came to rest, as a scene with run.until = "rest" may
    hash: str  #: of all poses and velocities, as `talus run --hash` prints it
    poses: np.ndarray  #: (n, 3) in 2D: x, z [m], angle [rad]; (n, 7) in 3D: x, y, z [m], quaternion x, y, z, w
    velocities: np.ndarray  #: (n, dimension), of the centres of mass [m/s]
    spins: np.ndarray  #: (n, 1) in 2D, (n, 3) in 3D [rad/s]
    asleep: np.ndarray  #: (n,) bool
    present: np.ndarray  #: (n,) bool; False for a removed body, whose other entries stay as they last were
    shapes: np.ndarray  #: (n,) int, number of each body's shape
    shape_names: tuple[str, ...]
    warnings: tuple[str, ...]  #: a line each, as `talus run` prints them
    folder: Path | None  #: run folder; None without out=

    def __repr__(self) -> str:
        rest = ", at rest" if self.at_rest else ""
        return f"<talus.Result after {self.time:.4g} s: {len(self.asleep)} bodies, {self.asleep.sum()} asleep{rest}>"


def simulate(
    scene: Scene,
    *,
    policy: str | None = None,
    seed: int | None = None,
    backend: str | None = None,
    set: Values | None = None,
    out: str | os.PathLike | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> Result:
    """talus.run() that keeps its warnings to itself."""
    run = open_scene(scene, policy, seed, backend, set, warnings=True, out=out)
    run.run(progress)
    return Result(
        dimension=run.dimension,
        seed=run.seed,
        time=run.time,
        step_count=run.step_count,
        at_rest=run.at_rest,
        hash=f"{run.hash():016x}",
        poses=run.poses(),
        velocities=run.velocities(),
        spins=run.spins(),
        asleep=np.array(run.asleep(), dtype=bool),
        present=~np.array(run.removed(), dtype=bool),
        shapes=np.array(run.shapes(), dtype=int),
        shape_names=tuple(run.shape_names),
        warnings=tuple(run.warnings),
        folder=Path(os.fsdecode(run.folder)) if out else None,
    )


def run(
    scene: Scene,
    *,
    policy: str | None = None,
    seed: int | None = None,
    backend: str | None = None,
    set: Values | None = None,
    out: str | os.PathLike | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> Result:
    """Simulates a scene to its end, as `talus run` does with the same bits; returns a Result.

    scene: path, name of a scene that `talus list` shows, or TOML text: a str with a line end, or with a `=` where
    no such file exists. set: values by path, as of `talus run --set`: {"run.frames": 600}. out: run folder to write, new
    or empty, which talus.open() reads. progress: a function that is called a few times a second with the steps done and
    those of the scene; the run may end before, at rest.

    Other threads run meanwhile. Ctrl-C, as any error of `progress`, stops the run; a folder then has it up to there.
    SceneError: errors of the scene, all of them. ValueError: other bad input. NonFiniteState: the state of a body
    became NaN or infinite. Warnings of scene and run are given as RuntimeWarning.
    """
    result = simulate(scene, policy=policy, seed=seed, backend=backend, set=set, out=out, progress=progress)
    for line in result.warnings:
        warnings.warn(line, RuntimeWarning, stacklevel=2)
    return result
