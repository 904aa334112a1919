"""Biovision hierarchies in and out."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

import markermend as mm
from markermend.errors import ExportError, FileFormatError
from markermend.poses import Pose

TEXT = """HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT LeftLeg
  {
    OFFSET 10 0 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 -40 0
    }
  }
}
MOTION
Frames: 2
Frame Time: 0.0333333
1 90 2 0 0 0 0 0 0
1 90 2 90 0 0 0 90 0
"""


def written(tmp_path, text):
    path = tmp_path / "walk.bvh"
    path.write_text(text)
    return path


def test_a_hierarchy_moves(tmp_path):
    pose = mm.read_pose(written(tmp_path, TEXT))
    assert pose.joints == ("Hips", "LeftLeg", "LeftLeg_end")
    assert pose.parents == (-1, 0, 1)
    assert pose.rate == 30.0
    assert "centimetres" in pose.warnings[0]
    assert_allclose(pose.positions[0], [[10, 900, 20], [110, 900, 20], [110, 500, 20]])
    # The root turned 90° about z: the hip is above it, the leg points along x; then about x.
    assert_allclose(pose.positions[1], [[10, 900, 20], [10, 1000, 20], [10, 1000, -380]], atol=1e-6)


def test_what_goes_out_comes_back(tmp_path, shared_data):
    from markermend.poses.nuitrack import to_nuitrack

    pose = mm.read_pose(shared_data / "poses" / "02_01.amc")
    pose = Pose(pose.positions, pose.rotations, pose.joints, pose.parents, pose.rate)
    body = to_nuitrack(pose)
    mm.write_pose(body, tmp_path / "body.bvh")
    back = mm.read_pose(tmp_path / "body.bvh")
    same = [back.joints.index(joint) for joint in body.joints]
    assert back.frames == body.frames
    turned = np.abs(np.sum(back.rotations[:, same] * body.rotations, axis=2))
    assert_allclose(turned, 1.0, atol=1e-8)
    # Arms and legs are rigid; shoulders move in the trunk, and are moved.
    assert_allclose(back.positions[:, same], body.positions, atol=1.0)
    text = (tmp_path / "body.bvh").read_text()
    assert "left_elbow\n" in text
    moved = [line.split()[1] for line in text.splitlines() if line.strip().startswith("CHANNELS")]
    assert 1 < moved.count("6") < len(moved) / 2


def test_joints_at_the_ends_of_their_bones_are_written_where_these_begin(tmp_path, shared_data):
    pose = mm.read_pose(shared_data / "poses" / "02_01.amc")
    mm.write_pose(pose, tmp_path / "body.bvh")
    back = mm.read_pose(tmp_path / "body.bvh")
    for joint, name in enumerate(pose.joints):
        here, above = back.index(name), max(pose.parents[joint], 0)
        assert_allclose(back.positions[:, here], pose.positions[:, above], atol=0.01)
        turned = np.abs(np.sum(back.rotations[:, here] * pose.rotations[:, joint], axis=1))
        assert_allclose(turned, 1.0, atol=1e-8)
        if f"{name}_end" in back.joints:
            end = back.positions[:, back.index(f"{name}_end")]
            assert_allclose(end, pose.positions[:, joint], atol=0.01)
    assert (tmp_path / "body.bvh").read_text().count("6 Xposition") == 1
    # What was read is written as it was.
    mm.write_pose(back, tmp_path / "again.bvh")
    one, two = ((tmp_path / n).read_text().split("MOTION") for n in ("body.bvh", "again.bvh"))
    assert one[0] == two[0]


def test_joints_that_slide_in_a_hierarchy_stay_who_they_are(tmp_path):
    random = np.random.default_rng(5)
    slides = "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n    End"
    text = TEXT.replace("CHANNELS 3 Zrotation Xrotation Yrotation\n    End", slides)
    head = text[: text.index("Frames")] + "Frames: 40\nFrame Time: 0.02\n"
    # Its own axes stay where they are, those of what it hangs on do not.
    hips = np.cumsum(random.normal(0.0, 9.0, (40, 6)), axis=0)
    turns = Rotation.from_euler("ZXY", hips[:, 3:], degrees=True)
    leg = np.hstack(
        [turns.inv().apply([10.0, 0.0, 0.0]), turns.inv().as_euler("ZXY", degrees=True)]
    )
    rows = [" ".join(f"{value:.6f}" for value in row) for row in np.hstack([hips, leg])]
    pose = mm.read_pose(written(tmp_path, head + "\n".join(rows) + "\n"))
    mm.write_pose(pose, tmp_path / "back.bvh")
    back = mm.read_pose(tmp_path / "back.bvh")
    assert back.joints == pose.joints
    np.testing.assert_allclose(back.positions, pose.positions, atol=1e-3)


def test_a_rate_comes_back(tmp_path):
    pose = mm.read_pose(written(tmp_path, TEXT))
    for rate in (240.0, 119.88, 1000.0, 29.97):
        mm.write_pose(replace(pose, rate=rate), tmp_path / "fast.bvh")
        assert mm.read_pose(tmp_path / "fast.bvh").rate == rate


@pytest.mark.parametrize("times", [0.01, 30.0])
def test_a_body_of_any_size_comes_back_in_it(tmp_path, times):
    pose = mm.read_pose(written(tmp_path, TEXT))
    other = pose.with_samples(pose.positions * times, pose.rotations)
    mm.write_pose(other, tmp_path / "other.bvh")
    back = mm.read_pose(tmp_path / "other.bvh")
    assert_allclose(back.positions, other.positions, rtol=1e-4, atol=1e-3)


def test_two_names_that_would_be_one_are_refused(tmp_path):
    pose = mm.read_pose(written(tmp_path, TEXT))
    alike = replace(pose, joints=("Left Arm", "Left_Arm", "Left_Arm_end"))
    with pytest.raises(ExportError, match="it has two joints called “Left_Arm”; rename joints"):
        mm.write_pose(alike, tmp_path / "alike.bvh")


def test_a_root_that_stands_still_keeps_its_place(tmp_path):
    pose = mm.read_pose(written(tmp_path, TEXT))
    mm.write_pose(pose, tmp_path / "still.bvh")
    assert_allclose(mm.read_pose(tmp_path / "still.bvh").positions, pose.positions, atol=1e-4)


def test_a_root_may_be_any_of_the_joints(tmp_path):
    turned = Rotation.from_euler("z", np.linspace(0, 60, 9)[:, None], degrees=True)
    bent = turned * Rotation.from_euler("x", np.linspace(0, 80, 9)[:, None], degrees=True)
    root = np.tile([500.0, 900.0, 20.0], (9, 1))
    knee = root + turned.apply([0, -400, 0])
    ankle = knee + bent.apply([0, -380, 0])
    still = np.tile([0.0, 0.0, 0.0, 1.0], (9, 1))
    rotations = np.stack([bent.as_quat(), turned.as_quat(), still], axis=1)
    positions = np.stack([ankle, knee, root], axis=1)
    pose = Pose(positions, rotations, ("shank", "thigh", "hips"), (1, 2, -1), 30.0)
    mm.write_pose(pose, tmp_path / "last.bvh")
    back = mm.read_pose(tmp_path / "last.bvh")
    for name, at in (("hips", root), ("thigh", root), ("shank", knee), ("shank_end", ankle)):
        assert_allclose(back.positions[:, back.index(name)], at, atol=0.01)


def test_nothing_is_no_bvh(tmp_path):
    pose = Pose(np.zeros((0, 1, 3)), np.zeros((0, 1, 4)), ("waist",), (-1,), 30.0)
    with pytest.raises(ExportError, match="no pose"):
        mm.write_pose(pose, tmp_path / "no.bvh")


def test_without_rotations_there_is_no_bvh(tmp_path):
    rotations = np.full((5, 1, 4), np.nan)
    pose = Pose(np.zeros((5, 1, 3)), rotations, ("waist",), (-1,), 30.0)
    with pytest.raises(ExportError, match="write a CSV"):
        mm.write_pose(pose, tmp_path / "no.bvh")


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("HIERARCHY", "HELLO"), "HIERARCHY"),
        (("Frame Time: 0.0333333", "Frame Time: 0"), "no time between frames"),
        (("Yrotation\n    End", "Wrotation\n    End"), "“Wrotation” is no channel"),
        (("0 90 0\n", "0 x 0\n"), "“x” in line 20 is no finite number"),
        (("Frame Time: 0.0333333", "Frame Time: soon"), "“soon” is no time between frames"),
        (
            ("Frame Time: 0.0333333", "Frame Time: 0.000001"),
            "walk.bvh would have 1e\\+06 poses a sec",
        ),
        (("Frame Time: 0.0333333", "Frame Time: 1e300"), "walk.bvh would have 1e-300 poses"),
        (("Frames: 2", "Frames: two"), "“two” is no number of frames"),
        (("Frames: 2", "Frames: ²"), "“²” is no number of frames"),
        (("Frames: 2", f"Frames: {'9' * 5000}"), "“9{40}” is no number of frames"),
        (("CHANNELS 3", f"CHANNELS {'9' * 5000}"), "“9{40}” is no number of channels"),
        (("Frames: 2", "Frames: 1"), "more poses follow than the 1"),
        (("CHANNELS 3", "CHANNELS all"), "“all” is no number of channels of “LeftLeg”"),
        (
            ("Zrotation Xrotation Yrotation\n    End", "Zrotation Zrotation Yrotation\n    End"),
            "twice",
        ),
        (("}\nMOTION", "}\n}\nMOTION"), "“}” stands outside of every joint"),
        (("ROOT Hips\n{", "OFFSET 0 0 0"), "“OFFSET” stands outside of every joint"),
        (("JOINT LeftLeg", "JOINT Hips"), "two joints called “Hips”"),
        (("OFFSET 10 0 0", "OFFSET nan 0 0"), "OFFSET of “LeftLeg” is “nan 0 0”"),
        (("OFFSET 10 0 0", "OFFSET 1e308 0 0"), "OFFSET of “LeftLeg” is “1e308 0 0”"),
        (("1 90 2 0 0 0 0 0 0\n", "1 90 2 0 0 0 0 0 0 0\n"), "line 19 has 10 numbers for 9"),
        (("1 90 2 0 0 0 0 0 0\n", "1 90 2 0 0 0 0 0\n"), "line 19 has 8 numbers for 9"),
        (("JOINT LeftLeg", "BONE LeftLeg"), "“BONE” has no place"),
        ((TEXT[TEXT.index("MOTION") :], ""), "cut short"),
    ],
)
def test_damaged_files_get_one_sentence(tmp_path, change, said):
    with pytest.raises(FileFormatError, match=said):
        mm.read_pose(written(tmp_path, TEXT.replace(*change)))


def test_a_joint_may_end_several_times(tmp_path):
    toe = TEXT[TEXT.index("    End Site") : TEXT.index("  }\n}\nMOTION")]
    three = TEXT.replace(toe, toe + toe.replace("0 -40 0", "5 -40 0") + toe.replace("-40", "-39"))
    pose = mm.read_pose(written(tmp_path, three))
    ends = [f"LeftLeg_end{n}" for n in ("", "2", "3")]
    assert pose.joints == ("Hips", "LeftLeg", *ends)
    mm.write_pose(pose, tmp_path / "back.bvh")
    text = (tmp_path / "back.bvh").read_text()
    assert (text.count("End Site"), text.count("CHANNELS")) == (3, 2)
    back = mm.read_pose(tmp_path / "back.bvh")
    assert back.joints == pose.joints
    np.testing.assert_allclose(back.positions, pose.positions, atol=1e-4)
    # A joint that is only called so has a name and angles of its own.
    other = replace(pose, joints=("Hips", "LeftLeg", "LeftLeg_end2", "LeftLeg_end", "toes"))
    mm.write_pose(other, tmp_path / "other.bvh")
    assert set(other.joints) < set(mm.read_pose(tmp_path / "other.bvh").joints)


@pytest.mark.parametrize(
    ("line", "other"),
    [
        ("Frame Time: 0.0333333", "Frame time:\t.0333333"),
        ("Frame Time: 0.0333333", "Frame Time:0.0333333"),
        ("Frames: 2", "Frames:2"),
        ("Frames: 2", "frames : 2\n\n"),
        ("Frames: 2\nFrame Time: 0.0333333\n", "Frames: 2 Frame Time: 0.0333333 "),
    ],
)
def test_the_head_of_a_movement_is_read_as_programs_write_it(tmp_path, line, other):
    pose = mm.read_pose(written(tmp_path, TEXT.replace(line, other)))
    assert (pose.frames, pose.rate) == (2, 30.0)


def test_what_is_wrong_with_a_file_names_it(tmp_path):
    with pytest.raises(FileFormatError, match=r"walk\.bvh is damaged: it has two"):
        mm.read_pose(written(tmp_path, TEXT.replace("LeftLeg", "Hips")))


def test_names_may_have_blanks(tmp_path):
    pose = mm.read_pose(written(tmp_path, TEXT.replace("LeftLeg", "Bip01 L Leg")))
    assert pose.joints == ("Hips", "Bip01 L Leg", "Bip01 L Leg_end")
    with pytest.raises(FileFormatError, match=r"no \{ follows the joint “LeftLeg”"):
        mm.read_pose(written(tmp_path, TEXT.replace("LeftLeg\n  {", "LeftLeg")))


def test_poses_may_go_over_several_lines(tmp_path):
    split = mm.read_pose(written(tmp_path, TEXT.replace("2 0 0 0", "2\n0 0 0")))
    assert_allclose(split.positions[0], mm.read_pose(written(tmp_path, TEXT)).positions[0])
    assert split.frames == 2


def test_a_pose_no_body_can_have_counts_as_not_seen(tmp_path):
    pose = mm.read_pose(written(tmp_path, TEXT.replace("1 90 2 0 0 0 0", "1e200 90 2 0 0 0 0")))
    assert pose.seen.tolist() == [[False] * 3, [True] * 3]
    assert "3 samples whose coordinates are no numbers" in pose.warnings[1]


def test_a_rate_that_is_given_holds(tmp_path):
    assert mm.read_pose(written(tmp_path, TEXT), rate=25.0).rate == 25.0
    for rate in (1e300, 1e-300, 1e6, 0.0):
        with pytest.raises(FileFormatError, match="no rate of a recording"):
            mm.read_pose(written(tmp_path, TEXT), rate=rate)


def test_joints_may_hang_deeper_than_python_calls(tmp_path):
    depth = 1500
    places = np.zeros((2, depth, 3))
    places[..., 1] = 100.0 * np.arange(depth)
    turns = np.tile([0.0, 0.0, 0.0, 1.0], (2, depth, 1))
    names = tuple(f"j{n}" for n in range(depth))
    pose = Pose(places, turns, names, tuple(range(-1, depth - 1)), 30.0)
    mm.write_pose(pose, tmp_path / "deep.bvh")
    back = mm.read_pose(tmp_path / "deep.bvh")
    # An end is written where the last joint is.
    assert back.joints == (*names, f"j{depth - 1}_end")
    assert_allclose(back.positions[:, -1], places[:, -1], rtol=0.01)


def test_a_file_cut_short_keeps_its_poses(tmp_path):
    pose = mm.read_pose(written(tmp_path, TEXT[: TEXT.rindex("0 90 0")]))
    assert pose.frames == 1
    assert "cut short" in pose.warnings[0]


def test_unseen_joints_cannot_go_out(tmp_path):
    pose = mm.read_pose(written(tmp_path, TEXT))
    hidden = pose.with_samples(pose.positions, pose.rotations, np.array([[1, 1, 0], [1, 1, 1.0]]))
    with pytest.raises(ExportError, match=r"not known: \w+ 1\. Repair these gaps"):
        mm.write_pose(hidden, tmp_path / "out.bvh")
