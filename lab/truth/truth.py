#!/usr/bin/env python3
"""Runs talus bench over scenes and prints the errors of the height of the centre of mass: for all scenes, and for each
scene that is off, by more than 3 % and two standard errors.

  lab/truth/truth.py [SCENE...] [--seeds 16] [--engine box2d,bullet-planar] [--talus PATH] [--jobs 2] [--out FOLDER]

Without scenes it takes those beside this script. Where --out has a bench.csv already, only its errors are printed.
"""
import argparse
import csv
import math
import pathlib
import statistics
import subprocess

PAIRS = (("adaptive", "full"), ("full", "reference"), ("adaptive", "reference"))


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", help="files", metavar="SCENE")
    parser.add_argument("--seeds", type=int, default=16)
    parser.add_argument("--engine", help="engines, separated by commas; default: each dimension's first")
    parser.add_argument("--talus", default="talus")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("truth"))
    return parser.parse_args()


def measure(chosen):
    scenes = chosen.scenes or sorted(map(str, (pathlib.Path(__file__).parent / "scenes").glob("*.toml")))
    engines = ["--backend", chosen.engine] if chosen.engine else []
    subprocess.run([chosen.talus, "bench", *scenes, "--policy", "full,adaptive,reference", "--seeds", str(chosen.seeds),
                    *engines, "--jobs", str(chosen.jobs), "--out", str(chosen.out)], check=False, stdout=subprocess.DEVNULL)


def read(file):
    """The heights, times and numbers of bodies of all runs that ended, by engine, scene and policy."""
    runs = {}
    for row in csv.DictReader(open(file, newline="")):
        if row["centre_height_m"]:
            by_policy = runs.setdefault(row["backend"], {}).setdefault(row["scene"], {})
            by_policy.setdefault(row["policy"], []).append(row)
    return runs


def column(rows, name):
    return [float(row[name]) for row in rows]


def error(rows, base):
    """The difference of the mean heights in per cent, and its standard error."""
    heights, base_heights = column(rows, "centre_height_m"), column(base, "centre_height_m")
    scale = 100 / statistics.mean(base_heights)
    variance = sum(statistics.variance(sample) / len(sample) for sample in (heights, base_heights))
    return scale * (statistics.mean(heights) - statistics.mean(base_heights)), scale * math.sqrt(variance)


def show(engine, scenes):
    seeds = [len(rows) for policies in scenes.values() for rows in policies.values()]
    print(f"\n{engine}: {len(scenes)} scenes, {min(seeds)} to {max(seeds)} seeds")
    for policy, base in PAIRS:
        pairs = {scene: (policies[policy], policies[base]) for scene, policies in scenes.items()
                 if min(len(policies.get(name, [])) for name in (policy, base)) > 1}
        if len(pairs) < 2:
            continue
        errors = {scene: error(*pair) for scene, pair in pairs.items()}
        means = [mean for mean, _ in errors.values()]
        mean_error = statistics.stdev(means) / math.sqrt(len(means))
        off = {scene: each for scene, each in errors.items() if abs(each[0]) > max(3.0, 2 * each[1])}
        time = statistics.median(statistics.mean(column(own, "seconds")) / statistics.mean(column(other, "seconds"))
                                 for own, other in pairs.values())
        print(f"  {policy} against {base}: {statistics.mean(means):+.1f} ± {mean_error:.1f} %, median "
              f"{statistics.median(means):+.1f} %, {len(off)} off, time {time:.2f}")
        for scene, (mean, own_error) in sorted(off.items(), key=lambda item: -abs(item[1][0])):
            print(f"    {scene:36} {mean:+6.1f} ± {own_error:.1f} %")
    rows = [row for policies in scenes.values() for row in policies.get("adaptive", [])]
    asleep = sum(row["asleep_at_end"] == row["bodies"] for row in rows)
    print(f"  all bodies of adaptive asleep at the end in {asleep} of {len(rows)} runs")


if __name__ == "__main__":
    settings = options()
    if not (settings.out / "bench.csv").exists():
        measure(settings)
    for engine_name, scenes_of_engine in read(settings.out / "bench.csv").items():
        show(engine_name, scenes_of_engine)
