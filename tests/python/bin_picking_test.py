"""Parts taken out of a bin."""

import numpy as np
import pytest
import talus

PARTS = 60
BIN = """
title = "Parts in a bin"
dimension = 3
world = {gravity = 98.1, steps_per_second = 240}
obstacle = [{kind = "container", inner_size = [2.0, 2.0, 3.0], wall = 0.5}]
shape.part = {kind = "box", size = [0.6, 0.4, 0.2]}
source = [{count = 60, rate = 17, position = [0, 0, 4], spread = [0.5, 0.5, 0], velocity = [0, 0, -10], ride_above = 3}]
"""


def test_begins_with_settled_parts_that_follow_from_the_seed():
    first, info = talus.BinPicking(BIN, PARTS).reset(seed=1)
    again, _ = talus.BinPicking(BIN, PARTS).reset(seed=1)
    other, _ = talus.BinPicking(BIN, PARTS).reset(seed=2)
    assert info["settled"]
    assert first["asleep"].all() and first["present"].all()
    np.testing.assert_array_equal(first["poses"], again["poses"])
    assert not np.array_equal(first["poses"], other["poses"])


def test_the_parts_above_come_down_when_those_below_are_taken_out():
    env = talus.BinPicking(BIN, PARTS)
    start, _ = env.reset(seed=1)
    upper = int(np.argmax(start["poses"][:, 2]))
    for part in np.argsort(start["poses"][:, 2])[:-1]:
        parts, reward, terminated, truncated, _ = env.step(part)
        assert (reward, terminated, truncated) == (1.0, False, False)
        assert not parts["present"][part]
    assert parts["poses"][upper, 2] < start["poses"][upper, 2] - 0.1
    assert env.step(upper)[2]


def test_gives_no_reward_for_a_part_that_is_not_there():
    env = talus.BinPicking(BIN, PARTS)
    with pytest.raises(ValueError):
        env.step(0)
    env.reset(seed=1)
    env.step(3)
    for missing in (3, PARTS, -1):
        _, reward, _, _, info = env.step(missing)
        assert (reward, info["moved"].max()) == (0.0, 0.0)
