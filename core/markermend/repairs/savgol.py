"""Savitzky–Golay smoothing of what is left of the signal."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from markermend.arrays import FloatArray
from markermend.artifact import Artifact, Kind, axis_columns
from markermend.repairs.registry import Evidence, Repair, register
from markermend.repairs.result import axes_of, make_repair, refuse


@dataclass(frozen=True)
class SavgolParams:
    """Order and window as published; the window is for 100 Hz and scaled by the rate."""

    order: int = field(
        default=13, metadata={"min": 1, "max": 25, "help": "Degree of the local polynomial"}
    )
    window: int = field(
        default=101,
        metadata={
            "unit": "samples at 100 Hz",
            "min": 5,
            "max": 1001,
            "help": "Length of the window, scaled by the take's rate",
        },
    )


@register(
    "savgol",
    label="Savitzky–Golay",
    summary="Smooths the damaged samples themselves; for noise that still holds the movement.",
    params=SavgolParams,
    source="skurowski2022, 4.1.2 (E3)",
    key=7,
)
def repair_savgol(evidence: Evidence, artifact: Artifact, params: Any) -> Repair:
    """Replace the interval by the local polynomial fit of order 13 over about a second.

    Missing samples inside the window are bridged by a straight line first; at the take's ends
    the window stops at the last frame and the fit is read off its centre.
    """
    take, marker = evidence.take, evidence.take.index(artifact.marker)
    start, stop = artifact.start, artifact.stop
    if artifact.kind is Kind.GAP or not take.present[start:stop, marker].any():
        return refuse("savgol", "There is no signal to smooth inside a gap.", params)
    window = round(params.window * take.rate / 100) // 2 * 2 + 1
    if window <= params.order:
        return refuse("savgol", "The window must hold more samples than the order.", params)
    if take.frames < window:
        return refuse(
            "savgol", f"The take has {take.frames} frames; the window needs {window}.", params
        )
    projection = _projection(window, params.order)
    frames = np.arange(start, stop)
    firsts = np.clip(frames - window // 2, 0, take.frames - window)
    low, high = int(firsts[0]), int(firsts[-1]) + window
    values = np.full((stop - start, 3), np.nan)
    for axis in axis_columns(axes_of(artifact)):
        signal = take.positions[low:high, marker, axis]
        seen = np.flatnonzero(~np.isnan(signal))
        whole = np.interp(np.arange(len(signal)), seen, signal[seen])
        windows = np.lib.stride_tricks.sliding_window_view(whole, window)[firsts - low]
        values[:, axis] = np.einsum("fw,fw->f", projection[frames - firsts], windows)
    return make_repair("savgol", evidence, artifact, values, params)


def _projection(window: int, order: int) -> FloatArray:
    """(window, window) least-squares fit of a polynomial, read at each place of the window."""
    # Legendre polynomials on [-1, 1]: plain powers of order 13 lose all digits.
    basis = np.polynomial.legendre.legvander(np.linspace(-1.0, 1.0, window), order)
    q, _ = np.linalg.qr(basis)
    return np.asarray(q @ q.T, dtype=np.float64)
