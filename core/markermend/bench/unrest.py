"""What a body leaves of its markers: the hills among which slow changes have to be told."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from joblib import Parallel, delayed
from numpy.lib.stride_tricks import sliding_window_view
from threadpoolctl import threadpool_limits

from markermend.arrays import FloatArray
from markermend.bench.columns import aligned
from markermend.bench.e1 import Clean
from markermend.bench.svg import chart
from markermend.detectors.joint.bank import shape_of
from markermend.detectors.joint.slow import Ground, prepare
from markermend.predictors.cross_fit import distance_spreads, predict_cross_fitted
from markermend.predictors.local import INPUT_MARKERS
from markermend.take import AXES, is_unlabelled

LENGTH, HEIGHT_MM = 50, 10.0
"""Of a slow change as the experiments draw them on average."""
DRAWN = "rounded 9"
AROUND = 60
HILLY = 0.9
"""Quantile of the swing where its own hill is drawn."""


@dataclass(frozen=True, eq=False)
class Unrest:
    """How far what a body leaves of its markers swings within the length of a slow change.

    Attributes
    ----------
    take : name
    median_mm : median of the swing, highest less lowest of 50 frames, over coordinates and frames
    share : part of them in which it is 10 mm or more, in [0, 1]
    coordinate : the one whose median swing is the median of all, ``"RKNE.z"``
    residual : (frames,) mm, what is left of it; NaN where nothing is known
    """

    take: str
    median_mm: float
    share: float
    coordinate: str
    residual: FloatArray


def unrest(clean: Clean, *, jobs: int = 1) -> Unrest | None:
    """Measure one take, thinned to about 120 Hz.

    Parameters
    ----------
    clean : recording with what is damaged in it already
    jobs : processes

    Returns
    -------
    None where the body says too little
    """
    take = clean.take
    markers = [i for i, label in enumerate(take.labels) if not is_unlabelled(label)]
    ground = prepare(take, markers, clean.flaws)
    if len(ground.positions) < LENGTH:
        return None
    with threadpool_limits(1):
        spreads = distance_spreads(ground.positions, ground.trusted)
        parts = Parallel(n_jobs=jobs)(
            delayed(_left)(ground, m, spreads[m]) for m in range(len(markers))
        )
    left = np.stack(parts, axis=1).reshape(len(ground.positions), -1)
    swing = swings(left)
    if not np.isfinite(swing).any():
        return None
    told = np.flatnonzero(np.isfinite(swing).any(axis=0))
    usual = np.nanmedian(swing[:, told], axis=0)
    middle = int(told[np.argsort(usual, kind="stable")[len(told) // 2]])
    known = swing[np.isfinite(swing)]
    return Unrest(
        clean.name,
        float(np.median(known)),
        float((known >= HEIGHT_MM).mean()),
        f"{take.labels[markers[middle // 3]]}.{AXES[middle % 3]}",
        left[:, middle],
    )


def swings(residual: FloatArray) -> FloatArray:
    """Highest less lowest of 50 frames from each on, (frames - 49, coordinates); NaN stays NaN."""
    windows = sliding_window_view(residual, LENGTH, axis=0)
    return np.asarray(windows.max(axis=2) - windows.min(axis=2))


def _left(ground: Ground, marker: int, spread: FloatArray) -> FloatArray:
    """What the body leaves of one marker, (frames, 3) mm."""
    order = np.argsort(spread, kind="stable")
    order = order[np.isfinite(spread[order])][:INPUT_MARKERS]
    predicted = predict_cross_fitted(ground.positions, marker, order, ground.trusted)
    away = ground.positions[:, marker] - predicted
    return np.asarray(np.where(ground.known[:, marker], away, np.nan))


def unrest_table(found: Sequence[Unrest]) -> list[str]:
    """Lines of text."""
    if not found:
        return []
    head = ("what the body leaves", f"swings in {LENGTH} frames", f"{HEIGHT_MM:g} mm or more")
    rows = [(u.take, f"{u.median_mm:.1f} mm", f"{100 * u.share:.0f} %") for u in found]
    return aligned([head, *rows])


def unrest_figure(one: Unrest) -> str:
    """Draw what is left of the coordinate beside the same with a slow change put on it.

    Returns
    -------
    A whole SVG document: as recorded where it swings as far as in one of ten places, and, where
    it swings as far as usual, with a drift of 10 mm whose kinks are rounded over 9 frames
    """
    swing = swings(one.residual[:, None])[:, 0]
    padded = np.pad(one.residual, AROUND, constant_values=np.nan)
    drift = np.pad(HEIGHT_MM * shape_of(DRAWN, LENGTH), AROUND)
    frames = (np.arange(len(drift)) - AROUND).tolist()
    places = [np.nanargmin(np.abs(swing - np.nanquantile(swing, q))) for q in (HILLY, 0.5)]
    hill, elsewhere = (padded[begin : begin + len(drift)] for begin in places)
    curves = {
        "a hill of its own": (frames, hill.tolist()),
        "a drift put on it": (frames, (elsewhere + drift).tolist()),
        "the drift alone": (frames, drift.tolist()),
    }
    title = f"{one.take}: what the body leaves of {one.coordinate}"
    return chart(curves, title, "frames from where it begins", "mm")


def figure_name(take: str) -> str:
    """File name of the figure of a take."""
    plain = re.sub(r"[^\w.-]", "_", take)
    return f"{plain}-unrest.svg"
