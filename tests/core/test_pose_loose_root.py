"""Bodies that hang on an origin, as animation programs have them."""

from __future__ import annotations

import numpy as np
import pytest
from arms import arm, hide
from numpy.testing import assert_allclose

import markermend as mm
from markermend.poses import Pose
from markermend.poses.loose_root import without_loose_root
from markermend.poses.nuitrack import to_nuitrack
from markermend.poses.prior import shipped_prior
from markermend.poses.restore import restore


@pytest.fixture(scope="module")
def run(shared_data):
    return to_nuitrack(mm.read_pose(shared_data / "poses" / "02_03.amc"))


def hung(pose, root):
    """A recording whose root hangs on a point (frames, 3)."""
    turned = np.broadcast_to([0.0, 0.0, 0.0, 1.0], (pose.frames, 1, 4))
    return Pose(
        np.concatenate([pose.positions, root[:, None]], axis=1),
        np.concatenate([pose.rotations, turned], axis=1),
        (*pose.joints, "Reference"),
        (*(len(pose.joints) if p < 0 else p for p in pose.parents), -1),
        pose.rate,
        np.concatenate([pose.confidence, np.ones((pose.frames, 1))], axis=1),
    )


@pytest.mark.parametrize("prior", [None, shipped_prior()], ids=["alone", "prior"])
def test_a_body_is_restored_as_if_it_hung_on_nothing(run, prior):
    some = hide(hide(run, slice(60, 80), 7), slice(100, 110), slice(0, 5))
    places = some.positions.copy()
    places[30:34, 13] += 900.0
    some = some.with_samples(places, some.rotations, some.confidence)
    own, told = restore(some, prior=prior), restore(hung(some, np.zeros((173, 3))), prior=prior)
    assert_allclose(told.pose.positions[:, :-1], own.pose.positions)
    assert_allclose(told.pose.rotations[:, :-1], own.pose.rotations)
    assert_allclose(told.error_mm[:, :-1], own.error_mm, rtol=1e-5)
    assert (told.filled[:, :-1] == own.filled).all()
    assert told.faults == own.faults != ()
    assert not told.pose.positions[:, -1].any()
    assert not told.error_mm[:, -1].any()
    assert told.pose.seen[:, -1].all()


def test_a_root_that_jumps_or_trembles_is_a_part_of_the_body():
    pose = arm()
    assert without_loose_root(pose) is None
    places = pose.positions + np.random.default_rng(1).normal(0.0, 30.0, pose.positions.shape)
    places[100:120, 0] += 900.0
    assert without_loose_root(pose.with_samples(places, pose.rotations)) is None
    far = hung(pose, np.zeros((400, 3)))
    assert without_loose_root(far).joints == pose.joints
    assert without_loose_root(hide(far, slice(0, 3), 5)) is None
