"""A sleeper in an engine of balls that is written in NumPy."""


import copy
import gc
import os
import weakref
from pathlib import Path

import numpy as np
import pytest
import talus

DT = 1 / 120
RADIUS = 0.5


class Balls:
    """Balls of 1 kg that do not turn, above the ground at height 0, by sequential impulses without restitution.

    A sleeping ball has no inverse mass. `up`: number of the axis that is up.
    """

    def __init__(self, sleeper, up=-1):
        self.sleeper = sleeper
        self.dimension = sleeper.dimension
        self.up = np.eye(self.dimension)[up]
        self.gravity = -9.81 * self.up
        self.position = np.empty((0, self.dimension))
        self.velocity = np.empty((0, self.dimension))
        self.movable = np.empty(0, bool)
        self.handle = np.empty(0, np.int64)
        self.log = []  # of all changes: time, name of the list, body, cause
        self.time = 0.0

    def pose(self, position):
        turn = [0.0] if self.dimension == 2 else [0.0, 0.0, 0.0, 1.0]
        return np.concatenate([position, turn])

    def poses(self, balls):
        return np.array([self.pose(self.position[ball]) for ball in balls])

    def add(self, position, **traits):
        self.position = np.vstack([self.position, position])
        self.velocity = np.vstack([self.velocity, np.zeros(self.dimension)])
        self.movable = np.append(self.movable, True)
        handle = self.sleeper.add(self.pose(position), mass=1.0, radius=RADIUS, **traits)
        self.handle = np.append(self.handle, handle)
        return handle

    def remove(self, handle):
        keep = self.handle != handle
        for name in ("position", "velocity", "movable", "handle"):
            setattr(self, name, getattr(self, name)[keep])
        self.do(self.sleeper.remove(handle))

    def index(self, handle):
        return int(np.flatnonzero(self.handle == handle)[0])

    def do(self, changes):
        for body, cause in changes.thaw:
            self.movable[self.index(body)] = True
            self.log.append((self.time, "thaw", body, cause))
        for body, velocity, spin, cause in changes.velocities:
            self.velocity[self.index(body)] = velocity
        for body, cause in changes.freeze:
            self.movable[self.index(body)] = False
            self.velocity[self.index(body)] = 0
            self.log.append((self.time, "freeze", body, cause))

    def touching(self):
        """Pairs (a, b, normal from b to a, depth); b = -1: the ground."""
        height = self.position @ self.up
        for a in np.flatnonzero(self.movable & (height < RADIUS)):
            yield a, -1, self.up, RADIUS - height[a]
        for a in range(len(self.position)):
            for b in range(a):
                away = self.position[a] - self.position[b]
                distance = np.linalg.norm(away)
                if distance < 2 * RADIUS and (self.movable[a] or self.movable[b]):
                    yield a, b, away / distance, 2 * RADIUS - distance

    def engine_step(self):
        """Returns the contacts."""
        self.velocity[self.movable] += DT * self.gravity
        pairs = list(self.touching())
        before = self.velocity.copy()
        impulse = np.zeros(len(pairs))
        share = np.append(self.movable.astype(float), 0.0)  # inverse masses, the ground's last
        velocity = np.vstack([self.velocity, np.zeros(self.dimension)])
        for _ in range(30):
            for k, (a, b, normal, depth) in enumerate(pairs):
                closing = -(velocity[a] - velocity[b]) @ normal + 0.1 / DT * max(0.0, depth - 0.002)
                more = max(-impulse[k], closing / (share[a] + share[b]))
                impulse[k] += more
                velocity[a] += share[a] * more * normal
                velocity[b] -= share[b] * more * normal
        self.velocity = velocity[:-1]
        self.position = self.position + DT * self.velocity
        self.time += DT
        before = np.vstack([before, np.zeros(self.dimension)])
        contacts = np.zeros(len(pairs), self.sleeper.contact_dtype)
        for contact, (a, b, normal, depth), strength in zip(contacts, pairs, impulse):
            contact["a"] = self.handle[a]
            contact["b"] = self.handle[b] if b >= 0 else 0
            contact["point"] = self.position[a] - RADIUS * normal
            contact["normal"] = normal
            contact["normal_impulse"] = strength
            contact["approach_speed"] = max(0.0, -(before[a] - before[b]) @ normal)
            contact["depth"] = depth
        return contacts

    def step(self, count=1):
        for _ in range(count):
            contacts = self.engine_step()
            bodies = self.sleeper.followed()
            balls = [self.index(body) for body in bodies]
            poses = self.poses(balls).reshape(len(balls), 3 if self.dimension == 2 else 7)
            spins = np.zeros((len(balls), 1 if self.dimension == 2 else 3))
            self.do(self.sleeper.step(DT, bodies, poses, self.velocity[balls], spins, contacts))


@pytest.fixture(params=[talus.PileSleeper2D, talus.PileSleeper3D])
def sleeper(request):
    return request.param()


def at(dimension, x, height):
    return np.array([x, height] if dimension == 2 else [x, 0.0, height])


def tower(sleeper, balls=3):
    engine = Balls(sleeper)
    for k in range(balls):
        engine.add(at(engine.dimension, 0.0, RADIUS * (1 + 2 * k)))
    engine.step(240)
    return engine


def test_balls_that_drop_on_the_ground_fall_asleep_there_once_they_rest(sleeper):
    engine = Balls(sleeper)
    heights = np.arange(1, 6)
    for k in heights:
        engine.add(at(engine.dimension, 3.0 * k, RADIUS + k))
    while sleeper.awake and engine.time < 10:
        engine.step()
    assert sleeper.awake == 0
    np.testing.assert_allclose(engine.position @ engine.up, RADIUS, atol=0.02)
    asleep_at = {body: time for time, kind, body, _ in engine.log if kind == "freeze"}
    for handle, height in zip(engine.handle, heights):
        fall = np.sqrt(2 * height / 9.81)  # of free fall
        assert asleep_at[handle] > fall
        assert asleep_at[handle] < fall + 0.5
    assert {cause for _, kind, _, cause in engine.log if kind == "freeze"} == {"rest"}


def test_a_sleeping_ball_stays_where_it_is_and_is_no_longer_followed(sleeper):
    engine = tower(sleeper)
    assert not engine.movable.any()
    assert len(sleeper.followed()) == 0
    before = engine.position.copy()
    engine.step(60)
    np.testing.assert_array_equal(engine.position, before)


def test_without_their_support_sleeping_balls_wake_and_fall(sleeper):
    engine = tower(sleeper)
    lowest, *others = (int(handle) for handle in engine.handle)
    started = engine.time
    engine.remove(lowest)
    thawed = {(body, cause) for time, kind, body, cause in engine.log if kind == "thaw" and time >= started}
    assert (others[0], "lost support") in thawed
    assert lowest not in sleeper
    assert len(sleeper) == 2
    engine.step(360)
    np.testing.assert_allclose(engine.position @ engine.up, [RADIUS, 3 * RADIUS], atol=0.03)
    assert sleeper.awake == 0


def test_a_fast_ball_wakes_the_one_that_it_hits(sleeper):
    engine = tower(sleeper, balls=1)
    struck = int(engine.handle[0])
    assert sleeper.asleep(struck)
    engine.add(at(engine.dimension, -2.0, RADIUS + 0.01))
    engine.velocity[-1, 0] = 8.0
    engine.step(40)
    assert (struck, "momentum") in [(body, cause) for _, kind, body, cause in engine.log if kind == "thaw"]
    assert engine.position[0, 0] > 0.5


def test_a_ball_that_the_program_moves_or_kicks_is_woken_before(sleeper):
    engine = tower(sleeper, balls=1)
    ball = int(engine.handle[0])
    changes = sleeper.wake(ball)
    assert changes.thaw == [(ball, "user")]
    assert (changes.velocities, changes.freeze) == ([], [])
    assert sleeper.wake(ball).thaw == []
    engine.do(changes)
    engine.velocity[0, 0] = 1.0
    engine.step(60)
    assert engine.position[0, 0] == pytest.approx(0.5, abs=1e-9)  # no friction in this engine
    engine.velocity[0] = 0
    engine.step(120)
    assert sleeper.asleep(ball)
    engine.position[0] = at(engine.dimension, 5.0, 2.0)
    engine.do(sleeper.moved(ball, engine.pose(engine.position[0])))
    engine.step(240)
    np.testing.assert_allclose(engine.position[0] @ engine.up, RADIUS, atol=0.02)


def test_a_body_that_stays_awake_never_sleeps():
    sleeper = talus.PileSleeper3D()
    engine = Balls(sleeper)
    engine.add(at(3, 0.0, RADIUS), role="stays_awake")
    engine.step(240)
    assert sleeper.awake == 1
    sleeper.set_role(int(engine.handle[0]), "sleeps")
    engine.step(240)
    assert sleeper.awake == 0


def test_a_restored_sleeper_sleeps_as_the_saved_one_in_new_bodies_too(sleeper):
    engine = tower(sleeper)
    engine.add(at(engine.dimension, 5.0, 4.0))
    engine.step()
    saved = sleeper.snapshot()
    assert saved["asleep"].tolist() == [True, True, True, False]
    again = Balls(type(sleeper)())
    for position in engine.position:
        again.add(position)
    saved["body"] = again.handle
    again.do(again.sleeper.restore(saved, again.poses(range(4))))
    assert again.movable.tolist() == [False, False, False, True]
    assert again.sleeper.awake == 1


def test_an_observed_sleeper_leaves_a_record_of_its_bodies(sleeper, tmp_path):
    path = tmp_path / "balls.lcm"
    sleeper.observe(path, name="balls", engine="numpy", dt=DT, frame_rate=60)
    engine = tower(sleeper)
    sleeper.end_observers()
    record = talus.open(path)
    assert len(record.steps) == 121  # each second step, and the start
    np.testing.assert_allclose(record.positions[-1], engine.position, atol=1e-5)
    assert record.asleep[-1].all()
    with pytest.raises(ValueError, match="no character 0"):
        sleeper.observe(tmp_path / "zero.lcm", name="a\0b")
    with pytest.raises(OSError):
        sleeper.observe(tmp_path / "no" / "folder.lcm")
    with pytest.raises(ValueError, match="enabled"):
        type(sleeper)(enabled=False).observe(tmp_path / "off.lcm")


def test_a_body_that_gets_through_another_is_reported(sleeper):
    reports = []
    sleeper.observe(report=lambda *report: reports.append(report))
    engine = Balls(sleeper)
    engine.add(at(engine.dimension, 0.0, 5.0))
    flying = engine.add(at(engine.dimension, -3.0, 5.0))
    velocity, spin = engine.velocity, np.zeros((2, 1 if engine.dimension == 2 else 3))
    for x in (-3.0, 3.0):
        engine.position[1] = at(engine.dimension, x, 5.0)
        sleeper.step(DT, engine.handle, engine.poses(range(2)), velocity, spin)
    assert [report[:3] for report in reports] == [("passed", flying, 6.0)]
    assert "body" in reports[0][3]


def test_a_report_cannot_change_the_sleeper_that_runs_it(sleeper, tmp_path):
    engine = Balls(sleeper)
    ball = engine.add(at(engine.dimension, 0.0, 5.0))
    pose = engine.pose(engine.position[0])
    refused = []

    def report(kind, body, value, text):
        for call in (
            sleeper.end_observers,
            lambda: sleeper.observe(tmp_path / "inner.lcm"),
            lambda: sleeper.add(pose, mass=1, radius=1),
            lambda: sleeper.remove(ball),
            sleeper.wake_all,
        ):
            with pytest.raises(ValueError, match="call = by an observer: must come after the step"):
                call()
            refused.append(call)

    sleeper.observe(report=report)
    engine.position[0] = at(engine.dimension, 1e9, 5.0)
    engine.step(2)
    assert len(refused) == 5
    sleeper.observe(report=report)  # of what is there already
    assert len(refused) == 10
    assert len(sleeper) == 1
    sleeper.end_observers()


def test_numbers_of_records_and_reports_name_bodies(sleeper):
    engine = Balls(sleeper)
    engine.add(at(engine.dimension, 0.0, 5.0), role="kinematic")
    handles = [engine.add(at(engine.dimension, 3.0 * k, 5.0)) for k in (1, 2)]
    assert [sleeper.handle_of(number) for number in (0, 1)] == handles
    engine.remove(handles[0])
    for none in (0, 2, -1):
        with pytest.raises(ValueError, match=f"body = {none}: must be the number of a body that is there"):
            sleeper.handle_of(none)
    later = engine.add(at(engine.dimension, 9.0, 5.0))
    assert sleeper.handle_of(0) == later


def test_a_sleeper_ends_though_its_report_refers_to_it(sleeper):
    def watched():
        own = type(sleeper)()
        own.observe(report=lambda *warning: own.wake_all())
        return weakref.ref(own)

    ended = watched()
    gc.collect()
    assert ended() is None


def test_a_block_ends_the_observers(tmp_path):
    path = Path(os.fsdecode(os.fsencode(tmp_path) + b"/\xff.lcm"))  # no UTF-8
    with talus.PileSleeper2D() as sleeper:
        sleeper.observe(path)
        tower(sleeper)
    assert talus.open(path).reason == "finished"


def test_a_sleeper_is_not_copied(sleeper):
    for call in (copy.copy, copy.deepcopy):
        with pytest.raises(TypeError, match="a sleeper cannot be copied"):
            call(sleeper)


def test_empty_lists_are_a_step_without_bodies(sleeper):
    for empty in ([], np.empty((0, 5)), np.empty(0, np.float32)):
        assert sleeper.step(DT, empty, empty, empty, empty, []) == ([], [], [])
    assert sleeper.restore(sleeper.snapshot(), []) == ([], [], [])


def test_what_a_report_raises_comes_out_of_the_next_step(sleeper):
    def stop(kind, body, value, text):
        raise InterruptedError(text)

    sleeper.observe(report=stop)
    engine = Balls(sleeper)
    engine.add(at(engine.dimension, 1e9, 5.0))
    engine.step()
    with pytest.raises(InterruptedError, match="body 0"):
        engine.step()
    engine.step()


def test_another_axis_may_be_up():
    sleeper = talus.PileSleeper3D(gravity=(0, -9.81, 0))
    engine = Balls(sleeper, up=1)
    for k in range(3):
        engine.add([0.0, RADIUS * (1 + 2 * k), 0.0])
    engine.step(240)
    usual = tower(talus.PileSleeper3D())
    assert engine.log == usual.log


def test_a_sleeper_that_is_disabled_changes_nothing():
    sleeper = talus.PileSleeper3D(enabled=False)
    engine = tower(sleeper)
    assert engine.log == []
    assert len(sleeper.followed()) == 0


def test_bodies_of_any_form_are_added():
    sleeper = talus.PileSleeper3D()
    pose = [0, 0, 0, 0, 0, 0, 1]
    bounds = [[-1, -1, -1], [1, 1, 1]]
    handles = {
        sleeper.add(pose, mass=1, size=(1, 2, 3), friction=0.3),
        sleeper.add(pose, mass=1, radius=1, role="kinematic"),
        sleeper.add(pose, mass=1, bounds=bounds, inertia=(0.4, 0.4, 0.4)),
        sleeper.add(pose, mass=1, bounds=bounds, inertia=0.4 * np.eye(3)),
    }
    assert len(handles) == 4
    assert set(sleeper.followed().tolist()) == handles
    flat = talus.PileSleeper2D()
    assert flat.add([0, 0, 0], mass=1, bounds=[[-1, -1], [1, 1]], inertia=0.5) in flat


def test_bad_input_is_an_error_with_field_and_value_and_changes_nothing():
    sleeper = talus.PileSleeper3D()
    pose = np.array([0, 0, 1, 0, 0, 0, 1.0])
    ball = sleeper.add(pose, mass=1, radius=0.5)
    state = ([ball], [pose], [[0, 0, 0]], [[0, 0, 0]])
    wrong = np.zeros(1, sleeper.contact_dtype)
    wrong["a"] = ball + 1
    for message, call in (
        ("pose.shape = \\(3,\\)", lambda: sleeper.add([0, 0, 1], mass=1, radius=0.5)),
        ("quaternion", lambda: sleeper.add([0, 0, 1, 0, 0, 0, 2], mass=1, radius=0.5)),
        ("mass", lambda: sleeper.add(pose, mass=-1, radius=0.5)),
        ("form", lambda: sleeper.add(pose, mass=1)),
        ("inertia", lambda: sleeper.add(pose, mass=1, bounds=[[-1, -1, -1], [1, 1, 1]], inertia=(-1, -1, 1))),
        ("role = tired", lambda: sleeper.add(pose, mass=1, radius=0.5, role="tired")),
        ("dt = -1", lambda: sleeper.step(-1, *state)),
        ("velocities.shape", lambda: sleeper.step(DT, [ball], [pose], [[0, 0]], [[0, 0, 0]])),
        ("spins.shape", lambda: sleeper.step(DT, [ball], [pose], [[0, 0, 0]], [[0], [0], [0]])),
        ("spins", lambda: sleeper.step(DT, [ball], [pose], [[0, 0, 0]], [0, 0, 0])),
        ("see followed", lambda: sleeper.step(DT, [], np.empty((0, 7)), np.empty((0, 3)), np.empty((0, 3)))),
        ("contact.a", lambda: sleeper.step(DT, *state, wrong)),
        ("body", lambda: sleeper.remove(ball + 1)),
        ("up = north", lambda: talus.PileSleeper3D(up="north")),
        ("extent = 0", lambda: talus.PileSleeper3D(extent=0)),
    ):
        with pytest.raises(ValueError, match=message):
            call()
    with pytest.raises(TypeError, match="contact_dtype"):
        sleeper.step(DT, *state, np.zeros((1, 3)))
    assert len(sleeper) == 1
    for number in (ball + 1, -1, 2**63, -(2**70)):
        assert number not in sleeper
    sleeper.step(DT, *state)


def test_the_first_number_that_is_out_of_range_is_named():
    sleeper = talus.PileSleeper3D()
    pose = np.array([0, 0, 1, 0, 0, 0, 1.0])
    ball = sleeper.add(pose, mass=1, radius=0.5)
    nan, inf = np.nan, np.inf

    def add(low, high, inertia=(1, 1, 1)):
        sleeper.add(pose, mass=1, bounds=[low, high], inertia=inertia)

    def step(poses=pose, velocity=(0, 0, 0), spin=(0, 0, 0), **contact):
        contacts = np.zeros(1, sleeper.contact_dtype)
        contacts["a"] = ball
        contacts["normal"] = (0, 0, 1)
        for name, value in contact.items():
            contacts[name] = value
        sleeper.step(DT, [ball], [poses], [velocity], [spin], contacts)

    for message, call in (
        ("pose.position[1] = nan", lambda: sleeper.add([0, nan, 0, 0, 0, 0, 1], mass=1, radius=1)),
        ("pose.rotation length = 2", lambda: sleeper.moved(ball, [0, 0, 0, 0, 0, 0, 2])),
        ("bounds.low[2] = nan", lambda: add([-1, -1, nan], [1, 1, 1])),
        ("bounds.high[0] = inf", lambda: add([-1, -1, -1], [inf, 1, 1])),
        ("bounds.low[1] = 0.5: must be at most 0", lambda: add([-1, 0.5, -1], [1, 1, 1])),
        ("bounds.high[2] = -0.5: must be at least 0", lambda: add([-1, -1, -1], [1, 1, -0.5])),
        ("inertia[4] = inf", lambda: add([-1, -1, -1], [1, 1, 1], (1, inf, 1))),
        ("gravity[2] = nan", lambda: talus.PileSleeper3D([0, 0, nan])),
        ("gravity[0] = -inf", lambda: sleeper.set_gravity([-inf, 0, 0])),
        ("box.high[1] = nan", lambda: sleeper.wake_near([0, 0, 0], [1, nan, 1])),
        ("poses[0].position[0] = inf", lambda: step(poses=[inf, 0, 0, 0, 0, 0, 1])),
        ("velocities[0][2] = nan", lambda: step(velocity=(0, 0, nan))),
        ("spins[0][1] = inf", lambda: step(spin=(0, inf, 0))),
        ("contacts[0].point[1] = nan", lambda: step(point=(0, nan, 0))),
        ("contacts[0].normal[2] = nan", lambda: step(normal=(0, 0, nan))),
        ("contacts[0].normal length = 0", lambda: step(normal=(0, 0, 0))),
        ("contacts[0].normal length = 2", lambda: step(normal=(0, 0, 2))),
        ("contacts[0].normal_impulse = -1", lambda: step(normal_impulse=-1)),
        ("contacts[0].friction_impulse[0] = nan", lambda: step(friction_impulse=(nan, 0, 0))),
        ("contacts[0].approach_speed = -0.5", lambda: step(approach_speed=-0.5)),
        ("contacts[0].depth = nan", lambda: step(depth=nan)),
    ):
        with pytest.raises(ValueError) as caught:
            call()
        assert str(caught.value).startswith(message)
    step(normal=(0, 0, 1.005), depth=-0.01)


def test_a_body_is_restored_once():
    sleeper = tower(talus.PileSleeper3D()).sleeper
    twice = sleeper.snapshot()[[0, 1, 0]]
    with pytest.raises(ValueError, match="must be there once"):
        sleeper.restore(twice, np.tile([0, 0, 0, 0, 0, 0, 1.0], (3, 1)))
    assert sleeper.awake == 0
