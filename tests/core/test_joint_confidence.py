"""How sure the joint detector is of sudden artifacts, and how that is learnt."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.artifact import Kind
from markermend.detectors.joint.confidence import Curve, confidences, shipped_curves
from markermend.detectors.joint.sudden import Sudden
from markermend.detectors.joint.training import PENALTY, RARER, collect, fit_curve, fit_curves
from markermend.errors import DataError
from markermend.simulation import contaminate, simulate_clean


def test_confidence_grows_with_score_and_falls_with_moving_neighbours():
    def one(**changes):
        values = {"size_mm": 3.0, "score": 8.0, "beside_mm": 0.1} | changes
        return Sudden(0, 10, 12, Kind.PEAK, **values)

    base, clearer, shared = confidences([one(), one(score=16.0), one(beside_mm=6.0)])
    assert shared < base < clearer <= 1.0
    assert set(shipped_curves()) == {Kind.PEAK, Kind.NOISE, Kind.STEP}


def test_curves_agree_with_scikit_learn():
    from sklearn.linear_model import LogisticRegression

    rng = np.random.default_rng(0)
    measured = rng.standard_normal((400, 4))
    real = measured[:, 0] + 0.5 * rng.standard_normal(400) > 0
    curve = fit_curve(measured, real)
    model = LogisticRegression(C=1 / PENALTY, max_iter=1000).fit(measured, real)
    ours = curve.bias + measured @ np.array(curve.weights) + np.log(RARER)
    assert np.allclose(ours, model.decision_function(measured))
    with pytest.raises(DataError):
        fit_curve(measured, np.ones(400, dtype=bool))


def test_training_is_seeded():
    # Damage that nobody tells of is what false flags are learned from.
    take, _ = contaminate(
        simulate_clean(duration_s=8.0, seed=7), share=0.2, amplitude_mm=4.0, seed=1
    )
    first, again = (fit_curves(collect([(take, ())], rounds=1, seed=2)) for _ in range(2))
    assert first == again
    assert isinstance(first[Kind.PEAK], Curve)
