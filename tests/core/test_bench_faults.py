"""How many faults that a sensor does not tell of are found, as an experiment."""

from __future__ import annotations

import numpy as np
import pytest
from recordings import seventeen_joints

import markermend as mm
from markermend.bench import faults
from markermend.bench.faults import BESIDE, CASES, SOUND, faults_csv, faults_table, find_faults
from markermend.errors import DataError
from markermend.poses.restore import Restored
from markermend.poses.simulated.breaking import HOLDS, KINDS


@pytest.fixture(scope="module")
def clips(shared_data):
    # Two seconds of each: enough to tell who was broken from who was not.
    return {
        name: pose.with_samples(pose.positions[-240:], pose.rotations[-240:])
        for name, pose in seventeen_joints(shared_data, "02_01", "03_02").items()
    }


def test_faults_are_found_and_mended_and_little_else_is_touched(clips):
    cases = [CASES[1], CASES[3]]
    rows = find_faults(clips, cases=cases)
    assert [(r.clip, r.case, r.kind) for r in rows] == [
        (clip, case.name, kind)
        for clip in clips
        for case in cases
        for kind in (*KINDS, SOUND, *HOLDS, BESIDE)
    ]
    for row in rows:
        broken, restored, told, live, live_told = row.off_mm
        if row.kind in (SOUND, BESIDE):
            assert row.named / row.faults < 0.001
            assert restored <= max(broken, 0.1)
            assert live < max(1.05 * broken, 10.0)
        elif row.kind in HOLDS:
            assert row.found == row.faults == 1
            assert told < broken
        else:
            assert row.found == row.named == row.faults == 1
            assert restored < 0.25 * broken
            assert told < 0.2 * broken
            assert live_told < 0.4 * broken
    held = [row for row in rows if row.kind in HOLDS]
    assert sum(row.named for row in held) >= 0.9 * len(held)
    # As poses come not all is found, and most of what is.
    for kind, left in {"vanished": 0.1, "swapped": 0.1, "jumped": 0.2, "stranger": 0.5}.items():
        off = np.array([row.off_mm for row in rows if row.kind == kind])
        assert off[:, 3].mean() < left * off[:, 0].mean()
    undone = [r.off_mm[1] for r in rows if (r.kind, r.case) == ("swapped", cases[0].name)]
    np.testing.assert_allclose(undone, 0.0, atol=0.01)
    text = "\n".join(faults_table(rows))
    assert "100.0 %" in text
    assert "a minute" in text
    assert len(faults_csv(rows).splitlines()) == 1 + len(rows)


def test_a_case_is_broken_alike_whatever_is_run_beside_it(clips, monkeypatch):
    def untouched(pose, prior):
        return Restored(pose, *(np.zeros(pose.seen.shape),) * 3)

    monkeypatch.setattr(faults, "restore", untouched)
    monkeypatch.setattr(faults, "as_they_come", lambda pose, prior: (pose, None))
    cases = [CASES[1], CASES[3]]

    def broken(cases, seed=1):
        rows = find_faults(clips, cases=cases, seed=seed)
        return [(r.clip, r.kind, r.off_mm[0]) for r in rows if r.case == CASES[3].name]

    assert broken(cases) == broken(cases[1:]) != broken(cases[1:], seed=2)


def test_everybody_must_be_new_to_what_was_learnt(clips):
    with pytest.raises(DataError, match="two or more"):
        find_faults({"02_01": clips["02_01"]})


def test_who_is_too_short_is_named(clips):
    short = {name: cut(pose, 60) for name, pose in clips.items()}
    with pytest.raises(DataError, match="02_01, 30 Hz: The recording is too short"):
        find_faults(short, cases=[CASES[1]])


def cut(pose, frames):
    return mm.Pose(
        pose.positions[:frames], pose.rotations[:frames], pose.joints, pose.parents, pose.rate
    )
