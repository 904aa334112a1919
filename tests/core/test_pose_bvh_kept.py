"""A BVH that comes from a BVH: what did not change is the same bytes."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

import markermend as mm
from markermend.files.pose import crop_pose, pose_writer
from markermend.poses import Pose
from markermend.poses.quaternion import inverse, multiply, turn
from markermend.poses.restore import restore

FRAMES = 40
NAMES = ("Hips", "Spine", "Head", "LeftArm", "LeftForeArm", "LeftHand", "LeftUpLeg", "LeftLeg")
PARENTS = (-1, 0, 1, 1, 3, 4, 0, 6)
_ARM, _LEG = ((18, 5, 0), (28, 0, 0), (25, 0, 0)), ((9, -5, 0), (0, -42, 1))
OFFSETS = ((0, 0, 0), (0, 50, 0), (0, 25, 0), *_ARM, *_LEG)
PLACES = ("Xposition", "Yposition", "Zposition")
INSIDE = slice(12, 20)
ELBOW = NAMES.index("LeftForeArm")
# As programs write it: orders of axes, channels of position on every joint, digits, indentation,
# what lines of poses and all lines end in, words of the head.
BLENDER = SimpleNamespace(
    order="XYZ", everywhere=False, front=True, digits=6, tab="\t", behind="", end="\n"
)
MIXAMO = SimpleNamespace(
    order="ZYX", everywhere=True, front=True, digits=4, tab="  ", behind=" ", end="\r\n"
)
MAYA = SimpleNamespace(
    order="YXZ", everywhere=False, front=False, digits=3, tab="    ", behind="\t", end="\n"
)


def angles_of_all():
    """(frames, joints, 3) degrees, some beyond half a turn."""
    time = np.arange(FRAMES)[:, None, None] / 30.0
    phase = np.arange(len(NAMES))[:, None] + np.arange(3.0)
    angles = 25.0 * np.sin(2.0 * time + phase)
    angles[:, 0, 2] = 150.0 + 80.0 * time[:, 0, 0]
    return angles


def text_of(tool, angles=None):
    """A file as a program writes it."""
    angles = angles_of_all() if angles is None else angles
    turns = [f"{axis}rotation" for axis in tool.order]
    lines, columns = ["HIERARCHY"], []

    def describe(joint, depth):
        tab, deeper = tool.tab * depth, tool.tab * (depth + 1)
        places = list(PLACES) if joint == 0 or tool.everywhere else []
        names = places + turns if tool.front else turns + places
        columns.extend((joint, name) for name in names)
        lines.append(f"{tab}{'ROOT' if joint == 0 else 'JOINT'} {NAMES[joint]}")
        lines.append(tab + "{")
        lines.append(f"{deeper}OFFSET " + " ".join(f"{v:.{tool.digits}f}" for v in OFFSETS[joint]))
        lines.append(f"{deeper}CHANNELS {len(names)} {' '.join(names)}")
        below = [k for k, parent in enumerate(PARENTS) if parent == joint]
        for child in below:
            describe(child, depth + 1)
        if not below:
            lines.extend([f"{deeper}End Site", deeper + "{"])
            lines.extend([f"{deeper}{tool.tab}OFFSET 0 -10 0", deeper + "}"])
        lines.append(tab + "}")

    describe(0, 0)
    lines += ["MOTION", f"Frames:\t{FRAMES}", "Frame Time: 0.0333333"]
    for frame in range(FRAMES):
        row = []
        for joint, name in columns:
            axis = "XYZ".index(name[0])
            place = OFFSETS[joint][axis] + (90.0 + frame if joint == 0 else 0.0)
            row.append(place if name in PLACES else angles[frame, joint, axis])
        lines.append(" ".join(f"{value:.{tool.digits}f}" for value in row) + tool.behind)
    return tool.end.join(lines) + tool.end


def written(tmp_path, text, name="tool.bvh"):
    path = tmp_path / name
    path.write_bytes(text.encode())
    return path


def again(pose, tmp_path):
    """What is written of a recording."""
    mm.write_pose(pose, tmp_path / "out.bvh")
    return (tmp_path / "out.bvh").read_bytes()


def bent(pose, name, rows, by, about="x"):
    """A joint turned by degrees about an axis of its own, and what hangs on it carried along."""
    positions, rotations = np.array(pose.positions), np.array(pose.rotations)
    joint = pose.index(name)
    turned = multiply(
        rotations[rows, joint], Rotation.from_euler(about, by, degrees=True).as_quat()
    )
    over = multiply(turned, inverse(rotations[rows, joint]))
    for below in pose.hanging_on(joint):
        away = positions[rows, below] - pose.positions[rows, joint]
        positions[rows, below] = pose.positions[rows, joint] + turn(over, away)
        rotations[rows, below] = multiply(over, pose.rotations[rows, below])
    return pose.with_samples(positions, rotations)


def changed_cells(pose, raws):
    """(frame, joint, channel) of each number that is another text in the two files given."""
    names = [(j.name, channel) for j in pose.source.joints for channel in j.channels]
    here, there = (raw.split(b"MOTION")[1].splitlines()[3:] for raw in raws)
    assert len(here) == len(there) == FRAMES
    return {
        (frame, *names[column])
        for frame, (one, two) in enumerate(zip(here, there, strict=True))
        for column, (a, b) in enumerate(zip(one.split(), two.split(), strict=True))
        if a != b
    }


@pytest.mark.parametrize("tool", [BLENDER, MIXAMO, MAYA])
def test_what_did_not_change_is_the_same_bytes(tmp_path, tool):
    angles = angles_of_all()
    if tool is MAYA:
        # Some programs tell every angle within half a turn.
        angles = (angles + 180.0) % 360.0 - 180.0
    path = written(tmp_path, text_of(tool, angles))
    pose = mm.read_pose(path)
    assert again(pose, tmp_path) == path.read_bytes()
    # How an end is turned no file tells.
    rotations = np.array(pose.rotations)
    rotations[:, pose.index("Head_end")] = (1.0, 0.0, 0.0, 0.0)
    assert again(pose.with_samples(pose.positions, rotations), tmp_path) == path.read_bytes()
    # Rotations may be told by quaternions of the other sign, or as long as 1 once more.
    other = pose.with_samples(pose.positions, -pose.rotations * (1.0 + 1e-12))
    assert again(other, tmp_path) == path.read_bytes()


def test_a_recording_that_is_restored_and_had_nothing_wrong_is_the_same_bytes(tmp_path):
    path = written(tmp_path, text_of(MIXAMO))
    assert again(restore(mm.read_pose(path)).pose, tmp_path) == path.read_bytes()


@pytest.mark.parametrize("tool", [BLENDER, MIXAMO, MAYA])
def test_of_a_joint_that_is_repaired_its_channels_change_in_these_frames_only(tmp_path, tool):
    path = written(tmp_path, text_of(tool))
    pose = mm.read_pose(path)
    mended = bent(pose, "LeftForeArm", INSIDE, 20.0)
    raw = again(mended, tmp_path)
    assert raw.split(b"MOTION")[0] == path.read_bytes().split(b"MOTION")[0]
    assert raw.count(b"\r\n") == path.read_bytes().count(b"\r\n")
    cells = changed_cells(pose, (path.read_bytes(), raw))
    assert {(frame, joint) for frame, joint, _ in cells} == {
        (frame, "LeftForeArm") for frame in range(FRAMES)[INSIDE]
    }
    assert {channel for *_, channel in cells} <= {f"{axis}rotation" for axis in "XYZ"}
    back = mm.read_pose(tmp_path / "out.bvh")
    assert_allclose(back.positions, mended.positions, atol=1e-4)
    assert_allclose(np.abs(np.sum(back.rotations * mended.rotations, axis=2)), 1.0, atol=1e-12)


def test_what_hangs_on_a_joint_and_does_not_go_with_it_is_turned_anew(tmp_path):
    path = written(tmp_path, text_of(BLENDER))
    pose = mm.read_pose(path)
    turned = bent(pose, "LeftForeArm", INSIDE, 20.0)
    positions, rotations = np.array(turned.positions), np.array(turned.rotations)
    hand, end = pose.index("LeftHand"), pose.index("LeftHand_end")
    rotations[:, hand:] = pose.rotations[:, hand:]
    positions[:, end] = positions[:, hand] + pose.positions[:, end] - pose.positions[:, hand]
    raw = again(pose.with_samples(positions, rotations), tmp_path)
    cells = changed_cells(pose, (path.read_bytes(), raw))
    assert {joint for _, joint, _ in cells} == {"LeftForeArm", "LeftHand"}


@pytest.mark.parametrize("inside", [INSIDE, slice(0, 20), slice(12, FRAMES), slice(0, FRAMES)])
def test_angles_that_are_written_go_on_from_those_beside_them(tmp_path, inside):
    path = written(tmp_path, text_of(BLENDER))
    pose = mm.read_pose(path)
    before = pose.source.values
    # It goes on beyond 180 degrees, and its middle angle beyond 90.
    assert before[:, 5].max() > 190.0
    again(bent(pose, "Hips", inside, 5.0), tmp_path)
    after = mm.read_pose(tmp_path / "out.bvh").source.values
    assert np.abs(after - before)[inside].max() > 1.0
    assert np.abs(np.diff(after, axis=0)).max() < 20.0


def test_a_middle_angle_beyond_a_quarter_turn_goes_on(tmp_path):
    angles = angles_of_all()
    angles[:, ELBOW, 1] = np.linspace(70.0, 120.0, FRAMES)
    pose = mm.read_pose(written(tmp_path, text_of(BLENDER, angles)))
    again(bent(pose, "LeftForeArm", slice(2, FRAMES), 3.0, "z"), tmp_path)
    after = mm.read_pose(tmp_path / "out.bvh").source.values
    assert np.abs(np.diff(after, axis=0)).max() < 90.0


def test_channels_of_position_are_kept_up_where_a_joint_slides(tmp_path):
    text = text_of(MIXAMO)
    pose = mm.read_pose(written(tmp_path, text))
    slid = np.array(pose.positions)
    hand = list(pose.hanging_on(pose.index("LeftHand")))
    slid[INSIDE, hand] += turn(
        pose.rotations[INSIDE, pose.index("LeftForeArm")], np.array([30.0, 0.0, 0.0])
    )[:, None]
    raw = again(pose.with_samples(slid, pose.rotations), tmp_path)
    assert changed_cells(pose, (text.encode(), raw)) == {
        (frame, "LeftHand", "Xposition") for frame in range(FRAMES)[INSIDE]
    }
    sliding = mm.read_pose(tmp_path / "out.bvh")
    assert_allclose(sliding.positions, slid, atol=1e-4)
    # Where it slides anyway less than a millimetre counts, too.
    slid[5, hand] += turn(pose.rotations[5, pose.index("LeftForeArm")], np.array([0.5, 0.0, 0.0]))
    again(sliding.with_samples(slid, sliding.rotations), tmp_path)
    assert_allclose(mm.read_pose(tmp_path / "out.bvh").positions, slid, atol=1e-4)


def test_a_joint_without_channels_of_position_gets_them_where_its_bone_is_no_longer_as_long(
    tmp_path,
):
    path = written(tmp_path, text_of(BLENDER))
    pose = mm.read_pose(path)
    positions = np.array(pose.positions)
    positions[INSIDE, pose.index("LeftHand_end")] += 30.0
    positions[INSIDE, list(pose.hanging_on(pose.index("LeftLeg")))] += 30.0
    raw = again(pose.with_samples(positions, pose.rotations), tmp_path)
    back = mm.read_pose(tmp_path / "out.bvh")
    # An end that moves is a joint, with an end of its own.
    assert set(back.joints) == {*pose.joints, "LeftHand_end_end"}
    here = [back.joints.index(joint) for joint in pose.joints]
    assert_allclose(back.positions[:, here], positions, atol=1e-4)
    head, motion = raw.decode().split("MOTION")
    told = "\tCHANNELS 6 Xposition Yposition Zposition Xrotation Yrotation Zrotation\n"
    assert head.count(told) == 3
    assert head.replace(told, told[:10] + "3" + told[41:]).count("CHANNELS 3") == len(NAMES) + 1
    # Nothing else is another: without them it is the file that it was.
    outside = np.ones(FRAMES, dtype=bool)
    outside[INSIDE] = False
    names = [(j.name, channel) for j in back.source.joints for channel in j.channels]
    had = {(j.name, channel) for j in pose.source.joints for channel in j.channels}
    old = path.read_text().split("MOTION")[1].splitlines()[3:]
    for row, before in zip(motion.splitlines()[3:], old, strict=True):
        cells = zip(row.split(), names, strict=True)
        assert [cell for cell, name in cells if name in had] == before.split()
    assert_allclose(back.source.values[outside][:, names.index(("LeftLeg", "Yposition"))], -42.0)


def test_a_hinge_that_is_turned_otherwise_gets_the_axes_it_lacks(tmp_path):
    hinge = "JOINT LeftLeg\n\t\t{\n\t\t\tOFFSET 0.000000 -42.000000 1.000000\n\t\t\tCHANNELS "
    text = text_of(BLENDER)
    assert hinge + "3 Xrotation Yrotation Zrotation" in text
    text = text.replace(hinge + "3 Xrotation Yrotation Zrotation", hinge + "1 Xrotation")
    head, motion = text.split("Frame Time: 0.0333333\n")
    rows = [" ".join(line.split()[:-2]) for line in motion.splitlines()]
    path = written(tmp_path, head + "Frame Time: 0.0333333\n" + "\n".join(rows) + "\n")
    pose = mm.read_pose(path)
    knee = pose.index("LeftLeg")
    again(bent(pose, "LeftLeg", INSIDE, 10.0), tmp_path)
    assert len(mm.read_pose(tmp_path / "out.bvh").source.joints[knee].channels) == 1
    rotations = np.array(pose.rotations)
    twist = Rotation.from_euler("y", 10.0, degrees=True).as_quat()
    rotations[INSIDE, knee:] = multiply(rotations[INSIDE, knee:], twist)
    twisted = pose.with_samples(pose.positions, rotations)
    again(twisted, tmp_path)
    back = mm.read_pose(tmp_path / "out.bvh")
    assert back.source.joints[knee].channels == ["Xrotation", "Yrotation", "Zrotation"]
    same = np.abs(np.sum(back.rotations[:, knee] * rotations[:, knee], axis=1))
    assert_allclose(same, 1.0, atol=1e-12)


def test_a_part_keeps_the_hierarchy_and_its_poses(tmp_path):
    path = written(tmp_path, text_of(MIXAMO))
    pose = mm.read_pose(path)
    part = crop_pose(pose, 5, 12)
    fill, _ = pose_writer(part, tmp_path / "part.bvh", lambda *_: None, whole=pose)
    with (tmp_path / "part.bvh").open("wb") as file:
        fill(file)
    lines = path.read_bytes().replace(b"Frames:\t40", b"Frames:\t7").splitlines(keepends=True)
    first = len(lines) - FRAMES
    expected = b"".join(lines[:first] + lines[first + 5 : first + 12])
    assert (tmp_path / "part.bvh").read_bytes() == expected
    # So does a part of poses that go over lines as they like.
    head, motion = path.read_bytes().split(b"0.0333333\r\n")
    words = motion.split()
    rows = [b" ".join(words[first : first + 30]) for first in range(0, len(words), 30)]
    path.write_bytes(head + b"0.0333333 " + b"\r\n".join(rows) + b"\r\n")
    raw = again(crop_pose(mm.read_pose(path), 5, 12), tmp_path)
    assert raw.split(b"0.0333333")[1].split() == words[5 * 48 : 12 * 48]
    assert raw.endswith(b"\r\n")
    assert_allclose(mm.read_pose(tmp_path / "out.bvh").positions, part.positions)


def test_the_head_tells_another_rate_and_other_names(tmp_path):
    path = written(tmp_path, text_of(BLENDER))
    pose = mm.read_pose(path, rate=25.0)
    joints = tuple("left hand" if joint == "LeftHand" else joint for joint in pose.joints)
    raw = again(replace(pose, joints=joints), tmp_path)
    assert raw == path.read_bytes().replace(b"0.0333333", b"0.04").replace(
        b"JOINT LeftHand\n", b"JOINT left_hand\n"
    )


def test_an_end_that_is_called_otherwise_is_told_so(tmp_path):
    pose = mm.read_pose(written(tmp_path, text_of(BLENDER)))
    joints = tuple("tip" if joint == "LeftHand_end" else joint for joint in pose.joints)
    again(replace(pose, joints=joints), tmp_path)
    assert "tip" in mm.read_pose(tmp_path / "out.bvh").joints


def test_a_root_goes_by_less_than_a_millimetre_too(tmp_path):
    text = text_of(BLENDER)
    head, motion = text.split("Frame Time: 0.0333333\n")
    rows = [" ".join(["90.0"] * 3 + line.split()[3:]) for line in motion.splitlines()]
    path = written(tmp_path, head + "Frame Time: 0.0333333\n" + "\n".join(rows) + "\n")
    pose = mm.read_pose(path)
    moved = np.array(pose.positions)
    moved[INSIDE] += (0.5, 0.0, 0.0)
    raw = again(pose.with_samples(moved, pose.rotations), tmp_path)
    assert changed_cells(pose, (path.read_bytes(), raw)) == {
        (frame, "Hips", "Xposition") for frame in range(FRAMES)[INSIDE]
    }
    # One that could not go anywhere gets channels for it.
    no_place = head.replace("CHANNELS 6 " + " ".join(PLACES), "CHANNELS 3")
    rows = [" ".join(line.split()[3:]) for line in rows]
    written(tmp_path, no_place + "Frame Time: 0.0333333\n" + "\n".join(rows) + "\n")
    pose = mm.read_pose(path)
    moved = pose.positions + np.array([5.0, 0.0, 0.0])
    raw = again(pose.with_samples(moved, pose.rotations), tmp_path)
    assert raw.decode().split("MOTION")[0] == head.split("MOTION")[0]
    assert_allclose(mm.read_pose(tmp_path / "out.bvh").positions, moved, atol=1e-4)


def test_a_file_cut_short_is_written_as_it_was_read(tmp_path):
    text = text_of(BLENDER)
    whole = text[: text.rindex("\n", 0, -1)]
    path = written(tmp_path, whole + "\n1.0 2.0")
    raw = again(mm.read_pose(path), tmp_path)
    assert raw.decode() == whole.replace("Frames:\t40", "Frames:\t39") + "\n"


@pytest.mark.parametrize("letters", ["utf-8-sig", "latin-1"])
def test_letters_stay_as_they_are(tmp_path, letters):
    path = tmp_path / "tool.bvh"
    path.write_bytes(text_of(BLENDER).replace("LeftHand", "Händ").encode(letters))
    pose = mm.read_pose(path)
    assert again(pose, tmp_path) == path.read_bytes()
    # What a file's letters cannot tell is written in others.
    again(replace(pose, joints=("Бёдра", *pose.joints[1:])), tmp_path)
    assert mm.read_pose(tmp_path / "out.bvh").joints == ("Бёдра", *pose.joints[1:])


def test_what_is_not_there_any_more_as_it_was_read_is_written_anew(tmp_path):
    path = written(tmp_path, text_of(BLENDER))
    pose = mm.read_pose(path)
    for other in (text_of(BLENDER, angles_of_all() + 1.0), text_of(MAYA), "HELLO", None):
        path.unlink() if other is None else path.write_text(other)
        assert b"CHANNELS 3 Zrotation Xrotation Yrotation" in again(pose, tmp_path)
        assert_allclose(mm.read_pose(tmp_path / "out.bvh").positions, pose.positions, atol=1e-3)


def test_a_unit_that_would_not_be_told_again_has_it_written_anew(tmp_path):
    pose = mm.read_pose(written(tmp_path, text_of(BLENDER)), unit="mm")
    again(pose, tmp_path)
    assert_allclose(mm.read_pose(tmp_path / "out.bvh").positions, pose.positions, atol=1e-3)


def test_what_is_written_anew_has_no_minus_nought_and_no_angle_that_jumps(tmp_path):
    angles = angles_of_all()
    angles[:, ELBOW, 0] = np.linspace(150.0, 400.0, FRAMES)
    pose = mm.read_pose(written(tmp_path, text_of(BLENDER, angles)))
    positions = np.array(pose.positions)
    positions -= positions[:, :1] + 1e-9
    plain = Pose(positions, pose.rotations, pose.joints, pose.parents, pose.rate)
    assert b"-0.000000" not in again(plain, tmp_path)
    back = mm.read_pose(tmp_path / "out.bvh")
    assert np.abs(np.diff(back.source.values, axis=0)).max() < 90.0
    assert_allclose(np.abs(np.sum(back.rotations * pose.rotations, axis=2)), 1.0, atol=1e-12)
    # And it comes back as it is.
    (tmp_path / "own.bvh").write_bytes(again(plain, tmp_path))
    assert (
        again(mm.read_pose(tmp_path / "own.bvh"), tmp_path) == (tmp_path / "own.bvh").read_bytes()
    )
