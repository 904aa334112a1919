"""Tables of joints whose tool kept every second or tenth pose and their numbers."""

from __future__ import annotations

import numpy as np
import pytest

import markermend as mm
from markermend.files.pose import crop_pose

POSES = 40
SAID = "Frames are numbered {}, {} and so on; they were read as following one another."


def table(folder, *, step, first=0, times=True, gone=(), crop=()):
    """A knee that swings on a hip; poses that are ``gone`` have no row, nor the knee of ``crop``"""
    lines = [f"frame{',time' if times else ''},joint,parent,x,y,z,confidence"]
    for n in range(POSES):
        time = f",{n * step / 60:.6f}" if times else ""
        front = f"{first + n * step}{time}"
        if n not in gone:
            lines.append(f"{front},hip,,0,900,0,1")
            if n not in crop:
                lines.append(f"{front},knee,hip,{3 * n},{500 + n},5,1")
    path = folder / "k.csv"
    path.write_text("\n".join(lines) + "\n")
    return path


@pytest.mark.parametrize(("step", "first"), [(2, 0), (10, 7), (3, -4)])
def test_poses_that_are_numbered_in_steps_follow_one_another(tmp_path, step, first):
    pose = mm.read_pose(table(tmp_path, step=step, first=first))
    assert (pose.frames, pose.rate, pose.first_frame) == (POSES, 60.0 / step, first)
    assert pose.seen.all()
    assert pose.warnings == (SAID.format(first, first + step),)
    np.testing.assert_array_equal(pose.positions[:, 1, 0], 3.0 * np.arange(POSES))


def test_a_number_that_is_missing_among_steps_is_a_gap(tmp_path):
    pose = mm.read_pose(table(tmp_path, step=5, gone=(10, 11)))
    assert (pose.frames, pose.rate) == (POSES, 12.0)
    assert np.flatnonzero(~pose.seen[:, 0]).tolist() == [10, 11]


def test_numbers_that_are_missing_among_those_one_by_one_stay_gaps(tmp_path):
    gone = (3, 7, 8, 20)
    pose = mm.read_pose(table(tmp_path, step=1, gone=gone))
    assert (pose.frames, pose.warnings) == (POSES, ())
    assert tuple(np.flatnonzero(~pose.seen[:, 0])) == gone
    # One number between others tells that these have gaps.
    path = table(tmp_path, step=2)
    path.write_text(path.read_text().replace("\n20,", "\n19,"))
    assert mm.read_pose(path).frames == 2 * POSES - 1


@pytest.mark.parametrize(("step", "rate"), [(1, 30.0), (2, 15.0), (30, 1.0), (100, 30.0)])
def test_without_times_the_numbers_are_those_of_a_sensor(tmp_path, step, rate):
    pose = mm.read_pose(table(tmp_path, step=step, times=False))
    assert pose.rate == rate
    assert pose.warnings[-1] == f"The file tells no rate; {rate:g} Hz was assumed."


def test_they_are_written_with_their_numbers(tmp_path):
    source = table(tmp_path, step=2, first=100, crop=(12, 13))
    pose = mm.read_pose(source)
    mm.write_pose(pose, tmp_path / "same.csv")
    assert (tmp_path / "same.csv").read_bytes() == source.read_bytes()
    clean = mm.denoise(pose)
    mm.write_pose(clean, tmp_path / "clean.csv")
    lines = (tmp_path / "clean.csv").read_text().splitlines()
    assert [line.split(",")[0] for line in lines[1:]] == [
        str(100 + 2 * n) for n in range(POSES) for _ in range(2)
    ]
    assert [line for line in lines if line.startswith("124,")][1].startswith("124,0.400000,knee")
    np.testing.assert_allclose(
        mm.read_pose(tmp_path / "clean.csv").positions, clean.positions, atol=1e-3
    )
    mm.write_pose(crop_pose(clean, 10, 15), tmp_path / "part.csv")
    part = mm.read_pose(tmp_path / "part.csv")
    assert (part.frames, part.rate) == (5, 30.0)
    assert part.first_time == pytest.approx(1 / 3, abs=1e-5)
    assert (tmp_path / "part.csv").read_text().splitlines()[1].startswith("120,")
    np.testing.assert_allclose(part.positions, clean.positions[10:15], atol=1e-3)


@pytest.mark.parametrize(
    ("step", "gone", "start", "stop"),
    [
        # Of what is left every number could be divided by 10, or by 2.
        (5, (11, 13, 15), 10, 17),
        (1, (11, 13, 15, 30), 10, 17),
        # Two numbers tell of no steps.
        (5, (), 10, 12),
        (5, (11,), 10, 13),
    ],
)
def test_a_part_has_as_many_poses_as_were_written(tmp_path, step, gone, start, stop):
    pose = mm.read_pose(table(tmp_path, step=step, gone=gone))
    part = crop_pose(pose, start, stop)
    mm.write_pose(part, tmp_path / "part.csv")
    again = mm.read_pose(tmp_path / "part.csv")
    assert (again.frames, again.rate) == (stop - start, pose.rate)
    np.testing.assert_array_equal(again.positions, part.positions)
    assert (tmp_path / "part.csv").read_text().splitlines()[1].startswith(f"{step * start},")


def test_what_is_written_anew_has_the_numbers_of_the_file(tmp_path):
    source = table(tmp_path, step=2, first=100, crop=(12, 13))
    # Without a confidence what is filled could not be told in it.
    lines = [line.rpartition(",")[0] for line in source.read_text().splitlines()]
    source.write_text("\n".join(lines) + "\n")
    clean = mm.denoise(mm.read_pose(source))
    mm.write_pose(clean, tmp_path / "clean.csv")
    rows = (tmp_path / "clean.csv").read_text().splitlines()
    assert rows[0].endswith(",confidence")
    numbers = [str(100 + 2 * n) for n in range(POSES) for _ in range(2)]
    assert [row.split(",")[0] for row in rows[1:]] == numbers
    again = mm.read_pose(tmp_path / "clean.csv")
    assert (again.frames, again.rate) == (POSES, 30.0)
    np.testing.assert_allclose(again.positions, clean.positions, atol=1e-3)
