"""Joints that are marked by hand at the same time are restored without believing each other."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from recordings import seventeen_joints

from markermend.artifact import Artifact, Kind, Status
from markermend.patch import patched
from markermend.poses.take import as_take, at_the_same_time, moved_far, pose_of
from markermend.repairs import propose

ARM = ("left_shoulder", "left_elbow", "left_wrist")
START, STOP = 300, 330


@pytest.fixture(scope="module")
def drifted(shared_data, tmp_path_factory):
    """A take whose arm is carried off so slowly that nobody finds it, and where it truly is."""
    truth = seventeen_joints(shared_data, "02_08")["02_08"]
    positions = np.array(truth.positions)
    away = 120.0 * np.sin(np.pi * (np.arange(STOP - START) + 1) / (STOP - START + 1))
    for name in ARM[1:]:
        positions[START:STOP, truth.index(name), 1] += away
    path = tmp_path_factory.mktemp("drifted") / "arm.csv"
    path.touch()
    given = truth.with_samples(positions, truth.rotations, truth.confidence)
    return as_take(given, path), truth


def marked(name, **more):
    return Artifact(name, "xyz", START, STOP, Kind.NOISE, **more)


def off(repair, truth):
    (patch,) = repair.patches
    right = truth.positions[START:STOP, truth.index(patch.marker)]
    return float(np.sqrt(np.mean(np.sum((patch.values - right) ** 2, axis=1))))


def test_each_is_nearer_when_all_are_marked(drifted):
    take, truth = drifted
    both = [marked(name) for name in ARM[1:]]
    alone = [off(propose(take, a, [a], method="skeleton"), truth) for a in both]
    together = [propose(take, a, both, method="skeleton") for a in both]
    assert min(alone) > 50.0
    for repair in together:
        assert off(repair, truth) < 25.0
        assert off(repair, truth) < 2.5 * repair.error_mm


@pytest.mark.parametrize("listed", [True, False])
def test_what_was_repaired_before_is_not_believed_as_it_was_read(drifted, listed):
    take, truth = drifted
    elbow, wrist = (marked(name) for name in ARM[1:])
    (patch,) = propose(take, elbow, [elbow, wrist], method="skeleton").patches
    mended = patched(take, [patch])
    done = [replace(elbow, status=Status.REPAIRED)] if listed else []
    assert off(propose(mended, wrist, [*done, wrist], method="skeleton"), truth) < 25.0


def test_a_joint_that_is_to_follow_others_is_restored_by_all(drifted):
    take, _ = drifted
    wrist = marked("left_wrist")
    by_all = propose(take, wrist, [wrist], method="skeleton")
    followed = propose(take, wrist, [wrist], method="skeleton", references=("neck", "head"))
    np.testing.assert_array_equal(followed.patches[0].values, by_all.patches[0].values)


def test_smoothing_leaves_a_recording_to_be_believed(drifted):
    take, _ = drifted
    assert not moved_far(take).any()
    rows = take.positions.copy()
    rows[:, 3] += 5.0
    rows[10:20, 4] += 200.0
    rows[30:40, 5] = np.nan
    far = moved_far(replace(take, positions=rows))
    assert far[10:20, 4].all()
    assert far[30:40, 5].all()
    assert far.sum() == 20
    assert pose_of(take).seen[30:40, 5].all()


def test_stretches_at_the_same_time_and_at_the_time_of_these():
    some, others = np.zeros((2, 60, 4), dtype=bool)
    some[10:20, 0] = True
    others[15:30, 1] = others[29:35, 2] = others[40:50, 3] = others[0:9, 1] = True
    found = at_the_same_time(some, others)
    assert found.sum() == 10 + 15 + 6
    assert found[15:30, 1].all()
    assert found[29:35, 2].all()
