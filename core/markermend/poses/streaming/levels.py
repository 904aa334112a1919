"""Where hidden parts of a pose are when visible ones are where they are, learnt as poses come."""

from __future__ import annotations

import numpy as np

from markermend.arrays import FloatArray, IntArray
from markermend.poses.filling.covariance import Moments
from markermend.poses.solving import Regression, average_in
from markermend.poses.streaming.joining import JOINING, Kept, widened, widened_mean

# Poses that others' recordings count for, and most that count at all.
_OTHERS, _MEMORY = 100.0, 3000.0
# Added to variances; features are of the size of one.
_RIDGE = 0.01
# A hidden joint stays as far from where it is expected as it was when it went for about this long,
# and is drawn there in this time.
_LASTS_S, _DRAWN_S = 1.0, 0.3


class Levels:
    """Draws hidden columns to where visible ones tell that they are.

    Movement that is added up strays from the truth with time; where a limb is does not.

    Parameters
    ----------
    first : (columns,) a whole pose
    others : of the same columns in others' recordings
    rate : poses per second
    """

    def __init__(self, first: FloatArray, others: Moments | None, rate: float) -> None:
        columns = len(first)
        self._mean, self._weight = first.copy(), 1.0
        self._covariance = np.zeros((columns, columns))
        if others is not None:
            self._mean, self._weight = others.mean.copy(), _OTHERS
            self._covariance = np.array(others.whole, order="C")
        self._hidden: IntArray = np.empty(0, dtype=int)
        self.come_at(rate)

    def come_at(self, rate: float) -> None:
        """So many poses a second come from now on."""
        self._fading = np.exp(-1.0 / (_LASTS_S * rate))
        self._staying = np.exp(-1.0 / (_DRAWN_S * rate))

    def go_on(self, before: Levels, kept: Kept) -> None:
        """Take over what was learnt of some columns."""
        usual = self._covariance
        self._mean = widened_mean(before._mean, self._mean, usual, kept, _RIDGE)
        self._covariance = widened(before._covariance, usual, kept, _RIDGE)
        self._weight = min(before._weight, max(self._weight, JOINING))

    def learn(self, values: FloatArray) -> None:
        """Add a pose."""
        self._weight = min(self._weight + 1.0, _MEMORY)
        away = values - self._mean
        self._mean += away / self._weight
        average_in(self._covariance, away[None], 1.0 / self._weight)

    def begin(self, hidden: IntArray, visible: IntArray, before: FloatArray) -> None:
        """Say which columns are hidden from now on.

        Parameters
        ----------
        hidden, visible : columns
        before : (columns,) the last pose until then
        """
        self._hidden, self._visible = hidden, visible
        self._others_tell = Regression(self._covariance, hidden, visible, _RIDGE)
        self._away = before[hidden] - self._expected(before)

    def draw(self, values: FloatArray, steps: float = 1.0) -> None:
        """Draw the hidden columns of a pose, in place, to where they are expected.

        Parameters
        ----------
        values : (columns,)
        steps : poses from the last to this one; those between did not come
        """
        self._away *= self._fading**steps
        there = self._expected(values) + self._away
        share = 1.0 - self._staying**steps
        values[self._hidden] += share * (there - values[self._hidden])

    def _expected(self, values: FloatArray) -> FloatArray:
        """(hidden,) what the visible columns tell."""
        told = self._others_tell.tell(values[self._visible] - self._mean[self._visible])
        return np.asarray(self._mean[self._hidden] + told)
