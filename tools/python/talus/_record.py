"""Recorded runs as arrays."""

from __future__ import annotations

import errno
import os
import warnings
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from . import _talus
from ._events import events_of


@dataclass(frozen=True, eq=False, repr=False)
class Record:
    """A recorded run: F frames of output, N bodies, S shapes. What talus.open() returns.

    A body that is not in the world at a frame, since it appears later or was removed, or whose pose there is lost, has
    NaN in `poses`.
    """

    path: Path  #: as given to talus.open()
    dimension: int  #: 2 or 3
    title: str  #: of the scene
    backend: str  #: engine; empty: the record does not say
    policy: str  #: sleep policy, likewise
    seed: int
    dt: float  #: of a step [s]
    version: str  #: of talus that made the run
    reason: str  #: why the run ended: "finished", "interrupted" or an error; empty: the record lacks its end
    damage: str  #: what could not be read; empty: nothing
    steps: np.ndarray  #: (F,) int64, steps done
    times: np.ndarray  #: (F,) simulated time [s]
    poses: np.ndarray  #: (F, N, 3) in 2D: x, z [m], angle [rad]; (F, N, 7) in 3D: x, y, z [m], quaternion x, y, z, w; float32
    asleep: np.ndarray  #: (F, N) bool; False where the body is not there
    shapes: np.ndarray  #: (N,) int32, number of each body's shape
    shape_names: tuple[str, ...]  #: (S)
    meshes: tuple[tuple[np.ndarray, np.ndarray], ...]  #: (S) of vertices (V, 3) [m] around the centre of mass and triangles (T, 3); plane shapes lie in y = 0
    events: np.ndarray  #: structured: step, body, woke, cause, pile, layer, score; each time a body fell asleep or woke
    contacts: np.ndarray  #: structured: step, a, b, point, normal_force, friction_force, kept; contact points of all frames of a run with `run.contacts`, else none. Numbers of `a` and `b` as of Simulation.contacts(), `point` [m], forces on a [N], `kept`: neither side is awake

    @property
    def positions(self) -> np.ndarray:
        """(F, N, dimension) [m], of the centres of mass: a view of `poses`."""
        return self.poses[..., : self.dimension]

    @property
    def rotations(self) -> np.ndarray:
        """(F, N, 1) in 2D: angle [rad]; (F, N, 4) in 3D: quaternion x, y, z, w. A view of `poses`."""
        return self.poses[..., self.dimension :]

    @property
    def present(self) -> np.ndarray:
        """(F, N) bool: the body is in the world, at a known pose."""
        return ~np.isnan(self.poses[..., 0])

    def __repr__(self) -> str:
        frames, bodies = self.asleep.shape
        return f"<talus.Record {self.path}: {frames} frames, {bodies} bodies, {self.reason or 'no end'}>"


def open(path: str | os.PathLike) -> Record:
    """Reads a recorded run: a run folder, as of `talus run`, or a file run.lcm alone.

    FileNotFoundError: no such path. ValueError, with file and reason: no record, one of another format or of several
    runs, or one without a frame. A damaged record is read as far as it can be, with a RuntimeWarning.
    """
    if not os.path.exists(path):
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(path))
    if not hasattr(_talus, "read_record"):
        raise NotImplementedError("talus was built without LCM, and so without records")
    fields = _talus.read_record(os.fsencode(path))
    record = Record(path=Path(path), **{**fields, "events": events_of(fields["events"])})
    if record.damage:
        warnings.warn(f"{path}: damaged: {record.damage}", RuntimeWarning, stacklevel=2)
    return record
