"""Joint centres from markers, against joints that are known."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import markermend as mm
from markermend.arrays import FloatArray
from markermend.cli import main
from markermend.errors import DataError
from markermend.mesh import Group, Mesh
from markermend.poses.from_markers import centre_of_rotation, joint_centres
from markermend.simulation import simulate_clean, simulate_motion
from markermend.take import Take

FRAMES, RATE = 300, 100.0
CORNERS = np.array([[0, 0, 0], [120, 0, 0], [0, 90, 0], [40, 20, 70.0]])
CENTRES = np.array([[60.0, 30.0, -80.0], [10.0, -20.0, 150.0]])


def two_bodies(turns: Rotation, rng: np.random.Generator) -> tuple[FloatArray, FloatArray]:
    """Markers (frames, 8, 3) of two bodies that share a point, and that point (frames, 3)."""
    time = np.arange(FRAMES) / RATE
    first = Rotation.from_rotvec(0.5 * np.sin(np.outer(time, [1.1, 1.7, 2.3])))
    place = 300 * np.sin(np.outer(time, [0.7, 0.9, 1.3]))
    joint = first.apply(CENTRES[0]) + place
    second = first * turns
    away = joint - second.apply(CENTRES[1])
    sets = [
        np.stack([body.apply(corner) + origin for corner in CORNERS], axis=1)
        for body, origin in ((first, place), (second, away))
    ]
    points = np.concatenate(sets, axis=1)
    return points + rng.normal(0, 0.1, points.shape), joint


def ball() -> Rotation:
    time = np.arange(FRAMES) / RATE
    return Rotation.from_rotvec(0.6 * np.sin(np.outer(time, [2.9, 3.7, 4.1])))


def hinge() -> Rotation:
    return Rotation.from_rotvec(np.outer(np.sin(np.arange(FRAMES) / 15.0), [0.0, 1.0, 0.0]))


def made(points: FloatArray, first: int = 4) -> tuple[Take, Mesh]:
    """A take of two groups, the first of so many markers."""
    labels = tuple(f"M{i}" for i in range(points.shape[1]))
    groups = (
        Group("Upper", "", tuple(range(first))),
        Group("Lower", "", tuple(range(4, 8)), parent=0, parent_marker=0),
    )
    return Take(points, labels, RATE), Mesh(labels, groups)


def test_closed_form_is_exact_without_noise() -> None:
    first, second = Rotation.random(50, random_state=1), Rotation.random(50, random_state=2)
    place = np.random.default_rng(0).normal(0, 500, (50, 3))
    other = first.apply(CENTRES[0]) + place - second.apply(CENTRES[1])
    centres, _, turning = centre_of_rotation(first.as_matrix(), place, second.as_matrix(), other)
    assert np.abs(centres - CENTRES).max() < 1e-9
    assert turning.min() > 45.0
    assert (np.diff(turning) >= 0).all()


def test_a_ball_joint_is_found_and_gaps_leave_it_to_the_other_group() -> None:
    points, joint = two_bodies(ball(), np.random.default_rng(3))
    points[50:80, 1] = np.nan
    points[70:90, 6] = np.nan
    found = joint_centres(*made(points))
    assert found.pose.joints == ("Upper/Lower",)
    unseen = ~found.pose.seen[:, 0]
    assert np.array_equal(np.flatnonzero(unseen), np.arange(70, 80))
    off = np.linalg.norm(found.pose.positions[~unseen, 0] - joint[~unseen], axis=1)
    assert off.max() < 1.5
    assert 0.05 < found.joints[0].error_mm < 0.5
    assert np.isnan(found.pose.rotations[72:88, 0]).all()


@pytest.mark.parametrize(
    ("turns", "first", "flat", "why"),
    [
        (hinge() ** 0.02, 4, False, "turn against each other about a second axis by"),
        (ball(), 2, False, "Upper has fewer than 3 markers"),
        (ball(), 4, True, "the markers of Upper lie along one line"),
    ],
)
def test_what_cannot_be_told_is_left_out_with_its_reason(
    turns: Rotation, first: int, flat: bool, why: str
) -> None:
    points, _ = two_bodies(turns, np.random.default_rng(4))
    if flat:
        points[:, 2] = (points[:, 0] + points[:, 1]) / 2
        points[:, 3] = 2 * points[:, 1] - points[:, 0]
    with pytest.raises(DataError, match=why):
        joint_centres(*made(points, first))


def test_a_hinge_is_on_its_axis_midway_between_the_markers() -> None:
    points, joint = two_bodies(hinge(), np.random.default_rng(4))
    found = joint_centres(*made(points))
    (only,) = found.joints
    assert only.along == "the markers' middle"
    assert only.turning_deg < 1.0
    # The axis is y of both bodies, whose markers lie from 0 to 90 there.
    off = found.pose.positions[:, 0] - joint
    first = Rotation.from_rotvec(0.5 * np.sin(np.outer(np.arange(FRAMES) / RATE, [1.1, 1.7, 2.3])))
    along = first.inv().apply(off)
    assert np.abs(along[:, [0, 2]]).max() < 1.5
    reach = np.concatenate([CORNERS[:, 1] - centre[1] for centre in CENTRES])
    assert np.abs(along[:, 1] - (reach.min() + reach.max()) / 2).max() < 1.5
    assert only.doubt_mm > np.abs(along[:, 1]).max()


def test_noise_that_the_turning_cannot_carry_leaves_a_joint_out() -> None:
    time = np.arange(FRAMES) / RATE
    small = Rotation.from_rotvec(0.1 * np.sin(np.outer(time, [2.9, 3.7, 4.1])))
    rng = np.random.default_rng(5)
    points, _ = two_bodies(small, rng)
    with pytest.raises(DataError, match=r"it could lie \d+ mm off"):
        joint_centres(*made(points + rng.normal(0, 25.0, points.shape)))


def test_a_performers_joints_are_found_where_they_are() -> None:
    found = joint_centres(simulate_clean(duration_s=40.0, rate=50.0, seed=2))
    at = simulate_motion(duration_s=40.0, rate=50.0, seed=2).origins
    # Neck and spine bend in two joints, half in each: together they turn about the point between.
    truth = {
        "Trunk/Head": (at["neck"] + at["head"]) / 2,
        "Trunk/Pelvis": (at["lumbar"] + at["thorax"]) / 2,
        "Pelvis/Left thigh": at["Lthigh"],
        "Pelvis/Right thigh": at["Rthigh"],
        "Trunk/Left upper arm": at["Lupperarm"],
        "Trunk/Right upper arm": at["Rupperarm"],
    }
    doubt = {joint.name: joint.doubt_mm for joint in found.joints if not joint.left_out}
    assert set(truth) <= set(found.pose.joints)
    for name, place in truth.items():
        off = np.linalg.norm(found.pose.positions[:, found.pose.index(name)] - place, axis=1)
        assert np.median(off) < 30.0, name
        assert np.median(off) < 2 * doubt[name], name
    # The performer's knees are hinges, below the hips.
    for side, letter in (("Left", "L"), ("Right", "R")):
        (knee,) = [j for j in found.joints if j.name.startswith(f"{side} thigh/{side} shank")]
        assert knee.along == "the joints beside it"
        off = np.linalg.norm(
            found.pose.positions[:, found.pose.index(knee.name)] - at[f"{letter}shank"], axis=1
        )
        assert np.median(off) < 40.0
        assert np.median(off) < knee.doubt_mm


def test_command_writes_joints_and_says_what_it_left_out(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    source, output = tmp_path / "walk.trc", tmp_path / "joints.csv"
    mm.write(simulate_clean(duration_s=40.0, rate=50.0, seed=0), source)
    assert main(["pose", str(source), "-o", str(output)]) == 0
    said = capsys.readouterr().out
    for words in ("Pelvis/Left thigh", "Left out", "fewer than 3 markers", "the joints beside it"):
        assert words in said
    back = mm.read_pose(output)
    found = joint_centres(mm.read(source))
    assert back.joints == found.pose.joints
    assert back.parents == found.pose.parents
    assert np.nanmax(np.abs(back.positions - found.pose.positions)) < 0.001
    assert main(["pose", str(source), "-o", str(output)]) == 1
    assert main(["pose", str(source), "-o", str(tmp_path / "joints.xyz")]) == 1
    assert "should end in .csv" in capsys.readouterr().err
    assert main(["pose", str(output), "-o", str(tmp_path / "again.csv")]) == 1
    assert "skeleton recording" in capsys.readouterr().err
