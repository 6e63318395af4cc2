"""The scripts of docs/examples and of the manual."""

import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np

DOCS = Path(__file__).resolve().parents[2] / "docs"


def python_of(page):
    return re.findall(r"```python\n(.*?)```", (DOCS / page).read_text(), re.DOTALL)


def test_bin_picking_gives_other_poses_in_the_bin_for_each_seed(tmp_path):
    command = [sys.executable, DOCS / "examples/bin_picking.py", "2"]
    output = subprocess.check_output(command, cwd=tmp_path, text=True).splitlines()
    poses = np.load(tmp_path / "bin_poses.npz")["poses"]
    assert [line.split()[0] for line in output] == ["seed", "1", "2"]
    assert poses.shape == (2, 200, 7)
    x, y, z = np.moveaxis(poses[..., :3], -1, 0)
    assert np.abs(x).max() < 0.15 - 0.01 + 0.002  # half the bin less half the thinnest side of a part
    assert np.abs(y).max() < 0.20 - 0.01 + 0.002
    assert z.min() > 0.01 - 0.002
    solid = 200 * 0.06 * 0.04 * 0.02 / (0.3 * 0.4)  # height of the parts without gaps
    mean_height = z.mean(axis=1)
    assert ((mean_height > 0.5 * solid) & (mean_height < 1.5 * solid)).all()
    assert np.abs(poses[0] - poses[1]).max() > 0.01


def test_the_python_of_the_manual_does_what_it_says(tmp_path):
    (package,), (record,) = python_of("extending.md"), python_of("record.md")
    package = package.replace("seeds=4", "seeds=1")  # which takes less long
    check = "\nassert end.folder == record.path and len(runs) == 2 and not any(run.error for run in runs)"
    subprocess.check_call([sys.executable, "-W", "ignore", "-c", package + check], cwd=tmp_path)
    command = [os.environ["TALUS"], "run", "drop_in_a_pile_2d", "--set", "run.frames=300", "--hash"]
    subprocess.check_call([*command, "--no-telemetry", "--out", "runs/logged"], cwd=tmp_path)
    check = "\nassert path.shape == (300, 2) and 0 < len(woken) < len(record.events)"
    subprocess.check_call([sys.executable, "-c", record + check], cwd=tmp_path)
