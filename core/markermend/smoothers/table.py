"""Smoothed trajectories, velocities and accelerations with their bands, as CSV."""

from __future__ import annotations

import csv
import io

import numpy as np

from markermend.smoothers.run import Derivatives
from markermend.take import AXES, Take

_KINDS = (("position", "mm"), ("velocity", "mm_s"), ("acceleration", "mm_s2"))


def derivatives_csv(found: Derivatives, take: Take) -> str:
    """One line a marker and frame; empty where the marker was not seen.

    Parameters
    ----------
    found : of :func:`markermend.smoothers.derivatives`
    take : the recording it was worked out from, for the numbers of its frames
    """
    names = [
        f"{axis}_{kind}{band}_{unit}"
        for kind, unit in _KINDS
        for band in ("", "_band")
        for axis in AXES
    ]
    numbers = take.first_frame + np.arange(take.frames)
    seconds = np.arange(take.frames) / take.rate
    text = io.StringIO()
    out = csv.writer(text, lineterminator="\n")
    out.writerow(["marker", "frame", "time_s", *names])
    for i, label in enumerate(found.labels):
        columns = np.concatenate(
            [getattr(found, kind + band)[:, i] for kind, _ in _KINDS for band in ("", "_band")],
            axis=1,
        )
        for number, time_s, row in zip(numbers, seconds, columns.tolist(), strict=True):
            cells = ("" if v != v else f"{v:.6g}" for v in row)
            out.writerow([label, number, f"{time_s:.6g}", *cells])
    return text.getvalue()
