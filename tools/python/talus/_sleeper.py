"""Sleep body by body in an engine of one's own."""

from __future__ import annotations

import os
import weakref
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _talus

_ROLES = ("sleeps", "stays_awake", "kinematic")
_UP = ("x", "y", "z", "-x", "-y", "-z")


class SleepChange(NamedTuple):
    """A body that falls asleep or wakes."""

    body: int  #: handle
    cause: str  #: why, as docs/record.md has it


class VelocityChange(NamedTuple):
    """A new velocity of a body that is awake."""

    body: int  #: handle
    velocity: np.ndarray  #: (dimension,), of the centre of mass [m/s]
    spin: np.ndarray  #: (1,) in 2D, (3,) in 3D [rad/s]
    cause: str


class Changes(NamedTuple):
    """What the program must do in its engine at once, in this order."""

    thaw: list[SleepChange]  #: make bodies movable again, at rest
    velocities: list[VelocityChange]  #: set velocities
    freeze: list[SleepChange]  #: stop bodies and make them immovable


def _changes(lists):
    thaw, velocities, freeze = lists
    return Changes(
        [SleepChange(*change) for change in thaw],
        [VelocityChange(*change) for change in velocities],
        [SleepChange(*change) for change in freeze],
    )


def _rows(values, width=None, dtype=float):
    """The values; where they are empty, of whatever shape and type: no rows of this width."""
    return values if np.size(values) else np.empty((0,) if width is None else (0, width), dtype)


def _choice(name, value, choices):
    if value not in choices:
        raise ValueError(f"{name} = {value}: must be one of {', '.join(choices)}")
    return choices.index(value)


class _PileSleeper:
    """Decides after each step of an engine which bodies need not be simulated, by policy `adaptive` on one pile.

        sleeper = talus.PileSleeper3D()
        handle = sleeper.add(pose, mass=1.0, radius=0.5)
        ...
        engine.step(dt)
        bodies = sleeper.followed()
        changes = sleeper.step(dt, bodies, poses, velocities, spins, contacts)

    A body has a handle, an int that names no other body later; `handle % 2**32` is its slot, a small number that is
    used again. A pose is that of the centre of mass: x, y, angle in 2D; x, y, z, quaternion x, y, z, w in 3D. All is in
    the program's axes [m, kg, s, rad].

    Methods that return Changes have already counted them as done: carry them out before anything else. Bad input raises
    ValueError and changes nothing.
    """

    dimension: int  #: 2 or 3
    contact_dtype: np.dtype  #: of the rows of `contacts`, see step()

    def __init__(
        self,
        gravity: ArrayLike | None = None,
        *,
        up: str | None = None,
        extent: float | None = None,
        tolerance: float = 0.0,
        enabled: bool = True,
    ) -> None:
        """gravity: [m/s^2]; None: 9.81 down the last axis. up: "x", "y", "z", "-x", "-y" or "-z"; None: against gravity.
        extent: diagonal of a typical body's box [m]; None: found from the bodies. tolerance: of stability checks, in
        extents; 0: none. enabled: False: nothing sleeps.
        """
        if gravity is None:
            gravity = [0.0] * (self.dimension - 1) + [-9.81]
        up = None if up is None else _choice("up", up, _UP)
        self._sleeper = self._native(gravity, enabled, up, extent, tolerance)
        self._reports = []

    def __reduce_ex__(self, protocol):
        raise TypeError("a sleeper cannot be copied")

    def __enter__(self):
        return self

    def __exit__(self, *error):
        self.end_observers()

    def add(
        self,
        pose: ArrayLike,
        *,
        mass: float,
        size: ArrayLike | None = None,
        radius: float | None = None,
        bounds: ArrayLike | None = None,
        inertia: ArrayLike | None = None,
        friction: float = 0.5,
        role: str = "sleeps",
    ) -> int:
        """Adds a body, awake; returns its handle. Its form is one of these:

        size: (dimension,), of a box of uniform density; radius: of a ball, in 2D a disc; bounds: (2, dimension), lower
        and upper corner of its box in its own axes, which has the centre of mass, 0, in it, with its inertia about that,
        [kg m^2]: a number in 2D, (3,) or (3, 3) in 3D. friction: of its surface against one like it. role: "sleeps";
        "stays_awake", as a body with a motor; "kinematic", which the program moves.
        """
        role = _choice("role", role, _ROLES)
        given = [form is not None for form in (size, radius, bounds)]
        if sum(given) != 1 or (bounds is None) != (inertia is None):
            raise ValueError("the form of a body: must be size, radius, or bounds and inertia")
        if radius is not None:
            return self._sleeper.add_ball(pose, mass, radius, friction, role)
        if size is not None:
            return self._sleeper.add_box(pose, mass, size, friction, role)
        inertia = np.asarray(inertia, float)
        inertia = np.atleast_2d(inertia) if self.dimension == 2 or inertia.ndim > 1 else np.diag(np.atleast_1d(inertia))
        return self._sleeper.add_other(pose, mass, inertia, bounds, friction, role)

    def remove(self, body: int) -> Changes:
        """Takes a body out: Changes. Sleeping bodies near it wake, since it may have supported them."""
        return _changes(self._sleeper.remove(body))

    def set_role(self, body: int, role: str) -> Changes:
        """Whether a body may sleep from now on, "sleeps" or "stays_awake": Changes. None becomes kinematic."""
        return _changes(self._sleeper.set_role(body, _choice("role", role, _ROLES)))

    def followed(self) -> np.ndarray:
        """(k,) int64: handles of the bodies whose states step() needs, those awake and the kinematic ones."""
        return self._sleeper.followed()

    def step(
        self,
        dt: float,
        bodies: ArrayLike,
        poses: ArrayLike,
        velocities: ArrayLike,
        spins: ArrayLike,
        contacts: np.ndarray | None = None,
    ) -> Changes:
        """One decision, after each step of the engine of dt [s]: Changes.

        bodies: (k,) handles, each of followed() once, in any order. poses: (k, 3) or (k, 7). velocities: (k, dimension),
        of the centres of mass. spins: (k, 1) or (k,) in 2D, (k, 3) in 3D. Without bodies: any that are empty.
        contacts: (c,) of contact_dtype, the contact points of these bodies, as in
        `contacts = numpy.zeros(c, sleeper.contact_dtype); contacts["a"] = ...`: handles `a` and `b`, b = 0 for what
        never moves; `point`; `normal`, a unit vector from b to a, with whose wrong sign nothing sleeps; `normal_impulse`
        [N s] over the step, >= 0; where known `friction_impulse` on a, `approach_speed` [m/s] before the step, >= 0, and
        `depth` [m], positive where they overlap.
        """
        if contacts is None or np.size(contacts) == 0:
            contacts = np.zeros(0, self.contact_dtype)
        elif getattr(contacts, "dtype", None) != self.contact_dtype:
            raise TypeError(f"contacts: must be an array of contact_dtype, {self.contact_dtype}")
        if self.dimension == 2 and np.ndim(spins) == 1:
            spins = np.reshape(spins, (-1, 1))
        bodies, poses, velocities = _rows(bodies, dtype=np.int64), self._poses(poses), _rows(velocities, self.dimension)
        spins = _rows(spins, 1 if self.dimension == 2 else 3)
        return _changes(self._sleeper.step(dt, bodies, poses, velocities, spins, contacts))

    def wake(self, body: int) -> Changes:
        """Before something acts on a body, a force or a new velocity: Changes. None for an awake one."""
        return _changes(self._sleeper.wake(body))

    def wake_all(self) -> Changes:
        """Wakes all bodies: Changes."""
        return _changes(self._sleeper.wake_all())

    def wake_near(self, low: ArrayLike, high: ArrayLike) -> Changes:
        """Wakes what sleeps near a box with these corners, where something came or went: Changes."""
        return _changes(self._sleeper.wake_near(low, high))

    def moved(self, body: int, pose: ArrayLike) -> Changes:
        """After the program has put a body elsewhere: Changes. It wakes, with those near its old and its new place."""
        return _changes(self._sleeper.moved(body, pose))

    def set_gravity(self, gravity: ArrayLike) -> Changes:
        """From the next step on [m/s^2]: Changes. All bodies wake if it differs by more than a hundredth."""
        return _changes(self._sleeper.set_gravity(gravity))

    def observe(
        self,
        record: str | os.PathLike | None = None,
        *,
        publish: bool = False,
        report: Callable[[str, int, float, str], None] | None = None,
        name: str = "program",
        title: str = "",
        engine: str = "own",
        dt: float = 1 / 60,
        frame_rate: float = 30.0,
    ) -> None:
        """Shows the bodies from now on. record: path of a file, which is replaced, for talus.open(), `talus view` and
        `talus film`. publish: to `talus monitor` and `talus view --live`. report(kind, body, value, text): called
        within the observe() or step() in which a kind of fault is first seen, "passed" (a body got through another one;
        value: its way in the step [m]), "overlap" (depth [extents]) or "outside_world" (coordinate [m]). What it raises
        in a step() the next one raises, before that changes anything. Within it, calls that change the sleeper raise
        ValueError.

        Columns of a record and numbers in `text` are those of handle_of(), and are used again once a body is removed.

        name, title, engine: what they are called there. dt: of the usual step [s], in which a record counts its time.
        frame_rate: frames of a record in a second of simulated time. Without an `enabled` sleeper: ValueError.
        """
        if record is not None or publish:
            if not hasattr(self._sleeper, "observe"):
                raise NotImplementedError("talus was built without LCM, and so without record and live view")
            path = None if record is None else os.fsencode(record)
            self._sleeper.observe(path, publish, name, title, engine, dt, frame_rate)
        if report is not None:
            self._watch(report)

    def _watch(self, report):
        # The extension module holds no report: one that refers to its sleeper would keep it alive for ever.
        sleeper, number = weakref.ref(self), len(self._reports)
        self._reports.append(report)
        self._sleeper.watch(lambda *warning: sleeper()._reports[number](*warning))

    def end_observers(self) -> None:
        """Ends record, live view and reports; else the end of a `with` block or of the sleeper does. OSError: the disk is
        full."""
        self._sleeper.end_observers()
        self._reports.clear()

    def handle_of(self, number: int) -> int:
        """Handle of the body in this column of a record, or with this number in a report's text. ValueError: no body that
        is there has it; kinematic ones have none."""
        return self._sleeper.handle_of(number)

    def asleep(self, body: int) -> bool:
        """Whether the body sleeps."""
        return self._sleeper.asleep(body)

    def __contains__(self, body: int) -> bool:
        """Whether the handle names a body that is there."""
        return -(2**63) <= body < 2**63 and self._sleeper.has(body)

    def __len__(self) -> int:
        """Number of bodies, the kinematic ones too."""
        return self._sleeper.size()

    @property
    def awake(self) -> int:
        """Number of awake bodies."""
        return self._sleeper.awake()

    def snapshot(self) -> np.ndarray:
        """A structured array of all bodies that are not kinematic, for restore(): body, asleep, settled."""
        return self._sleeper.snapshot()

    def restore(self, saved: np.ndarray, poses: ArrayLike) -> Changes:
        """Puts to sleep again what slept, and wakes all others: Changes. poses: entry i of saved[i].

        Put the bodies in their saved places before. A program that has added its bodies again replaces their handles
        in saved["body"].
        """
        return _changes(self._sleeper.restore(saved, self._poses(poses)))

    def _poses(self, poses):
        return _rows(poses, 3 if self.dimension == 2 else 7)


class PileSleeper2D(_PileSleeper):
    __doc__ = _PileSleeper.__doc__
    dimension = 2
    _native = _talus.Sleeper2
    contact_dtype = _talus.Sleeper2.contact_dtype


class PileSleeper3D(_PileSleeper):
    __doc__ = _PileSleeper.__doc__
    dimension = 3
    _native = _talus.Sleeper3
    contact_dtype = _talus.Sleeper3.contact_dtype
