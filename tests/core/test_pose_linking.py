"""Joints that were not seen, where rigid links to those around them say."""

from __future__ import annotations

import numpy as np
import pytest
from arms import hide
from scipy.spatial.transform import Rotation

import markermend as mm
from markermend.poses.filling.linking import linked
from markermend.poses.quaternion import lengths_of, turn
from markermend.poses.restore import restore

FRAMES, PARENTS = 60, (-1, 0, 1, 2)
GAP = slice(20, 30)
OFFSET = np.array([0.1, 1.0, -0.2])


def chain(by_parent: bool, moving: slice = slice(None)):
    """A chain of four joints whose offsets are fixed in parents' axes, or else in their own."""
    random = np.random.default_rng(3)
    angles = np.zeros((FRAMES, 4, 3))
    angles[moving] = np.cumsum(random.normal(0.0, 0.2, angles.shape), axis=0)[moving]
    rotations = Rotation.from_rotvec(angles.reshape(-1, 3)).as_quat().reshape(FRAMES, 4, 4)
    positions = np.zeros((FRAMES, 4, 3))
    for joint, parent in enumerate(PARENTS[1:], start=1):
        axes = rotations[:, parent if by_parent else joint]
        positions[:, joint] = positions[:, parent] + turn(axes, np.tile(OFFSET, (FRAMES, 1)))
    return positions, rotations


def unseen(joint: int):
    seen = np.ones((FRAMES, 4), dtype=bool)
    seen[GAP, joint] = False
    return seen


@pytest.mark.parametrize("by_parent", [True, False])
def test_a_joint_is_where_what_is_fixed_to_it_says(by_parent):
    positions, rotations = chain(by_parent)
    seen = unseen(2)
    given = np.where(seen[..., None], positions, 9.0)
    # A rotation is not known where the joint that hangs on it was not seen.
    turned = seen & np.roll(seen, -1, axis=1) if by_parent else seen
    turned[:, 1] = True
    found, error = linked(given, rotations, seen, turned, PARENTS, 0.01)
    np.testing.assert_allclose(found, positions, atol=1e-9)
    assert not error[seen].any()
    assert ((error[GAP, 2] > 0.0) & (error[GAP, 2] < 0.01)).all()


def test_what_moves_in_all_axes_is_left_alone():
    positions, rotations = chain(True)
    positions[:, 2] += np.random.default_rng(1).normal(0.0, 0.1, (FRAMES, 3))
    seen = unseen(2)
    found, error = linked(positions, rotations, seen, seen, PARENTS, 0.01)
    np.testing.assert_array_equal(found, positions)
    assert np.isnan(error[GAP, 2]).all()


def test_links_that_were_never_put_to_the_test_are_not_followed_where_they_disagree():
    # All stand still but in the gap: every link is rigid, and each says something else there.
    positions, rotations = chain(False, GAP)
    seen = unseen(2)
    found, error = linked(
        np.where(seen[..., None], positions, 9.0), rotations, seen, seen, PARENTS, 0.01
    )
    assert np.isnan(error[GAP, 2]).all()
    assert (found[GAP, 2] == 9.0).all()


@pytest.mark.parametrize("joint", ["ltibia", "lclavicle", "lhipjoint"])
def test_a_joint_between_others_is_restored_exactly_without_a_prior(shared_data, joint):
    walk = mm.read_pose(shared_data / "poses" / "02_02.amc")
    gap = slice(100, 160)
    found = restore(hide(walk, gap, walk.index(joint)))
    off = lengths_of(found.pose.positions - walk.positions)[:, walk.index(joint)]
    assert off.max() < 0.05
    assert found.filled[gap, walk.index(joint)].all()
    assert found.error_mm[gap, walk.index(joint)].max() < 0.5
