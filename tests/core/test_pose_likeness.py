"""Filling long gaps by alike moments of the same recording."""

from collections.abc import Sequence

import numpy as np
import pytest

from markermend.poses.filling.borders import Borders
from markermend.poses.filling.likeness import (
    Telling,
    by_likeness,
    moments_to_compare,
    moving,
    some_of,
)

RATE, START, STOP = 30.0, 300, 330


def movement(seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """Twelve visible channels, and two that bend with them but on no line."""
    random = np.random.default_rng(seed)
    time = np.arange(900) / RATE
    phase = 2 * np.pi * 0.7 * time + np.cumsum(random.normal(0.0, 0.02, 900))
    waves = np.stack([np.sin(phase), np.cos(phase)], axis=1)
    poses = waves @ random.normal(size=(2, 12))
    return poses, np.stack([np.cos(2 * phase), np.abs(np.sin(phase))], axis=1)


def chosen() -> np.ndarray:
    known = np.ones(900, dtype=bool)
    known[START:STOP] = False
    return moments_to_compare(np.flatnonzero(known), START, STOP, RATE)


def predicted(poses: np.ndarray, hidden: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    frames = chosen()
    weights = np.linalg.lstsq(poses[frames], hidden[frames], rcond=1e-6)[0]
    return filled(poses, np.ones(poses.shape[1]), weights, hidden, frames)


def filled(
    poses: np.ndarray,
    trust: np.ndarray,
    weights: np.ndarray,
    hidden: np.ndarray,
    frames: np.ndarray,
    noise: float = 0.0,
    others: Sequence[Telling] = (),
    borders: Borders | None = None,
) -> tuple[np.ndarray, np.ndarray]:
    moved = moving(np.float32(poses), RATE)[START:STOP]
    given = (np.float32(x) for x in (trust, weights))
    own = telling(poses, hidden, frames)
    return by_likeness(moved, START, own, *given, RATE, noise, others, borders)


def telling(poses: np.ndarray, hidden: np.ndarray, frames: np.ndarray) -> Telling:
    return Telling(moving(np.float32(poses), RATE)[frames], np.float32(hidden[frames]), frames)


def test_movement_that_recurs_is_followed_where_it_bends() -> None:
    poses, hidden = movement()
    found, variance = predicted(poses, hidden)
    off = np.abs(found - hidden[START:STOP])
    straight = np.linspace(hidden[START - 1], hidden[STOP], STOP - START)
    assert off.mean() < 0.05 < 0.3 < np.abs(straight - hidden[START:STOP]).mean()
    assert np.mean(off < 2.0 * np.sqrt(variance)) > 0.9


def test_what_a_limb_has_no_part_in_leads_less_far_astray() -> None:
    poses, hidden = movement()
    hidden = hidden + poses[:, :2]
    others = np.cumsum(np.random.default_rng(7).normal(0.0, 0.4, (900, 12)), axis=0)
    found, _ = predicted(np.hstack([poses, others]), hidden)
    assert np.abs(found - hidden[START:STOP]).mean() < 0.21


def test_a_gap_is_entered_and_left_at_the_speed_beside_it() -> None:
    poses, _ = movement()
    path = np.sin(np.arange(900) / 23.0)[:, None]
    found, _ = predicted(poses * 1e-3, path)
    off = np.abs(found - path[START:STOP])
    assert max(off[:3].max(), off[-3:].max()) < 0.12


def test_noise_of_what_was_seen_is_not_carried_on() -> None:
    poses, hidden = movement()
    frames = chosen()
    noisy = hidden + np.random.default_rng(8).normal(0.0, 0.1, hidden.shape)
    weights = np.zeros((12, 2))
    off = [
        np.abs(
            filled(poses, np.ones(12), weights, noisy, frames, noise)[0] - hidden[START:STOP]
        ).mean()
        for noise in (0.0, 0.1)
    ]
    assert off[1] < 0.8 * off[0]


def test_what_nothing_tells_meets_the_sides_and_is_unsure_between() -> None:
    poses, _ = movement()
    wander = np.cumsum(np.random.default_rng(5).normal(0.0, 0.1, (900, 1)), axis=0)
    found, variance = predicted(poses, wander)
    assert abs(found[0] - wander[START - 1]) < 0.5 * wander.std()
    assert variance[15, 0] > 2.0 * variance[0, 0]


def test_channels_without_trust_have_no_part() -> None:
    poses, hidden = movement()
    frames, spoilt = chosen(), poses.copy()
    spoilt[:, 3] = np.random.default_rng(6).normal(0.0, 1e3, 900)
    trust = (np.arange(12) != 3).astype(float)
    weights = trust[:, None] * np.ones((12, 2))
    results = [filled(body, trust, weights, hidden, frames)[0] for body in (poses, spoilt)]
    assert results[1] == pytest.approx(results[0])


def test_the_other_side_tells_of_movement_that_this_side_did_not_show() -> None:
    poses, hidden = movement()
    frames, elsewhere = np.r_[START - 15 : START, STOP : STOP + 15], np.arange(0, 250, 3)
    off = {}
    both = telling(poses, hidden, elsewhere)
    aslant = telling(poses, hidden + np.array([0.8, -0.5]), elsewhere)
    for name, others in (
        ("alone", []),
        ("both", [both]),
        ("aslant", [aslant]),
        ("each aslant", [both, aslant]),
    ):
        found, variance = filled(
            poses, np.ones(12), np.zeros((12, 2)), hidden, frames, others=others
        )
        off[name] = float(np.abs(found - hidden[START:STOP]).mean())
        assert np.all(variance > 0)
    assert off["both"] < 0.7 * off["alone"]
    # That it is carried a little differently does not matter.
    assert off["aslant"] < 1.3 * off["both"]
    assert off["each aslant"] < 1.3 * off["both"]


def test_where_a_limb_was_before_tells_which_way_it_goes() -> None:
    # The body shows when it moves, not which of two ways; that the limb itself shows beside it.
    time = np.arange(900)
    swing = np.sin(2 * np.pi * time / 60.0)
    way = np.repeat(np.random.default_rng(3).choice([-1.0, 1.0], 15), 60)
    poses = np.stack([swing, np.cos(2 * np.pi * time / 60.0)], axis=1) @ np.ones((2, 12))
    poses += np.outer(np.cos(2 * np.pi * time / 60.0), np.arange(12))
    hidden = (way * (1.5 + np.abs(swing)))[:, None]
    frames, off = chosen(), {}
    for name in ("alone", "beside"):
        path = np.float32(hidden)
        path[START:STOP] = 0.0
        borders = Borders(path, START, STOP, RATE) if name == "beside" else None
        found, variance = filled(
            poses, np.ones(12), np.zeros((12, 1)), hidden, frames, borders=borders
        )
        off[name] = float(np.abs(found - hidden[START:STOP]).mean())
        assert np.all(variance >= 0)
    assert off["beside"] < 0.8 * off["alone"]


@pytest.mark.parametrize("gap", [(0, 40), (300, 301), (300, 345), (860, 900)])
def test_every_frame_of_a_gap_is_told_from_places_that_count_for_one(gap: tuple[int, int]) -> None:
    path = np.float32(np.random.default_rng(4).normal(size=(900, 3)))
    borders = Borders(path, *gap, RATE)
    whole, frames = np.zeros(gap[1] - gap[0]), np.array([5, 500, 895])
    for place, part, share in borders.looks():
        whole[part] += share
        others = [(frames, path), (frames[:2], path[:100])]
        (places, much), (speeds, little) = borders.views(place, frames, others)
        sides = int(gap[0] > 0) + int(gap[1] < 900)
        assert places.shape == speeds.shape == (9, 3 * sides)
        assert 0 < little < much <= 1.0
        assert not np.isnan(places).any()
    assert whole == pytest.approx(1.0)


def test_what_a_gap_hides_is_not_looked_at() -> None:
    path = np.zeros((900, 1), dtype=np.float32)
    path[START:STOP] = np.nan
    borders = Borders(path, START, STOP, RATE)
    frames = np.r_[0:START, STOP:900]
    for place, *_ in borders.looks():
        places, _ = borders.views(place, frames, [])[0]
        assert not np.isnan(places).any()


def test_moments_are_some_of_those_there_are() -> None:
    there = np.flatnonzero(np.arange(900) % 3 > 0)
    assert set(some_of(there, 100)) <= set(there)
    assert 50 < len(some_of(there, 100)) <= 100
    assert list(some_of(there[:4], 100)) == list(there[:4])
    assert not len(some_of(there[:0], 100))


def test_moments_are_known_ones_and_enough() -> None:
    known = np.ones(900, dtype=bool)
    known[START:STOP] = known[500:600] = False
    frames = moments_to_compare(np.flatnonzero(known), START, STOP, RATE)
    assert known[frames].all()
    assert {START - 1, START - 2, STOP, STOP + 1} <= set(frames.tolist())
    assert not len(moments_to_compare(np.arange(20), 20, 900, RATE))
