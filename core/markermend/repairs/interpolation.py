"""Curves through a marker's own trusted samples on both sides of the interval."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from markermend.arrays import FloatArray
from markermend.artifact import Artifact, axis_columns
from markermend.repairs.registry import Evidence, Repair, register
from markermend.repairs.result import axes_of, make_repair, refuse

Curve = Callable[[FloatArray, FloatArray, FloatArray], FloatArray]
"""``(times, values, wanted times) -> values there``"""

SOURCE = "skurowski2021, 3.1.4"


@dataclass(frozen=True)
class InterpolationParams:
    """How far a curve looks at its own trajectory."""

    context: int = field(
        default=200,
        metadata={
            "unit": "frames",
            "min": 4,
            "max": 100_000,
            "help": "Frames on either side from which the curve is drawn",
        },
    )


def _linear(times: FloatArray, values: FloatArray, wanted: FloatArray) -> FloatArray:
    return np.interp(wanted, times, values)


def _spline(times: FloatArray, values: FloatArray, wanted: FloatArray) -> FloatArray:
    from scipy.interpolate import CubicSpline

    return np.asarray(CubicSpline(times, values)(wanted), dtype=np.float64)


def _pchip(times: FloatArray, values: FloatArray, wanted: FloatArray) -> FloatArray:
    from scipy.interpolate import PchipInterpolator

    return np.asarray(PchipInterpolator(times, values)(wanted), dtype=np.float64)


def _makima(times: FloatArray, values: FloatArray, wanted: FloatArray) -> FloatArray:
    from scipy.interpolate import Akima1DInterpolator

    curve = Akima1DInterpolator(times, values, method="makima")
    return np.asarray(curve(wanted), dtype=np.float64)


def _interpolate(
    method: str,
    curve: Curve,
    side: int,
    evidence: Evidence,
    artifact: Artifact,
    params: InterpolationParams,
) -> Repair:
    """Draw a curve from at least `side` trusted samples on either side, one axis at a time."""
    take, marker = evidence.take, evidence.take.index(artifact.marker)
    start, stop = artifact.start, artifact.stop
    first, last = max(0, start - params.context), min(take.frames, stop + params.context)
    wanted = np.arange(start, stop, dtype=np.float64)
    values = np.full((stop - start, 3), np.nan)
    for axis in axis_columns(axes_of(artifact)):
        usable = evidence.trusted[first:last, marker, axis].copy()
        usable[start - first : stop - first] = False
        frames = first + np.flatnonzero(usable)
        before, after = int((frames < start).sum()), int((frames >= stop).sum())
        if min(before, after) < side:
            return refuse(method, _too_little(artifact, before, after, side, take.frames), params)
        known = take.positions[frames, marker, axis]
        values[:, axis] = curve(frames.astype(np.float64), known, wanted)
    return make_repair(method, evidence, artifact, values, params)


def _too_little(artifact: Artifact, before: int, after: int, side: int, frames: int) -> str:
    """Why no curve can be drawn."""
    if artifact.start == 0 or artifact.stop == frames:
        end = "beginning" if artifact.start == 0 else "end"
        return f"The interval reaches the take's {end}; a curve needs samples on both sides."
    return too_few(artifact.marker, before, after, side)


def too_few(marker: str, before: int, after: int, needed: int) -> str:
    """Say at which end of an interval a marker has fewer trusted samples than are needed."""
    end = "beginning" if before < needed else "end"
    count = before if before < needed else after
    seen = {0: "no trusted samples", 1: "only one trusted sample"}
    return (
        f"{marker} has {seen.get(count, f'only {count} trusted samples')} near the interval's "
        f"{end}; needed: {needed}."
    )


@register(
    "linear",
    label="Straight line",
    summary="Joins the last good sample before and the first after; for the shortest intervals.",
    params=InterpolationParams,
    source=SOURCE,
    key=5,
)
def repair_linear(evidence: Evidence, artifact: Artifact, params: Any) -> Repair:
    """Straight line between the nearest trusted samples."""
    return _interpolate("linear", _linear, 1, evidence, artifact, params)


@register(
    "spline",
    label="Cubic spline",
    summary="Smooth curve of continuous acceleration; best for peaks and up to about 0.1 s.",
    params=InterpolationParams,
    source=SOURCE,
    key=2,
)
def repair_spline(evidence: Evidence, artifact: Artifact, params: Any) -> Repair:
    """Cubic spline, not-a-knot, through the trusted samples of the context."""
    return _interpolate("spline", _spline, 2, evidence, artifact, params)


@register(
    "pchip",
    label="PCHIP",
    summary="Piecewise cubic that never overshoots; safer than the spline over longer intervals.",
    params=InterpolationParams,
    source=SOURCE,
    key=3,
)
def repair_pchip(evidence: Evidence, artifact: Artifact, params: Any) -> Repair:
    """Monotone piecewise cubic Hermite interpolation."""
    return _interpolate("pchip", _pchip, 2, evidence, artifact, params)


@register(
    "makima",
    label="Modified Akima",
    summary="Piecewise cubic between spline and PCHIP: smooth, with little overshoot.",
    params=InterpolationParams,
    source=SOURCE,
    key=4,
)
def repair_makima(evidence: Evidence, artifact: Artifact, params: Any) -> Repair:
    """Modified Akima piecewise cubic Hermite interpolation."""
    return _interpolate("makima", _makima, 2, evidence, artifact, params)
