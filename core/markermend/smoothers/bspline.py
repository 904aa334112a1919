"""B-spline curve by least squares, as ardestani2022 proposes it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from markermend.arrays import FloatArray
from markermend.smoothers.registry import Signals, register


@dataclass(frozen=True)
class BsplineParams:
    """How freely the curve follows."""

    control_points: int = field(
        default=100,
        metadata={
            "min": 2,
            "max": 1_000_000,
            "help": "Control points for the whole take; a stretch gets its share",
        },
    )
    degree: int = field(default=3, metadata={"min": 1, "max": 5, "help": "Degree of the pieces"})


@register(
    "bspline",
    label="B-spline",
    summary="Least-squares curve of few control points; derivatives are continuous.",
    params=BsplineParams,
    source="ardestani2022, eq. 1 to 5",
)
def smooth_bspline(signals: Signals, params: Any) -> FloatArray:
    """Fit each stretch by a curve with its share of the control points."""
    frames = len(signals.values)

    def fit(values: FloatArray) -> FloatArray:
        share = round(params.control_points * len(values) / frames)
        return fit_bspline(values, share, params.degree)

    return signals.each_stretch(fit, params.degree + 2)


def fit_bspline(values: FloatArray, control_points: int, degree: int = 3) -> FloatArray:
    """Least-squares B-spline on uniform clamped knots.

    Parameters
    ----------
    values : (n, channels) float64, without NaN
    control_points : kept between degree + 1 and n
    degree : of the pieces

    Returns
    -------
    (n, channels) float64

    Notes
    -----
    ardestani2022, eq. 1 to 5. With more than one control point for two samples, uniform knots make
    the equations so ill-conditioned that the curve is lost; they are then averages of `degree` of m
    evenly spaced places (Piegl and Tiller 1997, eq. 9.8). As many control points as samples
    interpolate.
    """
    from scipy.interpolate import make_lsq_spline

    n = len(values)
    m = min(max(control_points, degree + 1), n)
    places = np.linspace(0.0, 1.0, n)
    inner = np.linspace(0.0, 1.0, m - degree + 1)[1:-1]
    if 2 * (m - degree) > n:
        inner = (np.arange(m - degree - 1) + (degree + 1) / 2) / (m - 1)
    knots = np.concatenate([np.zeros(degree + 1), inner, np.ones(degree + 1)])
    return np.asarray(make_lsq_spline(places, values, knots, k=degree)(places))
