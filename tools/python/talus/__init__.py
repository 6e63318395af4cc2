"""Piles of rigid bodies that fall asleep body by body: runs of talus scenes as NumPy arrays.

Lengths are in metres, times in seconds, angles in radians. The last axis is up: x, z in 2D, x, y, z in 3D. A body is
where its centre of mass is. A pose is x, z, angle in 2D; in 3D x, y, z and a quaternion x, y, z, w, as of SciPy.
"""

from ._record import Record, open
from ._run import Result, run
from ._simulation import Pile, Simulation
from ._sleeper import Changes, PileSleeper2D, PileSleeper3D, SleepChange, VelocityChange
from ._sweep import SweepRun, sweep
from ._talus import NonFiniteState, SceneError

__all__ = [
    "Changes",
    "NonFiniteState",
    "Pile",
    "PileSleeper2D",
    "PileSleeper3D",
    "Record",
    "Result",
    "SceneError",
    "Simulation",
    "SleepChange",
    "SweepRun",
    "VelocityChange",
    "open",
    "run",
    "sweep",
]
