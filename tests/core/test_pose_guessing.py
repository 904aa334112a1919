"""Joints that a sensor guessed: believed where the rest of the body agrees."""

from __future__ import annotations

import numpy as np
import pytest

import markermend as mm
from markermend.poses.faults.finding import GUESSED
from markermend.poses.faults.guessing import INFERRED, guessed
from markermend.poses.nuitrack import to_nuitrack
from markermend.poses.prior import shipped_prior
from markermend.poses.restore import restore

ARM = ("left_elbow", "left_wrist")
ROWS = slice(200, 260)


@pytest.fixture(scope="module")
def truth(shared_data):
    whole = to_nuitrack(mm.read_pose(shared_data / "poses" / "02_05.amc"))
    return whole.with_samples(whole.positions[:480], whole.rotations[:480])


def guessing(pose, off_mm, rows=ROWS, confidence=INFERRED):
    positions, sure = pose.positions.copy(), np.ones(pose.confidence.shape)
    for name in ARM:
        joint = pose.index(name)
        positions[rows, joint] += [off_mm, 0.0, 0.0]
        sure[rows, joint] = confidence
    return pose.with_samples(positions, pose.rotations, sure)


def away(restored, truth):
    arm = [truth.index(name) for name in ARM]
    off = restored.pose.positions - truth.positions
    return np.sqrt(np.sum(off[ROWS][:, arm] ** 2, axis=2))


def test_a_wrong_guess_is_filled_and_told(truth):
    given = guessing(truth, 150.0)
    restored = restore(given, prior=shipped_prior())
    told = {truth.joints[f.joint] for f in restored.faults if f.kind == GUESSED}
    assert told == set(ARM)
    assert all(ROWS.start <= f.start < f.stop <= ROWS.stop for f in restored.faults)
    assert away(restored, truth).mean() < 30.0
    assert restored.filled[ROWS][:, truth.index("left_wrist")].all()
    hidden = restore(guessing(truth, 150.0, confidence=0.0), prior=shipped_prior())
    # Bodies settle in single precision.
    np.testing.assert_allclose(restored.pose.positions, hidden.pose.positions, atol=0.02)


def test_a_right_guess_stays_and_is_as_doubtful_as_a_filled_joint(truth):
    given = guessing(truth, 0.0)
    restored = restore(given, prior=shipped_prior())
    assert not restored.faults
    assert away(restored, truth).max() < 1e-6
    wrist = truth.index("left_wrist")
    assert (restored.pose.confidence[ROWS, wrist] == INFERRED).all()
    assert (restored.pose.confidence[: ROWS.start] == 1.0).all()
    assert np.median(restored.error_mm[ROWS, wrist]) > 1.0
    assert restored.error_mm[ROWS.start - 20, wrist] < 0.1


def test_what_was_worked_out_is_taken_for_what_it_is(truth):
    hidden = guessing(truth, 0.0, confidence=0.0)
    once = restore(hidden, prior=shipped_prior()).pose
    twice = restore(once, prior=shipped_prior())
    assert not twice.faults
    np.testing.assert_allclose(twice.pose.positions, once.positions, atol=0.5)


def test_what_is_mostly_guessed_is_not_judged(truth):
    given = guessing(truth, 40.0, rows=slice(0, round(0.8 * truth.frames)))
    assert not guessed(given).any()
    assert guessed(guessing(truth, 0.0)).sum() == 2 * (ROWS.stop - ROWS.start)
