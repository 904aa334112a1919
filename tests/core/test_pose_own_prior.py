"""The prior that a user chose: learnt from files, used where it fits, ours where it does not."""

from __future__ import annotations

import os

import numpy as np
import pytest
from arms import arm, hide
from numpy.testing import assert_allclose, assert_array_equal

import markermend as mm
from markermend.cli import main
from markermend.errors import Cancelled, DataError, FileFormatError
from markermend.poses.filling.hanging import hanging_joints
from markermend.poses.nuitrack import to_nuitrack
from markermend.poses.own_prior import (
    fits,
    heeded,
    heeded_if_there,
    learn_files,
    prior_for,
)
from markermend.poses.pose import Pose
from markermend.poses.prior import fitting, load_prior, save_prior, shipped_prior
from markermend.poses.restore import restore
from markermend.poses.take import pose_of, prior_of, restored, restored_without
from markermend.simulation import simulate


@pytest.fixture
def recordings(tmp_path):
    """Two recordings of one body."""
    paths = [tmp_path / f"swing_{n}.csv" for n in range(2)]
    for n, path in enumerate(paths):
        mm.write_pose(arm(frames=300 + 50 * n), path)
    return paths


@pytest.fixture
def prior(recordings, tmp_path):
    """A prior of that body, in a file."""
    path = tmp_path / "p.npz"
    learn_files(recordings, path)
    return path


@pytest.fixture
def recording(tmp_path):
    """The same body, two joints of which are not seen for a while."""
    path = tmp_path / "damaged.csv"
    mm.write_pose(hide(hide(arm(), slice(200, 260), 2), slice(200, 260), 3), path)
    return path


def test_what_files_show_is_learnt_and_told_how_far(recordings, tmp_path) -> None:
    shares = []
    learn_files(recordings, tmp_path / "p.npz", progress=lambda share, _: shares.append(share))
    assert shares == sorted(shares)
    assert 0 <= shares[0] < 0.5 < shares[-1] <= 1
    prior = load_prior(tmp_path / "p.npz")
    assert prior.joints == ("root", "a", "b", "c", "d")
    assert len(prior.remembered) == 2


def test_who_stops_learning_keeps_what_was_there(recordings, prior) -> None:
    before = prior.read_bytes()

    def stop(share: float, _: str) -> None:
        if share > 0.5:
            raise Cancelled

    with pytest.raises(Cancelled):
        learn_files(recordings[:1], prior, progress=stop)
    assert prior.read_bytes() == before


def test_files_that_cannot_be_learnt_from_are_named(recordings, prior, tmp_path) -> None:
    with pytest.raises(FileFormatError, match="there"):
        learn_files([tmp_path / "not_there.csv"], tmp_path / "q.npz")
    blind = hide(arm(), slice(None), 4)
    mm.write_pose(blind, recordings[1])
    with pytest.raises(DataError, match=r"swing_1\.csv never shows d"):
        learn_files(recordings, tmp_path / "q.npz")
    assert not (tmp_path / "q.npz").exists()


def test_a_recording_under_review_is_restored_by_what_was_chosen(recording, prior) -> None:
    pose = pose_of(heeded(mm.read(recording), prior))
    wanted = restore(pose, prior=load_prior(prior)).pose.positions
    assert_array_equal(restored(pose).pose.positions, wanted)
    other = pose_of(mm.read(recording))
    by_ours = restore(other, prior=shipped_prior()).pose.positions
    assert_array_equal(restored(other).pose.positions, by_ours)
    assert not (wanted == by_ours).all()


def test_it_is_the_same_for_as_long_as_a_recording_is_open(recordings, recording, prior) -> None:
    pose = pose_of(heeded(mm.read(recording), prior))
    before = restored_without(pose, [2], slice(50, 80)).pose.positions
    learn_files(recordings[:1], prior)
    assert_array_equal(restored_without(pose, [2], slice(50, 80)).pose.positions, before)
    again = pose_of(heeded(mm.read(recording), prior))
    assert not (restored_without(again, [2], slice(50, 80)).pose.positions == before).all()


def test_where_it_does_not_fit_or_is_gone_ours_is_used(recording, prior, tmp_path) -> None:
    pose = pose_of(mm.read(recording))
    own, why = prior_for(pose, prior)
    assert (own.joints, why) == (pose.joints, "")
    for other in (tmp_path / "gone.npz", recording):
        with pytest.raises(FileFormatError, match=other.name):
            prior_for(pose, other)
        opened = heeded_if_there(mm.read(recording), other)
        assert f"{other.name} is gone or holds no prior" in opened.warnings[0]
        assert prior_of(pose_of(opened)) is shipped_prior()
    save_prior(shipped_prior(), prior)
    ours, why = prior_for(pose, prior)
    assert ours is shipped_prior()
    assert heeded(mm.read(recording), prior).warnings[0] == why
    assert "does not fit" in why


def test_what_was_written_anew_is_read_anew(recordings, recording, prior) -> None:
    pose = pose_of(mm.read(recording))
    before, told = prior_for(pose, prior)[0], prior.stat()
    assert prior_for(pose, prior)[0] is before
    learn_files(recordings[:1], prior)
    # As a copy that keeps its time.
    os.utime(prior, ns=(told.st_atime_ns, told.st_mtime_ns))
    assert len(prior_for(pose, prior)[0].remembered) == 1


def test_a_prior_of_ones_own_skeleton_serves_the_command_line(
    recordings, recording, tmp_path, capsys
) -> None:
    prior, done = tmp_path / "own.npz", tmp_path / "done.csv"
    assert main(["train", "prior", *map(str, recordings), "-o", str(prior)]) == 0
    assert main(["denoise", str(recording), "-o", str(done), "--prior", str(prior)]) == 0
    assert "does not fit" not in capsys.readouterr().err
    assert_allclose(mm.read_pose(done).positions, arm().positions, atol=30.0)


def under_a_root(pose: Pose) -> Pose:
    """The same body hung on a root that is no part of it, as animation programs have it."""
    still = np.zeros((pose.frames, 1, 3)), np.tile([0.0, 0.0, 0.0, 1.0], (pose.frames, 1, 1))
    parents = (-1, *(parent + 1 for parent in pose.parents))
    positions, rotations = (
        np.concatenate([one, own], axis=1)
        for one, own in zip(still, (pose.positions, pose.rotations), strict=True)
    )
    confidence = np.concatenate([np.ones((pose.frames, 1)), pose.confidence], axis=1)
    return Pose(positions, rotations, ("Reference", *pose.joints), parents, pose.rate, confidence)


def test_a_root_that_is_no_part_of_the_body_is_left_out_of_it(tmp_path) -> None:
    path = tmp_path / "p.npz"
    mm.write_pose(under_a_root(arm()), tmp_path / "a.csv")
    prior = learn_files([tmp_path / "a.csv"], path)
    assert prior.joints == ("root", "a", "b", "c", "d")
    damaged = under_a_root(hide(hide(arm(), slice(200, 260), 2), slice(200, 260), 3))
    assert fits(damaged, prior)
    told, why = prior_for(damaged, path)
    assert (told.joints, why) == (prior.joints, "")
    with_it, without = (restore(damaged, prior=p).pose.positions for p in (prior, None))
    assert not (with_it == without).all()


def test_joints_of_ones_own_are_told_by_what_they_hang_on_with_a_prior_too(arms_prior) -> None:
    pose = hide(arm(), slice(200, 260), 3)
    names = {joint: n for n, joint in enumerate(pose.joints)}
    moments, _ = fitting(pose, arms_prior)
    for known in (moments, None):
        hanging = hanging_joints(pose, known)
        assert not hanging[names["root"]]
        assert hanging[[names[joint] for joint in "abcd"]].all()
    off = np.linalg.norm(restore(pose, prior=arms_prior).pose.positions - arm().positions, axis=2)
    assert off[200:260, 3].mean() < 1.0


@pytest.fixture
def arms_prior(prior):
    """A prior of the arm."""
    return load_prior(prior)


def test_commands_on_takes_restore_by_a_prior_of_ones_own(recording, prior, tmp_path, capsys):
    done, usual = tmp_path / "done.csv", tmp_path / "usual.csv"
    assert main(["fill", str(recording), "-o", str(done), "--prior", str(prior)]) == 0
    assert main(["clean", str(recording), "-o", str(usual)]) == 0
    wanted = restore(mm.read_pose(recording), prior=load_prior(prior)).pose.positions
    assert_allclose(mm.read_pose(done).positions, wanted, atol=1e-3)
    assert not np.allclose(mm.read_pose(usual).positions, wanted, atol=0.1)
    assert not capsys.readouterr().err
    assert main(["detect", str(recording), "--prior", str(prior)]) == 0


def test_denoise_restores_by_ours_what_a_prior_does_not_fit(shared_data, prior, tmp_path, capsys):
    pose = to_nuitrack(mm.read_pose(shared_data / "poses" / "02_02.amc"))
    path, done = tmp_path / "walk.csv", tmp_path / "done.csv"
    mm.write_pose(hide(pose, slice(100, 140), pose.joints.index("left_elbow")), path)
    assert main(["denoise", str(path), "-o", str(done), "--prior", str(prior)]) == 0
    assert "p.npz does not fit this recording" in capsys.readouterr().err
    wanted = mm.denoise(mm.read_pose(path)).positions
    assert_allclose(mm.read_pose(done).positions, wanted, atol=1e-3)


def test_commands_say_why_a_prior_is_not_used(recording, tmp_path, capsys):
    other = tmp_path / "ours.npz"
    save_prior(shipped_prior(), other)
    assert main(["detect", str(recording), "--prior", str(other)]) == 0
    assert "ours.npz does not fit this recording" in capsys.readouterr().err
    assert main(["detect", str(recording), "--prior", str(recording)]) == 1
    assert "holds no prior" in capsys.readouterr().err
    take, _ = simulate(duration_s=2.0)
    mm.write(take, tmp_path / "walk.c3d")
    assert main(["detect", str(tmp_path / "walk.c3d"), "--prior", str(other)]) == 1
    assert "is for skeleton recordings" in capsys.readouterr().err
