"""Where a marker should be: rigid bodies exactly, people within millimetres, gaps and doubt."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from markermend.arrays import FloatArray
from markermend.errors import DataError
from markermend.files import read
from markermend.predictors.local import predict_local


def tumbling(
    frames: int = 400, markers: int = 8, noise_mm: float = 0.0, seed: int = 0
) -> FloatArray:
    """A rigid body that turns and travels."""
    rng = np.random.default_rng(seed)
    t = np.linspace(0, 4, frames)
    turn = Rotation.from_euler("zyx", np.column_stack([2 * t, np.sin(3 * t), np.cos(2 * t)]))
    body = rng.normal(0, 120, (markers, 3))
    travel = np.column_stack([400 * t, 200 * np.sin(t), 900 + 50 * np.cos(5 * t)])
    lab = np.stack([turn.apply(point) for point in body], axis=1) + travel[:, None]
    return lab + rng.normal(0, noise_mm, lab.shape)


def bending(frames: int = 1500, seed: int = 0) -> FloatArray:
    """A body whose markers also slide on it, all driven by two slow motions."""
    rng = np.random.default_rng(seed)
    t = np.arange(frames) / 100
    drive = np.column_stack([np.sin(2.1 * t), np.cos(3.3 * t + 1)])
    slide = rng.normal(0, 8, (14, 3, 2))
    lab = tumbling(frames, 14, seed=seed)
    return lab + np.einsum("tk,mck->tmc", drive, slide) + rng.normal(0, 0.2, lab.shape)


def errors(found: FloatArray, truth: FloatArray) -> FloatArray:
    return np.sqrt(((found - truth) ** 2).sum(axis=1))


@pytest.mark.parametrize("marker", [0, 5])
def test_a_rigid_body_is_exact(marker: int) -> None:
    p = tumbling()
    assert errors(predict_local(p, marker), p[:, marker]).max() < 1e-3


def test_what_slides_with_the_body_is_learned() -> None:
    p = bending()
    gap = slice(700, 800)
    found = predict_local(p, 3, start=700, stop=800)
    rigid = np.median(errors(predict_local(p[:, :4], 3, start=700, stop=800), p[gap, 3]))
    assert np.median(errors(found, p[gap, 3])) < min(1.0, 0.5 * rigid)


def test_samples_inside_the_interval_are_never_looked_at() -> None:
    p = bending()
    spoiled = p.copy()
    spoiled[300:380, 2] += 500.0
    gone = p.copy()
    gone[300:380, 2] = np.nan
    found = [predict_local(x, 2, start=300, stop=380) for x in (p, spoiled, gone)]
    np.testing.assert_array_equal(found[0], found[1])
    np.testing.assert_array_equal(found[0], found[2])


def test_untrusted_samples_are_neither_learned_from_nor_followed() -> None:
    p = bending()
    damaged, trusted = p.copy(), np.ones(p.shape[:2], dtype=bool)
    damaged[400:600, [1, 5, 6]] += np.array([80.0, -60.0, 40.0])
    damaged[:200, 0] += 150.0
    trusted[400:600, [1, 5, 6]] = False
    trusted[:200, 0] = False
    found = predict_local(damaged, 0, start=450, stop=550, trusted=trusted)
    assert np.median(errors(found, p[450:550, 0])) < 2.0
    blind = predict_local(damaged, 0, start=450, stop=550)
    assert np.median(errors(blind, p[450:550, 0])) > 2.0


def test_a_few_wrong_targets_do_not_bend_the_fit() -> None:
    p = bending()
    damaged = p.copy()
    damaged[np.random.default_rng(2).integers(0, 1500, 60), 4] += 200.0
    assert np.median(errors(predict_local(damaged, 4), p[:, 4])) < 1.5


def test_missing_references_are_bridged_down_to_three() -> None:
    p = tumbling(600, 10, noise_mm=0.3)
    gappy, rng = p.copy(), np.random.default_rng(1)
    for marker in range(1, 10):
        for _ in range(3):
            at = rng.integers(0, 560)
            gappy[at : at + 60, marker] = np.nan
    gappy[200:220, 1:8] = np.nan
    found = predict_local(gappy, 0)
    enough = (~np.isnan(gappy[:, 1:, 0])).sum(axis=1) >= 3
    assert not enough[200:220].any()
    np.testing.assert_array_equal(np.isnan(found[:, 0]), ~enough)
    assert np.median(errors(found[enough], p[enough, 0])) < 1.0


def test_no_frame_shows_all_references() -> None:
    p = tumbling(800, 9, noise_mm=0.2)
    gappy = p.copy()
    gappy[np.arange(800), 1 + np.arange(800) // 100] = np.nan
    found = predict_local(gappy, 0)
    assert np.isfinite(found).all()
    assert np.median(errors(found, p[:, 0])) < 1.0


def test_references_seen_all_through_the_interval_come_first() -> None:
    p = bending()
    gappy = p.copy()
    gappy[500:560, 0] = np.nan
    gappy[500:560, 1:5] = np.nan
    found = predict_local(gappy, 0, start=500, stop=560)
    assert np.isfinite(found).all()
    assert np.median(errors(found, p[500:560, 0])) < 1.5


def test_nothing_to_go_by_gives_nan() -> None:
    p = tumbling(50, 8)
    assert np.isnan(predict_local(p[:, :3], 0)).all()
    never = p.copy()
    never[:, 2] = np.nan
    assert np.isnan(predict_local(never, 2)).all()
    assert predict_local(p, 0, start=20, stop=20).shape == (0, 3)


def test_few_frames_still_give_the_rigid_place() -> None:
    p = tumbling(12, 8)
    assert errors(predict_local(p, 1, start=5, stop=7), p[5:7, 1]).max() < 1.0


def test_memory_prefers_frames_nearby() -> None:
    """A marker that slipped for good in mid-take: near frames know, far ones do not."""
    p = tumbling(1000, 10, noise_mm=0.2)
    slipped = p.copy()
    slipped[400:, 0] += 0.2 * (p[400:, 1] - p[400:, 2])
    gap = slice(500, 530)
    near, all_alike = (
        np.median(errors(predict_local(slipped, 0, start=500, stop=530, memory=m), slipped[gap, 0]))
        for m in (10.0, None)
    )
    assert near < 0.5 * all_alike


@pytest.mark.parametrize("asked", [(9, 0, 10), (-1, 0, 10), (0, -1, 10), (0, 5, 400), (0, 9, 5)])
def test_what_lies_outside_the_take_is_refused(asked: tuple[int, int, int]) -> None:
    marker, start, stop = asked
    with pytest.raises(DataError, match=r"take"):
        predict_local(tumbling(50, 8), marker, start=start, stop=stop)


@settings(max_examples=15, deadline=None)
@given(seed=st.integers(0, 1000), marker=st.integers(0, 13))
def test_prediction_turns_with_the_laboratory(seed: int, marker: int) -> None:
    p, rng = bending(300), np.random.default_rng(seed)
    turn, shift = Rotation.random(random_state=seed), rng.normal(0, 1000, 3)
    moved = np.stack([turn.apply(p[:, m]) for m in range(14)], axis=1) + shift
    here, there = (predict_local(x, marker, start=100, stop=160) for x in (p, moved))
    assert errors(turn.apply(here) + shift, there).max() < 1e-4


@pytest.mark.parametrize(
    ("name", "limit_mm"), [("85_02", 1.6), ("HDM_mm_01-02_03_120", 2.2), ("85_12", 4.2)]
)
def test_people_are_predicted_within_millimetres(
    shared_data: Path, name: str, limit_mm: float
) -> None:
    take = read(shared_data / "bodies" / f"{name}.c3d")
    named = [i for i, label in enumerate(take.labels) if not label.startswith("*")]
    p = take.positions[:, named]
    middle = [np.median(errors(predict_local(p, m), p[:, m])) for m in range(0, len(named), 2)]
    assert np.median(middle) < limit_mm


def test_a_gap_of_half_a_second_on_a_person(shared_data: Path) -> None:
    take = read(shared_data / "bodies" / "HDM_mm_01-02_03_120.c3d")
    wrong = []
    for number, label in enumerate(("LFHD", "T10", "LELB", "RWRA", "RKNE", "LTOE", "RFWT")):
        marker, start = take.index(f"meinard:{label}"), 400 + 450 * number
        found = predict_local(take.positions, marker, start=start, stop=start + 60, memory=100)
        wrong.append(errors(found, take.positions[start : start + 60, marker]).mean())
    assert np.median(wrong) < 5.0
