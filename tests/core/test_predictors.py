"""Loose predictors: from the body, not from the marker's own present."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.errors import DataError
from markermend.mesh import Group, Mesh
from markermend.predictors.bridging import bridge
from markermend.predictors.ffnn import FfnnParams, predict_ffnn
from markermend.predictors.inputs import distance_spread, lagged_powers, neighbours_of
from markermend.predictors.polynomial import predict_polynomial
from markermend.take import Take

RATE = 100.0


@pytest.fixture
def body() -> Take:
    """Five markers of a rigid body that turns and walks, and a sixth on its own way."""
    rng = np.random.default_rng(11)
    t = np.arange(1200) / RATE
    shape = np.array([[0, 0, 0], [200, 0, 0], [0, 300, 0], [0, 0, 250], [180, 120, 60]], float)
    turn = 0.8 * np.sin(1.1 * t)
    c, s, zero, one = np.cos(turn), np.sin(turn), np.zeros_like(t), np.ones_like(t)
    yaw = np.stack([c, -s, zero, s, c, zero, zero, zero, one], axis=1).reshape(-1, 3, 3)
    walk = np.stack([1500 * np.sin(0.5 * t), 900 * np.cos(0.4 * t), 900 + 20 * np.sin(3 * t)], 1)
    x = np.einsum("fij,mj->fmi", yaw, shape) + walk[:, None]
    own = np.stack([3000 * np.sin(0.9 * t), 100 * t, 50 * np.cos(2 * t)], axis=1)
    x = np.concatenate([x, own[:, None]], axis=1) + rng.normal(0, 0.1, (len(t), 6, 3))
    return Take(x, tuple("ABCDEF"), RATE)


@pytest.fixture
def mesh(body: Take) -> Mesh:
    return Mesh(body.labels, (Group("body", "", (0, 1, 2, 3, 4)), Group("else", "", (5,))))


def error(take: Take, predicted: np.ndarray, marker: int) -> float:
    return float(np.sqrt(np.nanmean((predicted - take.positions[:, marker]) ** 2)))


def test_neighbours_are_parent_and_siblings(body: Take) -> None:
    tree = Mesh(
        body.labels,
        (Group("root", "", (0, 1, 2)), Group("limb", "", (3, 4, 5), 0, parent_marker=1)),
    )
    assert neighbours_of(body, tree, 3) == (1, 4, 5)


def test_lonely_markers_get_the_steadiest_company(body: Take, mesh: Mesh) -> None:
    alone = Mesh(body.labels, (Group("one", "", (0,)), Group("rest", "", (1, 2, 3, 4, 5))))
    assert set(neighbours_of(body, alone, 0)) <= {1, 2, 3, 4}
    spread = distance_spread(body.positions, 0, [1, 2, 3, 4, 5])
    assert spread[:4].max() < 1 < spread[4]


def test_company_stays_within_the_subject(body: Take) -> None:
    take = Take(body.positions, ("P:A", "P:B", "Q:C", "Q:D", "Q:E", "*6"), RATE)
    empty = Mesh(take.labels, ())
    assert neighbours_of(take, empty, 0) == (1,)
    alone = Take(body.positions[:, :2], ("P:A", "Q:B"), RATE)
    with pytest.raises(DataError, match="P:A"):
        neighbours_of(alone, Mesh(alone.labels, ()), 0)


def test_design_holds_lags_and_powers() -> None:
    x = np.random.default_rng(0).normal(5, 2, (50, 4))
    design = lagged_powers(x, 3, 4)
    assert design.shape == (50, 4 * 4 * 4)
    np.testing.assert_allclose(design.mean(axis=0), 0, atol=1e-12)
    np.testing.assert_allclose(design.std(axis=0), 1)
    one_later = np.corrcoef(design[1:, 4], x[:-1, 0])[0, 1]
    assert one_later > 0.999
    assert (lagged_powers(np.full((10, 1), 3.0), 0, 2) == 0).all()


def test_polynomial_predicts_a_rigid_body(body: Take, mesh: Mesh) -> None:
    predicted = predict_polynomial(body, mesh, 2)
    assert predicted.shape == (1200, 3)
    assert error(body, predicted, 2) < 1.0


def test_polynomial_does_not_follow_what_is_not_trusted(body: Take, mesh: Mesh) -> None:
    x = body.positions.copy()
    x[500:560, 2] += 80
    trusted = np.ones(x.shape, dtype=bool)
    trusted[500:560, 2] = False
    damaged = Take(x, body.labels, RATE)
    predicted = predict_polynomial(damaged, mesh, 2, k=1, order=2, trusted=trusted)
    np.testing.assert_allclose(predicted[500:560], body.positions[500:560, 2], atol=5)


def test_network_predicts_a_rigid_body_and_ignores_the_untrusted(body: Take, mesh: Mesh) -> None:
    x = body.positions.copy()
    x[500:560, 2] += 80
    trusted = np.ones(x.shape, dtype=bool)
    trusted[500:560, 2] = False
    predicted = predict_ffnn(Take(x, body.labels, RATE), mesh, 2, trusted=trusted)
    assert error(body, predicted, 2) < 3
    np.testing.assert_allclose(predicted[500:560], body.positions[500:560, 2], atol=20)


def test_network_repeats_itself_with_the_same_seed(body: Take, mesh: Mesh) -> None:
    quick = FfnnParams(iterations=20)
    once = predict_ffnn(body, mesh, 1, params=quick, seed=4)
    np.testing.assert_array_equal(once, predict_ffnn(body, mesh, 1, params=quick, seed=4))
    assert (once != predict_ffnn(body, mesh, 1, params=quick, seed=5)).any()


def test_predictions_are_missing_where_most_of_the_body_is(body: Take, mesh: Mesh) -> None:
    x = body.positions.copy()
    x[100:120, [0, 1, 3]] = np.nan
    x[300:320, 0] = np.nan
    x[400:420, 2] = np.nan
    take = Take(x, body.labels, RATE)
    for predicted in (
        predict_polynomial(take, mesh, 2, k=1, order=2),
        predict_ffnn(take, mesh, 2, params=FfnnParams(iterations=30)),
    ):
        assert np.isnan(predicted[100:120]).all()
        assert not np.isnan(np.delete(predicted, np.s_[100:120], axis=0)).any()


def test_too_few_frames_to_learn_from_are_named(body: Take, mesh: Mesh) -> None:
    short = Take(body.positions[:30], body.labels, RATE)
    with pytest.raises(DataError, match="B"):
        predict_ffnn(short, mesh, 1)


def test_bridges_meet_what_is_known() -> None:
    t = np.linspace(0, 6, 400)
    x = 100 * np.sin(t)[:, None]
    known = np.ones_like(x, dtype=bool)
    known[50:60] = known[200:260] = False
    known[:10] = known[390:] = False
    whole = bridge(np.where(known, x, np.nan), known)
    np.testing.assert_array_equal(whole[known], x[known])
    assert np.abs(whole - x)[50:60].max() < 0.01
    assert np.abs(whole - x)[200:260].max() < 5
    assert (whole[:10] == x[10]).all()
    assert (whole[390:] == x[389]).all()


@pytest.mark.parametrize("count", [0, 1, 2, 3])
def test_bridges_from_hardly_anything(count: int) -> None:
    known = np.zeros((20, 1), dtype=bool)
    known[5 : 5 + count] = True
    whole = bridge(np.full((20, 1), 7.0), known)
    assert (whole == (7.0 if count else 0.0)).all()
