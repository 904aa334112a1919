"""How many numbers methods say they learnt, against counts worked out by hand."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.artifact import Artifact, Kind
from markermend.bench.gap_measures import INTERPOLATIONS, measure
from markermend.bench.gap_protocols import METHODS_OF, draw_cases
from markermend.bench.gaps import replay
from markermend.repairs import Repair, propose
from markermend.repairs.dynamics.system import System
from markermend.repairs.tits2018.models import freedom
from markermend.simulation import simulate_clean
from markermend.take import Take

MARKERS = 12


@pytest.fixture(scope="module")
def body() -> Take:
    take = simulate_clean(duration_s=8.0, rate=50.0, seed=3)
    return Take(take.positions[:, :MARKERS], take.labels[:MARKERS], take.rate)


def filled(body: Take, method: str, **params: object) -> Repair:
    positions = body.positions.copy()
    positions[200:230, 4] = np.nan
    gap = Artifact(body.labels[4], "xyz", 200, 230, Kind.GAP)
    take = Take(positions, body.labels, body.rate)
    return propose(take, gap, method=method, params=params)


def test_a_regression_learns_a_coefficient_for_each_input_and_coordinate(body: Take) -> None:
    # Three inputs, their squares and products, and an intercept, for three coordinates.
    assert filled(body, "lpr").weights == 30
    # An intercept and three coordinates of each of the markers that are near enough.
    inputs = filled(body, "glr").weights // 3 - 1
    assert inputs % 3 == 0
    assert 3 <= inputs <= 3 * (MARKERS - 1)


def test_an_average_learns_what_its_models_learn(body: Take) -> None:
    parts = [filled(body, name).weights for name in ("lpr", "lgrnn", "glr", "pca")]
    assert filled(body, "pma").weights == sum(parts)
    assert filled(body, "pma_no_pca").weights == sum(parts[:3])
    assert filled(body, "li").weights == 0


def test_a_low_rank_learns_a_mean_and_components(body: Take) -> None:
    assert filled(body, "msvd", rank=4).weights == 3 * MARKERS * 5


def test_a_system_learns_its_matrices() -> None:
    h, d = 2, 5
    square, row = np.zeros((h, h)), np.zeros(d)
    system = System(square, square, np.zeros((d, h)), row, np.zeros(h), square)
    assert system.parameters == 4 + 3 + 10 + 5 + 2 + 3


def test_lengths_of_bones_are_learnt_too(body: Take) -> None:
    plain, held = (filled(body, name, rounds=1).weights for name in ("dynammo", "bolero"))
    assert held > plain
    assert (held - plain) % 2 == 0


def test_a_kernel_learns_as_many_numbers_as_it_can_tell_rows_apart() -> None:
    rng = np.random.default_rng(0)
    far = rng.normal(size=(60, 30)) * 10
    assert freedom(far) == pytest.approx(180, abs=1)
    assert freedom(np.zeros((60, 3))) == 3


def test_a_process_learns_less_than_one_number_a_sample(body: Take) -> None:
    assert 3 * 10 < filled(body, "local_regression").weights < 3 * body.frames


def test_no_method_of_the_papers_lacks_its_criteria(body: Take) -> None:
    names = [
        n for names in METHODS_OF.values() for n in names if n not in ("lstm", "gru", "bilstm")
    ]
    cases = draw_cases({"body": body}, "skurowski2021", simulations=1, seed=1)[1:2]
    params = {n: {"epochs": 5} for n in ("ffnn_lin", "ffnn_tanh")} | {"bolero": {"rounds": 1}}
    measures = measure(replay(cases, {"body": body}, [*names, "auto"], params=params))
    assert {m.method for m in measures} == {*names, "auto"}
    assert all(np.isfinite([m.aic, m.bic]).all() for m in measures)
    assert all(m.aic < m.bic for m in measures if m.method not in INTERPOLATIONS)
