#!/usr/bin/env python3
"""Runs talus bench over the scenes of this folder and prints the errors of a policy, worst scene first.

  lab/truth/truth.py [--seeds 16] [--engine box2d] [--only 2d-f0.2] [--policy adaptive] [--talus PATH] [--out FOLDER]

Where --out has a bench.csv already, only its table is printed.
"""
import argparse
import csv
import math
import pathlib
import statistics
import subprocess

HERE = pathlib.Path(__file__).parent


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=16)
    parser.add_argument("--engine", default="box2d,bullet-planar,bullet", help="engines, separated by commas")
    parser.add_argument("--only", default="", help="scenes whose names contain this")
    parser.add_argument("--policy", default="adaptive")
    parser.add_argument("--talus", default="talus")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("truth"))
    return parser.parse_args()


def measure(chosen):
    scenes = sorted(str(file) for file in (HERE / "scenes").glob("*.toml") if chosen.only in file.stem)
    subprocess.run([chosen.talus, "bench", *scenes, "--policy", f"full,{chosen.policy},reference", "--drift",
                    "--backend", chosen.engine, "--seeds", str(chosen.seeds), "--jobs", str(chosen.jobs),
                    "--out", str(chosen.out)], check=False, stdout=subprocess.DEVNULL)


def bias(runs, baseline, column):
    """Difference of the means, and its standard error; nothing for fewer than two runs a side."""
    sides = [[float(run[column]) for run in side if run[column]] for side in (runs, baseline)]
    if min(len(side) for side in sides) < 2:
        return math.nan, math.nan
    error = math.sqrt(sum(statistics.variance(side) / len(side) for side in sides))
    return statistics.mean(sides[0]) - statistics.mean(sides[1]), error


def table(chosen):
    cells = {row["scene"]: row for row in csv.DictReader(open(HERE / "cells.csv", newline=""))}
    groups = {}
    for row in csv.DictReader(open(chosen.out / "bench.csv", newline="")):
        groups.setdefault((row["scene"], row["backend"]), {}).setdefault(row["policy"], []).append(row)
    lines = []
    for (scene, engine), runs in groups.items():
        own, full, reference = (runs.get(policy, []) for policy in (chosen.policy, "full", "reference"))
        extent = float(cells[scene]["D_m"])
        height, height_error = bias(own, reference, "centre_height_m")
        from_full, full_error = bias(own, full, "centre_height_m")
        drift = bias(own, full, "drift_D")[0]
        speed_ups = [float(run["speed_up"]) for run in own if run["speed_up"]]
        speed_up = statistics.median(speed_ups) if speed_ups else math.nan
        lines.append((abs(from_full) / extent, f"{scene:36} {engine:14} {height / extent:+7.3f} ± {height_error / extent:.3f} "
                      f"{from_full / extent:+7.3f} ± {full_error / extent:.3f} {drift:+7.3f} {speed_up:7.2f}"))
    print(f"{'scene':36} {'engine':14} {'centre off the reference, off full [D]':34} drift beyond full [D], speed-up")
    for _, line in sorted(lines, key=lambda line: -line[0] if line[0] == line[0] else 0.0):
        print(line)


if __name__ == "__main__":
    settings = options()
    if not (settings.out / "bench.csv").exists():
        measure(settings)
    table(settings)
