"""Samples that go astray beside a gap."""

from __future__ import annotations

import numpy as np
import pytest

import markermend as mm
from markermend.artifact import Artifact, Kind
from markermend.detectors.joint.lost import find_lost, with_lost
from markermend.simulation import simulate_clean
from markermend.take import Take

GAP = (700, 736)


@pytest.fixture(scope="module")
def performer():
    return simulate_clean(duration_s=14.0, rate=120.0, seed=8)


def lost(take, marker, before=0.0, after=0.0):
    """The take with a gap, up to which the marker drifts off for three frames, and after it."""
    positions = take.positions.copy()
    column, (start, stop) = take.index(marker), GAP
    way = np.array([0.6, 0.0, 0.8])
    ramp = np.array([1.0, 2.0, 3.0])[:, None] / 3
    positions[start - 3 : start, column] += before * ramp * way
    positions[stop : stop + 3, column] += after * ramp[::-1] * way
    positions[start:stop, column] = np.nan
    return Take(positions, take.labels, take.rate)


@pytest.mark.parametrize("marker", ["CLAV", "LTHI", "RANK", "LELB"])
def test_drifting_off_before_a_gap_and_back_after_it_is_found(performer, marker):
    take = lost(performer, marker, before=14.0, after=-14.0)
    found = [a for a in mm.detect(take, slow=False) if a.marker == marker and a.kind is Kind.PEAK]
    assert [a.axes for a in found] == ["xyz", "xyz"]
    before, after = found
    assert GAP[0] - 4 <= before.start <= GAP[0] - 2
    assert (before.stop, after.start) == GAP
    assert GAP[1] + 2 <= after.stop <= GAP[1] + 4
    assert "before it is lost" in before.why
    assert "after it is found again" in after.why
    fixed = mm.repair(take, mm.detect(take, slow=False))
    column = take.index(marker)
    off = np.linalg.norm(fixed.positions[:, column] - performer.positions[:, column], axis=1)
    assert np.nanmax(off[GAP[0] - 4 : GAP[1] + 4]) < 6.0


@pytest.mark.parametrize("marker", ["CLAV", "LTHI", "RANK", "LELB"])
def test_a_plain_gap_has_nothing_beside_it(performer, marker):
    found = mm.detect(lost(performer, marker), slow=False)
    assert [a.kind for a in found] == [Kind.GAP]


def test_a_marker_without_a_body_or_seen_too_briefly_is_passed_over(performer):
    take = lost(performer, "CLAV", before=14.0)
    alone = Take(take.positions[:, [take.index("CLAV")]], ("CLAV",), take.rate)
    assert find_lost(alone, [0], alone.present) == []
    brief = Take(take.positions[690:740], take.labels, take.rate)
    assert find_lost(brief, range(take.markers), brief.present) == []


def test_a_peak_that_it_overlaps_becomes_part_of_it():
    peak = Artifact("A", "x", 8, 10, Kind.PEAK)
    others = [Artifact("A", "x", 2, 4, Kind.PEAK), Artifact("B", "x", 8, 10, Kind.PEAK)]
    step = Artifact("A", "y", 7, 11, Kind.STEP)
    one = Artifact("A", "xyz", 9, 12, Kind.PEAK)
    kept = with_lost([peak, *others, step], [one])
    assert [(a.marker, a.axes, a.start, a.stop) for a in kept] == [
        *(("A", "x", 2, 4), ("B", "x", 8, 10), ("A", "y", 7, 11)),
        ("A", "xyz", 8, 12),
    ]
    noise = Artifact("A", "x", 2, 9, Kind.NOISE)
    (whole,) = with_lost([noise], [one, Artifact("A", "xyz", 1, 2, Kind.PEAK)])
    assert (whole.kind, whole.start, whole.stop) == (Kind.NOISE, 1, 12)
    (longer,) = with_lost([noise], [one])
    assert (longer.kind, longer.axes, longer.start, longer.stop) == (Kind.NOISE, "x", 2, 12)
