"""Acclaim movements written: what was measured stays, and what is said comes back as it was."""

from __future__ import annotations

import numpy as np
import pytest

import markermend as mm

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
