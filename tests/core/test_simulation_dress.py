"""Skeletons under virtual markers look like recordings."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from markermend.errors import DataError
from markermend.files.pose import read_pose
from markermend.simulation.dress import dress
from markermend.take import Take


@pytest.fixture(scope="module")
def walk(shared_data):
    return read_pose(shared_data / "poses" / "02_01.amc")


def hiss_mm(take: Take) -> float:
    """Deviation of white noise, from fourth differences, whose weights' squares sum to 70."""
    change = np.abs(np.diff(take.positions, 4, axis=0))
    return float(np.nanmedian(change) / 0.6745 / np.sqrt(70.0))


def test_dressed_takes_hiss_as_little_as_recordings(walk):
    # Cleaned recordings of three laboratories: 0.005, 0.006 and 0.023 mm.
    hiss = [hiss_mm(dress(walk, markers=20, seed=seed)) for seed in range(10)]
    assert 0.003 < np.mean(hiss) < 0.025


def test_a_seed_dresses_alike(walk):
    one, again, other = (dress(walk, markers=12, seed=seed) for seed in (1, 1, 2))
    assert np.array_equal(one.positions, again.positions)
    assert one.markers == 12
    assert not np.allclose(one.positions, other.positions)


def test_markers_stay_with_their_bone(walk):
    take = dress(walk, markers=12, seed=3)
    for label, path in zip(take.labels, take.positions.swapaxes(0, 1), strict=True):
        joint = walk.joints.index(label.rstrip("0123456789"))
        bone = walk.positions[:, [joint, walk.parents[joint]]]
        away = np.linalg.norm(path[:, None] - bone, axis=2).min(axis=1)
        assert away.max() < 500.0


def test_short_recordings_are_refused(walk):
    short = replace(
        walk,
        positions=walk.positions[:20],
        rotations=walk.rotations[:20],
        confidence=walk.confidence[:20],
    )
    with pytest.raises(DataError, match="30 poses"):
        dress(short, markers=12, seed=0)
