"""Frames to learn from: beside the interval, evenly spaced, and most alike."""

from __future__ import annotations

import numpy as np

from markermend.artifact import Artifact, Kind
from markermend.repairs.training_frames import choose_frames, near_interval

FRAMES, RATE = 1000, 100.0
GAP = Artifact("A", "xyz", 500, 560, Kind.GAP)


def chosen(alike: int, even: int = 20) -> np.ndarray:
    """Four references, of which one bends away in the gap and in frames 100 to 140 only."""
    positions = np.random.default_rng(0).normal(0, 0.1, (FRAMES, 4, 3))
    positions += np.array([[0, 0, 0], [100, 0, 0], [0, 100, 0], [0, 0, 100]])
    positions[500:560, 3] += 40.0
    positions[100:140, 3] += 40.0
    usable = np.ones(FRAMES, dtype=bool)
    usable[500:560] = usable[120:124] = False
    near = near_interval(FRAMES, GAP, 50)
    return choose_frames(usable, near, GAP, RATE, positions, np.arange(4), even=even, alike=alike)


def test_frames_in_which_the_body_is_as_in_the_interval_are_added() -> None:
    rare = np.arange(100, 140)
    without, with_them = chosen(0), chosen(48)
    assert np.isin(without, rare).sum() <= 1
    added = np.setdiff1d(with_them, without)
    assert len(added) > 0
    # Every fourth frame is looked at, and 120 is not usable.
    assert np.isin(rare[::4], [*with_them, 120]).all()
    assert np.isin(without, with_them).all()


def test_only_usable_frames_are_chosen_each_once_in_order() -> None:
    frames = chosen(48)
    assert (np.diff(frames) > 0).all()
    assert not np.isin(frames, [*range(500, 560), *range(120, 124)]).any()


def test_every_frame_beside_the_interval_is_learnt_from() -> None:
    frames = chosen(0)
    assert np.isin([*range(490, 500), *range(560, 570)], frames).all()
    assert 18 <= ((frames < 450) | (frames >= 610)).sum() <= 24
