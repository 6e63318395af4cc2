"""Runs to their end, against the command's own."""

import os
import signal
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest
import talus

COMMAND = os.environ["TALUS"]
SHORT = {"run.frames": 60}


@pytest.mark.parametrize("scene", ["drop_in_a_pile_2d", "drop_in_a_pile_3d"])
def test_leaves_the_record_of_the_command_and_its_last_frame_is_the_result(scene, tmp_path):
    result = talus.run(scene, seed=3, set=SHORT, out=tmp_path / scene)
    of_command = tmp_path / f"command_{scene}"
    command = [COMMAND, "run", scene, "--seed", "3", "--set", "run.frames=60", "--hash", "--no-telemetry"]
    output = subprocess.check_output([*command, "--out", of_command], stderr=subprocess.DEVNULL, text=True)
    assert result.hash == output.strip()
    assert result.folder == tmp_path / scene
    for file in ("run.lcm", "scene.toml", "pile.svg"):
        assert (result.folder / file).read_bytes() == (of_command / file).read_bytes(), file
    assert (result.folder / "summary.json").exists()
    record = talus.open(result.folder)
    np.testing.assert_array_equal(record.poses[-1], result.poses.astype(np.float32))
    np.testing.assert_array_equal(record.asleep[-1], result.asleep)
    np.testing.assert_array_equal(record.shapes, result.shapes)
    assert record.shape_names == result.shape_names
    assert (record.seed, record.times[-1]) == (result.seed, result.time)


def test_paths_that_are_no_utf_8_are_paths(tmp_path):
    odd = Path(os.fsdecode(os.fsencode(tmp_path) + b"/\xff"))
    text = (Path(COMMAND).resolve().parents[1] / "share/talus/scenes/drop_in_a_pile_2d.toml").read_text()
    odd.with_suffix(".toml").write_text(text)
    result = talus.run(odd.with_suffix(".toml"), set=SHORT, out=odd)
    assert result.folder == odd
    assert len(talus.open(odd).steps) == 60


def test_gives_the_same_bits_with_and_without_a_folder(tmp_path):
    with_folder = talus.run("drop_in_a_pile_2d", set=SHORT, out=tmp_path / "run")
    without = talus.run("drop_in_a_pile_2d", set=SHORT)
    assert without.folder is None
    assert without.hash == with_folder.hash


def test_ends_early_where_the_world_is_at_rest():
    result = talus.run("drop_in_a_pile_2d", set={"run.until": "rest", "run.frames": 6000, "source[0].count": 10})
    assert result.at_rest
    assert result.step_count < 6000
    assert result.poses.shape == (10, 3)
    assert np.abs(result.velocities).max() < 0.05
    assert "10 bodies" in repr(result)
    assert "at rest" in repr(result)


def test_tells_progress_up_to_the_end():
    told = []
    result = talus.run("drop_in_a_pile_3d", set={"run.frames": 600}, progress=lambda *steps: told.append(steps))
    done = [steps for steps, _ in told]
    assert done == sorted(done)
    assert done[-1] == result.step_count
    assert {steps for _, steps in told} == {result.step_count}


def test_an_error_of_the_progress_function_ends_the_run():
    def fail(step, steps):
        raise KeyError("told")

    with pytest.raises(KeyError, match="told"):
        talus.run("drop_in_a_pile_3d", set={"run.frames": 10**6}, progress=fail)


def test_ctrl_c_leaves_a_whole_folder(tmp_path):
    threading.Timer(0.4, signal.raise_signal, [signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        talus.run("drop_in_a_pile_3d", policy="full", set={"run.frames": 10**6}, out=tmp_path / "run")
    record = talus.open(tmp_path / "run")
    assert record.reason == "interrupted"
    assert record.damage == ""
    assert len(record.steps) > 0
    assert (tmp_path / "run/summary.json").exists()


def test_a_warning_of_the_run_is_a_python_warning_and_nothing_is_printed(tmp_path):
    script = "import talus; talus.run('drop_in_a_pile_2d', set={'run.frames': 5}, out='run')"
    for action, said in (("default", "RuntimeWarning"), ("ignore", "")):
        output = subprocess.run([sys.executable, "-W", action, "-c", script.replace("'run')", f"'{action}')")],
                                cwd=tmp_path, capture_output=True, text=True, check=True)
        assert output.stdout == ""
        assert said in output.stderr
    assert output.stderr == ""
    with pytest.warns(RuntimeWarning) as given:
        result = talus.run("drop_in_a_pile_2d", set={"run.frames": 5})
    assert str(given[0].message) in result.warnings


def test_warns_of_drift_with_and_without_a_folder(tmp_path):
    hangs = """
        title = "A cube that hangs at 0.2 D in its sleep"
        dimension = 2
        run = {frames = 4, frame_rate = 60}
        [shape.cube]
        kind = "box"
        size = [1, 1]
        [[body]]
        position = [0, 0.783]
        asleep = true
    """
    for out in (None, tmp_path / "run"):
        with pytest.warns(RuntimeWarning, match="once woken, the sleeping bodies move by"):
            assert len(talus.run(hangs, out=out).warnings) == 1


def test_a_folder_that_is_not_empty_is_refused(tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(ValueError, match="nothing is overwritten"):
        talus.run("drop_in_a_pile_2d", set=SHORT, out=tmp_path)


def test_bad_input_is_refused_before_the_run(tmp_path):
    with pytest.raises(talus.SceneError, match="run.frames = -5"):
        talus.run("drop_in_a_pile_2d", set={"run.frames": -5}, out=tmp_path / "run")
    with pytest.raises(ValueError, match="drop_in_a_pille_2d"):
        talus.run("drop_in_a_pille_2d")
    with pytest.raises(ValueError, match="bullet"):
        talus.run("drop_in_a_pile_3d", backend="box2d")
    assert not (tmp_path / "run").exists()
