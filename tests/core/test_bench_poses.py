"""The experiment on skeleton recordings, and what is learnt for it."""

from __future__ import annotations

import shutil

import numpy as np
import pytest
from numpy.testing import assert_allclose
from recordings import seventeen_joints

import markermend as mm
from markermend.bench import poses
from markermend.bench.parts import in_parts
from markermend.bench.poses import CASES, KNOWN, Row, compare, left_out, unseen
from markermend.bench.poses_network import error_of
from markermend.bench.poses_text import hidden_table, movements_table, poses_csv, poses_table
from markermend.cli import main
from markermend.errors import DataError, FileFormatError
from markermend.poses.networks.learning_sets import subject_of
from markermend.poses.nuitrack import mirrored, to_nuitrack
from markermend.poses.prior import fitting, load_prior, save_prior, shipped_prior
from markermend.poses.prior_learning import learn_prior
from markermend.poses.restore import Restored, restore
from markermend.poses.simulated.noise import Noise, corrupt_pose


@pytest.fixture(scope="module")
def clips(shared_data):
    return seventeen_joints(shared_data, "02_01", "03_02")


@pytest.fixture(scope="module")
def short(clips):
    """The first 1.5 s of each: enough to tell what is right from what is not."""
    return {
        name: pose.with_samples(pose.positions[:180], pose.rotations[:180])
        for name, pose in clips.items()
    }


def test_parts_are_equal_and_hold_every_pose(clips):
    pose = clips["02_01"]
    seen = np.arange(pose.frames * len(pose.joints)).reshape(pose.frames, -1) % 3 / 2
    pose = pose.with_samples(pose.positions, pose.rotations, seen)
    parts = in_parts("02_01", pose, 1.0)
    assert list(parts) == ["02_01.1", "02_01.2", "02_01.3"]
    assert np.ptp([part.frames for part in parts.values()]) <= 1
    for name in ("positions", "rotations", "confidence"):
        whole = np.concatenate([getattr(part, name) for part in parts.values()])
        assert_allclose(whole, getattr(pose, name), atol=1e-12)
    assert {subject_of(name) for name in parts} == {"02"}
    for whole in (60.0, None):
        assert in_parts("02_01", pose, whole) == {"02_01": pose}


def test_who_is_shown_is_known_where_others_show_the_same_person(shared_data):
    folder, some = shared_data / "poses", {}
    for name in ("02_01", "02_02", "03_02"):
        pose = to_nuitrack(mm.read_pose(folder / f"{name}.amc"))
        some[name] = pose.with_samples(pose.positions[:150], pose.rotations[:150])
    knows = {name: knowing for name, _, _, knowing in left_out(some)}
    assert {name: prior and len(prior.remembered) for name, prior in knows.items()} == {
        "02_01": 2,
        "02_02": 2,
        "03_02": None,
    }
    assert all(len(prior.remembered) for _, _, prior in unseen(some))
    rows = compare(some, cases=CASES[:1])
    named = [row.clip for row in rows if row.method == f"restore{KNOWN}"]
    assert named == ["02_01", "02_02"]
    assert "“who is shown known”" in poses_table(rows)[0]


def test_errors_are_the_papers():
    truth = np.zeros((2, 3, 7))
    truth[..., 6] = 1.0
    result = truth.copy()
    result[1, 1, 0] = 0.7
    result[:, 2, 3:] *= -2.0
    assert_allclose(error_of(result, truth), [0.0, 0.7 / 14])
    truth[:, 1, 3:] = [1.0, 0.0, 0.0, 0.0]
    result[:, 1, 3:] = [-1.0, 0.0, 0.0, 1e-9]
    assert_allclose(error_of(result, truth), [2.0 / 14, 2.7 / 14])
    assert_allclose(error_of(result, truth, nearer=True), [0.0, 0.7 / 14], atol=1e-9)
    assert subject_of("01_05") == "01"


def test_restoring_beats_what_knows_no_bodies(short):
    cases = [CASES[0], CASES[7]]
    rows = compare(short, cases=cases)
    error = {
        (case, method): np.mean([r.error for r in rows if (r.case, r.method) == (case, method)])
        for case, method in {(r.case, r.method) for r in rows}
    }
    for case in cases:
        for simple in ("as it is", "linear", "pchip", "pchip, filtered"):
            assert error[case.name, "restore"] < 0.8 * error[case.name, simple]
    text = "\n".join(poses_table(rows) + hidden_table(rows))
    assert "Frame by frame" in text
    assert "restore, no prior" in text
    assert len(poses_csv(rows).splitlines()) == 1 + len(rows)
    with pytest.raises(DataError, match="two or more"):
        compare({"02_01": short["02_01"]}, cases=cases)


def test_a_case_is_damaged_alike_whatever_is_run_beside_it(clips, monkeypatch):
    monkeypatch.setattr(poses, "restore", lambda pose, prior: Restored(pose, *(None,) * 3))
    monkeypatch.setattr(poses, "as_they_come", lambda pose, prior: (pose, pose.seen.any(axis=1)))
    cases = [CASES[0], CASES[7]]

    def damaged(cases, seed=1):
        rows = compare(clips, cases=cases, seed=seed)
        asked = CASES[7].name, "as it is"
        return [(r.clip, r.error) for r in rows if (r.case, r.method) == asked]

    assert damaged(cases) == damaged(cases[1:]) != damaged(cases[1:], seed=2)


def test_who_is_occluded_throughout_is_named(clips):
    short = {
        name: mm.Pose(p.positions[:60], p.rotations[:60], p.joints, p.parents, p.rate)
        for name, p in clips.items()
    }
    with pytest.raises(DataError, match="recording 02_01 is too short for “bursts of 1 s, 30 Hz”"):
        compare(short, cases=[CASES[6]])


def test_movements_are_grouped_by_how_much_is_occluded():
    def row(method, movements):
        return Row("02_01", "02", "bursts", "both", method, 0.1, (), (), tuple(movements), 10)

    rows = [
        row("one", [(1.0, 0.2), (1.1, 0.4), (2.0, 0.1)]),
        row("one", [(3.5, 0.9), (2.0, 0.3), (2.2, 0.3)]),
        row("other", [(1.0, 0.5)]),
    ]
    lines = [line.split() for line in movements_table(rows)[2:]]
    assert lines[1][-10:] == ["to", "1.5", "to", "2.0", "to", "2.5", "to", "3.0", "to", "3.5"]
    assert lines[2][1:] == ["2", "0", "3", "0", "1"]
    assert lines[3] == ["one", "0.3000", "–", "0.2333", "–", "0.9000"]
    assert lines[4] == ["other", "0.5000", "–", "–", "–", "–"]
    assert movements_table([row("short", [])]) == []


def test_poses_are_filled_as_they_come_too(clips):
    error = {r.method: r.error for r in compare(clips, cases=[CASES[4]]) if r.clip == "02_01"}
    assert error["restore"] < error["live"] < 0.5 * error["as it is"]


def test_a_prior_helps_whom_it_never_saw(clips):
    prior = learn_prior([clips["02_01"]])
    truth = clips["03_02"]
    noise = Noise(displacement=0.0, burst=120)
    damaged = [corrupt_pose(truth, noise, seed=seed) for seed in (1, 2)]

    def error(known):
        restored = [restore(pose, prior=known).pose.positions[~pose.seen] for pose in damaged]
        wanted = [truth.positions[~pose.seen] for pose in damaged]
        return np.sqrt(np.mean((np.concatenate(restored) - np.concatenate(wanted)) ** 2))

    assert error(prior) < 0.95 * error(None)


def test_a_prior_fits_left_hands_and_refuses_strangers(clips):
    prior, pose = shipped_prior(), clips["02_01"]
    moments, left_handed = fitting(pose, prior)
    assert not left_handed
    assert moments.mean.shape == (112,)
    assert fitting(mirrored(pose), prior)[1]
    shuffled = mm.Pose(
        pose.positions[:, ::-1],
        pose.rotations[:, ::-1],
        pose.joints[::-1],
        tuple(16 - p if p >= 0 else -1 for p in pose.parents[::-1]),
        pose.rate,
    )
    turned = fitting(shuffled, prior)[0]
    assert_allclose(turned.mean.reshape(16, 7)[::-1], moments.mean.reshape(16, 7))
    assert (
        fitting(
            mm.Pose(pose.positions[:, :2], pose.rotations[:, :2], ("a", "b"), (-1, 0), 30.0), prior
        )
        is None
    )
    damaged = corrupt_pose(pose, Noise(displacement=0.0, burst=20), seed=4)
    one, other = restore(damaged, prior=prior), restore(mirrored(damaged), prior=prior)
    assert_allclose(mirrored(other.pose).positions, one.pose.positions, atol=5e-3)


def test_priors_are_kept_in_files(clips, tmp_path):
    prior = learn_prior(list(clips.values()))
    save_prior(prior, tmp_path / "p.npz")
    back = load_prior(tmp_path / "p.npz")
    assert back.joints == prior.joints
    assert_allclose(back.moments.within, prior.moments.within, atol=1e-5)
    (tmp_path / "q.npz").write_bytes(b"nothing")
    with pytest.raises(FileFormatError, match="no prior"):
        load_prior(tmp_path / "q.npz")
    with pytest.raises(DataError, match="at least one"):
        learn_prior([])


def begin_of(folder, name, target, frames):
    """Copy the first poses of a recording, and its skeleton."""
    shutil.copy(folder / f"{name[:2]}.asf", target)
    text = (folder / f"{name}.amc").read_text()
    (target / f"{name}.amc").write_text(text[: text.index(f"\n{frames + 1}\n") + 1])


def test_command_line(shared_data, tmp_path, capsys):
    for name in ("02_01", "03_02"):
        begin_of(shared_data / "poses", name, tmp_path, 150)
    clip, prior = str(tmp_path / "02_01.amc"), str(tmp_path / "prior.npz")
    assert main(["train", "prior", clip, "-o", prior]) == 0
    assert "Learnt from 150 poses" in capsys.readouterr().out
    assert main(["denoise", clip, "-o", str(tmp_path / "o.csv"), "--prior", prior]) == 0
    assert main(["bench", "pose", clip, "--case", "nothing"]) == 1
    assert "frame by frame" in capsys.readouterr().err
    table = tmp_path / "t.csv"
    clips = [clip, str(tmp_path / "03_02.amc")]
    assert main(["bench", "pose", *clips, "--case", "0.25", "--hidden", "--csv", str(table)]) == 0
    assert "Joints occluded" in capsys.readouterr().out
    assert "restore" in table.read_text()
    parts = ["--parts", "0.6", "--case", "clean, 120", "--csv", "-"]
    assert main(["bench", "pose", *clips, *parts]) == 0
    named = {row.partition(",")[0] for row in capsys.readouterr().out.splitlines()[1:]}
    assert named == {"02_01.1", "02_01.2", "03_02.1", "03_02.2"}
    assert main(["bench", "pose", *clips, "--parts", "0.001"]) == 1
    assert "Parts must last 0.5 s at least" in capsys.readouterr().err
    assert main(["bench", "pose", *clips, *parts, "--networks", "n.npz"]) == 1
    assert "“--parts” or “--networks”" in capsys.readouterr().err
