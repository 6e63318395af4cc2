"""Recorded runs as arrays, against `talus export` and the run itself."""

import os
import subprocess
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np
import talus

COMMAND = os.environ["TALUS"]


def record(folder, scene, *options):
    subprocess.check_call([COMMAND, "run", scene, "--no-telemetry", "--hash", "--out", folder, *options],
                          stdout=subprocess.DEVNULL)
    return folder


class Record(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def test_has_what_talus_export_writes(self):
        for scene in ("drop_in_a_pile_2d", "drop_in_a_pile_3d"):
            run = record(self.folder / scene, scene, "--set", "run.frames=150")
            subprocess.check_call([COMMAND, "export", run, "--out", self.folder / "run.npz"], stdout=subprocess.DEVNULL)
            npz = np.load(self.folder / "run.npz")
            read = talus.open(run)
            there = npz["present"]
            np.testing.assert_array_equal(read.steps, npz["step"])
            np.testing.assert_array_equal(read.times, npz["time"])
            np.testing.assert_array_equal(read.present, there)
            np.testing.assert_array_equal(read.positions[there], npz["position"][there])
            rotation = npz["rotation"] if read.dimension == 2 else np.roll(npz["rotation"], -1, axis=-1)
            np.testing.assert_array_equal(read.rotations[there], rotation[there])
            np.testing.assert_array_equal(read.asleep, npz["asleep"])
            np.testing.assert_array_equal(read.shapes, npz["shape"])
            self.assertEqual(list(read.shape_names), [name.decode() for name in npz["shape_name"]])
            for name in ("step", "body", "woke", "layer"):
                np.testing.assert_array_equal(read.events[name], npz[f"event_{name}"])
            np.testing.assert_array_equal(read.events["cause"], npz["cause_name"][npz["event_cause"]].astype(str))
            self.assertGreater(len(read.events), 0)
            self.assertEqual(sum(len(triangles) for _, triangles in read.meshes), len(npz["mesh_triangle"]))

    def test_a_body_is_nan_until_it_appears_and_then_is_where_the_run_has_it(self):
        settings = {"run.frames": 120}
        read = talus.open(record(self.folder / "run", "drop_in_a_pile_3d", "--set", "run.frames=120"))
        run = talus.Simulation("drop_in_a_pile_3d", set=settings)
        self.assertFalse(read.present[0].all())
        for frame, step in enumerate(read.steps):
            run.step(int(step) - run.step_count)
            poses = run.poses()
            np.testing.assert_array_equal(read.poses[frame, : len(poses)], poses.astype(np.float32))
            self.assertTrue(np.isnan(read.poses[frame, len(poses):]).all())
            self.assertFalse(read.asleep[frame, len(poses):].any())
        self.assertEqual(read.reason, "finished")
        self.assertEqual(read.seed, 1)
        self.assertEqual((read.backend, read.policy), ("bullet", "adaptive"))

    def test_the_file_alone_is_enough(self):
        run = record(self.folder / "run", "drop_in_a_pile_2d", "--set", "run.frames=30")
        alone = (run / "run.lcm").rename(self.folder / "alone.lcm")
        self.assertEqual(len(talus.open(alone).steps), 30)
        self.assertIn("alone.lcm: 30 frames", repr(talus.open(str(alone))))

    def test_a_removed_body_is_nan_from_then_on(self):
        event = 'event=[{time=1.0, do="remove", body=[0]}]'
        read = talus.open(record(self.folder / "run", "drop_in_a_pile_2d", "--set", "run.frames=90", "--set", event))
        there = read.present[:, 0]
        gone = np.flatnonzero(there)[-1] + 1
        self.assertLess(gone, len(there))
        self.assertAlmostEqual(read.times[gone], 1.0, delta=2 * (read.times[1] - read.times[0]))
        self.assertFalse(there[gone:].any())

    def test_what_is_no_record_is_refused_with_file_and_reason(self):
        with self.assertRaisesRegex(FileNotFoundError, "nowhere"):
            talus.open(self.folder / "nowhere")
        with self.assertRaisesRegex(ValueError, f"{self.folder}: must be a folder that `talus run` left"):
            talus.open(self.folder)
        text = self.folder / "text.lcm"
        text.write_text("no log at all\n")
        with self.assertRaisesRegex(ValueError, "text.lcm.*no event is in its 14 bytes"):
            talus.open(text)

    def test_a_damaged_record_is_read_as_far_as_it_can_be_with_a_warning(self):
        file = record(self.folder / "run", "drop_in_a_pile_2d", "--set", "run.frames=60") / "run.lcm"
        whole = talus.open(file)
        data = bytearray(file.read_bytes())
        middle = len(data) // 2
        data[middle:middle + 8] = bytes(255 - byte for byte in data[middle:middle + 8])
        file.write_bytes(data)
        with self.assertWarnsRegex(RuntimeWarning, "run.lcm: damaged: .*damaged bytes"):
            read = talus.open(file)
        self.assertIn("damaged bytes", read.damage)
        self.assertEqual(read.steps[-1], whole.steps[-1])
        np.testing.assert_array_equal(read.poses[-1], whole.poses[-1])

    def test_a_whole_record_gives_no_warning(self):
        file = record(self.folder / "run", "drop_in_a_pile_2d", "--set", "run.frames=30")
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertEqual(talus.open(file).damage, "")


if __name__ == "__main__":
    unittest.main()
