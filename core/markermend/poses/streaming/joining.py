"""Go on with what was learnt of some columns when others join them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.arrays import FloatArray, IntArray
from markermend.poses.solving import add_to_diagonal, part_of, solved

JOINING = 30.0
"""Poses that what was learnt counts for at most when a joint joins; more would keep those that join
from being learnt of."""


@dataclass(frozen=True, eq=False)
class Kept:
    """Columns that go on.

    Attributes
    ----------
    now, before : (n,) their places
    """

    now: IntArray
    before: IntArray

    def beside(self, count: int) -> IntArray:
        """Of so many columns now those that join."""
        return np.setdiff1d(np.arange(count), self.now)


def widened(learnt: FloatArray, usual: FloatArray, kept: Kept, more: float) -> FloatArray:
    """Covariance of columns of which some join: these go with the others as is usual.

    Parameters
    ----------
    learnt : (n, n) of the columns before
    usual : (k, k) of the columns now, in other bodies; 0 where nothing is known
    kept : columns that are in both
    more : added to the variances of what tells

    Returns
    -------
    (k, k) positive semidefinite where both are, in C order
    """
    new = kept.beside(len(usual))
    weights, own = _weights(usual, kept, more), part_of(learnt, kept.before, kept.before)
    away = own - part_of(usual, kept.now, kept.now)
    wide = np.array(usual, order="C")
    wide[np.ix_(kept.now, kept.now)] = own
    wide[np.ix_(kept.now, new)] = own @ weights
    wide[np.ix_(new, kept.now)] = (own @ weights).T
    wide[np.ix_(new, new)] += weights.T @ away @ weights
    return wide


def widened_mean(
    learnt: FloatArray, mean: FloatArray, usual: FloatArray, kept: Kept, more: float
) -> FloatArray:
    """Mean of columns of which some join: as usual where the others are as they are.

    Parameters
    ----------
    learnt : (n,) of the columns before
    mean, usual : (k,) and (k, k) mean and covariance of the columns now, in other bodies
    kept, more : as of :func:`widened`
    """
    wide = mean.copy()
    wide[kept.now] = learnt[kept.before]
    away = wide[kept.now] - mean[kept.now]
    wide[kept.beside(len(mean))] += away @ _weights(usual, kept, more)
    return wide


def _weights(usual: FloatArray, kept: Kept, more: float) -> FloatArray:
    """(kept, joining) what kept columns usually tell of those that join."""
    among = part_of(usual, kept.now, kept.now)
    add_to_diagonal(among, more)
    return np.asarray(solved(among, part_of(usual, kept.now, kept.beside(len(usual)))))
