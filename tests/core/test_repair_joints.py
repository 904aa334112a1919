"""Which repair of a joint is best, and whether what it says of its error is true."""

from __future__ import annotations

import numpy as np
import pytest

import markermend as mm
from markermend.artifact import Artifact, Kind
from markermend.poses.nuitrack import JOINTS, to_nuitrack
from markermend.repairs import advise, compared, evidence_for, propose

pytestmark = pytest.mark.usefixtures("restored_once")


@pytest.fixture(scope="module")
def walk(shared_data):
    return mm.read(shared_data / "poses" / "02_01.amc")


@pytest.fixture(scope="module")
def sensed(shared_data, tmp_path_factory):
    path = tmp_path_factory.mktemp("sensed") / "walk.csv"
    mm.write_pose(to_nuitrack(mm.read_pose(shared_data / "poses" / "02_01.amc")), path)
    return mm.read(path)


def off(take, repair):
    patch = repair.patches[0]
    truth = take.positions[patch.start : patch.stop, take.index(patch.marker)]
    return float(np.linalg.norm(patch.values - truth, axis=1).mean())


def test_where_joints_around_it_tell_far_more_a_joint_follows_them(walk):
    # A thumb beside a hand and fingers, of a skeleton that no prior fits.
    marked = Artifact("lthumb", "xyz", 105, 225, Kind.NOISE)
    best = propose(walk, marked)
    restored = propose(walk, marked, method="skeleton")
    assert best.method == "local_regression"
    assert best.reason.startswith("Restore skeleton may be about ")
    assert off(walk, best) < 2.0 < off(walk, restored)


@pytest.mark.parametrize(("start", "stop"), [(105, 136), (0, 31)])
@pytest.mark.parametrize("recording", ["walk", "sensed"])
def test_a_root_is_told_by_what_hangs_on_it(recording, start, stop, request):
    take = request.getfixturevalue(recording)
    root = take.source.layout.joints[take.source.layout.order[0]]
    marked = Artifact(root, "xyz", start, stop, Kind.NOISE)
    best = propose(take, marked)
    restored = propose(take, marked, method="skeleton")
    # Following says less than a millimetre less, which is not worth doing without rotations.
    assert best.method == "skeleton"
    assert off(take, restored) < 1.0
    assert 0.3 < off(take, restored) / restored.error_mm < 3.0


def test_what_is_compared_begins_with_the_best_and_says_what_each_says_of_itself(walk):
    for start in (0, 105):
        marked = Artifact("root", "xyz", start, start + 31, Kind.NOISE)
        ranked = advise(evidence_for(walk, [marked]), marked, methods=compared(walk))
        assert ranked[0].method == propose(walk, marked).method
        told = {a.method: a.error_mm for a in ranked if a.repair.patches}
        for method in ("skeleton", "local_regression"):
            assert told[method] == propose(walk, marked, method=method).error_mm


def test_a_limb_is_restored(sensed):
    for name in ("left_wrist", "right_knee"):
        assert name in JOINTS
        marked = Artifact(name, "xyz", 100, 136, Kind.NOISE)
        best = propose(sensed, marked)
        assert best.method == "skeleton"
        assert off(sensed, best) <= off(sensed, propose(sensed, marked, method="local_regression"))


def test_a_mix_up_is_restored_on_both_sides(sensed):
    mixed = Artifact("left_hip", "xyz", 100, 104, Kind.STEP, counterpart="right_hip")
    best = propose(sensed, mixed)
    assert best.method == "skeleton"
    assert [patch.marker for patch in best.patches] == ["left_hip", "right_hip"]
