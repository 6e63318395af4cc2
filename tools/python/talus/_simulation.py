"""Runs step by step."""

import numpy as np

from ._scene import open_scene


class Simulation:
    """A run of a scene, step by step.

    scene: path, name of a scene that `talus list` shows, or TOML text. set: values by path, as of `talus run --set`.
    Errors of the scene raise SceneError with all of them. Arrays are copies, entry i belongs to body i.
    """

    def __init__(self, scene, policy=None, seed=None, backend=None, set=None):
        self._run = open_scene(scene, policy, seed, backend, set)

    def step(self, count=1):
        """Does up to `count` steps, fewer where the run ends. Other threads run meanwhile, and Ctrl-C stops it.

        NonFiniteState: the state of a body became NaN or infinite; the run stays at the step before.
        """
        self._run.step(count)

    dimension = property(lambda self: self._run.dimension, doc="2 or 3.")
    finished = property(lambda self: self._run.finished, doc="Whether the run is at its end.")
    time = property(lambda self: self._run.time, doc="Simulated time [s].")
    step_count = property(lambda self: self._run.step_count, doc="Steps done.")

    def hash(self):
        """Hash of all poses and velocities, as `talus run --hash` prints it."""
        return f"{self._run.hash():016x}"

    def poses(self, out=None):
        """(n, 3) in 2D: x, z [m], angle [rad]; (n, 7) in 3D: x, y, z [m], quaternion x, y, z, w.

        out: a C-ordered float64 array of that shape, which is filled and returned; ValueError on another shape,
        TypeError on another kind of array.
        """
        if out is None:
            return self._run.poses()
        self._run.write_poses(out)
        return out

    def velocities(self):
        """(n, dimension), of the centres of mass [m/s]."""
        return self._run.velocities()

    def spins(self):
        """(n, 1) in 2D, (n, 3) in 3D [rad/s]."""
        return self._run.spins()

    def asleep(self):
        """(n,) bool."""
        return np.array(self._run.asleep(), dtype=bool)

    def present(self):
        """(n,) bool: False for a removed body, whose other entries stay as they last were."""
        return ~np.array(self._run.removed(), dtype=bool)

    def shapes(self):
        """(n,) int: number of each body's shape in the scene."""
        return np.array(self._run.shapes(), dtype=int)

    def remove(self, body):
        """Removes a body. Sleeping bodies near it wake. ValueError on a number of no body in the world."""
        self._run.remove(body)

    def wake(self):
        """Wakes all bodies."""
        self._run.wake()
