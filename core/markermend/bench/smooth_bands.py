"""Whether the error bands of smoothing hold: share of errors within them, at rest and in motion."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from dataclasses import astuple, dataclass, fields

import numpy as np
from scipy.ndimage import gaussian_filter1d

from markermend.bench.columns import aligned, csv_cell, number
from markermend.bench.smooth import ENDS_S, Truth, noisy
from markermend.progress import Progress
from markermend.smoothers import derivatives
from markermend.smoothers.bands import acceleration, velocity
from markermend.take import Take

# Of a Gaussian error, in standard deviations.
_WIDTH_90 = 1.645
_REST_MM_S, _MOTION_MM_S = 30.0, 200.0
# Speed is looked at over this time; fewer samples at rest or in motion say nothing.
_OVER_S, _LEAST = 0.1, 500


@dataclass(frozen=True)
class BandRow:
    """Share of errors within the 90 % band, for one truth, noise, and kind of moment.

    Attributes
    ----------
    truth : name
    noise : ``"white"`` or ``"coloured"``
    noise_mm : root mean square
    moment : ``"rest"`` (below 30 mm/s) or ``"motion"`` (above 200 mm/s)
    frames : of all markers together
    position, velocity, acceleration : share of coordinates within
    """

    truth: str
    noise: str
    noise_mm: float
    moment: str
    frames: int
    position: float
    velocity: float
    acceleration: float


def hold(
    truths: Iterable[Truth],
    *,
    noises_mm: Sequence[float] = (0.3, 1.0, 3.0),
    kinds: Sequence[str] = ("white", "coloured"),
    seed: int = 0,
    progress: Progress | None = None,
) -> tuple[BandRow, ...]:
    """Add noise to truths, smooth by ``auto``, and see whether its bands hold the errors.

    Parameters
    ----------
    truths, noises_mm, kinds, seed : as for :func:`markermend.bench.smooth.compare`
    progress : told the share done; may raise ``Cancelled``
    """
    rows = []
    for truth, kind, noise_mm, values in noisy(
        truths, noises_mm=noises_mm, kinds=kinds, seed=seed, progress=progress
    ):
        rate, exact = truth.rate, truth.positions
        labels = tuple(str(i) for i in range(exact.shape[1]))
        found = derivatives(Take(values, labels, rate))
        speeds, changes = velocity(exact) * rate, acceleration(exact) * rate**2
        within = [
            np.abs(value - right) < _WIDTH_90 * band
            for value, band, right in (
                (found.position, found.position_band, exact),
                (found.velocity, found.velocity_band, speeds),
                (found.acceleration, found.acceleration_band, changes),
            )
        ]
        speed = np.linalg.norm(gaussian_filter1d(speeds, _OVER_S * rate, axis=0), axis=2)
        ends = max(1, round(ENDS_S * rate))
        speed[:ends] = speed[-ends:] = np.nan
        for moment, there in (("rest", speed < _REST_MM_S), ("motion", speed > _MOTION_MM_S)):
            frames = int(there.sum())
            if frames >= _LEAST:
                shares = [float(kind_within[there].mean()) for kind_within in within]
                rows.append(BandRow(truth.name, kind, noise_mm, moment, frames, *shares))
    return tuple(rows)


def bands_csv(rows: Sequence[BandRow]) -> str:
    """Write one line a row."""
    text = io.StringIO()
    out = csv.writer(text, lineterminator="\n")
    out.writerow([f.name for f in fields(BandRow)])
    out.writerows([csv_cell(v) if isinstance(v, float) else v for v in astuple(r)] for r in rows)
    return text.getvalue()


def bands_table(rows: Sequence[BandRow]) -> list[str]:
    """Lay rows out as lines for a terminal."""
    head = ["within the 90 % band", "", "", "", "frames", "position", "velocity", "acceleration"]
    cells = [
        [
            r.truth,
            r.noise,
            f"{r.noise_mm:g} mm",
            r.moment,
            str(r.frames),
            number(r.position, 2),
            number(r.velocity, 2),
            number(r.acceleration, 2),
        ]
        for r in rows
    ]
    return aligned([head, *cells])
