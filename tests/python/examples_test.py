"""The scripts of docs/examples and of the manual."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

DOCS = Path(__file__).resolve().parents[2] / "docs"


def python_of(page):
    return re.findall(r"```python\n(.*?)```", (DOCS / page).read_text(), re.DOTALL)


class Examples(unittest.TestCase):
    def test_bin_picking_gives_other_poses_in_the_bin_for_each_seed(self):
        with tempfile.TemporaryDirectory() as folder:
            command = [sys.executable, DOCS / "examples/bin_picking.py", "2"]
            output = subprocess.check_output(command, cwd=folder, text=True).splitlines()
            poses = np.load(Path(folder) / "bin_poses.npz")["poses"]
        self.assertEqual([line.split()[0] for line in output], ["seed", "1", "2"])
        self.assertEqual(poses.shape, (2, 200, 7))
        x, y, z = np.moveaxis(poses[..., :3], -1, 0)
        self.assertLess(np.abs(x).max(), 1.5 - 0.1 + 0.02)  # half the bin less half the thinnest side of a part
        self.assertLess(np.abs(y).max(), 2.0 - 0.1 + 0.02)
        self.assertGreater(z.min(), 0.1 - 0.02)
        solid = 200 * 0.6 * 0.4 * 0.2 / (3 * 4)  # height of the parts without gaps
        mean_height = z.mean(axis=1)
        self.assertTrue(((mean_height > 0.5 * solid) & (mean_height < 1.5 * solid)).all())
        self.assertGreater(np.abs(poses[0] - poses[1]).max(), 0.1)

    def test_the_python_of_the_manual_does_what_it_says(self):
        (package,), (record,) = python_of("extending.md"), python_of("record.md")
        package = package.replace("seeds=4", "seeds=1")  # which takes less long
        with tempfile.TemporaryDirectory() as folder:
            check = "\nassert end.folder == record.path and len(runs) == 2 and not any(run.error for run in runs)"
            subprocess.check_call([sys.executable, "-W", "ignore", "-c", package + check], cwd=folder)
            command = [os.environ["TALUS"], "run", "drop_in_a_pile_2d", "--set", "run.frames=300", "--hash"]
            subprocess.check_call([*command, "--no-telemetry", "--out", "runs/logged"], cwd=folder)
            check = "\nassert path.shape == (300, 2) and 0 < len(woken) < len(record.events)"
            subprocess.check_call([sys.executable, "-c", record + check], cwd=folder)


if __name__ == "__main__":
    unittest.main()
