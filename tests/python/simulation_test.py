"""Runs of the Python package against the command's own."""

import copy
import json
import os
import pickle
import signal
import subprocess
import threading

import numpy as np
import pytest
import talus

COMMAND = os.environ["TALUS"]

ONE_BOX = """
title = "One box"
dimension = 2
[shape.box]
kind = "box"
size = [1.0, 0.6]
density = 1000
[[body]]
shape = "box"
position = [0, 0.3]
[[pile]]
at = [0, 0]
"""


@pytest.mark.parametrize("scene", ["drop_in_a_pile_2d", "drop_in_a_pile_3d"])
def test_ends_with_the_hash_of_the_command(scene):
    run = talus.Simulation(scene, seed=3, set={"run.frames": 60})
    run.step(10**6)
    command = [COMMAND, "run", scene, "--seed", "3", "--set", "run.frames=60", "--hash"]
    assert run.finished
    assert run.hash() == subprocess.check_output(command, text=True).strip()


def test_a_scene_is_taken_for_text_only_where_it_names_no_file(tmp_path):
    folder = tmp_path / "rate=3"
    folder.mkdir()
    (folder / "scene.toml").write_text(ONE_BOX)
    for scene in (folder / "scene.toml", str(folder / "scene.toml"), ONE_BOX):
        assert talus.Simulation(scene).dimension == 2
    with pytest.raises(ValueError, match="missing.toml: must be a file or the name"):
        talus.Simulation(folder / "missing.toml")
    line = 'title = "One", dimension = 2' + " " * 300
    with pytest.raises(talus.SceneError, match="scene:1:"):
        talus.Simulation(line)


def test_a_file_goes_before_the_scene_of_its_name_as_for_the_command(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "drop_in_a_pile_2d").write_text(ONE_BOX)
    command = [COMMAND, "run", "drop_in_a_pile_2d", "--set", "run.frames=3", "--hash"]
    run = talus.Simulation("drop_in_a_pile_2d", set={"run.frames": 3})
    run.step(10**6)
    assert len(run.poses()) == 1
    assert run.hash() == subprocess.check_output(command, text=True).strip()


def test_poses_are_copies_that_also_go_into_out():
    run = talus.Simulation("drop_in_a_pile_3d")
    run.step(120)
    first = run.poses()
    assert first.shape[1] == 7
    np.testing.assert_allclose(np.linalg.norm(first[:, 3:], axis=1), 1, atol=1e-5)  # single precision
    out = np.empty_like(first)
    assert run.poses(out=out) is out
    np.testing.assert_array_equal(out, first)
    run.step(1)
    assert not np.array_equal(run.poses()[: len(first)], first)
    with pytest.raises(ValueError, match="out.shape"):
        run.poses(out=np.empty((1, 2)))
    with pytest.raises(TypeError):
        run.poses(out=np.empty((len(first), 7), dtype=np.float32))


def test_a_removed_body_is_no_longer_present():
    run = talus.Simulation("drop_in_a_pile_2d")
    run.step(120)
    run.remove(0)
    assert not run.present()[0]
    assert run.present()[1:].all()
    for body in (0, -1, 10**6, 2**40, np.int64(2**40), -(2**70)):
        with pytest.raises(ValueError, match="body"):
            run.remove(body)
    for body in (True, np.True_, 1.0):
        with pytest.raises(TypeError):
            run.remove(body)


def test_contacts_of_a_box_at_rest_carry_its_weight():
    run = talus.Simulation(ONE_BOX, policy="full", contacts=True)
    run.step(300)
    contacts = run.contacts()
    weight = 1000 * 1.0 * 0.6 * 9.81  # density, size and gravity
    dt = run.time / run.step_count
    vertical = contacts["normal_impulse"] * contacts["normal"][:, 1] + contacts["friction_impulse"][:, 1]
    assert vertical.sum() / (weight * dt) == pytest.approx(1.0, abs=0.01)
    assert set(contacts["a"]) == {0}
    assert set(contacts["b"]) == {-1}
    np.testing.assert_allclose(contacts["point"][:, 1], 0, atol=0.02)
    np.testing.assert_allclose(np.sort(contacts["point"][:, 0] - run.poses()[0, 0])[[0, -1]], [-0.5, 0.5], atol=0.02)
    with pytest.raises(ValueError, match="contacts"):
        talus.Simulation(ONE_BOX).contacts()


def test_contacts_change_no_bits_of_a_run():
    hashes = set()
    for contacts in (False, True):
        run = talus.Simulation("drop_in_a_pile_3d", policy="full", set={"run.frames": 60}, contacts=contacts)
        run.step(10**6)
        hashes.add(run.hash())
    assert len(hashes) == 1


def test_events_of_all_steps_add_up_to_the_bodies_that_sleep():
    run = talus.Simulation("drop_in_a_pile_2d")
    asleep, causes = set(), set()
    for _ in range(400):
        run.step()
        for event in run.events():
            assert event["step"] == run.step_count
            (asleep.remove if event["woke"] else asleep.add)(event["body"])
            causes.add((str(event["cause"]), bool(event["woke"])))
    assert asleep == set(np.flatnonzero(run.asleep()))
    assert ("rest", False) in causes


def test_bodies_by_number_are_woken():
    run = talus.Simulation("drop_in_a_pile_2d")
    run.step(400)
    first, second, *others = np.flatnonzero(run.asleep())
    run.wake([])
    assert run.asleep()[first]
    run.wake(first)
    run.wake([second])
    assert not run.asleep()[[first, second]].any()
    assert run.asleep()[others].all()
    run.wake()
    assert not run.asleep().any()
    with pytest.raises(ValueError, match="body = 1000"):
        run.wake([0, 1000])


def test_a_mask_names_the_bodies_that_it_has():
    run = talus.Simulation("drop_in_a_pile_2d")
    run.step(400)
    asleep = run.asleep()
    woken = asleep & (np.arange(len(asleep)) % 2 == 0)
    assert 0 < woken.sum() < asleep.sum()
    run.wake(woken)
    np.testing.assert_array_equal(run.asleep(), asleep & ~woken)
    before = run.velocities()
    run.kick(woken, [0.0, 1.0])
    np.testing.assert_allclose(run.velocities() - before, np.outer(woken, [0.0, 1.0]), atol=1e-6)
    run.wake(np.zeros(len(asleep), bool))
    with pytest.raises(ValueError, match="bodies.shape"):
        run.wake(woken[1:])
    for lone in (True, np.True_, np.array(True)):
        with pytest.raises(TypeError, match="mask"):
            run.wake(lone)
    for number in (2**40, -(2**70)):
        with pytest.raises(ValueError, match="body"):
            run.kick([0, number], [0.0, 1.0])


def test_a_kick_of_any_strength_is_cut_to_the_fastest_speed():
    run = talus.Simulation(ONE_BOX)
    run.step()
    fastest = []
    for speed in (1e100, 1e200, 1e308):
        run.kick(0, [speed, 0.0])
        fastest.append(run.velocities()[0, 0])
    assert fastest[0] > 10
    np.testing.assert_allclose(fastest, fastest[0])
    for field, velocity, spin in (("velocity[1] = nan", [0, np.nan], None), ("spin[0] = inf", [0, 0], [np.inf])):
        with pytest.raises(ValueError) as caught:
            run.kick(0, velocity, spin)
        assert str(caught.value).startswith(field)


def test_a_kicked_box_wakes_and_flies_as_thrown():
    run = talus.Simulation(ONE_BOX)
    run.step(300)
    assert run.asleep()[0]
    start = run.poses()[0, :2]
    began = run.time
    run.kick(0, [2.0, 6.0])
    np.testing.assert_allclose(run.velocities()[0], [2.0, 6.0], atol=1e-6)
    run.step(30)
    time = run.time - began
    flown = np.array([2.0 * time, 6.0 * time - 0.5 * 9.81 * time**2])
    np.testing.assert_allclose(run.poses()[0, :2] - start, flown, atol=9.81 * time * time / 30)  # of the integrator
    run.kick([0], [0, 0], [1.5])
    assert run.spins()[0, 0] == pytest.approx(1.5, abs=1e-3)
    with pytest.raises(ValueError, match="velocity"):
        run.kick(0, [1.0])


def test_a_pile_counts_the_bodies_in_its_layers():
    run = talus.Simulation("drop_in_a_pile_2d")
    run.step(600)
    (pile,) = run.piles()
    height = run.poses()[:, 1]
    inside = (np.abs(run.poses()[:, 0] - pile.centre[0]) < pile.radius) & (height < pile.height)
    assert pile.layers["count"].sum() <= len(height)
    assert pile.layers["count"].sum() >= 0.5 * inside.sum()
    assert (pile.layers["sleeping"] <= pile.layers["count"]).all()
    np.testing.assert_allclose(pile.layers["bottom"][1:], pile.layers["top"][:-1])
    assert pile.layers["capacity"].sum() == pytest.approx(pile.structure_size, abs=1e-6 * pile.structure_size)


def test_any_text_is_taken_as_it_is(tmp_path):
    for title in ("\N{PILE OF POO} \"quoted\" \\ \x7f", "Häufen"):
        result = talus.run("drop_in_a_pile_2d", set={"title": title, "run.frames": 1}, out=tmp_path / str(len(title)))
        assert json.loads((result.folder / "summary.json").read_text())["title"].startswith(title[:4])
    with pytest.raises(TypeError, match="None"):
        talus.Simulation("drop_in_a_pile_2d", set={"title": None})


def test_arrays_of_one_number_are_numbers():
    for frames in (np.array(7), np.int64(7)):
        run = talus.Simulation("drop_in_a_pile_2d", set={"run.frames": frames})
        run.step(100)
        assert run.finished


def test_a_run_is_not_copied():
    run = talus.Simulation(ONE_BOX)
    for call in (copy.copy, copy.deepcopy, pickle.dumps):
        with pytest.raises(TypeError, match="a simulation cannot be copied"):
            call(run)


def test_a_bad_value_is_an_error_with_field_and_value():
    with pytest.raises(talus.SceneError, match="run.frames = -5"):
        talus.Simulation("drop_in_a_pile_2d", set={"run.frames": -5})


def test_all_errors_of_a_toml_text_have_their_lines():
    with pytest.raises(talus.SceneError) as caught:
        talus.Simulation("dimension = 2\n[run]\nframes = -3\nfoo = 1\n")
    assert "scene:3:10: run.frames = -3" in str(caught.value)
    assert "scene:4:1: run.foo = 1" in str(caught.value)


def test_other_threads_run_during_a_step():
    counted = 0
    done = threading.Event()

    def count():
        nonlocal counted
        while not done.is_set():
            counted += 1

    run = talus.Simulation("drop_in_a_pile_2d")
    thread = threading.Thread(target=count)
    thread.start()
    before = counted
    run.step(300)
    during = counted - before
    done.set()
    thread.join()
    assert during > 1000


def test_a_call_while_another_thread_steps_is_refused():
    run = talus.Simulation("drop_in_a_pile_3d", policy="full", set={"run.frames": 10**6})
    thread = threading.Thread(target=run.step, args=[1000])
    thread.start()
    refused = 0
    calls = (run.step, run.poses, run.hash, run.wake, lambda: run.kick(0, [0, 0, 1]), lambda: run.time)
    while thread.is_alive():
        for call in calls:
            try:
                call()
            except RuntimeError as error:
                refused += "a step is under way in another thread" in str(error)
    thread.join()
    assert refused >= len(calls)
    before = run.step_count
    run.step()
    assert run.step_count == before + 1


def test_ctrl_c_stops_a_step_and_the_run_can_go_on():
    run = talus.Simulation("drop_in_a_pile_3d", policy="full", set={"run.frames": 10**6})
    threading.Timer(0.3, signal.raise_signal, [signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        run.step(10**9)
    stopped = run.step_count
    assert stopped < 10**6
    run.step(1)
    assert run.step_count == stopped + 1
