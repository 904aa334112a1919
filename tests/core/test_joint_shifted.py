"""Markers that slide to another place of the body and stay there."""

import numpy as np
import pytest

from markermend.artifact import Kind
from markermend.detectors import detect
from markermend.detectors.joint import JointParams
from markermend.detectors.joint.shifted import find_shifted
from markermend.predictors.local import align
from markermend.simulation import simulate_clean
from markermend.take import Take


@pytest.fixture(scope="module")
def performer():
    return simulate_clean(duration_s=20.0, rate=100.0, seed=5)


def slid(take, marker, mates, course, size_mm=20.0):
    """The marker moved among its mates along one of the body's own directions."""
    motion = align(take.positions[:, [take.index(m) for m in mates]])
    positions = take.positions.copy()
    away = motion.turn.transpose(0, 2, 1) @ np.array([0.6, 0.0, 0.8])
    positions[:, take.index(marker)] += size_mm * course[:, None] * away
    return Take(positions, take.labels, take.rate)


def shifted(take):
    return find_shifted(take, range(take.markers), take.present)


HEAD = ("LFHD", "RFHD", "LBHD", "RBHD")


def test_a_marker_that_slides_and_stays_off_is_found_and_no_other(performer):
    frames = np.arange(performer.frames)
    damaged = slid(performer, "LFHD", HEAD[1:], np.clip((frames - 1000) / 100, 0, 1))
    (a,) = shifted(damaged)
    assert (a.marker, a.axes, a.stop, a.kind) == ("LFHD", "xyz", performer.frames, Kind.SLOW)
    assert 950 <= a.start <= 1050
    assert 15 < a.amplitude_mm < 25
    assert "to the end of the take" in a.why


def test_two_that_slide_are_both_found(performer):
    frames = np.arange(performer.frames)
    damaged = slid(performer, "LFHD", HEAD[1:], np.clip((frames - 1000) / 100, 0, 1))
    damaged = slid(damaged, "LANK", ("LKNE", "LTOE", "LHEE"), np.clip((frames - 1200) / 50, 0, 1))
    assert {a.marker for a in shifted(damaged)} == {"LFHD", "LANK"}


def test_what_returns_or_never_happened_is_left_alone(performer):
    frames = np.arange(performer.frames)
    assert shifted(performer) == []
    back = np.clip((frames - 1100) / 50, 0, 1) - np.clip((frames - 1100) / 50, 0, 1)
    assert shifted(slid(performer, "LFHD", HEAD[1:], back)) == []


def test_a_short_take_or_a_few_markers_tell_nothing(performer):
    frames = np.arange(performer.frames)
    damaged = slid(performer, "LFHD", HEAD[1:], np.clip((frames - 1000) / 100, 0, 1))
    short = Take(damaged.positions[600:1400], damaged.labels, damaged.rate)
    assert shifted(short) == []
    few = Take(damaged.positions[:, :5], damaged.labels[:5], damaged.rate)
    assert shifted(few) == []


def test_the_detector_tells_of_it_with_its_slow_changes(performer):
    frames = np.arange(performer.frames)
    damaged = slid(performer, "LFHD", HEAD[1:], np.clip((frames - 1000) / 100, 0, 1))
    # Slow changes are searched for in one marker after the other, of which these are enough.
    some = (*HEAD, "C7", "CLAV", "STRN", "LSHO", "RSHO", "LUPA", "RUPA", "LELB", "RELB")
    columns = [damaged.index(label) for label in some]
    upper = Take(damaged.positions[:, columns], some, damaged.rate)
    found = detect(upper, method="joint", params=JointParams(jobs=1))
    own = [a for a in found if a.marker == "LFHD"]
    assert [(a.kind, a.stop) for a in own] == [(Kind.SLOW, performer.frames)]
