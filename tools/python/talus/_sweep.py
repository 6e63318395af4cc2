"""Many runs of a scene, on all cores."""

from __future__ import annotations

import itertools
import numbers
import os
import pickle
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Iterable, Mapping

from ._run import Result
from ._scene import Scene, Values, toml_text
from ._talus import has_twins, overlap


@dataclass(frozen=True)
class SweepRun:
    """A run of a sweep. Either `result` or `error` is None."""

    values: dict[str, Any]  #: of the keys that the sweep sets, by path
    seed: int | None  #: None: the scene's own
    result: Result | None  #: its warnings are in `result.warnings`
    error: Exception | None  #: that talus.run() raised, or ChildProcessError where its process died


class _Processes:
    """Runs in processes of their own: engines have global state, and a crash costs one run."""

    def __init__(self):
        self._running = []
        self._stopped = False
        path = [str(Path(__file__).resolve().parents[1]), os.environ.get("PYTHONPATH", "")]
        # Safe: nothing is imported from the current folder.
        self._environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, path)), "PYTHONSAFEPATH": "1"}

    def run(self, arguments):
        """(result, error) of talus.run() with these arguments."""
        command = [sys.executable, "-m", "talus._worker"]
        pipes = dict(stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        process = subprocess.Popen(command, env=self._environment, **pipes)
        self._running.append(process)
        if self._stopped:  # while this one began
            process.kill()
        output, messages = process.communicate(pickle.dumps(arguments))
        if process.returncode == 0:
            return pickle.loads(output)
        last = messages.decode(errors="replace").strip().rpartition("\n")[2]
        return None, ChildProcessError(f"the process of the run ended with {process.returncode}: {last}")

    def stop(self):
        self._stopped = True
        for process in self._running:
            process.kill()


def _check(values, seeds, policy, settings):
    """ValueError, as `talus sweep` refuses it: runs would not have all values that they tell, or be there twice."""
    paths = [("values", path) for path in values] + [("set", path) for path in settings]
    for path, argument, given in (("policy.kind", "policy", policy), ("seed", "seeds", seeds)):
        for name, other in paths if given is not None else ():
            if overlap(other, path):
                raise ValueError(f"{name}[{other!r}]: must be left out where {argument} = {given} is given")
    for (_, path), (name, other) in itertools.combinations(paths, 2):
        if overlap(path, other):
            raise ValueError(f"{name}[{other!r}]: must be given once, and {path!r} is given, too")
    of_seeds = {} if seeds is None else {"seeds": seeds}
    for name, choices in ({f"values[{path!r}]": choices for path, choices in values.items()} | of_seeds).items():
        if not choices:
            raise ValueError(f"{name} = {choices}: must be one value or more")
        if has_twins([toml_text(choice) for choice in choices]):
            raise ValueError(f"{name} = {choices}: must have no value twice")


def sweep(
    scene: Scene,
    values: Mapping[str, Iterable] | None = None,
    seeds: int | Iterable[int] | None = None,
    *,
    policy: str | None = None,
    backend: str | None = None,
    set: Values | None = None,
    jobs: int | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> list[SweepRun]:
    """Simulates a scene with all combinations of values and seeds; returns a list of SweepRun, seeds side by side.

    values: lists of values by path, {"shape.L.friction": [0.2, 0.4]}. seeds: how many, from 1 on, or the seeds
    themselves; None: the scene's own. set: values of all runs. jobs: runs at a time, each in a process of its own, from
    1 on; None: one for each core. progress: a function that is called with the number of runs done and of all, from 0 on.
    policy and backend as in talus.run(). ValueError: a key is given twice, also by a table that has it or by policy or
    seeds; a value or a seed is there twice, or none is.

    A run that fails has its error in the list and costs no other. Ctrl-C, as any error of `progress`, ends the sweep.
    """
    values = {path: list(choices) for path, choices in (values or {}).items()}
    if seeds is not None:
        seeds = list(range(1, seeds + 1) if isinstance(seeds, numbers.Integral) else seeds)
    if jobs is not None and jobs < 1:
        raise ValueError(f"jobs = {jobs}: must be at least 1")
    _check(values, seeds, policy, set or {})
    combinations = [dict(zip(values, chosen)) for chosen in itertools.product(*values.values())]
    plan = [(chosen, seed) for chosen in combinations for seed in seeds or [None]]
    processes = _Processes()
    outcomes = {}
    with ThreadPoolExecutor(jobs or len(os.sched_getaffinity(0))) as threads:
        try:
            number_of = {}
            for number, (chosen, seed) in enumerate(plan):
                settings = {**(set or {}), **chosen}
                arguments = dict(scene=scene, seed=seed, policy=policy, backend=backend, set=settings)
                number_of[threads.submit(processes.run, arguments)] = number
            if progress:
                progress(0, len(plan))
            for future in as_completed(number_of):
                outcomes[number_of[future]] = future.result()
                if progress:
                    progress(len(outcomes), len(plan))
        except BaseException:
            threads.shutdown(wait=False, cancel_futures=True)
            processes.stop()
            raise
    return [SweepRun(chosen, seed, *outcomes[number]) for number, (chosen, seed) in enumerate(plan)]
