"""Skeleton recordings that go out to files and come in from them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from arms import arm, hide
from numpy.testing import assert_allclose

import markermend as mm
from markermend.errors import ExportError, FileFormatError


def test_csv_keeps_what_it_is_given(tmp_path):
    pose = hide(arm(40), slice(5, 9), 2)
    path = tmp_path / "joints.csv"
    mm.write_pose(pose, path)
    back = mm.read_pose(path)
    assert back.joints == pose.joints
    assert back.parents == pose.parents
    assert back.rate == 100.0
    assert (back.seen == pose.seen).all()
    assert_allclose(back.positions, pose.positions, atol=6e-4)
    assert_allclose(back.rotations, pose.rotations, atol=2e-6)
    assert path.read_text().splitlines()[0].startswith("frame,time,joint,parent,x,y,z,qx")


@pytest.mark.parametrize("rate", [15.0, 30.0, 59.94, 120.0, 240.0])
@pytest.mark.parametrize("frames", [2, 3, 40])
def test_csv_tells_the_rate_it_was_written_with(tmp_path, rate, frames):
    path = tmp_path / "joints.csv"
    mm.write_pose(replace(arm(frames), rate=rate), path)
    # What is no whole number is known as well as rounded times tell it.
    off = 0.0 if rate == round(rate) else 1e-6 * rate**2 / (frames - 1)
    assert abs(mm.read_pose(path).rate - rate) <= off


def test_csv_of_others(tmp_path):
    path = tmp_path / "sensor.csv"
    path.write_text(
        "Frame;Name;Position X;Position Y;Position Z\n"
        "10;JOINT_WAIST;0;900;0\n10;JOINT_TORSO;0;1100;0\n"
        "11;JOINT_WAIST;1;900;0\n11;JOINT_TORSO;0;0;0\n12;JOINT_WAIST;2;900;0\n"
    )
    pose = mm.read_pose(path)
    assert pose.frames == 3
    assert pose.parents == (-1, 0)
    assert pose.seen.tolist() == [[True, True], [True, False], [True, False]]
    assert pose.rate == 30.0
    assert "30 Hz" in pose.warnings[0]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("frame,joint,x,y\n0,a,1,2\n", "lacks the column “z”"),
        ("frame,joint,x,y,z\n", "cut short"),
        ("frame,joint,x,y,z\n0,a,1,2,3\n", "add a column “parent”"),
        ("frame,joint,parent,x,y,z\n0,a,b,1,2,3\n", "“b” is no joint"),
        ("frame,joint,parent,x,y,z\n0,a,,1,2,3\n9e9,a,,1,2,3\n", "frames go from"),
        ("frame,joint,parent,x,y,z\n0,a\n1,a,,1,2,3\n", "line 2 has 2 cells"),
        ("frame,joint,parent,x,y,z\nx,a,,1,2,3\n", "“x” in line 2 is no frame number"),
    ],
)
def test_damaged_csv_gets_one_sentence(tmp_path, text, said):
    path = tmp_path / "bad.csv"
    path.write_text(text)
    with pytest.raises(FileFormatError, match=said):
        mm.read_pose(path)


def test_unknown_targets_are_refused(tmp_path):
    with pytest.raises(ExportError, match=r"\.csv"):
        mm.write_pose(arm(5), tmp_path / "out.txt")
    with pytest.raises(ExportError, match="skeleton"):
        mm.write_pose(arm(5), tmp_path / "out.amc")


def test_amc_goes_out_as_it_came_in(shared_data, tmp_path):
    folder = shared_data / "poses"
    pose = mm.read_pose(folder / "02_01.amc")
    mm.write_pose(pose, tmp_path / "out.amc")
    back = mm.read_pose(tmp_path / "out.amc", skeleton=folder / "02.asf")
    assert np.abs(back.positions - pose.positions).max() < 1e-3


def test_what_was_read_from_a_table_and_not_changed_keeps_its_last_digit(tmp_path):
    source, target = tmp_path / "in.csv", tmp_path / "out.csv"
    rows = ["frame,joint,parent,x,y,z,qx,qy,qz,qw,confidence"]
    for frame in range(30):
        rows.append(f"{frame},hip,,{0.123456789 + frame},2,3.25,0.123456789,0,0,0.9876543,0.87654")
        rows.append(f"{frame},knee,hip,1,{-400.000123 - frame},3,0,0,0.2,0.7,1")
    source.write_text("\n".join(rows) + "\n")
    pose = mm.read_pose(source)
    source.unlink()
    positions = pose.positions.copy()
    positions[10, 1] += 1.23456789
    mm.write_pose(pose.with_samples(positions, pose.rotations, pose.confidence), target)
    lines = target.read_text().splitlines()
    for n, line in enumerate(rows[1:], 1):
        written = [float(cell) for cell in lines[n].split(",")[4:]]
        read = [float(cell) for cell in line.split(",")[3:]]
        if n == 22:
            assert written[:3] == [round(v, 3) for v in positions[10, 1]]
            assert written[3:] == read[3:]
        else:
            assert written == read
