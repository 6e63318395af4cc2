"""Runs to their end, against the command's own."""

import os
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings
from pathlib import Path

import numpy as np
import talus

COMMAND = os.environ["TALUS"]
SCENES = ("drop_in_a_pile_2d", "drop_in_a_pile_3d")
SHORT = {"run.frames": 60}


class Run(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        caught = warnings.catch_warnings()
        caught.__enter__()
        self.addCleanup(caught.__exit__, None, None, None)
        warnings.simplefilter("ignore")

    def test_leaves_the_record_of_the_command_and_its_last_frame_is_the_result(self):
        for scene in SCENES:
            result = talus.run(scene, seed=3, set=SHORT, out=self.folder / scene)
            of_command = self.folder / f"command_{scene}"
            command = [COMMAND, "run", scene, "--seed", "3", "--set", "run.frames=60", "--hash", "--no-telemetry"]
            output = subprocess.check_output([*command, "--out", of_command], stderr=subprocess.DEVNULL, text=True)
            self.assertEqual(result.hash, output.strip())
            self.assertEqual(result.folder, self.folder / scene)
            for file in ("run.lcm", "scene.toml", "pile.svg"):
                self.assertEqual((result.folder / file).read_bytes(), (of_command / file).read_bytes(), file)
            self.assertTrue((result.folder / "summary.json").exists())
            record = talus.open(result.folder)
            np.testing.assert_array_equal(record.poses[-1], result.poses.astype(np.float32))
            np.testing.assert_array_equal(record.asleep[-1], result.asleep)
            np.testing.assert_array_equal(record.shapes, result.shapes)
            self.assertEqual(record.shape_names, result.shape_names)
            self.assertEqual((record.seed, record.times[-1]), (result.seed, result.time))

    def test_gives_the_same_bits_with_and_without_a_folder(self):
        with_folder = talus.run("drop_in_a_pile_2d", set=SHORT, out=self.folder / "run")
        without = talus.run("drop_in_a_pile_2d", set=SHORT)
        self.assertIsNone(without.folder)
        self.assertEqual(without.hash, with_folder.hash)

    def test_ends_early_where_the_world_is_at_rest(self):
        result = talus.run("drop_in_a_pile_2d", set={"run.until": "rest", "run.frames": 6000, "source[0].count": 10})
        self.assertTrue(result.at_rest)
        self.assertLess(result.step_count, 6000)
        self.assertEqual(result.poses.shape, (10, 3))
        self.assertLess(np.abs(result.velocities).max(), 0.05)
        self.assertIn("10 bodies", repr(result))
        self.assertIn("at rest", repr(result))

    def test_tells_progress_up_to_the_end(self):
        told = []
        result = talus.run("drop_in_a_pile_3d", set={"run.frames": 600}, progress=lambda *steps: told.append(steps))
        done = [steps for steps, _ in told]
        self.assertEqual(done, sorted(done))
        self.assertEqual(done[-1], result.step_count)
        self.assertEqual({steps for _, steps in told}, {result.step_count})

    def test_an_error_of_the_progress_function_ends_the_run(self):
        def fail(step, steps):
            raise KeyError("told")

        with self.assertRaisesRegex(KeyError, "told"):
            talus.run("drop_in_a_pile_3d", set={"run.frames": 10**6}, progress=fail)

    def test_ctrl_c_leaves_a_whole_folder(self):
        threading.Timer(0.4, signal.raise_signal, [signal.SIGINT]).start()
        with self.assertRaises(KeyboardInterrupt):
            talus.run("drop_in_a_pile_3d", policy="full", set={"run.frames": 10**6}, out=self.folder / "run")
        record = talus.open(self.folder / "run")
        self.assertEqual(record.reason, "interrupted")
        self.assertEqual(record.damage, "")
        self.assertGreater(len(record.steps), 0)
        self.assertTrue((self.folder / "run/summary.json").exists())

    def test_a_warning_of_the_run_is_a_python_warning_and_nothing_is_printed(self):
        script = "import talus; talus.run('drop_in_a_pile_2d', set={'run.frames': 5}, out='run')"
        for action, said in (("default", "RuntimeWarning"), ("ignore", "")):
            output = subprocess.run([sys.executable, "-W", action, "-c", script.replace("'run')", f"'{action}')")],
                                    cwd=self.folder, capture_output=True, text=True, check=True)
            self.assertEqual(output.stdout, "")
            self.assertIn(said, output.stderr)
        self.assertEqual(output.stderr, "")
        with self.assertWarns(RuntimeWarning) as given:
            result = talus.run("drop_in_a_pile_2d", set={"run.frames": 5})
        self.assertIn(str(given.warning), result.warnings)

    def test_a_folder_that_is_not_empty_is_refused(self):
        (self.folder / "file").touch()
        with self.assertRaisesRegex(ValueError, "nothing is overwritten"):
            talus.run("drop_in_a_pile_2d", set=SHORT, out=self.folder)

    def test_bad_input_is_refused_before_the_run(self):
        with self.assertRaisesRegex(talus.SceneError, "run.frames = -5"):
            talus.run("drop_in_a_pile_2d", set={"run.frames": -5}, out=self.folder / "run")
        with self.assertRaisesRegex(ValueError, "drop_in_a_pille_2d"):
            talus.run("drop_in_a_pille_2d")
        with self.assertRaisesRegex(ValueError, "bullet"):
            talus.run("drop_in_a_pile_3d", backend="box2d")
        self.assertFalse((self.folder / "run").exists())


if __name__ == "__main__":
    unittest.main()
