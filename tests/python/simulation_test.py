"""Runs of the Python package against the command's own."""

import os
import signal
import subprocess
import threading
import unittest

import numpy as np
import talus

COMMAND = os.environ["TALUS"]


class Simulation(unittest.TestCase):
    def test_ends_with_the_hash_of_the_command(self):
        for scene in ("drop_in_a_pile_2d", "drop_in_a_pile_3d"):
            run = talus.Simulation(scene, seed=3, set={"run.frames": 60})
            run.step(10**6)
            command = [COMMAND, "run", scene, "--seed", "3", "--set", "run.frames=60", "--hash"]
            self.assertTrue(run.finished)
            self.assertEqual(run.hash(), subprocess.check_output(command, text=True).strip())

    def test_poses_are_copies_that_also_go_into_out(self):
        run = talus.Simulation("drop_in_a_pile_3d")
        run.step(120)
        first = run.poses()
        self.assertEqual(first.shape[1], 7)
        np.testing.assert_allclose(np.linalg.norm(first[:, 3:], axis=1), 1, atol=1e-5)  # single precision
        out = np.empty_like(first)
        self.assertIs(run.poses(out=out), out)
        np.testing.assert_array_equal(out, first)
        run.step(1)
        self.assertFalse(np.array_equal(run.poses()[: len(first)], first))
        with self.assertRaisesRegex(ValueError, "out.shape"):
            run.poses(out=np.empty((1, 2)))
        with self.assertRaises(TypeError):
            run.poses(out=np.empty((len(first), 7), dtype=np.float32))

    def test_a_removed_body_is_no_longer_present(self):
        run = talus.Simulation("drop_in_a_pile_2d")
        run.step(120)
        run.remove(0)
        self.assertFalse(run.present()[0])
        self.assertTrue(run.present()[1:].all())
        with self.assertRaisesRegex(ValueError, "body"):
            run.remove(0)

    def test_a_bad_value_is_an_error_with_field_and_value(self):
        with self.assertRaisesRegex(talus.SceneError, "run.frames = -5"):
            talus.Simulation("drop_in_a_pile_2d", set={"run.frames": -5})

    def test_all_errors_of_a_toml_text_have_their_lines(self):
        with self.assertRaises(talus.SceneError) as caught:
            talus.Simulation("dimension = 2\n[run]\nframes = -3\nfoo = 1\n")
        self.assertIn("scene:3:10: run.frames = -3", str(caught.exception))
        self.assertIn("scene:4:1: run.foo = 1", str(caught.exception))

    def test_other_threads_run_during_a_step(self):
        counted = 0
        done = threading.Event()

        def count():
            nonlocal counted
            while not done.is_set():
                counted += 1

        run = talus.Simulation("drop_in_a_pile_2d")
        thread = threading.Thread(target=count)
        thread.start()
        before = counted
        run.step(300)
        during = counted - before
        done.set()
        thread.join()
        self.assertGreater(during, 1000)

    def test_ctrl_c_stops_a_step_and_the_run_can_go_on(self):
        run = talus.Simulation("drop_in_a_pile_3d", policy="full", set={"run.frames": 10**6})
        threading.Timer(0.3, signal.raise_signal, [signal.SIGINT]).start()
        with self.assertRaises(KeyboardInterrupt):
            run.step(10**9)
        stopped = run.step_count
        self.assertLess(stopped, 10**6)
        run.step(1)
        self.assertEqual(run.step_count, stopped + 1)


if __name__ == "__main__":
    unittest.main()
