"""Of all ways to change places back and forth the cheapest is found."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

from markermend.poses.faults.exchanging import cheapest


@pytest.mark.parametrize("seed", range(60))
def test_no_other_way_to_change_places_is_cheaper(seed: int) -> None:
    random = np.random.default_rng(seed)
    frames = int(random.integers(1, 9))
    cost, change = random.random((frames, 2)), float(random.choice([0.0, 0.3, 1.0]))
    straight = random.random(frames - 1)
    # To change may be cheaper than to stay, change and all.
    across = random.random(frames - 1) * random.choice([0.2, 1.0, 3.0])

    def whole(state: np.ndarray) -> float:
        changes = state[1:] != state[:-1]
        steps = np.where(changes, across + change, straight)
        return float(cost[np.arange(frames), state.astype(int)].sum() + steps.sum())

    ways = [np.array(way, dtype=bool) for way in product([False, True], repeat=frames)]
    found = cheapest(cost, straight, across, change)
    assert whole(found) == pytest.approx(min(map(whole, ways)))


def test_where_nothing_tells_nobody_changed_places() -> None:
    assert not cheapest(np.ones((5, 2)), np.ones(4), np.ones(4), 0.1).any()
