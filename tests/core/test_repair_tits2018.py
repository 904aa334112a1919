"""Model averaging: each equation on data whose answer is known, and the original's error."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from recordings import read_named

from markermend.artifact import Artifact, Kind
from markermend.bench.gaps import read_cases, replay, summarise
from markermend.repairs import propose
from markermend.repairs.tits2018.constraints import density, join, keep_distance, weigh
from markermend.repairs.tits2018.local_frame import into, local_axes, out_of, rank_by_spread
from markermend.repairs.tits2018.models import grnn, linear, polynomial, thin
from markermend.repairs.tits2018.pca import reconstruct
from markermend.repairs.tits2018.smoothing import smooth
from markermend.take import Take

BENCH = Path(__file__).resolve().parents[3] / "shared" / "bench" / "gaps-dev.json"
rng = np.random.default_rng(1)


def walk(frames: int, columns: int, seed: int = 0) -> np.ndarray:
    steps = np.random.default_rng(seed).normal(size=(frames, columns)).cumsum(axis=0)
    return smooth(smooth(steps, 31), 31)


def test_references_are_ranked_by_spread_of_distance() -> None:
    own = walk(500, 3)
    near, far = own + np.array([50, 0, 0]), own + np.array([0, 300, 0]) + 5 * walk(500, 3, seed=1)
    positions = np.stack([far, own, near], axis=1)
    ranked, spread = rank_by_spread(positions, 1)
    assert ranked.tolist() == [2, 0]
    distance = np.linalg.norm(far - own, axis=1)
    assert spread[0] == pytest.approx(distance.std(ddof=1))
    assert np.isinf(spread[1])


def test_the_local_system_is_orthonormal_and_goes_both_ways() -> None:
    one, two, three, point = (rng.normal(size=(20, 3)) * 100 for _ in range(4))
    axes = local_axes(one, two, three)
    assert np.allclose(axes.transpose(0, 2, 1) @ axes, np.eye(3), atol=1e-12)
    assert np.allclose(out_of(axes, one, into(axes, one, point)), point)
    assert np.allclose(into(axes, one, two)[:, 1:], 0, atol=1e-9)
    assert np.allclose(into(axes, one, three)[:, 1], 0, atol=1e-9)


def test_regressions_reproduce_what_they_can_express() -> None:
    known, wanted = rng.normal(size=(200, 3)), rng.normal(size=(30, 3))
    weights = rng.normal(size=(3, 3))
    assert np.allclose(linear(known, known @ weights + 5, wanted), wanted @ weights + 5)

    def curved(x: np.ndarray) -> np.ndarray:
        return x**2 @ weights + x[:, :1] * x[:, 1:2] - 3

    assert np.allclose(polynomial(known, curved(known), wanted), curved(wanted))


def test_grnn_stays_between_what_it_has_seen_and_halves_at_its_width() -> None:
    known, target = rng.normal(size=(300, 3)), rng.normal(size=(300, 3))
    far = rng.normal(size=(40, 3)) * 100
    result = grnn(known, target, far)
    assert np.isfinite(result).all()
    assert (result >= target.min(axis=0)).all()
    assert (result <= target.max(axis=0)).all()
    pair = np.array([[-1.0], [1.0]])
    weight = 0.5 ** ((0.7 / 0.3) ** 2), 0.5 ** ((1.3 / 0.3) ** 2)
    expected = weight[0] / sum(weight)
    assert grnn(pair, np.array([[0.0], [1.0]]), np.array([[0.3]]))[0, 0] == pytest.approx(expected)


def test_principal_components_rebuild_a_rigid_combination() -> None:
    base = walk(600, 6)
    mixed = base @ rng.normal(size=(6, 30))
    positions = mixed.reshape(600, 10, 3) + rng.normal(size=(10, 3)) * 100
    truth = positions[200:240, 4].copy()
    positions[200:240, 4] = np.nan
    wanted = np.zeros(600, dtype=bool)
    wanted[200:240] = True
    rebuilt = reconstruct(positions, 4, wanted)
    assert rebuilt is not None
    values, learnt = rebuilt
    assert learnt % 60 == 0
    spread = np.linalg.norm(truth - truth.mean(axis=0), axis=1).mean()
    assert np.linalg.norm(values - truth, axis=1).mean() < 0.5 * spread


@given(
    st.lists(st.floats(-1e3, 1e3), min_size=3, max_size=3),
    st.lists(st.floats(-1e3, 1e3), min_size=3, max_size=3),
    st.integers(1, 40),
)
@settings(max_examples=30, deadline=None)
def test_joining_meets_both_borders_and_bends_nothing(
    before: list[float], after: list[float], length: int
) -> None:
    values = walk(length + 2, 3)
    joined = join(values, np.array(before), np.array(after))
    assert np.allclose(joined[0], before)
    assert np.allclose(joined[-1], after)
    assert np.allclose(np.diff(joined - values, n=2, axis=0), 0, atol=1e-6)
    shifted = join(values, None, np.array(after))
    assert np.allclose(np.diff(shifted - values, axis=0), 0, atol=1e-9)


def test_density_integrates_to_one_and_floors_the_weight() -> None:
    samples = rng.normal(300, 5, size=2000)
    at = np.linspace(200, 400, 4001)
    assert density(samples, at).sum() * (at[1] - at[0]) == pytest.approx(1.0, abs=1e-3)
    assert weigh([np.array([9e3])] * 3, [samples] * 3)[0] == 1e-200


def test_distances_are_brought_into_their_usual_range() -> None:
    usual = [rng.uniform(90, 110, 500) for _ in range(3)]
    references = [np.tile(p, (50, 1)) for p in ([0.0, 0, 0], [30.0, 0, 0], [0, 30.0, 0])]
    values = rng.normal(size=(50, 3)) * 200
    nearest = np.linalg.norm(keep_distance(values, references[:1], usual[:1]), axis=1)
    low, high = np.quantile(usual[0], [0.01, 0.99])
    assert (nearest > low - 1e-9).all()
    assert (nearest < high + 1e-9).all()
    inside = np.tile([60.0, 60.0, 60.0], (50, 1))
    assert np.array_equal(keep_distance(inside, references[:1], usual[:1]), inside)


def test_the_filter_keeps_lines_holes_and_the_samples_beside_them() -> None:
    line = np.arange(60.0)[:, None] * [1.0, -2.0]
    line[20:25] = np.nan
    assert np.allclose(smooth(line, 9), line, equal_nan=True)
    spike = np.zeros((60, 1))
    spike[30] = 100
    assert np.abs(smooth(spike, 9)).max() < 1e-12
    spike[:] = 0
    spike[1] = 100
    assert smooth(spike, 9)[1, 0] == 100


def test_thinning_keeps_enough_rows_in_order() -> None:
    for count in (10, 700, 1999, 2000, 4500):
        rows = thin(np.arange(count), 1000)
        assert (np.diff(rows) > 0).all()
        assert min(count, 1000) <= len(rows) < 2000


@pytest.mark.parametrize(
    "name", ["pma", "pma_all", "pma_no_pca", "li", "lpr", "lgrnn", "glr", "pca"]
)
@pytest.mark.parametrize(("start", "stop"), [(0, 30), (200, 260), (370, 400)])
def test_a_rigid_body_is_recovered_everywhere(name: str, start: int, stop: int) -> None:
    body = rng.normal(size=(6, 3)) * 100
    positions = walk(400, 3)[:, None] * 30 + body
    truth = positions[start:stop, 2].copy()
    positions[start:stop, 2] = np.nan
    take = Take(positions, tuple("ABCDEF"), 120.0)
    done = propose(take, Artifact("C", "xyz", start, stop, Kind.GAP), method=name)
    assert np.abs(done.patches[0].values - truth).max() < (1e-6 if name != "pca" else 30)


def test_references_that_change_during_the_gap_are_taken_in_turn() -> None:
    body = rng.normal(size=(5, 3)) * 100
    truth = walk(400, 3)[:, None] * 30 + body
    positions = truth.copy()
    positions[150:250, 0] = np.nan
    positions[140:200, 1] = np.nan
    positions[200:260, 2] = np.nan
    take = Take(positions, tuple("ABCDE"), 120.0)
    done = propose(take, Artifact("A", "xyz", 150, 250, Kind.GAP), method="lpr")
    assert np.abs(done.patches[0].values - truth[150:250, 0]).max() < 1e-6


def test_error_is_that_of_the_original_code(shared_data: Path) -> None:
    if not BENCH.is_file():
        pytest.skip(f"the gap list is not here ({BENCH})")
    cases = [c for c in read_cases(BENCH) if c.length >= 50 and c.protocol != "pma10"][::16]
    takes = {n: read_named(n, shared_data) for n in {c.take for c in cases}}
    rows = summarise(replay(cases, takes, ["pma"]))
    error = np.mean([r.error_mm for r in rows])
    assert error / np.mean([r.reference_mm for r in rows]) == pytest.approx(1.0, abs=0.15)
