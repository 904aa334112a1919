"""Recordings of the performer that a prior remembers, asked where gaps last."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from recordings import seventeen_joints, to_and_fro

import markermend as mm
from markermend.cli import main
from markermend.errors import FileFormatError
from markermend.files.npz import read_arrays, write_arrays
from markermend.poses.filling.remembered import (
    REMEMBERED_HZ,
    Remembered,
    performances,
    resampled,
    shortened,
)
from markermend.poses.nuitrack import mirrored, to_nuitrack
from markermend.poses.pose import Pose
from markermend.poses.prior import (
    Prior,
    load_prior,
    remembered_of,
    save_prior,
    shipped_prior,
)
from markermend.poses.prior_learning import (
    beside_ours,
    learn_prior,
    learn_recording,
    together,
)
from markermend.poses.restore import restore
from markermend.poses.simulated.noise import Noise, corrupt_pose


@pytest.fixture(scope="module")
def clips(shared_data) -> dict[str, Pose]:
    return seventeen_joints(shared_data, "02_01", "02_02", "03_02")


@pytest.fixture(scope="module")
def prior(clips) -> Prior:
    return learn_prior([clips["02_02"], clips["03_02"]])


def shuffled(pose: Pose) -> Pose:
    """The same recording, its joints in another order."""
    order = np.random.default_rng(3).permutation(len(pose.joints))
    place = {int(joint): n for n, joint in enumerate(order)}
    parents = tuple(place.get(pose.parents[joint], -1) for joint in order)
    joints = tuple(pose.joints[joint] for joint in order)
    return Pose(pose.positions[:, order], pose.rotations[:, order], joints, parents, pose.rate)


def recording(frames: int, bones: tuple[float, ...] = (1.0, 2.0, 3.0)) -> Remembered:
    poses = np.random.default_rng(frames).normal(size=(frames, 25)).astype(np.float32)
    return Remembered(poses, np.array(bones, dtype=np.float32))


def test_what_a_performer_did_before_and_after_brings_whole_limbs_nearer(shared_data) -> None:
    pose = to_nuitrack(mm.read_pose(shared_data / "poses" / "03_03.amc"))
    before, truth, after = (part_of(pose, *some) for some in ((0, 2000), (2000, 2400), (2400, -1)))
    knowing = learn_prior([before, after])
    noise, off = Noise(displacement=0.0, burst=60, limbs=True), {"knows": 0.0, "forgot": 0.0}
    for seed in (1, 2, 3):
        damaged = corrupt_pose(truth, noise, seed=seed)
        for name, prior in (("knows", knowing), ("forgot", replace(knowing, remembered=()))):
            found = restore(damaged, prior=prior).pose.positions
            off[name] += float(np.abs(found - truth.positions)[~damaged.seen].sum())
    assert 0 < off["knows"] < 0.96 * off["forgot"]


def part_of(pose: Pose, start: int, stop: int) -> Pose:
    rows = slice(start, stop)
    return pose.with_samples(pose.positions[rows], pose.rotations[rows], pose.confidence[rows])


def test_strangers_are_asked_where_a_recording_is_short(clips, prior) -> None:
    strange = replace(prior, remembered=prior.remembered[1:])
    for seconds, asked in ((3.0, True), (20.0, False)):
        walk = to_and_fro(clips["02_01"], seconds)
        damaged = corrupt_pose(walk, Noise(displacement=0.0, burst=15), seed=1)
        assert len(remembered_of(damaged, prior)) == 1
        assert not remembered_of(damaged, strange)
        assert len(remembered_of(damaged, strange, strangers=True)) == 1
        (known,) = remembered_of(damaged, prior, strangers=True)
        assert_array_equal(known.bones, remembered_of(damaged, prior)[0].bones)
        without, with_them = (
            restore(damaged, prior=replace(prior, remembered=some)).pose.positions
            for some in ((), strange.remembered)
        )
        assert np.array_equal(without, with_them) != asked


def test_bodies_are_told_whatever_order_and_hand_their_joints_have(clips, prior) -> None:
    pose = clips["02_01"]
    one, other = (remembered_of(body, prior) for body in (pose, shuffled(pose)))
    assert len(one) == len(other) == 1
    assert_allclose(np.sort(one[0].poses[5]), np.sort(other[0].poses[5]))
    assert not np.array_equal(one[0].poses, other[0].poses)
    damaged = corrupt_pose(pose, Noise(displacement=0.0, burst=60), seed=4)
    straight, left = restore(damaged, prior=prior), restore(mirrored(damaged), prior=prior)
    assert_allclose(mirrored(left.pose).positions, straight.pose.positions, atol=5e-3)


def test_a_body_that_lacks_a_joint_or_has_more_is_no_other(clips, prior) -> None:
    pose = clips["02_01"]
    kept = [joint for joint, name in enumerate(pose.joints) if name != "left_ankle"]
    parents = tuple(kept.index(pose.parents[j]) if pose.parents[j] >= 0 else -1 for j in kept)
    joints = tuple(pose.joints[j] for j in kept)
    less = Pose(pose.positions[:, kept], pose.rotations[:, kept], joints, parents, pose.rate)
    assert remembered_of(less, prior) == []


@pytest.mark.parametrize(
    ("bones", "same"),
    [
        ((1.0, 2.0, 3.0), True),
        ((10.0, 20.0, 30.0), True),
        ((1.0, np.nan, 3.0), False),
        ((1.0, 2.0, 3.1), True),
        ((1.0, 2.0, 3.6), False),
        ((np.nan, np.nan, np.nan), False),
        ((np.nan, np.nan, 3.0), False),
    ],
)
def test_proportions_tell_a_body(bones: tuple[float, ...], same: bool) -> None:
    assert recording(3).of_body(np.array(bones)) == same


def test_a_bone_that_is_not_known_tells_no_body_apart() -> None:
    known = recording(3, (1.0, 2.0, 3.0, 2.0))
    assert known.of_body(np.array([1.0, 2.0, np.nan, 2.0]))
    assert not known.of_body(np.array([1.0, 2.6, np.nan, 2.0]))


@given(st.lists(st.integers(0, 30_000), min_size=1, max_size=6))
def test_ten_minutes_are_kept_at_most_and_of_each_recording_an_equal_share(lengths) -> None:
    kept = shortened([Remembered(np.zeros((n, 1), np.float32), np.ones(1)) for n in lengths])
    counts = [len(one.poses) for one in kept]
    assert all(counts)
    lengths = [n for n in lengths if n]
    assert sum(counts) <= 600 * REMEMBERED_HZ
    if sum(lengths) <= 600 * REMEMBERED_HZ:
        assert counts == lengths
    else:
        share = 600 * REMEMBERED_HZ / sum(lengths)
        lengths = [n for n in lengths if int(n * 600 * REMEMBERED_HZ) // sum(lengths)]
        assert all(abs(n - share * whole) <= 1 for n, whole in zip(counts, lengths, strict=True))


@given(st.integers(1, 300), st.sampled_from([10.0, 25.0, 29.97, 30.0, 60.0, 120.0, 240.0]))
def test_another_rate_has_the_same_movement(frames: int, rate: float) -> None:
    ramp = np.arange(frames, dtype=np.float32)[:, None] * [1.0, -2.0]
    there = resampled(ramp, 30.0, rate)
    assert_allclose(there[:, 0], np.arange(len(there)) * 30.0 / rate, atol=1e-3)
    assert_allclose(there[:, 1], -2.0 * there[:, 0], atol=1e-3)
    assert there[-1, 0] <= frames - 1 < there[-1, 0] + max(30.0 / rate, 1e-3) + 1e-3


def test_signs_of_rotations_are_those_of_whom_they_tell_of() -> None:
    one, usual = recording(40), np.zeros(21)
    usual[[6, 13, 20]] = -np.sign(one.poses[:, [6, 13, 20]].mean(axis=0))
    turned = one.signed_like(usual)
    assert_array_equal(turned.poses[:, 3:7], -one.poses[:, 3:7])
    for first in (0, 7, 14):
        assert_array_equal(turned.poses[:, first : first + 3], one.poses[:, first : first + 3])
    assert_array_equal(turned.poses[:, 21:], one.poses[:, 21:])


def test_the_nearest_moments_are_asked() -> None:
    given = performances([recording(200), recording(100)], REMEMBERED_HZ)
    assert given is not None
    trust = np.ones(25, dtype=np.float32)
    rows = given.moved[[17, 250]]
    found = dict(given.nearest(rows, trust, 2))
    assert {path: given.frames[places].tolist() for path, places in found.items()} == {
        0: [17],
        1: [50],
    }
    every = given.nearest(rows, trust, 1000)
    assert sum(len(places) for _, places in every) == 300
    # What counts for nothing is not looked at.
    trust[3:] = 0
    far = rows.copy()
    far.reshape(2, 2, 25)[..., 3:] += 100.0
    assert dict(given.nearest(far, trust, 2)).keys() == {0, 1}
    assert performances([], 30.0) is None


def test_recordings_are_kept_in_the_file(prior, tmp_path) -> None:
    path = tmp_path / "p.npz"
    save_prior(prior, path)
    back = load_prior(path)
    for one, other in zip(prior.remembered, back.remembered, strict=True):
        assert_array_equal(one.poses, other.poses)
        assert_array_equal(one.bones, other.bones)
    save_prior(replace(prior, remembered=()), path)
    assert load_prior(path).remembered == ()
    save_prior(prior, path)
    whole = read_arrays(path)
    for name, damaged in (
        ("frames", whole["frames"] + 1),
        ("frames", np.array(5)),
        ("frames", whole["frames"] * [1, 0] + [0, whole["frames"][0]]),
        ("recordings", np.where(whole["recordings"] > 2, np.nan, whole["recordings"])),
        ("bones", -whole["bones"]),
        ("joints", np.array("waist")),
    ):
        write_arrays(path, whole | {name: damaged})
        with pytest.raises(FileFormatError, match="no prior"):
            load_prior(path)


def test_recordings_learnt_one_by_one_make_the_same_prior(clips, prior) -> None:
    parts = [learn_recording(clips[name], name) for name in ("02_02", "03_02")]
    one = together(parts)
    assert_array_equal(one.moments.whole, prior.moments.whole)
    assert [len(r.poses) for r in one.remembered] == [len(r.poses) for r in prior.remembered]


def test_a_prior_that_others_get_holds_no_recordings(shared_data, tmp_path) -> None:
    clip, path = str(shared_data / "poses" / "02_02.amc"), tmp_path / "p.npz"
    assert main(["train", "prior", clip, "-o", str(path)]) == 0
    assert len(load_prior(path).remembered) == 1
    assert main(["train", "prior", clip, "-o", str(path), "--no-recordings", "--force"]) == 0
    assert load_prior(path).remembered == ()


def test_what_left_handed_recordings_tell_is_the_same(clips) -> None:
    one, other = (learn_recording(pose, "") for pose in (clips["02_01"], mirrored(clips["02_01"])))
    assert_allclose(other.moments.mean, one.moments.mean, atol=1e-9)
    assert_allclose(other.remembered[0].poses, one.remembered[0].poses, atol=1e-5)


def test_beside_ours_a_few_recordings_count_for_half(clips, prior) -> None:
    ours, few = shipped_prior(), learn_prior([clips["02_01"]])
    both = beside_ours(few)
    assert both.remembered
    theirs = few.moments.signed_like(ours.moments.mean)
    assert_allclose(both.moments.mean, 0.5 * (ours.moments.mean + theirs.mean))
    # Whoever stands elsewhere is another body, and so is one with other joints.
    moved = replace(few.moments, mean=few.moments.mean + 2.0)
    assert beside_ours(replace(few, moments=moved)).moments is moved
    fewer = replace(few, joints=("root", *few.joints[1:]))
    assert beside_ours(fewer) is fewer
