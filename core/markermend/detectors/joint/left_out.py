"""How well curves hold on a take they were not fitted to."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.artifact import Kind
from markermend.detectors.joint.training import KINDS, RARER, Examples, fit_curve


@dataclass(frozen=True)
class LeftOut:
    """One class of one take, judged by curves fitted to all others.

    Attributes
    ----------
    take : position of the take
    kind : class
    flags, real : how many, and how many of them real
    error : calibration error, the mean over deciles of |mean confidence − share of real flags|
        weighted by flags, with the odds of training; NaN without flags, or where the others hold
        no false or no real one to learn from
    area : share of pairs of a real and a false flag in which the real one is believed more
        (area under the receiver operating curve); NaN without both
    """

    take: int
    kind: Kind
    flags: int
    real: int
    error: float
    area: float


def leave_one_out(takes: Sequence[Mapping[Kind, Examples]]) -> list[LeftOut]:
    """Judge the examples of each take by curves fitted to the others.

    Parameters
    ----------
    takes : examples by class, from :func:`markermend.detectors.joint.training.collect`; at
        least two
    """
    rows = []
    for i, own in enumerate(takes):
        for kind in KINDS:
            others = [take[kind] for k, take in enumerate(takes) if k != i]
            measured, real = own[kind].measured, own[kind].real
            error, area = _judge(others, measured, real)
            rows.append(LeftOut(i, kind, len(real), int(real.sum()), error, area))
    return rows


def _judge(
    others: Sequence[Examples], measured: FloatArray, real: BoolArray
) -> tuple[float, float]:
    """Calibration error and area under the curve of one class on one take."""
    learnt = np.concatenate([o.real for o in others])
    if learnt.all() or not learnt.any() or not len(real):
        return math.nan, math.nan
    curve = fit_curve(np.concatenate([o.measured for o in others]), learnt)
    logit = curve.bias + math.log(RARER) + measured @ np.array(curve.weights)
    sure = 1.0 / (1.0 + np.exp(-np.clip(logit, -50, 50)))
    decile = np.minimum((10 * sure).astype(int), 9)
    error = float(np.abs(np.bincount(decile, sure - real, minlength=10)).sum() / len(real))
    if real.all() or not real.any():
        return error, math.nan
    from sklearn.metrics import roc_auc_score

    return error, float(roc_auc_score(real, sure))
