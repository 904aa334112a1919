"""A skeleton recording that is smoothed keeps its rotations, and its bones point where they do."""

from __future__ import annotations

import shutil

import numpy as np
import pytest

import markermend as mm
from markermend.artifact import Artifact, Kind
from markermend.cli import main
from markermend.poses.faults.guessing import INFERRED
from markermend.poses.faults.swinging import carried, swung
from markermend.poses.nuitrack import JOINTS, to_nuitrack
from markermend.poses.pose import Pose
from markermend.poses.quaternion import between, multiply, turn
from markermend.poses.restore import restore
from markermend.poses.take import as_pose, pose_of, restored_without

pytestmark = pytest.mark.usefixtures("restored_once")

UNTURNED = (0.0, 0.0, 0.0, 1.0)


def turns(a, b):
    """Degrees between rotations."""
    same = np.abs(np.sum(a.rotations * b.rotations, axis=2)).clip(0, 1)
    return np.degrees(2 * np.arccos(same))


def apart(a, b):
    return np.linalg.norm(a.positions - b.positions, axis=2)


@pytest.fixture(scope="module")
def source(shared_data):
    return shared_data / "poses" / "02_03.amc"


@pytest.fixture(scope="module")
def take(source):
    return mm.read(source)


@pytest.fixture(scope="module")
def table(take, tmp_path_factory):
    path = tmp_path_factory.mktemp("table") / "walk.csv"
    mm.write(take, path)
    return path


def test_a_smoothed_joint_keeps_its_rotation(table, tmp_path, capsys):
    out = tmp_path / "out.csv"
    assert main(["smooth", str(table), "--marker", "lhumerus", "-o", str(out)]) == 0
    capsys.readouterr()
    before, after = mm.read_pose(table), mm.read_pose(out)
    joint, turned = before.joints.index("lhumerus"), turns(before, after)
    assert 1.0 < apart(before, after).max() < 2.0
    assert turned.max() < 1.0
    # Its own bone and the two that hang on it are all that swings.
    hanging = [joint, *(j for j, parent in enumerate(before.parents) if parent == joint)]
    still = [j for j in range(len(before.joints)) if j not in hanging]
    np.testing.assert_allclose(after.rotations[:, still], before.rotations[:, still], atol=2e-6)
    np.testing.assert_array_equal(after.confidence, before.confidence)
    bone = after.positions[:, joint] - after.positions[:, before.parents[joint]]
    place = before.positions[:, joint] - before.positions[:, before.parents[joint]]
    own = turn(before.rotations[:, joint] * [-1, -1, -1, 1], place)
    told = turn(after.rotations[:, joint], np.broadcast_to(np.median(own, axis=0), own.shape))
    off = np.degrees(
        np.arccos(
            np.sum(bone * told, axis=1)
            / np.linalg.norm(bone, axis=1)
            / np.linalg.norm(told, axis=1)
        )
    )
    assert off.max() < 0.01


def test_an_amc_turns_as_little_as_its_joint_moved(shared_data, tmp_path):
    take = mm.read(shared_data / "poses" / "03_01.amc")
    smoothed = mm.smooth(take, markers=["lhumerus"])
    export = mm.write(smoothed, tmp_path / "out.amc")
    after = mm.read_pose(tmp_path / "out.amc", skeleton=shared_data / "poses" / "03.asf")
    turned = turns(pose_of(take), after)
    assert turned[:, take.index("lhumerus")].max() < 5.0
    assert turned.max() < 10.0
    assert export.off_mm < 5.0


@pytest.mark.parametrize("method", ["auto", "butterworth"])
def test_a_whole_recording_is_smoothed(take, table, source, method, tmp_path):
    for recording in (take, mm.read(table)):
        smoothed = mm.smooth(recording, method)
        before, after = pose_of(recording), as_pose(smoothed)
        np.testing.assert_array_equal(after.positions, smoothed.positions)
        assert (after.confidence == 1).all()
        turned = turns(before, after)
        assert np.median(turned) < 0.5
        # A short bone swings by more, but by no more than its ends were moved.
        lengths = np.linalg.norm(before.positions - before.positions[:, before.parents], axis=2)
        most = np.degrees(4 * apart(before, after).max() / lengths[:, 1:].min())
        assert turned.max() < min(most, 15.0)
        for ending in ("csv", "bvh"):
            mm.write(smoothed, tmp_path / f"out.{ending}")
            assert mm.read(tmp_path / f"out.{ending}").frames == take.frames
    smoothed = mm.smooth(take, method)
    assert mm.write(smoothed, tmp_path / "out.amc").off_mm < 5.0
    back = mm.read_pose(tmp_path / "out.amc", skeleton=source.with_name("02.asf"))
    assert turns(pose_of(take), back).max() < 15.0


def test_the_command_line_smooths_a_skeleton(source, tmp_path, capsys):
    shutil.copy(source.with_name("02.asf"), tmp_path / "s.asf")
    for ending in ("amc", "csv", "bvh"):
        assert main(["smooth", str(source), "-o", str(tmp_path / f"s.{ending}")]) == 0
        assert mm.read(tmp_path / f"s.{ending}").skeleton
    assert "Smoothed: 31 markers" in capsys.readouterr().out


def test_smoothing_noise_brings_rotations_nearer_to_the_truth(shared_data, tmp_path):
    walk = to_nuitrack(mm.read_pose(shared_data / "poses" / "02_01.amc"))
    rng = np.random.default_rng(1)
    noisy = walk.with_samples(
        walk.positions + rng.normal(0, 5, walk.positions.shape),
        walk.rotations + rng.normal(0, 0.02, walk.rotations.shape),
    )
    mm.write_pose(noisy, tmp_path / "noisy.csv")
    take = mm.read(tmp_path / "noisy.csv")
    after = as_pose(mm.smooth(take))
    assert turns(after, walk).mean() < 0.8 * turns(pose_of(take), walk).mean()


def test_what_was_not_seen_is_still_restored_beside_what_is_smoothed(shared_data, tmp_path):
    walk = to_nuitrack(mm.read_pose(shared_data / "poses" / "02_01.amc"))
    confidence, head, rows = np.array(walk.confidence), JOINTS.index("head"), slice(200, 230)
    confidence[rows, head] = 0.0
    mm.write_pose(walk.with_samples(walk.positions, walk.rotations, confidence), tmp_path / "w.csv")
    take = mm.read(tmp_path / "w.csv")
    repaired = mm.repair(take, mm.detect(take))
    alone, both = as_pose(repaired), as_pose(mm.smooth(repaired))
    assert (both.confidence[rows, head] == INFERRED).all()
    assert np.delete(both.confidence, np.r_[rows], axis=0).min() == 1
    assert turns(alone, both)[rows, head].max() < 1e-3
    assert turns(both, walk)[rows].max() < 15.0


def test_intervals_restored_by_hand_are_written_as_restoring_has_them(take):
    marked = [
        Artifact("rthumb", "xyz", 100, 120, Kind.STEP),
        Artifact("rfemur", "xyz", 40, 80, Kind.STEP),
        Artifact("head", "xyz", 50, 55, Kind.STEP),
    ]
    after, pose = as_pose(mm.repair(take, marked, method="skeleton")), pose_of(take)
    confidence = np.array(pose.confidence)
    for one in marked:
        confidence[one.start : one.stop, take.index(one.marker)] = 0.0
    hidden = pose.with_samples(pose.positions, pose.rotations, confidence)
    told = restore(hidden, prior=mm.poses.prior.shipped_prior()).pose
    for one in marked:
        joint = take.index(one.marker)
        for which in (joint, pose.parents[joint]):
            rows = slice(one.start, one.stop)
            np.testing.assert_allclose(
                after.rotations[rows, which], told.rotations[rows, which], atol=1e-12
            )
        # Those at the same time are restored together.
        rows = slice(one.start, one.stop)
        there = restored_without(pose, [joint], rows, doubted=confidence == 0).pose.positions
        np.testing.assert_array_equal(after.positions[rows, joint], there[rows, joint])


def test_a_recording_too_short_to_restore_may_be_moved(tmp_path):
    (tmp_path / "two.csv").write_text(
        "frame,joint,parent,x,y,z,qx,qy,qz,qw\n"
        + "".join(f"{n},a,,{n},0,1000,0,0,0,1\n{n},b,a,{n},0,1300,0,0,0,1\n" for n in range(2))
    )
    take = mm.read(tmp_path / "two.csv")
    moved = take.positions + np.array([[0, 0, 0], [30.0, 0, 0]])
    after = as_pose(take.with_positions(moved, take.origin))
    np.testing.assert_array_equal(after.positions, moved)
    np.testing.assert_allclose(turns(pose_of(take), after)[0], np.degrees(np.arctan(0.1)))


def line(rotation=UNTURNED, frames=40):
    """A trunk with two arms that its rotation carries, as it is turned."""
    places = np.array([[0, 0, 0], [0, 0, 400.0], [300, 0, 350.0], [-300, 0, 350.0]])
    turned = np.tile(rotation, (frames, 4, 1))
    # Ends of arms turn as they like.
    angle = np.linspace(0, 3, frames)
    for joint in (1, 2, 3):
        turned[:, joint] = np.stack([np.sin(angle), 0 * angle, 0 * angle, np.cos(angle)], axis=1)
    positions = turn(turned[:, :1], places[None])
    return Pose(positions, turned, ("hip", "neck", "left", "right"), (-1, 0, 0, 0), 30.0)


def test_a_joint_of_several_bones_turns_with_all_of_them():
    pose = line()
    assert carried(pose) == [[1, 2, 3], [], [], []]
    about = between(np.array([1.0, 0, 0]), np.array([1.0, 0.1, 0.05]))
    moved = np.ones((pose.frames, 4), dtype=bool)
    now = turn(about, pose.positions)
    rotations = swung(pose, now, moved, ~moved)
    np.testing.assert_allclose(rotations[:, 0], multiply(about, pose.rotations[:, 0]), atol=1e-3)
    np.testing.assert_array_equal(rotations[:, 1:], pose.rotations[:, 1:])
    # Those that are to stay do, and so does what nothing is known of.
    np.testing.assert_array_equal(swung(pose, now, moved, moved), pose.rotations)
    now[5:9, 1:] = np.nan
    np.testing.assert_array_equal(swung(pose, now, moved, ~moved)[5:9], pose.rotations[5:9])
    np.testing.assert_allclose(swung(pose, now, moved, ~moved)[:5], rotations[:5])
