"""Recorded runs as arrays, against `talus export` and the run itself."""

import os
import subprocess

import numpy as np
import pytest
import talus

COMMAND = os.environ["TALUS"]


def record(folder, scene, *options):
    subprocess.check_call([COMMAND, "run", scene, "--no-telemetry", "--hash", "--out", folder, *options],
                          stdout=subprocess.DEVNULL)
    return folder


@pytest.mark.parametrize("scene", ["drop_in_a_pile_2d", "drop_in_a_pile_3d"])
def test_has_what_talus_export_writes(scene, tmp_path):
    run = record(tmp_path / scene, scene, "--set", "run.frames=150", "--set", "run.contacts=true")
    subprocess.check_call([COMMAND, "export", run, "--out", tmp_path / "run.npz"], stdout=subprocess.DEVNULL)
    npz = np.load(tmp_path / "run.npz")
    read = talus.open(run)
    there = npz["present"]
    np.testing.assert_array_equal(read.steps, npz["step"])
    np.testing.assert_array_equal(read.times, npz["time"])
    np.testing.assert_array_equal(read.present, there)
    np.testing.assert_array_equal(read.positions[there], npz["position"][there])
    rotation = npz["rotation"] if read.dimension == 2 else np.roll(npz["rotation"], -1, axis=-1)
    np.testing.assert_array_equal(read.rotations[there], rotation[there])
    np.testing.assert_array_equal(read.asleep, npz["asleep"])
    np.testing.assert_array_equal(read.shapes, npz["shape"])
    assert list(read.shape_names) == [name.decode() for name in npz["shape_name"]]
    for name in ("step", "body", "woke", "layer"):
        np.testing.assert_array_equal(read.events[name], npz[f"event_{name}"])
    np.testing.assert_array_equal(read.events["cause"], npz["cause_name"][npz["event_cause"]].astype(str))
    for name in ("step", "point", "normal_force", "friction_force", "kept"):
        np.testing.assert_array_equal(read.contacts[name], npz[f"contact_{name}"])
    np.testing.assert_array_equal(read.contacts["a"], npz["contact_body"][:, 0])
    np.testing.assert_array_equal(read.contacts["b"], npz["contact_body"][:, 1])
    assert len(read.events) > 0 and len(read.contacts) > 0
    assert sum(len(triangles) for _, triangles in read.meshes) == len(npz["mesh_triangle"])


def test_a_body_is_nan_until_it_appears_and_then_is_where_the_run_has_it(tmp_path):
    settings = {"run.frames": 120}
    read = talus.open(record(tmp_path / "run", "drop_in_a_pile_3d", "--set", "run.frames=120"))
    run = talus.Simulation("drop_in_a_pile_3d", set=settings)
    assert not read.present[0].all()
    for frame, step in enumerate(read.steps):
        run.step(int(step) - run.step_count)
        poses = run.poses()
        np.testing.assert_array_equal(read.poses[frame, : len(poses)], poses.astype(np.float32))
        assert np.isnan(read.poses[frame, len(poses):]).all()
        assert not read.asleep[frame, len(poses):].any()
    assert read.reason == "finished"
    assert read.seed == 1
    assert (read.backend, read.policy) == ("bullet", "adaptive")


@pytest.mark.parametrize("scene", ["drop_in_a_pile_2d", "drop_in_a_pile_3d"])
def test_the_forces_at_contacts_are_the_impulses_of_the_run_over_its_step(scene, tmp_path):
    settings = {"run.frames": 90, "run.contacts": True, "policy.kind": "full"}
    options = [word for key in settings for word in ("--set", f"{key}={str(settings[key]).lower()}")]
    read = talus.open(record(tmp_path / "run", scene, *options))
    run = talus.Simulation(scene, set=settings, contacts=True)
    run.step(int(read.steps[-1]))
    there = run.contacts()
    there = there[there["normal_impulse"] > 0]
    told = read.contacts[read.contacts["step"] == read.steps[-1]]
    assert len(there) >= 10
    np.testing.assert_array_equal(told["a"], there["a"])
    np.testing.assert_array_equal(told["b"], there["b"])
    np.testing.assert_array_equal(told["point"], there["point"].astype(np.float32))
    force = there["normal"] * there["normal_impulse"][:, None] / read.dt
    np.testing.assert_allclose(told["normal_force"], force, rtol=1e-5, atol=1e-5)
    np.testing.assert_allclose(told["friction_force"], there["friction_impulse"] / read.dt, rtol=1e-5, atol=1e-5)
    assert not told["kept"].any()


def test_a_run_without_contacts_has_none_in_its_record(tmp_path):
    assert len(talus.open(record(tmp_path / "run", "drop_in_a_pile_2d", "--set", "run.frames=60")).contacts) == 0


def test_the_file_alone_is_enough(tmp_path):
    run = record(tmp_path / "run", "drop_in_a_pile_2d", "--set", "run.frames=30")
    alone = (run / "run.lcm").rename(tmp_path / "alone.lcm")
    assert len(talus.open(alone).steps) == 30
    assert "alone.lcm: 30 frames" in repr(talus.open(str(alone)))


def test_a_removed_body_is_nan_from_then_on(tmp_path):
    event = 'event=[{time=1.0, do="remove", body=[0]}]'
    read = talus.open(record(tmp_path / "run", "drop_in_a_pile_2d", "--set", "run.frames=90", "--set", event))
    there = read.present[:, 0]
    gone = np.flatnonzero(there)[-1] + 1
    assert gone < len(there)
    assert read.times[gone] == pytest.approx(1.0, abs=2 * (read.times[1] - read.times[0]))
    assert not there[gone:].any()


def test_what_is_no_record_is_refused_with_file_and_reason(tmp_path):
    with pytest.raises(FileNotFoundError, match="nowhere"):
        talus.open(tmp_path / "nowhere")
    with pytest.raises(ValueError, match=f"{tmp_path}: must be a folder that `talus run` left"):
        talus.open(tmp_path)
    text = tmp_path / "text.lcm"
    text.write_text("no log at all\n")
    with pytest.raises(ValueError, match="text.lcm.*no event is in its 14 bytes"):
        talus.open(text)


def test_a_damaged_record_is_read_as_far_as_it_can_be_with_a_warning(tmp_path):
    file = record(tmp_path / "run", "drop_in_a_pile_2d", "--set", "run.frames=60") / "run.lcm"
    whole = talus.open(file)
    data = bytearray(file.read_bytes())
    middle = len(data) // 2
    data[middle:middle + 8] = bytes(255 - byte for byte in data[middle:middle + 8])
    file.write_bytes(data)
    with pytest.warns(RuntimeWarning, match="run.lcm: damaged: .*damaged bytes"):
        read = talus.open(file)
    assert "damaged bytes" in read.damage
    assert read.steps[-1] == whole.steps[-1]
    np.testing.assert_array_equal(read.poses[-1], whole.poses[-1])


@pytest.mark.filterwarnings("error")
def test_a_whole_record_gives_no_warning(tmp_path):
    file = record(tmp_path / "run", "drop_in_a_pile_2d", "--set", "run.frames=30")
    assert talus.open(file).damage == ""
