"""Rigid body, pattern, cyclic, Kalman: exact where they should be, smooth, and honest."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from gaps import gap, hide
from hypothesis import given, settings
from hypothesis import strategies as st
from recordings import read_named

from markermend.arrays import FloatArray
from markermend.bench.gaps import BAND_90, GapRow, read_cases, replay, summarise
from markermend.mesh import Group, Mesh
from markermend.repairs import REPAIRS, propose
from markermend.repairs.bridge import bridge, bridge_within, context_of
from markermend.repairs.kalman import smooth
from markermend.take import Take

BENCH = Path(__file__).resolve().parents[3] / "shared" / "bench" / "gaps-dev.json"
OPERATORS = ["rigid", "pattern", "cyclic", "kalman"]
RATE = 100.0
SHAPE = np.array([[0, 0, 0], [200, 0, 0], [0, 300, 0], [40, 60, 150], [120, 80, 60]], float)


def turning(frames: int = 600) -> FloatArray:
    """(frames, 3, 3) rotations about two axes."""
    a, b = 0.9 * np.sin(np.arange(frames) / 37), np.arange(frames) / 90
    one, zero = np.ones(frames), np.zeros(frames)
    about_z = [np.cos(b), -np.sin(b), zero, np.sin(b), np.cos(b), zero, zero, zero, one]
    about_x = [one, zero, zero, zero, np.cos(a), -np.sin(a), zero, np.sin(a), np.cos(a)]
    turns = [np.stack(m, axis=1).reshape(-1, 3, 3) for m in (about_z, about_x)]
    return np.asarray(turns[0] @ turns[1])


def way(frames: int = 600) -> FloatArray:
    t = np.arange(frames)[:, None] / RATE
    return 400 * np.sin(t * np.array([2.1, 1.3, 3.7]) + np.array([0.0, 1.0, 2.0]))


def rigid_take(frames: int = 600) -> Take:
    positions = np.einsum("fij,mj->fmi", turning(frames), SHAPE) + way(frames)[:, None]
    return Take(positions, tuple("ABCDE"), RATE)


def one_group(take: Take) -> Mesh:
    return Mesh(take.labels, (Group("Body", "", tuple(range(take.markers))),))


def lonely(values: FloatArray) -> Take:
    return Take(values[:, None], ("A",), RATE)


def test_keys_of_the_window_stay_as_they_are() -> None:
    keyed = [name for name, m in REPAIRS.items() if m.key is not None]
    assert list(REPAIRS)[: len(keyed)] == keyed
    assert not set(keyed) & set(OPERATORS)


@pytest.mark.parametrize(("start", "stop"), [(0, 80), (200, 215), (250, 450), (540, 600)])
def test_rigid_reproduces_a_rigid_body_everywhere(start: int, stop: int) -> None:
    truth = rigid_take()
    take = hide(truth, "E", start, stop)
    done = propose(take, gap("E", start, stop), method="rigid", mesh=one_group(take))
    assert np.abs(done.patches[0].values - truth.positions[start:stop, 4]).max() < 1e-6


def test_rigid_needs_three_that_are_not_on_a_line() -> None:
    truth = rigid_take()
    take = hide(hide(truth, "E", 200, 250), "A", 240, 245)
    few = Mesh(take.labels, (Group("Body", "", (0, 1, 2, 4)),))
    done = propose(take, gap("E", 200, 250), method="rigid", mesh=few)
    assert not done.patches
    assert "3 are needed" in done.reason
    line = truth.positions.copy()
    line[:, 2] = 0.3 * line[:, 0] + 0.7 * line[:, 1]
    row = Mesh(truth.labels, (Group("Body", "", (0, 1, 2, 4)),))
    flat = propose(Take(line, truth.labels, RATE), gap("E", 200, 250), method="rigid", mesh=row)
    assert not flat.patches
    assert "line" in flat.reason


@pytest.mark.parametrize(("start", "stop"), [(0, 60), (200, 330), (560, 600)])
def test_pattern_reproduces_a_translated_copy(start: int, stop: int) -> None:
    one = way()
    positions = np.stack([one, one + np.array([30.0, -80.0, 10.0]), one[::-1]], axis=1)
    truth = Take(positions, tuple("ABC"), RATE)
    take = hide(truth, "A", start, stop)
    done = propose(take, gap("A", start, stop), method="pattern", params={"donor": "B"})
    assert np.abs(done.patches[0].values - one[start:stop]).max() < 1e-6


def test_pattern_follows_a_donor_that_drifts_away_evenly() -> None:
    one = way()
    drift = np.arange(600)[:, None] * np.array([0.5, 0.0, -0.2])
    take = hide(Take(np.stack([one, one + drift], axis=1), ("A", "B"), RATE), "A", 200, 330)
    done = propose(take, gap("A", 200, 330), method="pattern", params={"donor": "B"})
    assert np.abs(done.patches[0].values - one[200:330]).max() < 1e-6


def test_pattern_chooses_the_sibling_of_most_constant_distance() -> None:
    truth = rigid_take()
    positions = truth.positions.copy()
    positions[:, [0, 1, 3]] += np.random.default_rng(0).normal(0, 5, (600, 3, 3))
    take = hide(Take(positions, truth.labels, RATE), "E", 200, 260)
    artifact, mesh = gap("E", 200, 260), one_group(take)
    chosen = propose(take, artifact, method="pattern", mesh=mesh).patches[0].values
    named = propose(take, artifact, method="pattern", mesh=mesh, params={"donor": "C"})
    assert np.array_equal(chosen, named.patches[0].values)


@pytest.mark.parametrize("donor", ["E", "nobody", "B"])
def test_pattern_says_why_a_donor_cannot_serve(donor: str) -> None:
    take = hide(hide(rigid_take(), "E", 200, 260), "B", 210, 212)
    done = propose(take, gap("E", 200, 260), method="pattern", params={"donor": donor})
    assert not done.patches
    assert donor in done.reason


def periodic(frames: int = 900, period: int = 110) -> FloatArray:
    phase = 2 * np.pi * np.arange(frames)[:, None] / period
    wave = 200 * np.sin(phase + np.arange(3)) + 60 * np.sin(3 * phase) + 20 * np.cos(5 * phase)
    return np.asarray(wave + np.arange(frames)[:, None] * np.array([2.0, 0.0, 0.0]))


@pytest.mark.parametrize(("start", "stop"), [(0, 70), (300, 420), (830, 900)])
def test_cyclic_reproduces_a_walking_lone_marker(start: int, stop: int) -> None:
    truth = periodic()
    done = propose(hide(lonely(truth), "A", start, stop), gap("A", start, stop), method="cyclic")
    # The marker walks on, so what comes before the beginning can only be held level.
    walked = 2.0 * 70 if start == 0 or stop == 900 else 0.5
    assert np.abs(done.patches[0].values - truth[start:stop]).max() < walked


def test_cyclic_finds_the_pose_where_the_body_is_seen() -> None:
    truth = rigid_take(900).positions.copy()
    bend = periodic()[:, 1:2] * np.array([0.0, 0.2, 0.1])
    truth[:, 4] += np.einsum("fij,fj->fi", turning(900), bend)
    truth[:, 3] += np.einsum("fij,fj->fi", turning(900), -0.3 * bend)
    take = hide(Take(truth, tuple("ABCDE"), RATE), "E", 400, 480)
    done = propose(take, gap("E", 400, 480), method="cyclic")
    assert np.abs(done.patches[0].values - truth[400:480, 4]).max() < 1.0


def test_cyclic_refuses_what_is_not_repeated() -> None:
    rng = np.random.default_rng(2)
    wandering = np.cumsum(np.cumsum(rng.normal(size=(500, 3)), axis=0), axis=0)
    done = propose(
        hide(lonely(wandering), "A", 200, 290),
        gap("A", 200, 290),
        method="cyclic",
        params={"unlikeness": 0.1},
    )
    assert not done.patches
    assert "not repeated" in done.reason
    short = propose(hide(lonely(wandering[:150]), "A", 30, 120), gap("A", 30, 120), method="cyclic")
    assert not short.patches
    assert "as long as" in short.reason


@given(
    velocity=st.floats(-20, 20),
    acceleration=st.floats(-1, 1),
    length=st.integers(1, 80),
)
@settings(max_examples=15, deadline=None)
def test_kalman_reproduces_constant_acceleration(
    velocity: float, acceleration: float, length: int
) -> None:
    t = np.arange(200.0)[:, None]
    truth = 800 + velocity * t + acceleration / 2 * t**2 * np.array([1.0, -0.5, 0.1])
    start, stop = 60, 60 + length
    done = propose(hide(lonely(truth), "A", start, stop), gap("A", start, stop), method="kalman")
    assert np.abs(done.patches[0].values - truth[start:stop]).max() < 1e-3


def test_kalman_smooths_noise_and_knows_its_size() -> None:
    rng = np.random.default_rng(5)
    clean = way(300)
    noisy = clean + rng.normal(0, 0.5, clean.shape)
    known = np.ones(300, dtype=bool)
    mean, variance, noise = smooth(noisy, known, 100, 200)
    error = mean - clean[100:200]
    assert error.std() < 0.35
    assert np.sqrt(variance.mean()) == pytest.approx(error.std(), rel=0.5)
    assert np.sqrt(noise) == pytest.approx([0.5] * 3, rel=0.1)


def test_the_band_of_a_short_gap_counts_the_noise_of_measurement() -> None:
    rng = np.random.default_rng(6)
    truth = way(300) + rng.normal(0, 0.5, (300, 3))
    held = []
    for start in range(40, 240, 8):
        done = propose(
            hide(lonely(truth), "A", start, start + 3), gap("A", start, start + 3), method="kalman"
        )
        off = np.linalg.norm(done.patches[0].values - truth[start : start + 3], axis=1)
        held.append(np.mean(off <= BAND_90 * done.band_mm))
    assert 0.8 < np.mean(held) < 0.99


def test_kalman_stays_sound_where_a_lone_sample_precedes_a_long_gap() -> None:
    time = np.arange(360.0)[:, None] * np.ones(3)
    track = 100 * np.sin(time / 40) + np.random.default_rng(0).normal(0, 0.1, time.shape)
    known = np.ones(360, dtype=bool)
    known[1:143] = known[175:179] = False
    with np.errstate(all="raise", under="ignore"):
        mean, variance, _ = smooth(track, known, 175, 179)
    assert np.abs(mean - track[175:179]).max() < 1.0
    assert (variance > 0).all()


def test_kalman_is_least_sure_in_the_middle_and_stops_at_the_ends() -> None:
    take = hide(lonely(way()), "A", 200, 230)
    band = propose(take, gap("A", 200, 230), method="kalman").band_mm
    assert band is not None
    assert 12 <= int(np.argmax(band)) <= 17
    for start, stop in ((0, 20), (580, 600)):
        done = propose(
            hide(lonely(way()), "A", start, stop), gap("A", start, stop), method="kalman"
        )
        assert not done.patches
        assert "needed" in done.reason


@pytest.mark.parametrize("name", OPERATORS)
def test_there_is_no_kink_at_either_border(name: str) -> None:
    truth = rigid_take(900).positions.copy()
    rng = np.random.default_rng(4)
    soft = np.cumsum(rng.normal(0, 1, (900, 5, 3)), axis=0)
    kernel = np.hanning(41) / np.hanning(41).sum()
    soft = np.apply_along_axis(np.convolve, 0, soft, kernel, mode="same")
    truth += soft + np.repeat(periodic()[:, None] * 0.05, 5, axis=1)
    take = hide(Take(truth, tuple("ABCDE"), RATE), "E", 400, 440)
    done = propose(
        take,
        gap("E", 400, 440),
        method=name,
        mesh=one_group(take),
        params={"unlikeness": 1.0} if name == "cyclic" else None,
    )
    whole = truth[380:460, 4].copy()
    usual = np.abs(np.diff(whole, n=2, axis=0)).max()
    whole[20:60] = done.patches[0].values
    assert np.abs(np.diff(whole, n=2, axis=0)).max() < 3 * usual + 0.2
    assert done.band_mm is not None
    assert done.band_mm.shape == (40,)


def test_a_bridge_meets_value_and_velocity_and_widens_inside() -> None:
    signal = 0.02 * way()
    known = np.ones(600, dtype=bool)
    frames = context_of(known, 300, 340, RATE)
    assert frames.tolist() == [*range(250, 300), *range(340, 390)]
    mean, deviation = bridge(frames, signal[frames], 300, 340, RATE)
    joined = signal[290:350].copy()
    joined[10:50] = mean
    assert np.abs(np.diff(joined, n=2, axis=0)).max() < 0.15
    assert (deviation[20] > 3 * deviation[0]).all()


def test_the_deviation_of_a_bridge_is_measured() -> None:
    rng = np.random.default_rng(0)
    inside = []
    for start in range(200, 1800, 100):
        signal = np.cumsum(rng.normal(size=(2000, 3)), axis=0)
        known = np.ones(2000, dtype=bool)
        known[start : start + 50] = False
        mean, deviation = bridge_within(signal, known, start, start + 50, RATE)
        miss = np.linalg.norm(mean - signal[start : start + 50], axis=1)
        inside.append(miss <= 2.5003 * np.sqrt(np.mean(deviation**2, axis=1)))
    assert 0.8 < np.mean(inside) < 0.97


@pytest.fixture(scope="module")
def replayed(shared_data: Path) -> dict[tuple[int, str], GapRow]:
    if not BENCH.is_file():
        pytest.skip(f"the gap list is not here ({BENCH})")
    cases = [c for c in read_cases(BENCH) if c.length in (10, 120)][::9]
    takes = {n: read_named(n, shared_data) for n in {c.take for c in cases}}
    rows = summarise(replay(cases, takes, OPERATORS), reference=None)
    return {(r.length, r.method): r for r in rows}


def test_all_are_good_on_short_gaps_and_the_body_on_long_ones(
    replayed: dict[tuple[int, str], GapRow],
) -> None:
    for name in ("rigid", "cyclic"):
        assert replayed[120, name].error_mm < 0.3 * replayed[120, "kalman"].error_mm
    for name in OPERATORS:
        assert replayed[10, name].error_mm < 2.0
        assert replayed[120, name].in_band > 0.5
