"""Pictures of a whole take: nothing short may vanish, nothing may move."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.artifact import Artifact, Kind, Status
from markermend.errors import Cancelled
from markermend.heat import (
    LEAST_SHARE,
    body_residuals,
    count_missing,
    damage_share,
    missing_share,
    worst,
)
from markermend.simulation import simulate_clean
from markermend.take import Origin, Take


@pytest.mark.parametrize("frames", [0, 1, 254, 255, 256, 100_000])
def test_missing_samples_are_counted_in_takes_of_any_length(frames):
    origin = np.random.default_rng(1).integers(0, 3, (frames, 2)).astype(np.uint8)
    np.testing.assert_array_equal(count_missing(origin), (origin == 0).sum(axis=0))
    np.testing.assert_array_equal(count_missing(np.zeros_like(origin)), [frames, frames])


def test_one_missing_frame_stays_visible_at_any_width() -> None:
    origin = np.full((1000, 2), Origin.MEASURED, dtype=np.uint8)
    origin[517, 1] = Origin.MISSING
    for columns in (3, 100, 1000, 2500):
        share = missing_share(origin, columns)
        assert share.shape == (2, columns)
        assert not share[0].any()
        hit = np.flatnonzero(share[1])
        assert hit.size
        np.testing.assert_allclose((hit + 0.5) / columns, 0.5175, atol=1 / min(columns, 1000))


def test_shares_are_counted_and_do_not_overflow() -> None:
    origin = np.full((4000, 1), Origin.MISSING, dtype=np.uint8)
    origin[1000:] = Origin.MEASURED
    np.testing.assert_allclose(missing_share(origin, 2), [[0.5, 0.0]])
    assert missing_share(origin, 4000)[0, 999] == 1.0
    assert missing_share(np.r_[origin, origin[:1]], 1, 3900, 4001)[0, 0] == LEAST_SHARE


def test_a_part_shows_the_frames_asked_for() -> None:
    values = np.arange(1000, dtype=np.float32)[None]
    np.testing.assert_array_equal(worst(values, 4, 100, 104), [[100, 101, 102, 103]])
    np.testing.assert_array_equal(worst(values, 2, 100, 200), [[149, 199]])
    # Zoomed in beyond the frames, each is repeated.
    np.testing.assert_array_equal(worst(values, 4, 100, 102), [[100, 100, 101, 101]])
    assert worst(values, 3, 999, 1000).tolist() == [[999] * 3]


def test_the_worst_passes_over_what_is_unknown() -> None:
    values = np.array([[1, np.nan, 3, np.nan, np.nan, np.nan]], dtype=np.float32)
    np.testing.assert_array_equal(worst(values, 2), [[3, np.nan]])


@pytest.fixture(scope="module")
def person() -> Take:
    """A few seconds of a simulated person with one displaced marker."""
    take = simulate_clean(duration_s=4.0, rate=60.0, seed=2)
    positions = take.positions.copy()
    positions[100:130, 5, 2] += 60.0
    positions[40:50, 7] = np.nan
    return Take(positions, take.labels, take.rate)


def test_residuals_show_where_a_marker_is_off(person: Take) -> None:
    known = Artifact(person.labels[5], "z", 100, 130, Kind.STEP, 1.0)
    found = body_residuals(person, [known], [person.labels[5], person.labels[7]])
    assert found.shape == (2, person.frames)
    assert np.median(found[0, 100:130]) > 40
    assert np.median(found[0, :90]) < 8
    assert np.isnan(found[1, 40:50]).all()
    assert np.isfinite(found[1, :40]).all()


def test_long_takes_are_thinned_without_losing_what_is_short(monkeypatch) -> None:
    take = simulate_clean(duration_s=10.0, rate=120.0, seed=2)
    positions = take.positions.copy()
    positions[601, 5] += (0.0, 0.0, 25.0)
    positions[300:320, 5] = np.nan
    take = Take(positions, take.labels, take.rate)
    whole = body_residuals(take, (), take.labels[5:6])[0]
    monkeypatch.setattr("markermend.heat.LEAST_KNOTS", 300)
    thinned = body_residuals(take, (), take.labels[5:6])[0]
    assert (thinned != whole).any()
    assert np.array_equal(np.isnan(thinned), np.isnan(whole))
    assert abs(thinned[601] - whole[601]) < 2.0
    assert np.nanmedian(np.abs(thinned - whole)) < 0.3


@pytest.mark.parametrize(("frames", "markers"), [(1, 1), (1, 2), (0, 2), (50, 1)])
def test_residuals_of_takes_with_nothing_to_learn_from(frames, markers) -> None:
    take = Take(np.ones((frames, markers, 3)), ("A", "B")[:markers], 100.0)
    assert np.isnan(body_residuals(take)).all()
    assert body_residuals(take).shape == (markers, frames)


def test_residuals_can_be_cancelled(person: Take) -> None:
    def stop(share: float, doing: str) -> None:
        raise Cancelled

    with pytest.raises(Cancelled):
        body_residuals(person, progress=stop)


def test_damage_is_what_is_missing_or_open() -> None:
    positions = np.zeros((100, 3, 3))
    positions[:20, 0] = np.nan
    found = (
        Artifact("A", "xyz", 10, 30, Kind.GAP, 1.0),
        Artifact("B", "x", 50, 60, Kind.STEP, 1.0, counterpart="C"),
        Artifact("B", "x", 70, 80, Kind.STEP, 1.0).with_status(Status.REJECTED),
    )
    share = damage_share(Take(positions, ("A", "B", "C"), 100.0), found)
    np.testing.assert_allclose(share, [0.3, 0.1, 0.1])
