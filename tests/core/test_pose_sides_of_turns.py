"""Of q and -q the one that like rotations elsewhere in a recording have."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_array_equal
from scipy.spatial.transform import Rotation

from markermend.poses.quaternion import unrolled
from markermend.poses.sides_of_turns import on_one_side

FRAMES = 400


def waved(hidden=slice(0)):
    """(frames, 1, 4) a joint that waves to and fro by 200 degrees about x."""
    angle = 100.0 * np.sin(np.arange(FRAMES) / 30.0)
    q = Rotation.from_euler("x", angle[:, None], degrees=True).as_quat()[:, None]
    q[hidden] = np.nan
    return q


def on_the_side_of(truth, q):
    """Whether all that are known have the sign of the truth, or all of them the other."""
    known = ~np.isnan(q[:, 0, 3])
    return len(set(np.sum(q * truth, axis=2)[known, 0] > 0)) == 1


def test_after_what_was_not_seen_like_rotations_are_alike():
    truth = unrolled(waved())
    # Gone while it turns from one end to the other, so that the nearer sign is the wrong one.
    given = waved(slice(50, 140))
    assert not on_the_side_of(truth, unrolled(given))
    assert on_the_side_of(truth, on_one_side(given))


def test_what_turns_over_for_a_moment_turns_nothing_after_it():
    q = waved()
    about = np.linspace(170, 190, 5)[:, None]
    over = Rotation.from_quat(q[200:205, 0]) * Rotation.from_euler("z", about, degrees=True)
    q[200:205, 0] = over.as_quat()
    truth = unrolled(waved())
    over_and_back = np.r_[:200, 205:FRAMES]
    assert not on_the_side_of(truth[over_and_back], unrolled(q)[over_and_back])
    assert on_the_side_of(truth[over_and_back], on_one_side(q)[over_and_back])


def test_what_follows_from_the_frame_before_stays_and_nan_passes():
    q = waved(slice(100, 103))
    assert_array_equal(on_one_side(q), unrolled(q))
    never = np.full((5, 1, 4), np.nan)
    assert np.isnan(on_one_side(never)).all()
