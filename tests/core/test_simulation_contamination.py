from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from markermend.artifact import Kind, axis_columns, damage_mask
from markermend.errors import DataError, MethodError
from markermend.simulation import contaminate, place_gaps
from markermend.simulation.contamination import triangle
from markermend.take import Origin, Take

seeds = st.integers(0, 2**31)


def smooth_take(frames: int = 3200, markers: int = 12, gap: bool = True) -> Take:
    t = np.arange(frames)[:, None, None] / 100
    phase = np.arange(markers)[None, :, None] + np.arange(3)[None, None, :]
    positions = 300 * np.sin(0.7 * t + phase)
    if gap:
        positions[100:700, 0] = np.nan
        positions[2000:2100, :5] = np.nan
    return Take(positions, (*(f"M{i}" for i in range(markers - 1)), "*1"), 100.0)


@settings(max_examples=15, deadline=None)
@given(seeds)
def test_truth_is_exactly_what_differs(seed: int) -> None:
    clean = smooth_take()
    damaged, truth = contaminate(clean, seed=seed)
    differs = (clean.positions != damaged.positions) & ~np.isnan(clean.positions)
    assert np.array_equal(differs, damage_mask(clean, truth))
    assert np.array_equal(np.isnan(clean.positions), np.isnan(damaged.positions))
    assert (damaged.origin == clean.origin).all()


@pytest.mark.parametrize("share", [0.05, 0.1, 0.2])
def test_each_class_gets_its_share_and_never_two_at_once(share: float) -> None:
    clean = smooth_take(gap=False)
    _, truth = contaminate(clean, share=share, seed=3)
    for kind in (Kind.PEAK, Kind.NOISE, Kind.STEP, Kind.SLOW):
        assert sum(a.length for a in truth if a.kind is kind) == round(share * clean.frames)
    mask = damage_mask(clean, truth)
    assert mask.sum(axis=(1, 2)).max() == 1
    assert all(len(a.axes) == 1 and a.marker != "*1" for a in truth)
    assert all(a.length == 1 for a in truth if a.kind is Kind.PEAK)


@settings(max_examples=10, deadline=None)
@given(seeds)
def test_artifacts_of_one_coordinate_keep_apart(seed: int) -> None:
    clean = smooth_take(gap=False)
    _, truth = contaminate(clean, seed=seed)
    last: dict[tuple[str, str], int] = {}
    for a in truth:
        key = (a.marker, a.axes)
        assert a.start - last.get(key, -100) >= 10
        last[key] = a.stop


def test_shapes_and_sizes_are_as_published() -> None:
    clean = smooth_take(frames=20000, gap=False)
    damaged, truth = contaminate(clean, amplitude_mm=10.0, share=0.1, seed=11)
    sizes = {kind: [] for kind in Kind}
    for a in truth:
        column, axis = clean.index(a.marker), axis_columns(a.axes)[0]
        rows = slice(a.start, a.stop)
        delta = damaged.positions[rows, column, axis] - clean.positions[rows, column, axis]
        if a.kind is Kind.STEP:
            assert np.allclose(np.abs(delta), a.amplitude_mm)
        elif a.kind is Kind.SLOW:
            assert np.allclose(np.abs(delta), a.amplitude_mm * triangle(a.length))
        elif a.kind is Kind.PEAK:
            assert abs(delta[0]) == pytest.approx(a.amplitude_mm)
        elif a.length > 40:
            assert 0.6 < delta.std() / a.amplitude_mm < 1.4
        sizes[a.kind].append(a.amplitude_mm)
    peaks = np.array(sizes[Kind.PEAK])
    assert peaks.mean() == pytest.approx(10, abs=0.4)
    assert peaks.std() == pytest.approx(4, abs=0.4)
    lengths = np.array([a.length for a in truth if a.kind is not Kind.PEAK])
    assert lengths.mean() == pytest.approx(50, abs=3)
    assert lengths.std() == pytest.approx(np.sqrt(50), abs=3)


def test_rmse_of_distorted_peaks_is_that_of_the_paper() -> None:
    frames, markers = 2000, 53
    clean = Take(np.zeros((frames, markers, 3)), tuple(f"M{i}" for i in range(markers)), 100.0)
    for share, expected in ((0.05, 0.191), (0.1, 0.270), (0.2, 0.382)):
        damaged, _ = contaminate(clean, share=share, kinds=("peak",), seed=5)
        rmse = np.sqrt(np.mean((damaged.positions - clean.positions) ** 2))
        assert rmse == pytest.approx(expected, rel=0.06)


def test_the_same_seed_does_the_same_damage() -> None:
    clean = smooth_take()
    first, again, other = (contaminate(clean, seed=s) for s in (1, 1, 2))
    assert first[1] == again[1]
    assert np.array_equal(first[0].positions, again[0].positions, equal_nan=True)
    assert first[1] != other[1]


def test_only_named_markers_are_damaged() -> None:
    _, truth = contaminate(smooth_take(), kinds=("slow",), markers=["M3"], seed=0)
    assert {a.marker for a in truth} == {"M3"}


def test_impossible_wishes_are_refused() -> None:
    clean = smooth_take()
    with pytest.raises(MethodError, match="wobble"):
        contaminate(clean, kinds=("wobble",), seed=0)
    with pytest.raises(MethodError, match="fit"):
        contaminate(clean, share=0.3, seed=0)
    unseen = Take(np.full((500, 2, 3), np.nan), ("A", "B"), 100.0)
    with pytest.raises(DataError, match="seen"):
        contaminate(unseen, seed=0)


@settings(max_examples=15, deadline=None)
@given(seeds, st.integers(1, 4), st.integers(1, 3))
def test_gaps_hide_known_samples_and_nothing_else(seed: int, together: int, count: int) -> None:
    clean = smooth_take()
    gapped, truth = place_gaps(clean, count=count, concomitant=together, seed=seed)
    assert len(truth) == count * together
    hidden = clean.present & ~gapped.present
    assert np.array_equal(hidden, damage_mask(clean, truth).all(axis=2) & clean.present)
    assert sum(a.length for a in truth) == hidden.sum()
    seen = gapped.present
    assert np.array_equal(gapped.positions[seen], clean.positions[seen])
    assert (gapped.origin[hidden] == Origin.MISSING).all()
    for a in truth:
        column = clean.index(a.marker)
        assert seen[a.start - 1, column]
        assert seen[a.stop, column]


def test_gap_lengths_can_be_fixed_and_room_is_needed() -> None:
    clean = smooth_take()
    _, truth = place_gaps(clean, count=5, mean_length=20, fixed_length=True, seed=1)
    assert {a.length for a in truth} == {20}
    with pytest.raises(DataError, match="room"):
        place_gaps(clean, mean_length=3300, seed=1)


def test_kinks_of_slow_changes_can_be_rounded() -> None:
    clean = smooth_take(frames=20000, gap=False)
    damaged, truth = contaminate(clean, kinds=[Kind.SLOW], rounded=9, seed=11)
    a = truth[3]
    column, axis = clean.index(a.marker), axis_columns(a.axes)[0]
    rows = slice(a.start, a.stop)
    delta = np.abs(damaged.positions[rows, column, axis] - clean.positions[rows, column, axis])
    assert delta.max() == pytest.approx(a.amplitude_mm)
    kinks = [np.abs(np.diff(d, 2)).max() for d in (delta, a.amplitude_mm * triangle(a.length))]
    assert kinks[0] < 0.3 * kinks[1]
    assert len(triangle(30, 9)) == 30
