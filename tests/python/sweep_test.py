"""Sweeps against single runs."""

import signal
import threading
import time
import unittest
import warnings
from unittest import mock

import numpy as np
import talus
from talus import _sweep

SHORT = {"run.frames": 30}


class Sweep(unittest.TestCase):
    def setUp(self):
        caught = warnings.catch_warnings()
        caught.__enter__()
        self.addCleanup(caught.__exit__, None, None, None)
        warnings.simplefilter("ignore")

    def test_gives_each_combination_as_a_run_of_its_own_gives_it(self):
        told = []
        values = {"policy.kind": ["full", "adaptive"], "ground.friction": np.array([0.3, 0.6])}
        runs = talus.sweep("drop_in_a_pile_2d", values, seeds=2, set=SHORT, progress=lambda *done: told.append(done))
        self.assertEqual(
            [(run.values["policy.kind"], run.values["ground.friction"], run.seed) for run in runs],
            [(kind, friction, seed) for kind in ("full", "adaptive") for friction in (0.3, 0.6) for seed in (1, 2)],
        )
        self.assertEqual(told, [(done, 8) for done in range(9)])
        for run in (runs[0], runs[-1]):
            self.assertIsNone(run.error)
            alone = talus.run("drop_in_a_pile_2d", seed=run.seed, set={**SHORT, **run.values})
            self.assertEqual(run.result.hash, alone.hash)
            np.testing.assert_array_equal(run.result.poses, alone.poses)
            self.assertEqual(run.result.warnings, alone.warnings)

    def test_a_run_that_fails_has_its_error_and_costs_no_other(self):
        runs = talus.sweep("drop_in_a_pile_2d", {"run.frames": [5, -5, 10]})
        self.assertEqual([run.result and run.result.step_count > 0 for run in runs], [True, None, True])
        self.assertIsInstance(runs[1].error, talus.SceneError)
        self.assertIn("run.frames = -5", str(runs[1].error))

    def test_a_process_that_dies_costs_its_run_alone(self):
        alive = _sweep._Processes.run

        def run(self, arguments):
            if arguments["seed"] == 2:
                threading.Timer(0.3, lambda: self._running[-1].kill()).start()
                arguments = {**arguments, "set": {"run.frames": 10**7, "policy.kind": "full"}}
            return alive(self, arguments)

        with mock.patch.object(_sweep._Processes, "run", run):
            runs = talus.sweep("drop_in_a_pile_2d", seeds=[1, 2, 3], set=SHORT, jobs=1)
        self.assertEqual([run.result is not None for run in runs], [True, False, True])
        self.assertIsInstance(runs[1].error, ChildProcessError)
        self.assertIn("-9", str(runs[1].error))

    def test_ctrl_c_ends_the_runs_at_work(self):
        threading.Timer(1.0, signal.raise_signal, [signal.SIGINT]).start()
        started = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            talus.sweep("drop_in_a_pile_2d", seeds=4, policy="full", set={"run.frames": 10**7})
        self.assertLess(time.monotonic() - started, 20)


if __name__ == "__main__":
    unittest.main()
