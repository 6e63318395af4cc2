"""Runs step by step."""

from __future__ import annotations

import operator
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ._events import events_of
from ._scene import Scene, Values, open_scene


class Pile(NamedTuple):
    """The model of a heap, as the policy counts it: a cone or wedge of layers, within walls a prism under it."""

    centre: np.ndarray  #: (dimension,), middle of the base [m]
    alpha: float  #: slope [rad]
    height: float  #: [m]
    radius: float  #: of the base [m]
    structure_size: float  #: number of bodies for which there is room
    layers: np.ndarray  #: bottom-up, structured: bottom, top, radius [m]; capacity [bodies]; count, sleeping


def _numbers(bodies, count):
    """Numbers of bodies, of `count`, for the extension module: of one, of several, or of those that a mask has."""
    bodies = np.asarray(bodies)
    if bodies.dtype == bool:
        if bodies.ndim == 0:
            raise TypeError(f"bodies = {bodies}: must be numbers of bodies or a mask of all")
        if bodies.shape != (count,):
            raise ValueError(f"bodies.shape = {bodies.shape}: must be ({count},), as of a mask of all bodies")
        return np.flatnonzero(bodies).tolist()
    return [_number(body) for body in np.atleast_1d(bodies).tolist()]


def _number(body):
    if isinstance(body, (bool, np.bool_)):
        raise TypeError(f"body = {body}: must be the number of a body")
    body = operator.index(body)
    if not -(2**31) <= body < 2**31:
        raise ValueError(f"body = {body}: must be the number of a body in the world")
    return body


class Simulation:
    """A run of a scene, step by step.

    scene, set: as of talus.run().
    contacts: whether contacts() is needed, which takes 5 to 15 % of a step.
    Errors of the scene raise SceneError with all of them. Arrays are copies, entry i belongs to body i. `bodies` are the
    number of a body, several of them, or a mask: (n,) bool. While a thread is within step(), every call by another one
    raises RuntimeError.
    """

    def __init__(
        self,
        scene: Scene,
        policy: str | None = None,
        seed: int | None = None,
        backend: str | None = None,
        set: Values | None = None,
        contacts: bool = False,
    ) -> None:
        self._run = open_scene(scene, policy, seed, backend, set, contacts=contacts)

    def __reduce_ex__(self, protocol):
        raise TypeError("a simulation cannot be copied")

    def step(self, count: int = 1) -> None:
        """Does up to `count` steps, fewer where the run ends. Other threads run meanwhile, and Ctrl-C stops it.

        NonFiniteState: the state of a body became NaN or infinite; the run stays at the step before.
        """
        self._run.step(count)

    @property
    def dimension(self) -> int:
        """2 or 3."""
        return self._run.dimension

    @property
    def finished(self) -> bool:
        """Whether the run is at its end."""
        return self._run.finished

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self._run.time

    @property
    def step_count(self) -> int:
        """Steps done."""
        return self._run.step_count

    def hash(self) -> str:
        """Hash of all poses and velocities, as `talus run --hash` prints it."""
        return f"{self._run.hash():016x}"

    def poses(self, out: np.ndarray | None = None) -> np.ndarray:
        """(n, 3) in 2D: x, z [m], angle [rad]; (n, 7) in 3D: x, y, z [m], quaternion x, y, z, w.

        out: a C-ordered float64 array of that shape, which is filled and returned; ValueError on another shape,
        TypeError on another kind of array.
        """
        if out is None:
            return self._run.poses()
        self._run.write_poses(out)
        return out

    def velocities(self) -> np.ndarray:
        """(n, dimension), of the centres of mass [m/s]."""
        return self._run.velocities()

    def spins(self) -> np.ndarray:
        """(n, 1) in 2D, (n, 3) in 3D [rad/s]."""
        return self._run.spins()

    def asleep(self) -> np.ndarray:
        """(n,) bool."""
        return np.array(self._run.asleep(), dtype=bool)

    def present(self) -> np.ndarray:
        """(n,) bool: False for a removed body, whose other entries stay as they last were."""
        return ~np.array(self._run.removed(), dtype=bool)

    def shapes(self) -> np.ndarray:
        """(n,) int: number of each body's shape in the scene."""
        return np.array(self._run.shapes(), dtype=int)

    def remove(self, body: int) -> None:
        """Removes a body. Sleeping bodies near it wake. ValueError on a number of no body in the world."""
        self._run.remove(_number(body))

    def wake(self, bodies: ArrayLike | None = None) -> None:
        """Wakes these bodies, all without `bodies`. ValueError on a number of no body in the world."""
        if bodies is None:
            self._run.wake_all()
        else:
            self._run.wake(_numbers(bodies, len(self._run.shapes())))

    def kick(self, bodies: ArrayLike, velocity: ArrayLike, spin: ArrayLike | None = None) -> None:
        """Wakes these bodies and adds to their velocity, (dimension,) [m/s], and spin, (1,) or (3,) [rad/s].

        No body becomes faster than its engine allows. ValueError on a number of no body in the world.
        """
        numbers = _numbers(bodies, len(self._run.shapes()))
        spin = [] if spin is None else np.atleast_1d(spin)
        self._run.kick(numbers, np.atleast_1d(velocity), spin)

    def events(self) -> np.ndarray:
        """The bodies that fell asleep or woke in the last step: structured array, as Record.events."""
        return events_of(self._run.events())

    def contacts(self) -> np.ndarray:
        """Contact points of awake bodies in the last step, each once: structured array with these fields.

        `a`: an awake body; `b`: a body, -1 for the ground, -2 - k for obstacle k; `point` [m]; `normal`: unit vector from
        b to a; `normal_impulse` and `friction_impulse`, on a [N s] over the step; `approach_speed` [m/s] before the
        step; `depth` [m], positive where they overlap. ValueError without Simulation(..., contacts=True).
        """
        return self._run.contacts()

    def piles(self) -> list[Pile]:
        """A list of Pile: those that the policy counts, none under `full` and `engine`."""
        return [Pile(*pile) for pile in self._run.piles()]
