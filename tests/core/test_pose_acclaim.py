"""Acclaim skeletons and movements: read, moved, and refused in one sentence when damaged."""

from __future__ import annotations

import math
import random
from dataclasses import replace

import numpy as np
import pytest
from acclaim import AMC, ASF, write_small
from numpy.testing import assert_allclose

import markermend as mm
from markermend.errors import FileFormatError, NoSkeletonError
from markermend.files.amc import read_amc
from markermend.files.asf import read_asf
from markermend.files.pose import crop_pose


@pytest.fixture
def small(tmp_path):
    return write_small(tmp_path)


def turn(axis, degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    i, j = [k for k in range(3) if k != axis]
    m = np.eye(3)
    m[i, i] = m[j, j] = c
    m[i, j], m[j, i] = (-s, s) if axis != 1 else (s, -s)
    return m


def in_order(axes, degrees):
    m = np.eye(3)
    for axis, angle in zip(axes, degrees, strict=True):
        m = turn("xyz".index(axis), angle) @ m
    return m


def test_kinematics_are_those_of_the_paper(small):
    pose = mm.read_pose(small / "a_1.amc")
    mm_of = 25.4 / 0.45
    root_c = in_order("xyz", [0, 0, 30])
    root = root_c @ in_order("xyz", [10, 20, 30]) @ root_c.T
    upper_c = in_order("xyz", [10, 20, 30])
    upper = root @ upper_c @ in_order("xyz", [40, 50, 60]) @ upper_c.T
    lower_c = in_order("zyx", [0, -40, 15])
    lower = upper @ lower_c @ in_order("zx", [-20, 35]) @ lower_c.T
    start = np.array([2.0, 2, 3]) * mm_of
    knee = start + upper @ [0, -4 * mm_of, 0]
    at = dict(zip(pose.joints, pose.positions[0], strict=True))
    assert pose.joints == ("root", "upper", "stump", "lower")
    assert pose.parents == (-1, 0, 0, 1)
    assert_allclose(at["root"], start)
    assert_allclose(at["upper"], knee)
    assert_allclose(at["lower"], knee + lower @ [3 * mm_of, 0, 0])
    assert_allclose(at["stump"], start + root @ [0, 0, mm_of])
    x, y, z, w = pose.rotations[0, 3]
    assert_allclose([1 - 2 * (y * y + z * z), 2 * (x * y + z * w)], lower[:2, 0], atol=1e-12)


def test_radians_rate_and_scale(small):
    degrees = mm.read_pose(small / "a_1.amc")
    words = [line.split() for line in AMC.splitlines()]
    lines = [":FULLY-SPECIFIED", ":RADIANS", ":SAMPLES-PER-SECOND 60"]
    for first, *rest in words[3:]:
        turns = rest if first != "root" else rest[3:]
        kept = [] if first != "root" else rest[:3]
        lines.append(" ".join([first, *kept, *(repr(math.radians(float(v))) for v in turns)]))
    (small / "r.amc").write_text("\n".join(lines))
    radians = mm.read_pose(small / "r.amc", skeleton=small / "a.asf")
    assert radians.rate == 60
    assert radians.warnings == ()
    (small / "s.amc").write_text("\n".join([lines[0], ": Radians", *lines[2:]]))
    spaced = mm.read_pose(small / "s.amc", skeleton=small / "a.asf")
    assert_allclose(spaced.positions, radians.positions)
    assert degrees.rate == 120
    assert_allclose(radians.positions, degrees.positions, atol=1e-9)
    (small / "a.asf").write_text(ASF.replace("length 0.45", "length 0.9"))
    assert_allclose(mm.read_pose(small / "a_1.amc").positions, degrees.positions / 2)


def test_segments_left_out(small):
    (small / "a_2.amc").write_text(AMC.replace("lower -20 35\n", "").replace("lower 10 20\n", ""))
    never = mm.read_pose(small / "a_2.amc")
    assert never.seen.all()
    assert any("lower" in sentence for sentence in never.warnings)
    (small / "a_3.amc").write_text(AMC.replace("upper 40 50 60\n", "extra 1\n") + "# the end\n")
    once = mm.read_pose(small / "a_3.amc")
    assert once.seen.tolist() == [[True, False, True, False], [True] * 4]
    assert not once.turned[0, 0], "nobody knows how the root of an unseen segment is turned"
    assert any("extra" in sentence for sentence in once.warnings)


def test_the_same_poses_however_they_are_written(small):
    alike = mm.read_pose(small / "a_1.amc")
    (small / "a_4.amc").write_text(AMC.replace("lower -20 35", "lower -20 35 # bent"))
    assert_allclose(mm.read_pose(small / "a_4.amc").positions, alike.positions)
    (small / "a_5.amc").write_bytes(AMC.replace("\n", "\r\n").encode())
    assert_allclose(mm.read_pose(small / "a_5.amc").positions, alike.positions)


CUT = "The file is cut short; what its last pose lacks was read as missing."


@pytest.mark.parametrize(
    ("end", "lacks"),
    [
        ("upper 0 0 90\n", {"lower"}),
        ("upper 0 0 90\nlow", {"lower"}),
        ("upper 0 0 90\nlower 10", {"lower"}),
        # Of the last number digits may be missing.
        ("upper 0 0 9", {"upper", "lower"}),
        ("upper 0", {"upper", "lower"}),
    ],
)
def test_of_a_last_pose_that_is_cut_only_what_lacks_is_missing(small, end, lacks):
    head = AMC[: AMC.rindex("upper")]
    (small / "a_6.amc").write_text(head + end)
    pose = mm.read_pose(small / "a_6.amc")
    assert pose.seen.tolist() == [[True] * 4, [joint not in lacks for joint in pose.joints]]
    assert pose.warnings[0] == CUT
    mm.write_pose(mm.read_pose(small / "a_1.amc"), small / "a_7.amc")
    whole = mm.read_pose(small / "a_7.amc").source
    filled = replace(pose, source=replace(whole, file=small / "a_6.amc"))
    filled = filled.with_samples(
        mm.read_pose(small / "a_7.amc").positions, mm.read_pose(small / "a_7.amc").rotations
    )
    mm.write_pose(filled, small / "a_8.amc")
    assert (small / "a_8.amc").read_text().rstrip() == AMC.rstrip()


@pytest.mark.parametrize("end", ["2\n", "2", "2\nroot 4 5"])
def test_a_last_pose_of_which_nothing_is_there_is_left_out(small, end):
    (small / "a_6.amc").write_text(AMC[: AMC.index("\n2\n") + 1] + end)
    pose = mm.read_pose(small / "a_6.amc")
    assert pose.frames == 1
    assert pose.warnings[0] == "The file is cut short; its last pose was left out."


def test_a_number_that_is_cut_is_no_jump(tmp_path):
    (tmp_path / "a.asf").write_text(ASF)
    (tmp_path / "a_1.amc").write_text(
        AMC.replace("\n2\n", "\n12\n").replace("\n1\n", "\n11\n") + "1"
    )
    pose = mm.read_pose(tmp_path / "a_1.amc")
    assert pose.frames == 2
    assert pose.warnings[0] == "The file is cut short; its last pose was left out."
    assert len(pose.warnings) == 2


@pytest.mark.parametrize(
    ("asf", "amc", "says"),
    [
        (ASF, AMC.replace("upper 40 50 60", "upper 40 fifty 60"), "line 6"),
        (ASF, AMC.replace("upper 40 50 60", "upper 40 50"), "line 6"),
        (ASF, AMC.replace("upper 40 50 60", "upper 40 50 nan"), "line 6"),
        (ASF, ":DEGREES\n", "cut short"),
        (ASF, "1\nnobody 3\n", "no pose"),
        (ASF.replace("     length 4\n", ""), AMC, "upper"),
        (ASF.replace("dof rz rx", "dof rz rq"), AMC, "rq"),
        (ASF.replace("ZYX", "ZYY"), AMC, "ZYY"),
        (ASF.replace("upper lower", "lower lower"), AMC, "lower"),
        (ASF.replace("upper lower", "upper lower nobody"), AMC, "nobody"),
        (ASF.replace("root upper stump", "root upper lower"), AMC, "lower"),
        (ASF.partition(":bonedata")[0], AMC, ":bonedata"),
        (ASF[: ASF.index("name stump")], AMC, "no end"),
        (ASF.replace("length 0.45", "length 0"), AMC, "unit of length"),
        ("", AMC, ":root"),
    ],
)
def test_damage_is_one_sentence(tmp_path, asf, amc, says):
    (tmp_path / "a.asf").write_text(asf)
    (tmp_path / "a_1.amc").write_text(amc)
    with pytest.raises(FileFormatError, match=says) as raised:
        mm.read_pose(tmp_path / "a_1.amc")
    assert "a_1.amc" in str(raised.value) or "a.asf" in str(raised.value)
    assert "\n" not in str(raised.value)


def test_skeleton_that_is_not_there(tmp_path):
    (tmp_path / "a_1.amc").write_text(AMC)
    with pytest.raises(FileFormatError, match=r"a\.asf"):
        mm.read_pose(tmp_path / "a_1.amc")
    with pytest.raises(FileFormatError, match="There is no file"):
        mm.read_pose(tmp_path / "a_1.amc", skeleton=tmp_path / "b.asf")


def test_the_only_skeleton_is_taken_where_the_movement_fits_it(small):
    movement = (small / "a_1.amc").rename(small / "other.amc")
    assert (
        "Its skeleton is taken to be a.asf, the only one here." in mm.read_pose(movement).warnings
    )
    (small / "a.asf").write_text(ASF.replace("lower", "upper_part"))
    with pytest.raises(NoSkeletonError, match=r"a\.asf.*does not have lower"):
        mm.read_pose(movement)


def test_of_several_skeletons_none_is_taken_that_no_name_leads_to(small):
    movement = (small / "a_1.amc").rename(small / "other.amc")
    (small / "b.asf").write_text(ASF)
    with pytest.raises(NoSkeletonError, match=r"none of the ASF files .* other\.asf"):
        mm.read_pose(movement)
    movement.write_text(AMC.replace("#!OML", "#!OML:ASF C:\\takes\\B.ASF"))
    assert mm.read_pose(movement).source.skeleton.file == small / "b.asf"


@pytest.mark.parametrize("header", ["#!OML", "#!OML:ASF D:\\gone.ASF"])
@pytest.mark.parametrize("name", ["walk.amc", "b_2.amc"])
def test_what_is_written_under_another_name_opens_with_its_skeleton(small, header, name):
    (small / "a_1.amc").write_text(AMC.replace("#!OML", header))
    (small / "b.asf").write_text(ASF.replace("length 4", "length 9"))
    pose = mm.read_pose(small / "a_1.amc")
    mm.write_pose(pose, small / name)
    back = mm.read_pose(small / name)
    assert back.source.skeleton.file == small / "a.asf"
    np.testing.assert_array_equal(back.positions, pose.positions)
    text = (small / name).read_text()
    assert text.count("#!OML:ASF") == 1
    mm.write_pose(pose, small / "a_2.amc")
    assert (small / "a_2.amc").read_bytes() == (small / "a_1.amc").read_bytes()


def test_mangled_files_never_fail_otherwise(tmp_path):
    draw = random.Random(0)
    for _ in range(300):
        texts = [ASF, AMC]
        which = draw.randrange(2)
        text = list(texts[which])
        for _ in range(draw.randrange(1, 6)):
            at = draw.randrange(len(text))
            text[at : at + draw.randrange(4)] = draw.choice(["", "x", "\n", "9e99", " ", "-", ":"])
        texts[which] = "".join(text)
        (tmp_path / "a.asf").write_text(texts[0])
        (tmp_path / "a_1.amc").write_text(texts[1])
        try:
            pose = mm.read_pose(tmp_path / "a_1.amc")
        except FileFormatError:
            continue
        assert pose.frames > 0


def test_real_recordings(shared_data):
    folder = shared_data / "poses"
    frames = 0
    for path in sorted(folder.glob("*.amc")):
        movement, _, warnings = read_amc(path, read_asf(folder / f"{path.stem[:2]}.asf"))
        frames += movement.frames
        assert warnings == []
    assert frames == 50_519
    pose = mm.read_pose(folder / "02_01.amc")
    assert len(pose.joints) == 31
    for joint, parent in enumerate(pose.parents):
        if parent >= 0:
            length = np.linalg.norm(pose.positions[:, joint] - pose.positions[:, parent], axis=1)
            assert np.ptp(length) < 1e-12
    head = pose.positions[:, pose.index("head"), 1]
    foot = pose.positions[:, pose.index("lfoot"), 1]
    assert 1300 < (head - foot).max() < 1900
    assert mm.read_pose(folder / "02.asf").frames == 1


def amc(small, text):
    (small / "a_3.amc").write_text(text)
    return small / "a_3.amc"


@pytest.mark.parametrize("behind", ["/* two */", "start of punch"])
def test_text_behind_the_number_of_a_pose_is_a_comment(small, behind):
    text = AMC.replace("\n2\n", f"\n2 {behind}\n")
    pose, plain = mm.read_pose(amc(small, text)), mm.read_pose(small / "a_1.amc")
    assert_allclose(pose.positions, plain.positions)
    assert pose.warnings == plain.warnings
    mm.write_pose(pose, small / "out.amc")
    assert (small / "out.amc").read_text() == text


@pytest.mark.parametrize("gone", ["1", "2"])
def test_a_pose_whose_number_is_missing_is_no_part_of_another(small, gone):
    pose = mm.read_pose(amc(small, AMC.replace(f"\n{gone}\n", "\n")))
    assert_allclose(pose.positions, mm.read_pose(small / "a_1.amc").positions)
    assert "No number stands before 1 poses, in line" in pose.warnings[0]


@pytest.mark.parametrize("number", ["0", "1", "900"])
def test_numbers_of_poses_that_tell_no_gap_are_said(small, number):
    pose = mm.read_pose(amc(small, AMC.replace("\n2\n", f"\n{number}\n")))
    assert pose.frames == 2
    assert pose.warnings[0] == (
        f"Frame numbers go from 1 to {number} in line 8; poses were read one after the other."
    )


def test_poses_that_numbers_leave_out_are_gaps(small):
    text = AMC.replace("\n2\n", "\n7\n")
    pose = mm.read_pose(amc(small, text))
    assert pose.seen.all(axis=1).tolist() == [True, *[False] * 5, True]
    assert pose.warnings[0] == (
        "Frame numbers leave out 5 poses, from 1 to 7 in line 8 for one; they were read as gaps."
    )
    # Nothing of them is written as long as nothing is known, and each in its place then.
    mm.write_pose(pose, small / "a_8.amc")
    assert (small / "a_8.amc").read_text() == text
    filled = pose.with_samples(
        np.repeat(pose.positions[[0, 6]], [6, 1], axis=0),
        np.repeat(pose.rotations[[0, 6]], [6, 1], axis=0),
    )
    mm.write_pose(filled, small / "a_8.amc")
    back = mm.read_pose(small / "a_8.amc")
    assert back.warnings == mm.read_pose(small / "a_1.amc").warnings
    assert_allclose(back.positions, filled.positions, atol=1e-5)
    written = (small / "a_8.amc").read_text()
    assert written.startswith(text[: text.index("\n7\n")])
    assert written.endswith(text[text.index("\n7\n") :])
    part = crop_pose(filled, 2, 4)
    mm.write_pose(part, small / "a_9.amc")
    assert_allclose(mm.read_pose(small / "a_9.amc").positions, part.positions, atol=1e-5)


def test_poses_that_are_numbered_in_steps_follow_one_another(small):
    first, second = AMC[: AMC.index("\n2\n") + 1], AMC[AMC.index("\n2\n") + 3 :]
    text = first + "".join(f"{number}\n{second}" for number in (5, 9, 17))
    pose = mm.read_pose(amc(small, text))
    assert pose.seen.all(axis=1).tolist() == [True, True, True, False, True]
    mm.write_pose(pose, small / "a_8.amc")
    assert (small / "a_8.amc").read_text() == text


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("upper 40 50 60\n", "upper 40 50 60\nupper 1 2 3\n", "line 7 tells of upper a second"),
        ("root 4 5 6", "root 1 1 1 1 1 1\nroot 4 5 6", "line 10 tells of root a second time"),
        ("upper 40 50 60\n", "40 50 60\n", "line 6 has only numbers"),
        (":DEGREES\n", ":DEGREES\n:SAMPLES-PER-SECOND 1e7\n", "a_3.amc would have 1e.07 poses"),
    ],
)
def test_what_makes_no_poses_is_said(small, old, new, said):
    with pytest.raises(FileFormatError, match=said):
        mm.read_pose(amc(small, AMC.replace(old, new)))


@pytest.mark.parametrize("wild", ["1e20", "1e200"])
def test_what_no_body_does_counts_as_not_seen(small, wild):
    pose = mm.read_pose(amc(small, AMC.replace("root 4 5", f"root {wild} 5")))
    assert pose.seen.tolist() == [[True] * 4, [False] * 4]
    assert "1 samples whose coordinates are no numbers, or farther" in pose.warnings[0]
    pose = mm.read_pose(amc(small, AMC.replace("upper 1 2", f"upper {wild} 2")))
    assert pose.seen.tolist() == [[True] * 4, [True, False, True, False]]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("length 0.45", "length inch", "line 5 should have a number of a body.*“inch”"),
        ("length 0.45", "length nan", "line 5 should have a number of a body.*“nan”"),
        ("length 0.45", "length 1e-200", "unit of length, 1e-200 in line 5, makes no body"),
        ("direction 0 -2 0", "direction 1e308 1e308 0", "line 16 should have 3 numbers of a body"),
        ("length 4", "length 1e300", "line 17 should have a number of a body"),
    ],
)
def test_what_makes_no_skeleton_is_said(small, old, new, said):
    (small / "a.asf").write_text(ASF.replace(old, new))
    with pytest.raises(FileFormatError, match=said):
        mm.read_pose(small / "a_1.amc")


def test_a_skeleton_at_rest_comes_back(small):
    rest = mm.read_pose(small / "a.asf")
    mm.write_pose(rest, small / "a_4.amc")
    back = mm.read_pose(small / "a_4.amc")
    assert back.frames == 1
    assert_allclose(back.positions, rest.positions)
