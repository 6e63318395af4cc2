"""Sweeps against single runs."""

import signal
import threading
import time

import numpy as np
import pytest
import talus
from talus import _sweep

SHORT = {"run.frames": 30}


def test_gives_each_combination_as_a_run_of_its_own_gives_it():
    told = []
    values = {"policy.kind": ["full", "adaptive"], "ground.friction": np.array([0.3, 0.6])}
    runs = talus.sweep("drop_in_a_pile_2d", values, seeds=2, set=SHORT, progress=lambda *done: told.append(done))
    planned = [(kind, friction, seed) for kind in ("full", "adaptive") for friction in (0.3, 0.6) for seed in (1, 2)]
    assert [(run.values["policy.kind"], run.values["ground.friction"], run.seed) for run in runs] == planned
    assert told == [(done, 8) for done in range(9)]
    for run in (runs[0], runs[-1]):
        assert run.error is None
        alone = talus.run("drop_in_a_pile_2d", seed=run.seed, set={**SHORT, **run.values})
        assert run.result.hash == alone.hash
        np.testing.assert_array_equal(run.result.poses, alone.poses)
        assert run.result.warnings == alone.warnings


def test_takes_its_modules_from_no_other_folder(tmp_path, monkeypatch):
    (tmp_path / "pickle.py").write_text("raise SystemExit(3)")
    monkeypatch.chdir(tmp_path)
    (run,) = talus.sweep("drop_in_a_pile_2d", set=SHORT)
    assert run.error is None


def test_takes_numpys_whole_numbers_and_refuses_jobs_that_are_none():
    runs = talus.sweep("drop_in_a_pile_2d", seeds=np.int64(2), set=SHORT)
    assert [run.seed for run in runs] == [1, 2]
    for jobs in (0, -1):
        with pytest.raises(ValueError, match=f"jobs = {jobs}: must be at least 1"):
            talus.sweep("drop_in_a_pile_2d", set=SHORT, jobs=jobs)


@pytest.mark.parametrize("path, given", [("policy.kind", {"policy": "full"}), ("seed", {"seeds": 2})])
def test_a_value_that_an_argument_gives_too_is_refused(path, given):
    with pytest.raises(ValueError, match=f"{path}.*must be left out where {next(iter(given))}"):
        talus.sweep("drop_in_a_pile_2d", {path: ["full"]}, set=SHORT, **given)


@pytest.mark.parametrize(
    "values, arguments, told",
    [
        ({"policy": [{"kind": "full"}]}, {"policy": "full"}, r"values\['policy'\]: must be left out where policy = full"),
        ({"run.frames": [2, 3], "run": [{"frames": 4}]}, {}, r"values\['run'\]: must be given once, and 'run.frames'"),
        ({"run.frames": [2, 3]}, {"set": SHORT}, r"set\['run.frames'\]: must be given once"),
        ({"ground.friction": np.array([0.5, 0.7, 0.5])}, {}, "friction.*must have no value twice"),
        ({"ground.friction": [1, 1.0]}, {}, "friction.*must have no value twice"),
        ({"ground.friction": []}, {}, r"values\['ground.friction'\] = \[\]: must be one value or more"),
        ({}, {"seeds": 0}, r"seeds = \[\]: must be one value or more"),
        ({}, {"seeds": -1}, "seeds.*must be one value or more"),
        ({}, {"seeds": [1, 2, 1]}, r"seeds = \[1, 2, 1\]: must have no value twice"),
    ],
)
def test_what_would_be_run_twice_or_not_at_all_is_refused(values, arguments, told):
    with pytest.raises(ValueError, match=told):
        talus.sweep("drop_in_a_pile_2d", values, **arguments)


def test_a_run_that_fails_has_its_error_and_costs_no_other():
    runs = talus.sweep("drop_in_a_pile_2d", {"run.frames": [5, -5, 10]})
    assert [run.result and run.result.step_count > 0 for run in runs] == [True, None, True]
    assert isinstance(runs[1].error, talus.SceneError)
    assert "run.frames = -5" in str(runs[1].error)


def test_a_process_that_dies_costs_its_run_alone(monkeypatch):
    alive = _sweep._Processes.run

    def run(self, arguments):
        if arguments["seed"] == 2:
            threading.Timer(0.3, lambda: self._running[-1].kill()).start()
            arguments = {**arguments, "set": {"run.frames": 10**7, "policy.kind": "full"}}
        return alive(self, arguments)

    monkeypatch.setattr(_sweep._Processes, "run", run)
    runs = talus.sweep("drop_in_a_pile_2d", seeds=[1, 2, 3], set=SHORT, jobs=1)
    assert [run.result is not None for run in runs] == [True, False, True]
    assert isinstance(runs[1].error, ChildProcessError)
    assert "-9" in str(runs[1].error)


def test_ctrl_c_ends_the_runs_at_work():
    threading.Timer(1.0, signal.raise_signal, [signal.SIGINT]).start()
    started = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        talus.sweep("drop_in_a_pile_2d", seeds=4, policy="full", set={"run.frames": 10**7})
    assert time.monotonic() - started < 20
