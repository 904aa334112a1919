"""Slow changes: what tells drifts from hills, trees as arrays, and drifts found end to end."""

from __future__ import annotations

import numpy as np
import pytest

import markermend as mm
from markermend.artifact import Artifact, Kind
from markermend.detectors.joint import JointParams, slow
from markermend.detectors.joint.bands import clipped, split
from markermend.detectors.joint.bank import shape_of
from markermend.detectors.joint.drift import scan
from markermend.detectors.joint.explained import explained
from markermend.detectors.joint.judge import Judge, evidence, load_judge, quiet_levels
from markermend.detectors.joint.loudness import loudness
from markermend.detectors.joint.measures import FEATURES, measure, stack
from markermend.detectors.joint.refilled import Spot, unevenness
from markermend.detectors.joint.slow import prepare, shipped_judge
from markermend.detectors.joint.slow_training import examples_of
from markermend.detectors.joint.trees import from_scikit
from markermend.detectors.joint.views import VIEWS, Seen, Views
from markermend.errors import Cancelled
from markermend.predictors.cross_fit import distance_spreads
from markermend.simulation import simulate_clean
from markermend.take import Take

LABELS = ("LFHD", "RFHD", "LBHD", "RBHD", "C7", "LSHO", "RSHO", "CLAV")
LEFT_ARM = ("LUPA", "LELB", "LELM", "LFRM", "LWRA", "LWRB")


@pytest.fixture(scope="module")
def performer():
    return simulate_clean(duration_s=12.0, rate=120.0, seed=6)


def drifted(take, marker, axis, start, deviation):
    positions = take.positions.copy()
    positions[start : start + len(deviation), take.index(marker), axis] += deviation
    return Take(positions, take.labels, take.rate)


@pytest.mark.parametrize(("frames", "window"), [(300, 65), (300, 161), (40, 65), (1, 65)])
def test_loudness_is_the_median_size_around(frames, window):
    signal = np.random.default_rng(0).normal(size=(2, 3, frames))
    half = min(window // 2, frames - 1)
    size = np.pad(np.abs(signal), ((0, 0), (0, 0), (half, half)), mode="reflect")
    found, step = loudness(signal, window), max(4, window // 8)
    for at in range(0, frames, step):
        level = np.median(size[..., at : at + 2 * half + 1], axis=-1) / 0.6745
        np.testing.assert_allclose(found[..., at], level)
    if frames > 2 * step:
        middle = 0.5 * (found[..., 0] + found[..., step])
        np.testing.assert_allclose(found[..., step // 2], middle)


def test_hills_are_told_where_the_body_sets_out_and_where_it_stops():
    frames = 1200
    each = (VIEWS, 3, 1, 1)
    parts, weight = split(np.random.default_rng(4).standard_normal(frames))
    speed = np.zeros((frames, 3))
    speed[400:800] = 2.0, 0.0, 1.0
    views = Views(
        np.tile(parts, each),
        np.tile(weight, each),
        np.tile([1.0] + 8 * [0.0], (VIEWS, 3, frames, 1)),
        np.tile(parts, (3, 1, 1)),
        np.zeros((frames, 3)),
        np.cumsum(speed, axis=0),
    )
    start = np.array([400, 600, 750, 0, 1150])
    length, kind = np.full(5, 50), np.array(["sharp"] * 5)
    shapes = stack(kind, length)
    _, rows = measure(views, np.zeros(5, int), start, length, kind, shapes, np.ones(5))
    out, in_ = (rows[:, FEATURES.index(name)] for name in ("sets out", "stops"))
    assert (out > 2).tolist() == [True, False, False, False, False]
    assert (in_ > 2).tolist() == [False, False, True, False, False]
    assert np.abs([out[1], in_[1]]).max() < 0.1


def test_trees_agree_with_scikit_learn(tmp_path):
    from sklearn.ensemble import HistGradientBoostingClassifier

    rng = np.random.default_rng(0)
    rows = rng.standard_normal((600, 5))
    real = rows[:, 0] * rows[:, 1] + rows[:, 2] > 0.3
    models = [
        HistGradientBoostingClassifier(max_iter=30, max_depth=3, random_state=n).fit(rows, real)
        for n in range(2)
    ]
    mean = np.mean([model.decision_function(rows) for model in models], axis=0)
    trees = from_scikit(models)
    assert np.allclose(trees.log_odds(rows), mean)
    Judge(trees, np.arange(8.0)).save(tmp_path / "judge.npz")
    stored = load_judge(tmp_path / "judge.npz")
    assert np.allclose(stored.trees.log_odds(rows), mean, atol=1e-4)
    assert (stored.weights == np.arange(8.0)).all()


def test_the_shipped_judge_fits_the_features():
    judge = shipped_judge()
    assert judge.trees.feature.max() < len(FEATURES)
    one = evidence(np.zeros(1), np.ones(1, dtype=bool), np.zeros(2), np.zeros(1))
    assert len(judge.weights) == 1 + one.shape[1]
    assert judge.weights[-2] < 0.0
    assert judge.weights[-2] + judge.weights[-1] < 0.0
    assert np.isfinite(judge.trees.log_odds(np.ones((3, len(FEATURES))))).all()


def test_candidates_are_believed_less_where_the_take_has_many_as_clear():
    judge, rng = shipped_judge(), np.random.default_rng(0)
    odds = np.concatenate([[1.0], rng.normal(-6.0, 1.0, 400)])
    rougher = np.concatenate([[1.0], rng.normal(-4.0, 1.0, 400)])
    sharp = np.ones(401, dtype=bool)

    def weighed(values):
        levels, uneven = quiet_levels(values, 20.0), np.full(401, -2.0)
        return judge.confidence(evidence(values, sharp, levels, uneven))[0]

    assert weighed(odds) > weighed(rougher)
    assert quiet_levels(odds, 20.0)[0] == np.sort(odds)[-41]
    assert (quiet_levels(np.zeros(0), 20.0) == 0.0).all()


def test_what_is_truly_a_drift_leaves_quiet_behind():
    rng = np.random.default_rng(4)
    bends = np.diff(np.pad(shape_of("sharp", 60), 40), n=2, prepend=0.0, append=0.0)
    shape = split(bends)[0][None]
    noise = 0.02 * rng.standard_normal(shape.shape[2])
    drift, hill = 5.0 * bends, 5.0 * np.roll(bends, 7)
    quieter = []
    for error in (drift + noise, hill + noise):
        parts, weight = split(error)
        seen = Seen(shape, clipped(parts, weight)[None], weight[None])
        score, gain = explained(seen, parts[None], np.array([5.0]))
        quieter.append(float(gain[0]))
        assert score[0] > 0
    assert quieter[0] > quieter[1] + 0.5


def test_a_drift_is_even_beside_its_filling_and_a_hill_is_not(performer):
    spot = Spot(performer.index("LBHD"), 2, 700, 750, "rounded 9")
    seen, shape, wave = performer.present, shape_of("rounded 9", 50), np.sin(np.arange(50) / 3.0)
    drift, hill, tremble = (performer.positions.copy() for _ in range(3))
    drift[700:750, spot.marker, 2] += 10.0 * shape
    hill[700:750, spot.marker, 2] += 10.0 * wave
    tremble[700:750, spot.marker] += 6.0 * wave[:, None] + 10.0 * shape[:, None] * np.eye(3)[2]
    even, hilly, trembling = (unevenness(x, seen, 120.0, spot) for x in (drift, hill, tremble))
    assert even < -2.0
    assert min(hilly, trembling) > even + 1.0
    seen = seen.copy()
    seen[:, np.arange(performer.markers) != spot.marker] = False
    assert unevenness(drift, seen, 120.0, spot) == 0.0


def only(take, labels):
    return Take(take.positions[:, [take.index(label) for label in labels]], labels, take.rate)


@pytest.mark.parametrize(("kind", "length"), [("sharp", 50), ("hann", 50)])
def test_a_drift_is_found_and_named(performer, kind, length):
    # Each marker is searched as long as any other; the clean performance has them all.
    some = only(performer, (*LABELS, *LEFT_ARM))
    take = drifted(some, "LBHD", 2, 700, 20.0 * shape_of(kind, length))
    found = mm.detect(take, method="joint", params=JointParams(jobs=1))
    (a,) = [a for a in found if a.kind is not Kind.GAP]
    assert (a.marker, a.axes, a.kind) == ("LBHD", "z", Kind.SLOW)
    assert abs(a.start - 700) <= 10
    assert abs(a.stop - 700 - length) <= 10
    assert a.amplitude_mm == pytest.approx(20.0, rel=0.3)
    assert "drifts" in a.why


def test_a_clean_performance_does_not_drift(performer):
    # Every second marker: all of the body, in half the time.
    some = only(performer, performer.labels[::2])
    found = mm.detect(some, method="joint", params=JointParams(jobs=1))
    assert [a for a in found if a.kind is Kind.SLOW] == []


def test_several_processes_find_what_one_does(performer, monkeypatch):
    monkeypatch.setattr(slow, "PARALLEL_FROM", 0)
    ramp = 20.0 * shape_of("sharp", 50)
    damaged = drifted(drifted(performer, "LBHD", 2, 700, ramp), "RFHD", 1, 300, ramp)
    chosen = only(damaged, LABELS)
    told: list[list[tuple[float, str]]] = [[], []]

    def find(jobs):
        def note(share, doing):
            told[jobs - 1].append((share, doing))

        params = JointParams(jobs=jobs, sensitivity=0.9)
        return mm.detect(chosen, method="joint", params=params, progress=note)

    one, several = find(1), find(2)
    assert one == several
    assert {a.marker for a in one if a.kind is Kind.SLOW} == {"LBHD", "RFHD"}
    assert told[0] == told[1]
    assert told[0][-1][0] == pytest.approx(1.0)
    assert sum(doing == "slow changes, filled" for _, doing in told[0]) >= 2


@pytest.mark.parametrize("jobs", [1, 2])
def test_filling_can_be_stopped(performer, monkeypatch, jobs):
    monkeypatch.setattr(slow, "PARALLEL_FROM", 0)
    ground = prepare(performer, range(performer.markers), [])
    spots = [Spot(8, 2, start, start + 40, "sharp") for start in range(100, 1300, 100)]
    done = []

    def stop(share, doing):
        done.append(share)
        if len(done) == 2:
            raise Cancelled

    with pytest.raises(Cancelled):
        slow.fill_all(ground, spots, jobs, stop)
    assert len(done) == 2


def test_mending_undoes_steps_and_swaps(performer):
    head, other = performer.index("LFHD"), performer.index("RFHD")
    positions = performer.positions.copy()
    positions[300:360, 4, 1] += 15.0
    positions[600:640, [head, other]] = positions[600:640, [other, head]]
    take = Take(positions, performer.labels, performer.rate)
    sudden = [
        Artifact(take.labels[4], "y", 300, 360, Kind.STEP),
        Artifact("LFHD", "xyz", 600, 640, Kind.STEP, counterpart="RFHD"),
    ]
    ground = prepare(take, range(take.markers), sudden)
    assert np.abs(ground.positions - performer.positions).max() < 1.5
    assert ground.trusted.all()


def test_fast_takes_are_thinned():
    take = simulate_clean(duration_s=4.0, rate=240.0, seed=1, labels=LABELS)
    ground = prepare(take, range(take.markers), [])
    assert ground.thin == 2
    assert len(ground.positions) == take.frames // 2


def test_few_frames_or_markers_are_passed_over():
    short = simulate_clean(duration_s=1.5, seed=1, labels=LABELS)
    few = simulate_clean(duration_s=4.0, seed=1, labels=LABELS[:3])
    for take in (short, few):
        found = mm.detect(take, method="joint", params=JointParams(jobs=1, sensitivity=1.0))
        assert [a for a in found if a.kind is Kind.SLOW] == []


def test_examples_are_seeded_and_of_both_sorts():
    take = simulate_clean(duration_s=4.0, seed=3, labels=LABELS)
    first, again = (examples_of(take, (), rounds=1, seed=1) for _ in range(2))
    assert np.array_equal(first.features, again.features)
    assert np.array_equal(first.drawn, again.drawn)
    assert first.features.shape == (len(first.real), len(FEATURES))
    assert 0 < first.real.sum() < len(first.real)
    assert first.drift.max() < len(first.drawn)
    assert len(first.spots) == len(first.copy) == len(first.real)
    spot = first.spots[int(np.flatnonzero(first.real)[0])]
    track = first.tracks[first.copy[first.real][0]]
    off = np.abs(track - first.ground.positions[:, spot.marker]).max(axis=1)
    assert (off[spot.start : spot.stop] > 0.5).mean() > 0.4


def test_a_marker_without_a_body_has_no_candidates():
    positions = np.full((600, 5, 3), np.nan)
    positions[:, 0] = np.cumsum(np.ones((600, 3)), axis=0)
    known = ~np.isnan(positions)
    seen = known.all(axis=2)
    assert len(scan(positions, 0, known[:, 0], seen, distance_spreads(positions, seen))) == 0


def test_the_ceiling_rises_with_size_and_sinks_with_round_kinks():
    from markermend.bench.ceiling import ceiling_table, slow_ceiling
    from markermend.bench.e1 import Clean

    take = simulate_clean(duration_s=6.0, rate=120.0, seed=2, labels=LABELS)
    sharp, *_, hann = found = slow_ceiling(Clean("one", take), seed=1)
    assert found == slow_ceiling(Clean("one", take), seed=1)
    assert list(sharp.shares) == sorted(sharp.shares)
    assert 0.0 < hann.shares[0] < sharp.shares[0] <= 1.0
    assert "hann" in ceiling_table(found)[-1]
    few = Take(take.positions[:, :3], take.labels[:3], take.rate)
    assert slow_ceiling(Clean("few", few)) == []


def test_what_a_body_leaves_swings_less_on_a_calm_take():
    from markermend.bench.e1 import Clean
    from markermend.bench.unrest import swings, unrest, unrest_figure, unrest_table

    take = simulate_clean(duration_s=6.0, rate=120.0, seed=2, labels=LABELS)
    calm = unrest(Clean("calm", take))
    assert calm is not None
    rng = np.random.default_rng(1)
    shaken = Take(take.positions + rng.normal(0.0, 4.0, take.positions.shape), take.labels, 120.0)
    wild = unrest(Clean("wild", shaken))
    assert wild is not None
    assert calm.median_mm < 10.0 < wild.median_mm
    assert calm.share < 0.5 < wild.share
    assert "wild" in unrest_table([calm, wild])[-1]
    assert unrest_figure(calm).count("<path") > 6
    known = np.where(np.arange(60) == 5, 7.0, 0.0)[:, None]
    assert swings(known)[:, 0].tolist() == [7.0] * 6 + [0.0] * 5
    few = Take(take.positions[:, :3], take.labels[:3], take.rate)
    assert unrest(Clean("few", few)) is None
