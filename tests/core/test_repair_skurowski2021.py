"""The small networks and the low rank: counts, gradients, exactness, missing inputs, time."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from gaps import gap, hide
from recordings import read_named

from markermend.arrays import BoolArray, FloatArray
from markermend.bench.gaps import GapRow, read_cases, replay, summarise
from markermend.mesh import Group, Mesh
from markermend.repairs import evidence_for, propose
from markermend.repairs.skurowski2021.low_rank import choose_rank, complete
from markermend.repairs.skurowski2021.network import Network, Training, glorot, gradient, train
from markermend.repairs.skurowski2021.regression import input_vectors, neighbours
from markermend.take import Take

BENCH = Path(__file__).resolve().parents[3] / "shared" / "bench" / "gaps-dev.json"
NETWORKS = ["ffnn_lin", "ffnn_tanh"]


def waves(frames: int, columns: int, seed: int = 0) -> FloatArray:
    """Smooth signals of a few mm to a few hundred mm."""
    rng = np.random.default_rng(seed)
    t = np.arange(frames)[:, None] / 100.0
    return 100 * np.sin(rng.uniform(1, 6, columns) * t + rng.uniform(0, 6, columns))


def body(frames: int = 800, markers: int = 6, seed: int = 0) -> Take:
    """Markers that share three movements and little else."""
    rng = np.random.default_rng(seed)
    shared = waves(frames, 3, seed)[:, None] + rng.normal(size=(markers, 3)) * 150
    own = (waves(frames, 3, seed + 1) @ rng.normal(size=(3, markers * 3))) * 0.05
    positions = shared + own.reshape(frames, markers, 3)
    return Take(positions, tuple(f"M{i}" for i in range(markers)), 100.0)


def test_thirty_inputs_make_275_parameters() -> None:
    assert glorot(30, 3, tanh=True, seed=0).parameters == 275


def test_inputs_are_in_the_papers_order() -> None:
    values = np.arange(2 * 2 * 3, dtype=float).reshape(2, 2, 3)
    rows = input_vectors(values)
    assert rows[1].tolist() == [6, 7, 8, 0, 1, 2, 9, 10, 11, 3, 4, 5]
    assert rows[0].tolist() == [0, 1, 2, 0, 1, 2, 3, 4, 5, 3, 4, 5]


@pytest.mark.parametrize("tanh", [False, True])
def test_gradient_is_that_of_half_the_mean_squared_error(tanh: bool) -> None:
    rng = np.random.default_rng(3)
    inputs, targets = rng.normal(size=(40, 5)), rng.normal(size=(40, 3))
    network = glorot(5, 3, tanh=tanh, seed=1)
    weights = [network.first, network.first_bias, network.second, network.second_bias]

    def error(changed: list[FloatArray]) -> float:
        one, two, three, four = changed
        miss = Network(one, two, three, four, tanh)(inputs) - targets
        return float(np.sum(miss**2) / 2 / len(targets))

    for i, slope in enumerate(gradient(network, inputs, targets)):
        place = tuple(0 for _ in weights[i].shape)
        up, down = [w.copy() for w in weights], [w.copy() for w in weights]
        up[i][place] += 1e-6
        down[i][place] -= 1e-6
        assert slope[place] == pytest.approx((error(up) - error(down)) / 2e-6, abs=1e-6)


def test_steps_have_momentum_a_falling_rate_and_a_limited_gradient() -> None:
    zero = np.zeros((1, 1))
    still = Network(zero, np.zeros(1), zero, np.zeros(1), tanh=False)
    far, near = np.full((4, 1), 100.0), np.full((4, 1), 0.1)
    inputs = np.zeros((4, 1))
    first = train(still, inputs, far, Training(epochs=1)).second_bias[0]
    assert first == pytest.approx(0.01 * 0.7)
    assert train(still, inputs, near, Training(epochs=1)).second_bias[0] == pytest.approx(0.001)
    second = train(still, inputs, far, Training(epochs=2)).second_bias[0]
    assert second == pytest.approx(first + 0.8 * first + 0.01 * 0.7)
    plain = Training(epochs=20, momentum=0.0)
    fallen = train(still, inputs, far, plain).second_bias[0]
    assert fallen == pytest.approx(10 * 0.007 + 10 * 0.007 * 0.9)


def test_training_learns_a_linear_relation() -> None:
    rng = np.random.default_rng(0)
    inputs = rng.normal(size=(500, 4))
    targets = inputs @ rng.normal(size=(4, 3)) / 2
    learnt = train(glorot(4, 3, tanh=False, seed=0), inputs, targets)
    assert np.mean((learnt(inputs) - targets) ** 2) < 0.02 * np.mean(targets**2)


@pytest.mark.parametrize("name", NETWORKS)
def test_the_seed_decides_alone(name: str) -> None:
    take, artifact = hide(body(), "M2", 300, 340), gap("M2", 300, 340)
    one = propose(take, artifact, method=name).patches[0].values
    again = propose(take, artifact, method=name).patches[0].values
    other = propose(take, artifact, method=name, params={"seed": 1}).patches[0].values
    assert np.array_equal(one, again)
    assert not np.allclose(one, other)


@pytest.mark.parametrize("name", NETWORKS)
def test_a_network_predicts_far_better_than_the_mean(name: str) -> None:
    truth = body()
    done = propose(hide(truth, "M2", 300, 400), gap("M2", 300, 400), method=name)
    miss = np.linalg.norm(done.patches[0].values - truth.positions[300:400, 2], axis=1).mean()
    moved = truth.positions[:, 2] - truth.positions[:, 2].mean(axis=0)
    assert miss < 0.4 * np.linalg.norm(moved, axis=1).mean()


@pytest.mark.parametrize("name", [*NETWORKS, "msvd"])
def test_joining_meets_both_borders(name: str) -> None:
    truth = body()
    done = propose(
        hide(truth, "M2", 300, 400), gap("M2", 300, 400), method=name, params={"join": True}
    )
    whole = truth.positions[290:410, 2].copy()
    usual = np.abs(np.diff(whole, n=2, axis=0)).max()
    whole[10:110] = done.patches[0].values
    assert np.abs(np.diff(whole, n=2, axis=0)).max() < 4 * usual + 0.1


def test_parent_comes_first_and_absent_siblings_are_no_inputs() -> None:
    take = body(markers=7)
    mesh = Mesh(
        take.labels,
        (Group("A", "", (0, 1)), Group("B", "", (2, 3, 4, 5), parent=0, parent_marker=1)),
    )
    artifact = gap("M2", 300, 340)
    assert neighbours(evidence_for(take, mesh=mesh), artifact) == (1, 3, 4, 5)
    without = evidence_for(hide(take, "M4", 310, 340), mesh=mesh)
    assert neighbours(without, artifact) == (1, 3, 5)
    briefly = evidence_for(hide(take, "M4", 310, 320), mesh=mesh)
    assert neighbours(briefly, artifact) == (1, 3, 4, 5)
    lonely = evidence_for(hide(hide(take, "M3", 290, 350), "M4", 290, 350), mesh=mesh)
    assert len(neighbours(lonely, artifact)) == 3
    assert neighbours(lonely, artifact)[:2] == (1, 5)


@pytest.mark.parametrize("name", [*NETWORKS, "msvd"])
def test_a_take_that_says_too_little_is_refused_with_the_reason(name: str) -> None:
    take = body(frames=90)
    done = propose(hide(take, "M2", 10, 70), gap("M2", 10, 70), method=name)
    assert not done.patches
    assert "50" in done.reason


def lowly(frames: int, columns: int, rank: int, seed: int = 0) -> FloatArray:
    rng = np.random.default_rng(seed)
    return rng.normal(size=(frames, rank)) @ rng.normal(size=(rank, columns)) * 50


def test_a_matrix_of_low_rank_is_completed_exactly() -> None:
    matrix = lowly(400, 24, 5)
    known: BoolArray = np.ones(matrix.shape, dtype=bool)
    known[100:160, 3:6] = False
    known[140:200, 9:12] = False
    guess = np.where(known, matrix, 0.0)
    completed, _, basis = complete(guess, known, 5)
    assert np.abs(completed - matrix).max() < 0.5
    assert np.array_equal(completed[known], matrix[known])
    assert np.allclose(basis.T @ basis, np.eye(5))


def test_the_rank_is_found_by_hiding() -> None:
    rng = np.random.default_rng(1)
    matrix = lowly(600, 30, 6) + rng.normal(size=(600, 30))
    judged = np.arange(30) < 3
    assert choose_rank(matrix, judged, judged) == 6


def test_low_rank_recovers_what_is_low_rank_and_beats_the_line_it_starts_from() -> None:
    truth = Take(lowly(700, 24, 4).reshape(700, 8, 3), tuple("ABCDEFGH"), 100.0)
    for start, stop in ((0, 60), (300, 400), (650, 700)):
        done = propose(hide(truth, "C", start, stop), gap("C", start, stop), method="msvd")
        assert np.abs(done.patches[0].values - truth.positions[start:stop, 2]).max() < 1.0


@pytest.fixture(scope="module")
def replayed(shared_data: Path) -> dict[tuple[int, str], GapRow]:
    if not BENCH.is_file():
        pytest.skip(f"the gap list is not here ({BENCH})")
    cases = [c for c in read_cases(BENCH) if c.protocol == "skurowski2021"]
    cases = [c for c in cases if c.length in (10, 100)][::18]
    takes = {n: read_named(n, shared_data) for n in {c.take for c in cases}}
    methods = ["ffnn_lin", "ffnn_tanh", "spline", "makima", "pchip", "linear"]
    return {(r.length, r.method): r for r in summarise(replay(cases, takes, methods))}


def test_the_papers_order_holds_on_other_takes(
    replayed: dict[tuple[int, str], GapRow],
) -> None:
    for length in (10, 100):
        assert replayed[length, "ffnn_lin"].error_mm < replayed[length, "ffnn_tanh"].error_mm
    assert replayed[10, "spline"].error_mm < replayed[10, "ffnn_lin"].error_mm
    for other in ("spline", "makima", "pchip", "linear"):
        assert replayed[100, "ffnn_lin"].error_mm < replayed[100, other].error_mm
