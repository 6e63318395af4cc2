"""Settled poses of 200 parts in a bin, over several seeds: what a bin-picking data set begins with."""

import sys

import numpy as np
import talus

# Lengths in decimetres, since talus simulates no thinner parts in metres: 6 x 4 x 2 cm, and gravity is 98.1 dm/s^2.
BIN = """
title = "Parts in a bin"
dimension = 3
world = {gravity = 98.1, steps_per_second = 240}
obstacle = [{kind = "container", inner_size = [3.0, 4.0, 3.0], wall = 0.5}]
shape.part = {kind = "box", size = [0.6, 0.4, 0.2]}
source = [{count = 200, rate = 17, position = [0, 0, 5], spread = [1, 1.5, 0], velocity = [0, 0, -10], ride_above = 3}]
run = {until = "rest", frames = 900}
"""

print("seed   after  highest  flat")
layouts = []
for run in talus.sweep(BIN, seeds=int(sys.argv[1]) if len(sys.argv) > 1 else 8):
    if run.error:
        raise run.error
    poses = run.result.poses  # [part, x y z and quaternion x y z w]
    flat = np.abs(1 - 2 * (poses[:, 3] ** 2 + poses[:, 4] ** 2)) > 0.9  # vertical part of the z axis of each
    print(f"{run.seed:4} {run.result.time:5.1f} s {poses[:, 2].max():5.2f} dm {flat.mean():5.0%}")
    layouts.append(poses)
np.savez_compressed("bin_poses.npz", poses=np.array(layouts))

try:
    import matplotlib.pyplot as plt
except ImportError:
    sys.exit()
plt.hist([poses[:, 2] for poses in layouts], bins=20)
plt.xlabel("height of the centre [dm]")
plt.ylabel("parts")
plt.savefig("bin_heights.png")
