"""How others bend: learnt, kept in a prior's file, told in a recording's own order, and of use."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from recordings import seventeen_joints, to_and_fro
from scipy.spatial.transform import Rotation
from sensed_bodies import with_hands

import markermend as mm
import markermend.poses.body.agreeing as agreed
import markermend.poses.restore as restoring
from markermend.errors import FileFormatError
from markermend.files.npz import read_arrays, write_arrays
from markermend.poses.body.bending import LOCAL, OthersBends, find_bends
from markermend.poses.body.suppleness import Suppleness, averaged_suppleness, suppleness
from markermend.poses.nuitrack import mirrored, to_nuitrack, twins
from markermend.poses.pose import Pose
from markermend.poses.prior import (
    Prior,
    bending_of,
    bones_of,
    load_prior,
    save_prior,
    shipped_prior,
)
from markermend.poses.prior_learning import learn_prior, learn_recording, together
from markermend.poses.restore import restore
from markermend.poses.simulated.noise import Noise, corrupt_pose
from markermend.poses.smoothing import smooth

JOINTS = ("waist", "left_hip", "right_hip", "left_knee", "right_knee")
PARENTS = (-1, 0, 0, 1, 2)


@pytest.fixture(scope="module")
def clips(shared_data) -> dict[str, Pose]:
    return seventeen_joints(shared_data, "02_01", "02_02", "03_02")


@pytest.fixture(scope="module")
def prior(clips) -> Prior:
    return learn_prior([clips["02_01"], clips["02_02"]])


def walking(frames: int = 400) -> np.ndarray:
    """(frames, joints, 7) of one whose left leg swings, and whose right one stands."""
    time = np.arange(frames) / 60.0
    features = np.zeros((frames, len(JOINTS), 7))
    features[..., 6] = 1.0
    features[:, 1, :3], features[:, 2, :3] = (0.1, -0.1, 0.0), (-0.1, -0.1, 0.0)
    hip = Rotation.from_rotvec(np.outer(0.4 * np.sin(2 * np.pi * time), (1.0, 0.3, -0.2)))
    bent = 0.6 + 0.5 * np.sin(2 * np.pi * time + 0.7)
    knee = hip * Rotation.from_rotvec(np.outer(bent, (1.0, 0.0, 0.0)))
    features[:, 1, 3:], features[:, 3, 3:] = hip.as_quat(), knee.as_quat()
    features[:, 3, :3] = features[:, 1, :3] + hip.apply([0.0, -0.4, 0.0])
    features[:, 4, :3] = features[:, 2, :3] + (0.0, -0.4, 0.0)
    return features


def test_a_knee_bends_about_one_axis_and_keeps_its_place() -> None:
    learnt = suppleness(walking(), JOINTS, PARENTS, range(5))
    assert learnt.joints == JOINTS[1:]
    assert learnt.parents == ("waist", "waist", "left_hip", "right_hip")
    for knee in (2, 3):
        own = slice(knee * LOCAL, (knee + 1) * LOCAL)
        bends = learnt.covariance[own, own]
        # Half of what is learnt is the other side's.
        assert bends[0, 0] == pytest.approx(0.5**2 / 2 / 2, rel=0.1)
        assert np.abs(np.delete(np.delete(bends, 0, 0), 0, 1)).max() < 1e-12


def test_the_mirror_image_of_a_body_bends_alike() -> None:
    features = walking()
    turned = features[:, twins(JOINTS)] * (-1, 1, 1, 1, -1, -1, 1)
    learnt = [suppleness(body, JOINTS, PARENTS, range(5)) for body in (features, turned)]
    assert_allclose(learnt[0].covariance, learnt[1].covariance, atol=1e-12)
    left, right = (learnt[0].covariance[n : n + 3, n : n + 3] for n in (0, LOCAL))
    # Turns about y and z are the other way round in a mirror of x.
    turned = np.outer([1, -1, -1], [1, -1, -1])
    assert_allclose(left, turned * right, atol=1e-12)
    assert left[0, 1] == pytest.approx(0.3 * left[0, 0])
    assert left[0, 0] == pytest.approx(0.4**2 / 2 / 2, rel=0.1)


def test_joints_are_told_in_any_order_unless_they_hang_elsewhere() -> None:
    covariance = np.arange(144.0).reshape(12, 12)
    one = Suppleness(("a", "b"), ("root", "a"), covariance)
    same = one.of(["a", "b"], ["root", "a"])
    assert same.told.all()
    assert_allclose(same.covariance, covariance)
    other = one.of(["b", "a"], ["a", "root"]).covariance
    assert_allclose(other[:LOCAL, LOCAL:], covariance[LOCAL:, :LOCAL])
    assert_allclose(other[LOCAL:, LOCAL:], covariance[:LOCAL, :LOCAL])
    for names, on in ((["c", "a", "b"], ["root", "root", "c"]), (["b", "a"], ["x", "root"])):
        some = one.of(names, on)
        at = names.index("a") * LOCAL
        assert some.told.sum() == LOCAL
        assert some.told[at : at + LOCAL].all()
        assert not some.covariance[~some.told].any()
        block = some.covariance[at : at + LOCAL, at : at + LOCAL]
        assert_allclose(block, covariance[:LOCAL, :LOCAL])


def test_places_are_in_the_unit_of_the_recording() -> None:
    one = Suppleness(("a",), ("root",), np.ones((6, 6)))
    longer = one.of(["a"], ["root"], times=2.0).covariance
    assert_allclose(longer, np.outer([1, 1, 1, 2, 2, 2], [1, 1, 1, 2, 2, 2]))


def test_several_count_by_their_weights() -> None:
    one = Suppleness(("a", "b"), ("root", "a"), np.eye(12))
    other = Suppleness(("b", "a"), ("a", "root"), 4 * np.diag([1.0] * 6 + [2.0] * 6))
    both = averaged_suppleness([one, None, other], [300.0, 5000.0, 100.0])
    assert both.joints == ("a", "b")
    assert_allclose(np.diag(both.covariance), [2.75] * 6 + [1.75] * 6)
    assert averaged_suppleness([None], [1.0]) is None
    elsewhere = replace(other, parents=("root", "root"))
    assert averaged_suppleness([one, elsewhere], [1.0, 1.0]) is None


def test_others_count_beside_what_a_recording_shows() -> None:
    features = walking()
    own = find_bends(features, PARENTS, range(5))
    covariance, told = np.zeros((4 * LOCAL, 4 * LOCAL)), np.ones(4 * LOCAL, dtype=bool)
    covariance[1, 1] = 0.3
    more = find_bends(features, PARENTS, range(5), OthersBends(covariance, told, 0.85))
    assert more.at.shape[1] == own.at.shape[1] + 1
    # Poses are the same poses in whatever coordinates.
    assert_allclose(more.features(more.at, features), features, atol=1e-9)


def test_joints_that_others_have_not_bend_as_far_as_the_recording_shows() -> None:
    features = walking()
    learnt = suppleness(features, JOINTS, PARENTS, range(5))
    without = replace(learnt, joints=learnt.joints[:2], parents=learnt.parents[:2])
    without = replace(without, covariance=4 * learnt.covariance[: 2 * LOCAL, : 2 * LOCAL])
    others = replace(without.of(learnt.joints, learnt.parents), share=1.0)
    assert others.told.sum() == 2 * LOCAL
    bends = find_bends(features, PARENTS, range(5), others)
    # Knees, of which nothing is told, go on bending.
    assert np.abs(bends.features(bends.at, features) - features).max() < 1e-6
    own = find_bends(features, PARENTS, range(5))
    assert bends.at.shape[1] >= own.at.shape[1]


@pytest.mark.parametrize("rate", [30.0, 120.0])
def test_who_stands_still_is_not_taken_to_bend_as_others_do(clips, prior, rate) -> None:
    some = np.full(200, 50)
    walk = clips["03_02"]
    truth = replace(
        walk.with_samples(walk.positions[some], walk.rotations[some], walk.confidence[some]),
        rate=rate,
    )
    damaged = corrupt_pose(truth, Noise(occlusion=0.0), seed=1)
    off = [
        np.sqrt(np.mean((restore(damaged, prior=known).pose.positions - truth.positions) ** 2))
        for known in (prior, replace(prior, suppleness=None))
    ]
    assert off[0] < off[1]


def test_files_keep_it(prior, tmp_path) -> None:
    save_prior(prior, tmp_path / "p.npz")
    back = load_prior(tmp_path / "p.npz").suppleness
    assert (back.joints, back.parents) == (prior.suppleness.joints, prior.suppleness.parents)
    assert_allclose(back.covariance, prior.suppleness.covariance, atol=1e-6)


def test_files_of_before_know_nothing_of_it(prior, tmp_path) -> None:
    save_prior(replace(prior, suppleness=None), tmp_path / "p.npz")
    assert "bent" not in read_arrays(tmp_path / "p.npz")
    assert load_prior(tmp_path / "p.npz").suppleness is None


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("bent", lambda bent: np.roll(bent, 1, axis=0)),
        ("bent", lambda bent: np.char.add(bent, "x")),
        ("bent", lambda bent: bent[:1]),
        ("bent", lambda bent: np.array([bent[0], np.char.add(bent[1], "x")])),
        ("bending", lambda bending: bending[:1]),
        ("bending", lambda bending: -bending),
        ("bending", lambda bending: bending > 0),
        ("bending", lambda bending: bending[:-1]),
        ("bending", lambda bending: np.full_like(bending, np.nan)),
    ],
)
def test_damaged_files_are_refused(prior, tmp_path, name, change) -> None:
    save_prior(prior, tmp_path / "p.npz")
    arrays = read_arrays(tmp_path / "p.npz")
    write_arrays(tmp_path / "q.npz", arrays | {name: change(arrays[name])})
    with pytest.raises(FileFormatError, match=r"q\.npz holds no prior"):
        load_prior(tmp_path / "q.npz")


def test_a_recording_is_told_of_it_where_its_joints_hang_alike(clips, prior) -> None:
    pose = clips["03_02"]
    told = bending_of(pose, prior)
    assert told.told.all()
    assert bending_of(pose, replace(prior, suppleness=None)) is None
    # Shoulders that hang on the neck turn in other axes.
    neck = pose.joints.index("neck")
    elsewhere = tuple(
        neck if "shoulder" in name else parent
        for name, parent in zip(pose.joints, pose.parents, strict=True)
    )
    body = replace(pose, parents=elsewhere)
    untold = ~bending_of(body, prior).told.reshape(-1, LOCAL)[:, 0]
    bent = [body.joints[joint] for joint in body.order[1:]]
    assert [bent[n] for n in np.flatnonzero(untold)] == ["left_shoulder", "right_shoulder"]
    other = Pose(
        pose.positions[:, ::-1],
        pose.rotations[:, ::-1],
        pose.joints[::-1],
        tuple(16 - p if p >= 0 else -1 for p in pose.parents[::-1]),
        pose.rate,
    )
    names = [[body.joints[j] for j in body.order[1:]] for body in (pose, other)]
    place = np.array([names[0].index(name) for name in names[1]])
    columns = (place[:, None] * LOCAL + np.arange(LOCAL)).ravel()
    assert_allclose(bending_of(other, prior).covariance, told.covariance[np.ix_(columns, columns)])


def test_bodies_with_hands_are_told_of_the_joints_that_others_have(shared_data, prior) -> None:
    pose = mm.read_pose(shared_data / "poses" / "03_02.amc")
    known = replace(prior, suppleness=replace(prior.suppleness, covariance=np.ones((96, 96))))
    body = with_hands(pose)
    told = bending_of(body, known)
    bent = [body.joints[joint] for joint in body.order[1:]]
    names = {bent[n] for n in np.flatnonzero(told.told[::LOCAL])}
    assert names == {*prior.joints[1:]}
    lengths = [np.mean(bones_of(p)) for p in (to_nuitrack(pose), body)]
    at = bent.index("left_knee") * LOCAL
    scale = np.sqrt(np.diag(told.covariance)[at : at + LOCAL])
    assert_allclose(scale, [1.0] * 3 + [lengths[0] / lengths[1]] * 3, rtol=1e-6)


def test_left_handed_recordings_teach_the_same(clips) -> None:
    one, other = (learn_recording(pose, "") for pose in (clips["02_01"], mirrored(clips["02_01"])))
    assert_allclose(other.suppleness.covariance, one.suppleness.covariance, atol=1e-9)


def test_what_comes_with_markermend_knows_it(clips) -> None:
    assert bending_of(clips["02_01"], shipped_prior()) is not None
    few = learn_recording(clips["02_01"], "")
    both = together([shipped_prior(), few])
    assert both.suppleness is not None


def test_it_brings_noisy_poses_nearer(clips, prior) -> None:
    truth = clips["03_02"]
    wanted = truth.positions
    off = {}
    for name, known in (("knows", prior), ("not", replace(prior, suppleness=None))):
        squared = []
        for seed in (1, 2, 3):
            damaged = corrupt_pose(truth, Noise(occlusion=0.0), seed=seed)
            found = restore(damaged, prior=known).pose.positions
            squared.append(np.mean((found - wanted) ** 2))
        off[name] = np.sqrt(np.mean(squared))
    assert off["knows"] < 0.97 * off["not"]


def test_each_step_of_restoring_is_told(clips, prior, monkeypatch) -> None:
    told = {}

    def spied(name, step):
        def run(*given):
            told[name] = given[-1]
            return step(*given)

        return run

    for where, name in ((restoring, "smooth"), (agreed, "settle"), (agreed, "settle_in_time")):
        monkeypatch.setattr(where, name, spied(name, getattr(where, name)))
    restore(corrupt_pose(clips["03_02"], Noise(), seed=1), prior=prior)
    assert told["smooth"].mean.shape == (112,)
    for name in ("settle", "settle_in_time"):
        assert told[name].covariance.shape == (96, 96)
    noisy = told["settle"].share
    for seconds, share in ((40.0, 0.5), (10.0, 0.8), (3.0, noisy)):
        lasting = to_and_fro(clips["03_02"], seconds)
        restore(corrupt_pose(lasting, Noise(displacement=0.0), seed=1), prior=prior)
        assert told["settle"].share == pytest.approx(share)


def test_what_moves_together_elsewhere_tells_movement_from_noise(clips, prior) -> None:
    random, moments = np.random.default_rng(1), prior.moments
    axes = np.linalg.eigh(moments.within_s(0.067))[1][:, -3:]
    time = np.arange(90) / 30.0
    paths = np.stack([np.sin(2 * np.pi * hertz * time) for hertz in (0.5, 0.8, 1.3)], axis=1)
    clean = 0.1 * paths @ axes.T
    noise = np.full(clean.shape[1], 0.05)
    noisy = clean + random.normal(0.0, 0.05, clean.shape)
    own, told = (smooth(noisy, noise, 30.0, known) for known in (None, moments))
    assert np.std(told - clean) < 0.9 * np.std(own - clean)
