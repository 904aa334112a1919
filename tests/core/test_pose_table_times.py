"""Poses that a table of joints lacks, as only its times tell."""

from __future__ import annotations

import numpy as np
import pytest

import markermend as mm
from markermend.files.pose_clock import with_gaps_by_times
from markermend.files.pose_rows import header_of

HEADER = header_of("frame,time,joint,x,y,z", "k.csv")
POSES = 40


def moved(times):
    """Frames that poses are, which are counted through, and how many are said to be missing."""
    times = [float(time) for time in times]
    frames, said = with_gaps_by_times(times, list(range(len(times))), HEADER)
    return frames, said


def at_30_hz(*gaps, count=POSES):
    """Times of so many poses, with so many missing before some."""
    number = np.arange(count)
    for before, missing in gaps:
        number[before:] += missing
    return number / 30.0, number.tolist()


@pytest.mark.parametrize(
    "gaps", [[(20, 15)], [(10, 1), (12, 4)], [(15, 3), (16, 7), (30, 30)], [(39, 2)]]
)
def test_times_tell_of_gaps(gaps):
    times, number = at_30_hz(*gaps)
    shaken = times + np.random.default_rng(0).normal(0.0, 0.002, POSES)
    for unit in (1.0, 1000.0):
        frames, said = moved(unit * np.round(shaken, 4) + 1.7e9)
        assert frames == number
        missing = sum(count for _, count in gaps)
        assert said[0].startswith(
            f"Times tell of {missing} poses that are missing, after frame {gaps[0][0] - 1} for one;"
        )


def late_at_once():
    times, _ = at_30_hz()
    times[20:25] = times[25] - 0.001 * np.arange(5, 0, -1)
    return times


@pytest.mark.parametrize(
    "times",
    [
        late_at_once(),
        at_30_hz()[0] + np.random.default_rng(0).uniform(0.0, 0.03, POSES),
        at_30_hz()[0].round(1),
        -at_30_hz((20, 15))[0],
        np.full(POSES, np.nan),
        at_30_hz((20, 10_000))[0],
        at_30_hz((4, 15), count=8)[0],
    ],
)
def test_other_times_tell_of_none(times):
    assert moved(times) == (list(range(len(times))), ())


def test_where_numbers_tell_of_a_gap_times_tell_no_other(tmp_path):
    times, number = at_30_hz((20, 15))
    assert with_gaps_by_times(times.tolist(), number, HEADER) == (number, ())


def table(folder, times, more=""):
    lines = [f"frame,time,joint,parent,x,y,z,confidence{',state' if more else ''}"]
    for n, time in enumerate(times):
        lines.append(f"{n + 3},{time:.4f},hip,,0,900,0,1{more}")
        lines.append(f"{n + 3},{time:.4f},knee,hip,{3 * n},{500 + n},5,1{more}")
    (folder / "k.csv").write_text("\n".join(lines) + "\n")
    return folder / "k.csv"


def test_what_only_times_tell_is_a_gap_and_filled(tmp_path):
    times, number = at_30_hz((20, 15))
    pose = mm.read_pose(table(tmp_path, times + 2.0))
    assert (pose.frames, pose.first_frame) == (POSES + 15, 3)
    assert pose.rate == pytest.approx(30.0, abs=0.01)
    assert pose.first_time == pytest.approx(2.0)
    assert np.flatnonzero(pose.seen.all(axis=1)).tolist() == number
    assert pose.warnings == (
        "Times tell of 15 poses that are missing, after frame 22 for one; they were read as gaps,"
        " and frames after them are numbered anew.",
    )
    clean = mm.denoise(pose)
    assert clean.seen.all()
    mm.write_pose(clean, tmp_path / "clean.csv")
    back = mm.read_pose(tmp_path / "clean.csv")
    assert (back.frames, back.first_frame, back.warnings) == (POSES + 15, 3, ())
    np.testing.assert_allclose(back.positions, clean.positions, atol=1e-3)


@pytest.mark.parametrize(("by", "doing"), [(-1.0, "run backwards"), (0.0, "stand still")])
def test_times_that_do_not_grow_are_said_to(tmp_path, by, doing):
    pose = mm.read_pose(table(tmp_path, by * np.arange(POSES) / 30.0 + 9.0))
    assert pose.rate == 30.0
    assert pose.warnings == (f"Times in the file {doing} and tell no rate; 30 Hz was assumed.",)
