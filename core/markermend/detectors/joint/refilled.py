"""How unlike a drift a possible one is, beside its frames as filled from the body.

The search foretells a marker all through the take by one fit, which knows nothing of the moment.
A repair knows the marker's way in and out as well, and comes much nearer. What a drift differs by
from such a filling has the drift's shape and is little else; what a hill differs by, which is
movement that the body does not tell, is uneven, and so on all axes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.artifact import Artifact, Kind
from markermend.detectors.joint.bank import shape_of
from markermend.take import AXES, Take

_DUST, _DUST_MM = 0.05, 0.5
"""What cameras leave of the evenest drift: less says nothing."""


@dataclass(frozen=True)
class Spot:
    """Where a slow change may be, and which shape of the bank it has."""

    marker: int
    axis: int
    start: int
    stop: int
    kind: str


def unevenness(positions: FloatArray, trusted: BoolArray, rate: float, spot: Spot) -> float:
    """Hide a possible slow change, fill it by local regression, and look at the difference.

    Parameters
    ----------
    positions : (frames, markers, 3) mm; NaN = missing
    trusted : (frames, markers) bool, samples that may be learned from
    rate : frames per second
    spot : where to look

    Returns
    -------
    Logarithm of what the shape, fitted to each axis, leaves unexplained on its axis and on the
    worse of the others, over its height and the deviation that the filling expects of itself;
    0 where nothing can be filled
    """
    # Repairs look again with the detector that this is a part of.
    from markermend.repairs.local_regression import LocalRegressionParams, repair_local_regression
    from markermend.repairs.registry import Evidence

    frames, markers = trusted.shape
    first, last = max(spot.start - 1, 0), min(spot.stop + 1, frames)
    take = Take(positions, tuple(f"{m}" for m in range(markers)), rate)
    seen = np.repeat((trusted & take.present)[:, :, None], 3, axis=2)
    hidden = Artifact(take.labels[spot.marker], AXES, first, last, Kind.SLOW)
    filled = repair_local_regression(Evidence(take, seen), hidden, LocalRegressionParams())
    if not filled.patches or filled.band_mm is None:
        return 0.0
    off = positions[first:last, spot.marker] - filled.patches[0].values
    shape = np.zeros(last - first)
    inner = slice(spot.start - first, min(spot.stop, frames) - first)
    shape[inner] = shape_of(spot.kind, spot.stop - spot.start)[: frames - spot.start]
    height = shape @ off / (shape @ shape)
    expected = shape @ filled.band_mm / (shape @ shape)
    rest = np.sqrt(np.mean((off - shape[:, None] * height) ** 2, axis=0))
    uneven = np.hypot(rest[spot.axis], np.delete(rest, spot.axis).max())
    return float(np.log(uneven / (abs(height[spot.axis]) + expected + _DUST_MM) + _DUST))
