"""How far a few frames of a marker are from where the rest of its body puts them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.predictors.local import predict_local
from markermend.take import Take

AROUND_S = 0.25
"""What is seen of the marker so long before and after says how well the body tells its place."""
LEARNT_S = 5.0
"""Enough motion before and after to learn from; all of a long take would cost too much."""
DUST_MM = 1.0
"""Added to that: on simulated bodies the prediction is sometimes better than any real one."""


@dataclass(frozen=True)
class Beside:
    """Deviation from the body's prediction.

    Attributes
    ----------
    deviation : (frames, 3) mm, measured less predicted; NaN where either is missing
    usual_mm : distance that is usual around, its 90th percentile
    """

    deviation: FloatArray
    usual_mm: float

    @property
    def size_mm(self) -> float:
        """Largest distance; NaN when nothing is known."""
        away = np.linalg.norm(self.deviation, axis=1)
        return float(np.nanmax(away)) if np.isfinite(away).any() else np.nan


def beside_body(
    take: Take, marker: int, start: int, stop: int, trusted: BoolArray
) -> Beside | None:
    """Compare an interval of one marker with the prediction from its neighbours.

    Parameters
    ----------
    take : the recording
    marker : column
    start, stop : half-open interval
    trusted : (frames, markers) bool, samples to be believed; the marker's own in the interval and
        around are not learned from

    Returns
    -------
    None when the body tells nothing, or the marker is not seen around
    """
    around = round(AROUND_S * take.rate)
    own = np.flatnonzero(trusted[:, marker])
    before, after = own[own < start][-around:], own[own >= stop][:around]
    first = int(before[0]) if len(before) else start
    last = int(after[-1]) + 1 if len(after) else stop
    learnt = round(LEARNT_S * take.rate)
    rows = slice(max(0, first - learnt), last + learnt)
    predicted = predict_local(
        take.positions[rows],
        marker,
        start=first - rows.start,
        stop=last - rows.start,
        trusted=trusted[rows],
    )
    deviation = take.positions[first:last, marker] - predicted
    near = np.linalg.norm(deviation[np.concatenate([before, after]) - first], axis=1)
    near = near[np.isfinite(near)]
    inside = deviation[start - first : stop - first]
    if len(near) < around // 2 or not np.isfinite(inside).any():
        return None
    return Beside(inside, float(np.quantile(near, 0.9)) + DUST_MM)


def belief(ratio: float, half: float) -> float:
    """Confidence that grows with a ratio: one half at ``half``, 0.8 at twice that."""
    return float(ratio**2 / (ratio**2 + half**2))
