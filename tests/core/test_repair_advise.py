"""Advice: methods ranked by what they would have done to known stretches nearby."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from recordings import read_named

from markermend import mesh
from markermend.artifact import Artifact, Kind
from markermend.bench.gaps import BAND_90, read_cases
from markermend.mesh import infer_mesh
from markermend.repairs import advise, evidence_for, propose, propose_from
from markermend.repairs.advice import CANDIDATES, COMPARED, MODELS, _hidden, _trials_of
from markermend.simulation import simulate_clean
from markermend.simulation.markers import MARKER_SET
from markermend.take import Take

BENCH = Path(__file__).resolve().parents[3] / "shared" / "bench" / "gaps-dev.json"


def wave_take(frames: int = 400, alone: bool = False) -> Take:
    t = np.arange(frames)[:, None] / 100.0
    centre = 200 * np.sin(3 * t + np.arange(3))
    offsets = np.array([[0, 0, 0], [100, 0, 0], [0, 100, 0], [0, 0, 100], [50, 60, 70]], float)
    positions = centre[:, None] + offsets
    labels = tuple(f"M{i}" for i in range(5))
    return Take(positions[:, :1], labels[:1], 100.0) if alone else Take(positions, labels, 100.0)


def hide(take: Take, start: int, stop: int) -> tuple[Take, Artifact]:
    positions = take.positions.copy()
    positions[start:stop, 0] = np.nan
    gap = Artifact(take.labels[0], "xyz", start, stop, Kind.GAP)
    return Take(positions, take.labels, take.rate), gap


def test_the_body_wins_over_curves_where_it_is_seen() -> None:
    take, gap = hide(wave_take(), 150, 200)
    advice = advise(evidence_for(take), gap)
    # Rigid body is as right, where nothing but one rigid body moves.
    assert {a.method for a in advice[:2]} == {"local_regression", "rigid"}
    assert {a.method for a in advice} >= {"spline", "pchip", "makima", "linear"}
    known = [a.error_mm for a in advice[1:] if a.error_mm is not None]
    assert known == sorted(known)


def test_a_lone_marker_gets_the_best_curve_and_the_reason_for_the_rest() -> None:
    take, gap = hide(wave_take(alone=True), 150, 165)
    advice = advise(evidence_for(take), gap, trials=2)
    assert advice[0].method == "kalman"
    assert next(a.method for a in advice if a.method in CANDIDATES) == "kalman"
    assert advice[0].trials == 2
    without = {a.method: a.repair.reason for a in advice if not a.repair.patches}
    assert "local_regression" in without
    assert all(without.values())


def test_the_structure_of_the_body_is_worked_out_once(monkeypatch: pytest.MonkeyPatch) -> None:
    take, gap = hide(wave_take(), 150, 200)
    counted = []
    monkeypatch.setattr(mesh, "infer_mesh", lambda take: counted.append(1) or infer_mesh(take))
    assert "rigid" in {a.method for a in advise(evidence_for(take), gap)}
    assert len(counted) == 1


def test_a_trial_hides_the_marker_and_what_is_missing_with_it() -> None:
    take, gap = hide(wave_take(), 150, 200)
    other = Artifact("M3", "y", 160, 170, Kind.NOISE)
    hidden = _hidden(_trials_of(evidence_for(take, [other]), gap, 1), 300)
    assert not hidden.trusted[300:350, 0].any()
    assert not hidden.trusted[310:320, 3, 1].any()
    assert hidden.trusted[310:320, 3, 0].all()
    assert np.array_equal(hidden.seen, hidden.trusted.all(axis=2))


def test_stray_frames_inside_a_gap_are_as_far_off_as_the_gap_is_long() -> None:
    take, gap = hide(wave_take(alone=True), 150, 210)
    positions = take.positions.copy()
    positions[178:181] = positions[149] + 30.0
    stray = Artifact("M0", "xyz", 178, 181, Kind.STEP)
    evidence = evidence_for(Take(positions, take.labels, take.rate), [stray])
    (inside,) = advise(evidence, stray, methods=["spline"])
    (across,) = advise(evidence_for(take), gap, methods=["spline"])
    truth = wave_take(alone=True).positions[178:181, 0]
    off = np.linalg.norm(inside.repair.patches[0].values - truth, axis=1).mean()
    assert inside.error_mm is not None
    assert across.error_mm is not None
    assert off / 2 < inside.error_mm < 2 * off
    assert across.error_mm < inside.error_mm < 2 * across.error_mm
    assert inside.repair.band_mm is not None
    assert np.ptp(inside.repair.band_mm) < 0.05 * inside.repair.band_mm.mean()


@pytest.mark.parametrize("start", [200, 96, 140])
def test_beside_a_gap_longer_than_all_that_is_known_errors_are_tried_on_less(start: int) -> None:
    take, _ = hide(wave_take(300, alone=True), 100, 200)
    positions = take.positions.copy()
    positions[start : start + 4] = 0.0
    damage = Artifact("M0", "xyz", start, start + 4, Kind.PEAK)
    evidence = evidence_for(Take(positions, take.labels, take.rate), [damage])
    tried = _trials_of(evidence, damage, 3)
    assert tried.start <= damage.start < damage.stop <= tried.stop
    assert 40 <= tried.stop - tried.start <= 50
    assert len(tried.places) >= 1
    (spline,) = advise(evidence, damage, methods=["spline"])
    assert spline.error_mm is not None


# Not every marker: PMA asks all of them.
@pytest.mark.parametrize(("method", "every"), [("linear", 2), ("spline", 2), ("pma", 3)])
def test_a_measured_error_comes_with_a_band_that_holds(method: str, every: int) -> None:
    take = simulate_clean(duration_s=20.0, rate=100.0, seed=3, labels=list(MARKER_SET)[::every])
    inside, rng = [], np.random.default_rng(0)
    for length in (6, 20, 50):
        for _ in range(6):
            marker, start = int(rng.integers(take.markers)), int(rng.integers(50, 1900))
            gap = Artifact(take.labels[marker], "xyz", start, start + length, Kind.GAP)
            done = propose(take, gap, method=method)
            assert done.band_mm is not None
            truth = take.positions[start : start + length, marker]
            off = np.linalg.norm(done.patches[0].values - truth, axis=1)
            inside.extend(off <= BAND_90 * done.band_mm)
            assert done.band_mm.argmax() == pytest.approx(length / 2, abs=1)
    assert 0.8 < np.mean(inside) < 0.99


def test_a_band_does_not_narrow_where_the_take_ends() -> None:
    take = simulate_clean(duration_s=20.0, rate=100.0, seed=3)
    gap = Artifact("LFHD", "xyz", take.frames - 40, take.frames, Kind.GAP)
    done = propose(take, gap, method="pma")
    assert done.band_mm is not None
    assert (np.diff(done.band_mm) > 0).all()


def test_what_is_missing_during_the_artifact_is_hidden_in_the_trials_too() -> None:
    whole = wave_take()
    positions = whole.positions.copy()
    positions[150:200] = np.nan
    take = Take(positions, whole.labels, whole.rate)
    advice = advise(evidence_for(take), Artifact("M0", "xyz", 150, 200, Kind.GAP), trials=2)
    assert advice[0].method != "local_regression"
    assert not advice[-1].repair.patches


def test_a_known_swap_comes_first() -> None:
    take = wave_take()
    artifact = Artifact("M0", "xyz", 100, 120, Kind.STEP, counterpart="M1")
    assert advise(evidence_for(take), artifact)[0].method == "swap"


def test_nothing_to_try_on_leaves_the_error_unknown() -> None:
    take, gap = hide(wave_take(60, alone=True), 10, 50)
    curves = [a for a in advise(evidence_for(take), gap) if a.method == "pchip"]
    assert curves[0].trials == 0
    assert curves[0].error_mm is None


def test_curves_say_how_far_off_they_may_be() -> None:
    take, gap = hide(wave_take(alone=True), 150, 165)
    truth = wave_take(alone=True).positions[150:165, 0]
    done = propose(take, gap, method="linear")
    assert done.error_mm is not None
    error = np.linalg.norm(done.patches[0].values - truth, axis=1).mean()
    assert 0.3 < done.error_mm / error < 3


def test_expected_errors_follow_the_true_ones_on_real_takes(shared_data: Path) -> None:
    if not BENCH.is_file():
        pytest.skip(f"the gap list is not here ({BENCH})")
    cases = [c for c in read_cases(BENCH) if c.take == "85_12" and c.length <= 120][::12]
    take = read_named("85_12", shared_data)
    expected, true = [], []
    for case in cases:
        positions = take.positions.copy()
        for label, start, stop in case.gaps:
            positions[start:stop, take.index(label)] = np.nan
        evidence = evidence_for(Take(positions, take.labels, take.rate))
        for label, start, stop in case.gaps:
            best = advise(evidence, Artifact(label, "xyz", start, stop, Kind.GAP))[0]
            truth = take.positions[start:stop, take.index(label)]
            miss = np.linalg.norm(best.repair.patches[0].values - truth, axis=1)
            expected.append(best.error_mm)
            true.append(miss.mean())
    assert np.corrcoef(np.log(expected), np.log(true))[0, 1] > 0.8
    assert 0.6 < np.mean(expected) / np.mean(true) < 1.7


def swaying_take(frames: int = 700) -> Take:
    """Two markers that keep their distance, and three that go their own ways."""
    t = np.arange(frames)[:, None] / 100.0
    rng = np.random.default_rng(2)
    ways = rng.normal(size=(4, 5, 3))
    paths = [sum(w * np.sin((k + 1.3) * t + k) for k, w in enumerate(way)) * 150 for way in ways]
    beside = paths[0] + [40.0, 10.0, 0.0] + 2 * np.sin(5 * t)
    labels = tuple(f"M{i}" for i in range(5))
    return Take(np.stack([paths[0], beside, *paths[1:]], axis=1), labels, 100.0)


def test_a_marker_is_followed_where_the_body_is_not_seen() -> None:
    take = swaying_take(500)
    positions = take.positions.copy()
    positions[180:290, [0, 2, 3, 4]] = np.nan
    holed = Take(positions, take.labels, take.rate)
    gap = Artifact("M0", "xyz", 180, 290, Kind.GAP)
    best = advise(evidence_for(holed), gap)[0]
    assert best.method == "pattern"
    assert best.trials == 2
    chosen = propose(holed, gap)
    assert chosen.method == "pattern"
    assert "Only one other marker" in chosen.reason
    off = np.linalg.norm(chosen.patches[0].values - take.positions[180:290, 0], axis=1).mean()
    assert off < 5.0


def test_rigid_body_is_measured_where_the_body_is_seen_and_pattern_where_not() -> None:
    take, gap = hide(wave_take(), 150, 200)
    tried = {a.method for a in advise(evidence_for(take), gap, trials=1)}
    assert "rigid" in tried
    assert "pattern" not in tried
    positions = take.positions.copy()
    positions[150:200, 2:] = np.nan
    few = evidence_for(Take(positions, take.labels, take.rate))
    tried = {a.method for a in advise(few, gap, trials=1)}
    assert "pattern" in tried
    assert "rigid" not in tried


@pytest.mark.parametrize("name", ["rigid", "pattern", "cyclic"])
def test_a_method_chosen_by_hand_is_compared_by_its_measured_error(name: str) -> None:
    take, gap = hide(wave_take(900), 400, 450)
    alone = propose(take, gap, method=name)
    assert alone.error_mm is not None
    (compared,) = [a for a in advise(evidence_for(take), gap, methods=COMPARED) if a.method == name]
    assert compared.trials == 4
    assert compared.error_mm is not None


def moving_take(frames: int = 600, seed: int = 3) -> Take:
    """Two rigid bodies that move against each other, so that no model is exact."""
    t = np.arange(frames)[:, None] / 100.0
    rng = np.random.default_rng(seed)
    parts = []
    for speed in (2.0, 3.1):
        centre = 200 * np.sin(speed * t + rng.uniform(0, 6, 3))
        angle = 0.5 * np.sin(1.3 * speed * t[:, 0])
        for x, y, z in rng.uniform(-100, 100, (4, 3)):
            turned = np.cos(angle) * x - np.sin(angle) * y, np.sin(angle) * x + np.cos(angle) * y
            parts.append(centre + np.column_stack([*turned, np.full(frames, z)]))
    labels = tuple(f"M{i}" for i in range(8))
    return Take(np.stack(parts, axis=1), labels, 100.0)


@pytest.mark.parametrize("name", MODELS)
def test_models_picked_by_hand_are_measured_in_a_proposal(name: str) -> None:
    whole = moving_take()
    take, gap = hide(whole, 250, 290)
    done = propose(take, gap, method=name)
    off = float(np.linalg.norm(done.patches[0].values - whole.positions[250:290, 0], axis=1).mean())
    assert done.error_mm is not None
    assert off / 4 < done.error_mm < 4 * off
    # Many gaps are filled without: it would take four times as long.
    unmeasured = propose_from(evidence_for(take, [gap]), gap, method=name)
    assert unmeasured.error_mm is None
    np.testing.assert_array_equal(done.patches[0].values, unmeasured.patches[0].values)


def test_a_proposal_is_measured_with_the_parameters_it_was_made_with() -> None:
    take, gap = hide(moving_take(), 250, 290)
    errors = {
        n: propose(take, gap, method="ffnn_loose", params={"iterations": n}).error_mm
        for n in (2, 150)
    }
    assert errors[2] > 2 * errors[150]


def test_what_cannot_be_tried_elsewhere_is_not_measured() -> None:
    take = moving_take(100)
    positions = take.positions.copy()
    positions[:30, 0] = positions[70:, 0] = np.nan
    gaps = [Artifact("M0", "xyz", 30, 50, Kind.GAP), Artifact("M0", "xyz", 0, 30, Kind.GAP)]
    positions[30:50, 0] = np.nan
    done = propose(Take(positions, take.labels, take.rate), gaps[0], gaps, method="li")
    assert done.patches
    assert done.error_mm is None
