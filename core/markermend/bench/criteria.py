"""Information criteria: an error weighed against the numbers that were learnt for it."""

from __future__ import annotations

import math


def aic(samples: int, mse: float, weights: float) -> float:
    """Akaike's information criterion (skurowski2021, eq. 18).

    Parameters
    ----------
    samples : coordinates tested
    mse : mean squared error, mm²
    weights : numbers that were learnt
    """
    return _misfit(samples, mse) + 2.0 * weights


def bic(samples: int, mse: float, weights: float) -> float:
    """Bayesian information criterion (skurowski2021, eq. 17); arguments as for :func:`aic`."""
    return _misfit(samples, mse) + weights * math.log(max(samples, 1))


def _misfit(samples: int, mse: float) -> float:
    """What both have in common; an error of nothing is infinitely good."""
    if mse > 0.0:
        return samples * math.log(mse)
    return float("nan") if math.isnan(mse) else -math.inf
