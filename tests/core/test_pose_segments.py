"""From 17 joints back to 31 segments."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

import markermend as mm
from markermend.bench.segments import try_segments
from markermend.cli import main
from markermend.errors import DataError, FileFormatError
from markermend.poses.nuitrack import mirrored, to_nuitrack
from markermend.poses.segments import (
    CARRIERS,
    NAMES,
    PARENT_OF,
    learn_segments,
    load_segments,
    save_segments,
    shipped_segments,
    to_cmu,
)

pytestmark = pytest.mark.usefixtures("restored_once")


@pytest.fixture(scope="module")
def clips(shared_data):
    folder = shared_data / "poses"
    return {name: mm.read_pose(folder / f"{name}.amc") for name in ("02_01", "02_03", "03_02")}


def test_the_tree_is_the_databases(clips):
    pose = clips["02_01"]
    assert set(NAMES) == set(pose.joints)
    assert len(NAMES) == 31
    for joint, parent in zip(pose.joints, pose.parents, strict=True):
        assert PARENT_OF[joint] == (pose.joints[parent] if parent >= 0 else "")


def test_joints_come_back_exactly(clips):
    body = to_nuitrack(clips["03_02"])
    whole = to_cmu(body)
    again = to_nuitrack(whole)
    assert_allclose(again.positions, body.positions, atol=1e-9)
    assert_allclose(again.rotations, body.rotations, atol=1e-9)
    assert whole.confidence[:, whole.index("ltoes")].max() == 0.5
    assert whole.confidence[:, whole.index("lfemur")].min() == 1.0
    other = to_cmu(mirrored(body))
    assert_allclose(mirrored(other).positions, whole.positions, atol=1e-6)


def test_people_never_seen(clips):
    tried = {added.name: added for added in try_segments(clips)}
    assert list(tried) == list(CARRIERS)
    # Ends that joints tell of are exact; nothing else is, and nothing is far off.
    assert tried["lclavicle"].place_mm < 1e-9
    assert 0.1 < tried["lradius"].place_mm < 25.0
    assert 0.1 < tried["rhand"].place_mm < 25.0
    assert tried["ltoes"].place_mm < 80.0
    assert tried["lowerback"].turned_deg < 25.0
    assert try_segments({"02_01": clips["02_01"]}) == []


def test_what_ships_bends_with_the_body(clips):
    learnt = shipped_segments()
    stiff = type(learnt)(learnt.bend, learnt.place, learnt.turned, np.zeros_like(learnt.weights))
    truth = clips["02_03"]
    column = truth.index("lclavicle")

    def off(by):
        back = to_cmu(to_nuitrack(truth), by)
        alike = np.sum(
            back.rotations[:, back.index("lclavicle")] * truth.rotations[:, column], axis=1
        )
        return np.degrees(2 * np.arccos(np.minimum(np.abs(alike), 1.0))).mean()

    assert off(learnt) < 0.7 * off(stiff)


def test_frames_with_unseen_joints_get_nothing_added(clips):
    body = to_nuitrack(clips["03_02"])
    confidence = np.array(body.confidence)
    confidence[5, 3] = 0.0
    whole = to_cmu(body.with_samples(body.positions, body.rotations, confidence))
    toes = whole.index("ltoes")
    assert not whole.seen[5, toes]
    assert whole.seen[6, toes]
    assert whole.seen[5, whole.index("lfemur")]


def test_files_and_commands(clips, shared_data, tmp_path, capsys):
    learnt = learn_segments([clips["02_01"]])
    save_segments(learnt, tmp_path / "s.npz")
    assert_allclose(load_segments(tmp_path / "s.npz").weights, learnt.weights, atol=1e-5)
    (tmp_path / "bad.npz").write_bytes(b"nothing")
    with pytest.raises(FileFormatError, match="no segments"):
        load_segments(tmp_path / "bad.npz")
    with pytest.raises(DataError, match="CMU skeleton only"):
        learn_segments([to_nuitrack(clips["02_01"])])
    with pytest.raises(DataError, match="at least one"):
        learn_segments([])
    folder = shared_data / "poses"
    files = [str(folder / name) for name in ("02_03.amc", "03_02.amc")]
    assert main(["train", "segments", *files, "-o", str(tmp_path / "t.npz")]) == 0
    assert "ltoes" in capsys.readouterr().out
    joints, out = tmp_path / "joints.csv", tmp_path / "out.csv"
    mm.write_pose(to_nuitrack(clips["02_03"]), joints)
    assert main(["denoise", str(joints), "--cmu", "-o", str(out)]) == 0
    assert set(mm.read_pose(out).joints) == set(NAMES)


def test_poses_that_are_not_whole_are_passed_over(clips):
    pose = clips["02_03"]
    turned = np.array(pose.rotations)
    turned[10:60, pose.index("lhand")] = np.nan
    some = learn_segments([pose.with_samples(pose.positions, turned)])
    assert all(np.isfinite(getattr(some, name)).all() for name in ("place", "turned", "weights"))
    assert np.abs(some.place - learn_segments([pose]).place).max() < 0.2
    turned[:, pose.index("lhand")] = np.nan
    none = pose.with_samples(pose.positions, turned)
    with pytest.raises(DataError, match="take has no pose in which every segment was seen"):
        learn_segments([none], names=["take"])
    with pytest.raises(DataError, match="Recording 2 has no pose"):
        learn_segments([pose, none])
    tried = try_segments({"02_03": pose, "03_02": clips["03_02"], "02_01": clips["02_01"]})
    assert all(np.isfinite(added.place_mm) for added in tried)


def test_ends_without_rotation_are_turned_as_others(clips):
    body = to_nuitrack(clips["03_02"])
    without = np.array(body.rotations)
    ends = [body.index("head"), body.index("left_wrist")]
    without[:, ends] = np.nan
    whole, true = to_cmu(body.with_samples(body.positions, without)), clips["03_02"]
    assert whole.seen.all()
    assert not np.isnan(whole.rotations).any()
    for name, most in (("head", 40.0), ("lhand", 60.0)):
        ours, theirs = whole.rotations[:, whole.index(name)], true.rotations[:, true.index(name)]
        alike = np.abs(np.sum(ours * theirs, axis=1))
        assert np.degrees(2 * np.arccos(np.minimum(alike, 1.0))).mean() < most
    without[:, body.index("left_elbow")] = np.nan
    with pytest.raises(DataError, match="never tells of left_elbow"):
        to_cmu(body.with_samples(body.positions, without))
