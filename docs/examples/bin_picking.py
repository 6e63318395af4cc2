"""Settled poses of 200 parts in a bin, over several seeds: what a bin-picking data set begins with."""

import sys

import numpy as np
import talus

BIN = """
title = "Parts in a bin"
dimension = 3
obstacle = [{kind = "container", inner_size = [0.3, 0.4, 0.3], wall = 0.05}]
shape.part = {kind = "box", size = [0.06, 0.04, 0.02]}
source = [{count = 200, rate = 17, position = [0, 0, 0.5], spread = [0.1, 0.15, 0], velocity = [0, 0, -1], ride_above = 0.3}]
run = {until = "rest", frames = 900}
"""

print("seed   after  highest  flat")
layouts = []
for run in talus.sweep(BIN, seeds=int(sys.argv[1]) if len(sys.argv) > 1 else 8):
    if run.error:
        raise run.error
    poses = run.result.poses  # [part, x y z and quaternion x y z w]
    flat = np.abs(1 - 2 * (poses[:, 3] ** 2 + poses[:, 4] ** 2)) > 0.9  # vertical part of the z axis of each
    print(f"{run.seed:4} {run.result.time:5.1f} s {poses[:, 2].max():5.3f} m  {flat.mean():5.0%}")
    layouts.append(poses)
np.savez_compressed("bin_poses.npz", poses=np.array(layouts))

try:
    import matplotlib.pyplot as plt
except ImportError:
    sys.exit()
plt.hist([poses[:, 2] for poses in layouts], bins=20)
plt.xlabel("height of the centre [m]")
plt.ylabel("parts")
plt.savefig("bin_heights.png")
