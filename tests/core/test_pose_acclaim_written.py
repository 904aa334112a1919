"""Acclaim movements written: what was measured stays, and what is said comes back as it was."""

from __future__ import annotations

import numpy as np
import pytest
from acclaim import AMC, write_small

import markermend as mm
from markermend.errors import ExportError, FileFormatError
from markermend.files.pose import crop_pose
from markermend.poses.take import pose_of

ASF = """\
:units
  length 0.45
  angle deg
:root
   order TX TY TZ RX RY RZ
   axis XYZ
   position 0 0 0
   orientation 0 0 0
:bonedata
  begin
     name upper
     direction 0 -1 0
     length 4
     axis 10 20 30 XYZ
     dof rx ry rz
  end
  begin
     name lower
     direction 1 0 0
     length 3
     axis 0 -40 15 ZYX
     dof rz rx
  end
  begin
     name tip
     direction 0 0 1
     length 1
     axis 0 0 0 XYZ
     dof rx
  end
:hierarchy
  begin
    root upper
    upper lower
    lower tip
  end
"""
SEGMENTS = ("root", "upper", "lower", "tip")


def pose_lines(number):
    """A pose, the root first."""
    return [
        str(number),
        f"root {number} 2 3 10 20 {number}",
        f"upper 40 {number} 60",
        f"lower -20 {30 + number}",
        f"tip {5 * number}",
    ]


def movement(folder, *, poses=6, head=(":DEGREES",), gone=lambda number, segment: False):
    """A file whose poses lack what is gone."""
    (folder / "a.asf").write_text(ASF)
    lines = list(head)
    for number in range(1, poses + 1):
        lines += [line for line in pose_lines(number) if not gone(number, line.split()[0])]
    (folder / "a_1.amc").write_text("\n".join(lines) + "\n")
    return folder / "a_1.amc"


def with_hidden(pose, rows, *joints):
    confidence = np.array(pose.confidence)
    confidence[rows, [[pose.index(joint)] for joint in joints]] = 0.0
    return pose.with_samples(pose.positions, pose.rotations, confidence)


def test_lines_of_what_hangs_on_a_missing_segment_stay(tmp_path):
    source = movement(tmp_path, gone=lambda number, segment: (number, segment) == (3, "upper"))
    pose = mm.read_pose(source)
    assert pose.seen[2].tolist() == [True, False, False, False]
    mm.write_pose(pose, tmp_path / "a_2.amc")
    assert (tmp_path / "a_2.amc").read_bytes() == source.read_bytes()
    # They are told again where the file is written anew.
    source.unlink()
    mm.write_pose(pose, tmp_path / "a_3.amc")
    assert "tip 15\n" in (tmp_path / "a_3.amc").read_text()


@pytest.mark.parametrize("segment", ["root", "upper"])
def test_a_last_pose_that_lacks_a_segment_is_no_end_of_a_file(tmp_path, segment):
    pose = mm.read_pose(movement(tmp_path))
    hidden = with_hidden(pose, [5], segment)
    for target in ("a_2.amc", "a_3.amc"):
        mm.write_pose(hidden, tmp_path / target)
        source = mm.read_pose(tmp_path / target)
        below = SEGMENTS.index(segment)
        assert source.frames == 6
        assert source.seen[5].tolist() == [n < below for n in range(4)]
        assert not any("cut short" in said for said in source.warnings)
        (tmp_path / "a_1.amc").unlink(missing_ok=True)


def turned(pose):
    """The same, but for one joint in one pose."""
    rotations = np.array(pose.rotations)
    rotations[2, 3] = rotations[1, 3]
    return pose.with_samples(pose.positions, rotations, pose.confidence)


@pytest.mark.parametrize("told", [":SAMPLES-PER-SECOND 60", ":SAMPLES-PER-SECOND 60 # a second"])
def test_a_rate_stays_in_a_part_and_in_what_is_written_anew(tmp_path, told):
    source = movement(tmp_path, head=(":DEGREES", told))
    take = mm.read(source)
    assert take.rate == 60.0
    mm.write(take, tmp_path / "a_2.amc", frames=(2, 5))
    part = mm.read_pose(tmp_path / "a_2.amc")
    assert (part.rate, part.first_frame, part.warnings) == (60.0, 3, ())
    np.testing.assert_allclose(part.positions, take.positions[2:5], atol=1e-5)
    pose = mm.read_pose(source)
    source.unlink()
    mm.write_pose(pose, tmp_path / "a_3.amc")
    assert mm.read_pose(tmp_path / "a_3.amc").rate == 60.0


@pytest.mark.parametrize(
    ("head", "rate", "written"),
    [
        ((":DEGREES",), 60.0, [":DEGREES", ":SAMPLES-PER-SECOND 60", "1"]),
        ((":DEGREES",), 120.0, [":DEGREES", "1"]),
        (("\ufeff# made",), 60.0, [":SAMPLES-PER-SECOND 60", "\ufeff# made", "1"]),
        (
            (":SAMPLES-PER-SECOND 60 # slow", ":DEGREES"),
            30.0,
            [":SAMPLES-PER-SECOND 30 # slow", ":DEGREES", "1"],
        ),
        (
            (":SAMPLES-PER-SECOND 60", ":DEGREES"),
            120.0,
            [":SAMPLES-PER-SECOND 120", ":DEGREES", "1"],
        ),
        (
            (":SAMPLES-PER-SECOND 60", ":DEGREES"),
            None,
            [":SAMPLES-PER-SECOND 60", ":DEGREES", "1"],
        ),
    ],
)
def test_a_rate_that_is_given_is_written_over_a_file(tmp_path, head, rate, written):
    source = movement(tmp_path, head=head)
    pose = turned(mm.read_pose(source, rate=rate))
    mm.write_pose(pose, tmp_path / "a_2.amc")
    lines = (tmp_path / "a_2.amc").read_text(encoding="utf-8").splitlines()
    if written[1].startswith("\ufeff"):
        written = [f"\ufeff{written[0]}", written[1][1:], "1"]
    assert lines[: len(written)] == written
    assert mm.read_pose(tmp_path / "a_2.amc").rate == pose.rate


def test_poses_keep_their_numbers(tmp_path):
    source = movement(tmp_path)
    text = source.read_text().replace("\n1\n", "\n0041\n")
    for number in range(2, 7):
        text = text.replace(f"\n{number}\n", f"\n{40 + number}\n")
    source.write_text(text)
    take = mm.read(source)
    assert take.first_frame == 41
    mm.write(take, tmp_path / "a_2.amc", frames=(2, 5))
    assert mm.read(tmp_path / "a_2.amc").first_frame == 43


def test_a_part_within_a_gap_is_refused_rather_than_shown_at_rest(tmp_path):
    source = movement(tmp_path, gone=lambda number, name: 2 <= number < 5 and name == "upper")
    take = mm.read(source)
    with pytest.raises(ExportError) as refused:
        mm.write(take, tmp_path / "a_2.amc", frames=(1, 4))
    assert str(refused.value) == (
        "An AMC cannot say that a segment is never seen, and would show upper at rest. Write more"
        " frames, repair these gaps first, or write a CSV."
    )
    assert not (tmp_path / "a_2.amc").exists()
    mm.write(take, tmp_path / "a_2.amc", frames=(1, 5))
    np.testing.assert_array_equal(mm.read(tmp_path / "a_2.amc").present, take.present[1:5])


def test_a_segment_without_any_line_stays_without(tmp_path):
    source = movement(tmp_path, gone=lambda number, name: name == "tip")
    pose = mm.read_pose(source)
    places = pose.positions + np.array([5.0, 0.0, 0.0])
    mm.write_pose(pose.with_samples(places, pose.rotations), tmp_path / "a_2.amc")
    np.testing.assert_allclose(mm.read_pose(tmp_path / "a_2.amc").positions, places, atol=1e-3)
    assert "tip" not in (tmp_path / "a_2.amc").read_text()


@pytest.mark.parametrize("digits", ["²", "9" * 5000, "٣" * 5000])
@pytest.mark.parametrize("place", ["\n2\n", "\n1\n"])
def test_what_is_no_number_of_a_pose_gets_one_short_sentence(tmp_path, digits, place):
    source = movement(tmp_path)
    text = source.read_text().replace(place, f"\n{digits}\n")
    source.write_text(text, encoding="utf-8")
    try:
        sentences = mm.read_pose(source).warnings
    except FileFormatError as error:
        sentences = (str(error),)
    assert all(len(said) < 200 for said in sentences)
    assert any(digits[:40] in said for said in sentences)


@pytest.fixture
def small(tmp_path):
    return write_small(tmp_path)


def test_written_over_its_file_only_what_changed_is_another(small):
    text = AMC.replace("#!OML\n", "#!OML:ASF made elsewhere\n").replace("lower 10", "lower 10.00")
    lines = text.replace("upper 1 2 3\nlower 10.00 20", "lower 10.00 20 # bent\nupper 1 2 3")
    source = small / "a_7.amc"
    source.write_bytes(lines.replace("\n", "\r\n").encode())
    pose = mm.read_pose(source)
    mm.write_pose(pose, small / "same.amc")
    assert (small / "same.amc").read_bytes() == source.read_bytes()
    rotations = pose.rotations.copy()
    rotations[1, 3] = rotations[1, 1]
    turned = pose.with_samples(pose.positions, rotations, pose.confidence)
    mm.write_pose(turned, small / "other.amc")
    before, after = (
        (small / name).read_bytes().split(b"\r\n") for name in ("a_7.amc", "other.amc")
    )
    other = [(a, b) for a, b in zip(before, after, strict=True) if a != b]
    assert len(other) == 1
    assert other[0][0] == b"lower 10.00 20 # bent"
    assert other[0][1].startswith(b"lower ")
    assert other[0][1].endswith(b" # bent")
    # Without the file it is written anew, with the same poses.
    source.unlink()
    mm.write_pose(turned, small / "a_8.amc")
    over, anew = (
        mm.read_pose(small / name, skeleton=small / "a.asf") for name in ("other.amc", "a_8.amc")
    )
    np.testing.assert_allclose(anew.rotations, over.rotations, atol=1e-7)


@pytest.mark.parametrize("begins", ["", "\ufeff"])
def test_written_over_a_file_in_radians(small, begins):
    source = small / "a_9.amc"
    text = AMC.partition("\n")[2].replace(":FULLY-SPECIFIED\n:DEGREES", ":RADIANS")
    source.write_text(begins + text.replace("50", "1.5"), encoding="utf-8")
    pose = mm.read_pose(source)
    mm.write_pose(pose, small / "same.amc")
    assert (small / "same.amc").read_bytes() == source.read_bytes()
    rotations = pose.rotations.copy()
    rotations[0, 3] = rotations[1, 3]
    mm.write_pose(pose.with_samples(pose.positions, rotations, pose.confidence), small / "b.amc")
    again = mm.read_pose(small / "b.amc", skeleton=small / "a.asf")
    assert (small / "b.amc").read_bytes().splitlines()[:4] == source.read_bytes().splitlines()[:4]
    np.testing.assert_allclose(
        np.abs(np.sum(again.rotations * rotations, axis=2))[1], 1.0, atol=1e-9
    )
    assert again.warnings == pose.warnings


def test_of_a_file_with_other_poses_all_is_written_anew(small):
    pose = mm.read_pose(small / "a_1.amc")
    (small / "a_1.amc").write_text(AMC.rpartition("2\nroot")[0])
    mm.write_pose(pose, small / "b.amc")
    assert mm.read_pose(small / "b.amc", skeleton=small / "a.asf").frames == 2


def test_a_part_keeps_the_header_and_the_comments_beside_its_poses(tmp_path):
    head = ("# of the morning", ":FULLY-SPECIFIED", ":DEGREES", ":SAMPLES-PER-SECOND 60")
    source = movement(tmp_path, head=head)
    text = source.read_text().replace("upper 40 3 60", "upper 40.00 3 60 # bent")
    text = text.replace("\n2\n", "\n# too early\n2\n").replace("\n3\n", "\n# he jumps\n0003\n")
    source.write_bytes(text.replace("\n5\n", "\n# he lands\n5\n").replace("\n", "\r\n").encode())
    take = mm.read(source)
    mm.write(take, tmp_path / "a_2.amc", frames=(2, 4))
    lines = source.read_bytes().splitlines(keepends=True)
    of_part = lines[lines.index(b"# he jumps\r\n") : lines.index(b"5\r\n")]
    assert (tmp_path / "a_2.amc").read_bytes() == b"".join(lines[:4] + of_part)
    # A part of a part, changed, is written over the file too.
    pose = crop_pose(crop_pose(pose_of(take), 1, 5), 1, 3)
    rotations = np.array(pose.rotations)
    rotations[1, 3] = rotations[0, 3]
    mm.write_pose(pose.with_samples(pose.positions, rotations), tmp_path / "a_3.amc")
    after = (tmp_path / "a_3.amc").read_bytes().splitlines(keepends=True)
    differs = [(a, b) for a, b in zip(lines[:4] + of_part, after, strict=True) if a != b]
    assert [pair[0] for pair in differs] == [b"tip 20\r\n"]


def test_a_file_that_is_cut_short_keeps_what_is_whole(tmp_path):
    source = movement(tmp_path, head=("# of the morning", ":DEGREES"))
    whole = source.read_bytes()
    source.write_bytes(whole[: whole.index(b"\n6\n") + 10])
    pose = mm.read_pose(source)
    assert pose.frames == 5
    mm.write_pose(pose, tmp_path / "a_2.amc")
    assert (tmp_path / "a_2.amc").read_bytes() == whole[: whole.index(b"6\nroot")]
