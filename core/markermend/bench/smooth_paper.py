"""The tables of ardestani2022 again, beside the figures it gives.

Tables 1 to 3 smooth a noisy sine; 4 to 7 the hips of a kick, channels 1 and 3 of the root of a
CMU recording. Which take that is the paper does not tell; on others the order of the methods can be
compared, not the figures.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from markermend.arrays import FloatArray
from markermend.errors import FileFormatError
from markermend.smoothers.bspline import fit_bspline
from markermend.smoothers.kalman import filter_kalman
from markermend.smoothers.metrics import percent_less, sm1, sm2
from markermend.smoothers.moving_average import recursive_average, symmetric_average

# Two periods in a thousand samples, with noise within a tenth of the amplitude.
_SAMPLES, _PERIODS, _NOISE = 1000, 2, 0.1
# What the paper's kick has; other takes are cut to it, or get their share of control points.
_FRAMES = 600

Filter = Callable[[FloatArray], FloatArray]

SINE: Mapping[str, tuple[Filter, tuple[float, float]]] = {
    "moving average, past, 2": (partial(recursive_average, window=2), (28.12, 2.64)),
    "moving average, past, 3": (partial(recursive_average, window=3), (20.29, 1.67)),
    "moving average, symmetric, 3": (partial(symmetric_average, window=3), (23.14, 1.15)),
    "moving average, symmetric, 5": (partial(symmetric_average, window=5), (15.48, 0.56)),
    "B-spline, 500 control points": (partial(fit_bspline, control_points=500), (23.06, 0.88)),
    "B-spline, 200 control points": (partial(fit_bspline, control_points=200), (9.47, 0.03)),
    "B-spline, 100 control points": (partial(fit_bspline, control_points=100), (8.21, 0.0)),
    "B-spline, 50 control points": (partial(fit_bspline, control_points=50), (8.07, 0.0)),
    "Kalman, E_mea 0.01": (partial(filter_kalman, measurement_error=0.01), (8.69, 0.08)),
    "Kalman, E_mea 0.02": (partial(filter_kalman, measurement_error=0.02), (7.82, 0.02)),
}
"""Rows of tables 1 to 3 with SM1 and SM2 after smoothing as published."""

SINE_BEFORE = (64.87, 19.08)
"""SM1 and SM2 of the noisy sine as published."""

KICK: Mapping[str, tuple[tuple[float, float], tuple[float, float]]] = {
    "moving average, past, 2": ((4.86, 76.14), (22.2, 80.66)),
    "moving average, past, 3": ((10.67, 82.63), (35.05, 91.09)),
    "moving average, symmetric, 3": ((4.26, 79.96), (20.04, 84.44)),
    "moving average, symmetric, 5": ((6.06, 84.69), (28.49, 93.15)),
    "B-spline, 598 control points": ((0.72, 31.41), (2.62, 33.37)),
    "B-spline, 200 control points": ((4.01, 85.76), (22.09, 94.07)),
    "B-spline, 100 control points": ((5.11, 91.29), (33.58, 98.68)),
    "B-spline, 50 control points": ((7.06, 92.33), (37.7, 99.4)),
    "B-spline, 25 control points": ((38.3, 98.46), (49.45, 99.94)),
    "Kalman, E_mea 0.005": ((16.88, 92.94), (40.97, 97.88)),
    "Kalman, E_mea 0.01": ((32.71, 96.3), (48.88, 99.29)),
    "Kalman, E_mea 0.02": ((53.65, 98.51), (58.91, 99.74)),
}
"""Rows of tables 6 and 7: %SM1 and %SM2 of channel 1 and of channel 3 as published."""


@dataclass(frozen=True)
class PaperRow:
    """One row of a table.

    Attributes
    ----------
    signal : ``"sine"``, ``"channel 1"`` or ``"channel 3"``
    method : filter and setting
    before, after : SM1 and SM2, means over draws or takes
    percent : %SM1 and %SM2, means
    published_after : SM1 and SM2 in the paper, or None where its signal is not ours
    published_percent : %SM1 and %SM2 in the paper
    """

    signal: str
    method: str
    before: tuple[float, float]
    after: tuple[float, float]
    percent: tuple[float, float]
    published_after: tuple[float, float] | None
    published_percent: tuple[float, float]


def sine_rows(draws: int = 20, seed: int = 0) -> tuple[PaperRow, ...]:
    """Tables 1 to 3: a sine in noise, smoothed.

    Parameters
    ----------
    draws : of the noise, averaged over
    seed : of the noise

    Notes
    -----
    The signal and what the text leaves open of two filters are those of which the published
    figures come out. B-splines of 500 control points do not reach them, on uniform or averaged
    knots, with chord-length parameters or other degrees; 425 control points would. The paper's
    598 on as many samples take away a third of SM2 (tables 4 to 7), where least squares would
    interpolate: its curve of many control points is smoother than its eq. 5 makes it.
    """
    time = np.linspace(0.0, 1.0, _SAMPLES)
    rng = np.random.default_rng(seed)
    noise = rng.uniform(-_NOISE, _NOISE, (_SAMPLES, draws))
    signals = np.sin(2 * np.pi * _PERIODS * time)[:, None] + noise
    rows = []
    for name, (smooth, published) in SINE.items():
        percent = tuple(
            100.0 * (before - after) / before
            for before, after in zip(SINE_BEFORE, published, strict=True)
        )
        before, after, less = _measure(signals, smooth(signals))
        rows.append(
            PaperRow("sine", name, before, after, less, published, (percent[0], percent[1]))
        )
    return tuple(rows)


def kick_rows(roots: Sequence[FloatArray]) -> tuple[PaperRow, ...]:
    """Tables 4 to 7: channels 1 and 3 of the root, smoothed.

    Parameters
    ----------
    roots : (frames, 6) each, as :func:`read_root` gives; at most the first 600 frames are used
    """
    rows = []
    for place, channel in enumerate((0, 2)):
        for name, published in KICK.items():
            measured = []
            for root in roots:
                signal = root[:_FRAMES, channel : channel + 1]
                measured.append(_measure(signal, _kick_filter(name, len(signal))(signal)))
            before, after, less = np.mean(measured, axis=0)
            rows.append(
                PaperRow(
                    f"channel {channel + 1}",
                    name,
                    (before[0], before[1]),
                    (after[0], after[1]),
                    (less[0], less[1]),
                    None,
                    published[place],
                )
            )
    return tuple(rows)


def read_root(path: str | Path) -> FloatArray:
    """Read the root's six channels of an Acclaim AMC file.

    Parameters
    ----------
    path : the file

    Returns
    -------
    (frames, 6) float64: position in the file's unit, rotation in degrees

    Raises
    ------
    FileFormatError
        when the file has no line for the root in every frame
    """
    try:
        lines = Path(path).read_text(encoding="ascii", errors="replace").splitlines()
        rows = [[float(word) for word in line.split()[1:]] for line in lines if _is_root(line)]
        root = np.array(rows, dtype=np.float64)
    except ValueError as error:
        raise FileFormatError(f"“{path}” is no AMC file that can be read ({error}).") from error
    if root.ndim != 2 or root.shape[1] != 6 or len(root) < 4:
        raise FileFormatError(f"“{path}” has no six channels of a root.")
    return root


def _is_root(line: str) -> bool:
    return line.startswith("root ")


def _kick_filter(name: str, frames: int) -> Filter:
    """The filter of a row, control points in proportion for shorter takes."""
    kind, _, setting = name.rpartition(", ")
    number = float(setting.split()[-1] if kind == "Kalman" else setting.split()[0])
    if kind == "B-spline":
        points = round(number * min(frames, _FRAMES) / _FRAMES)
        return partial(fit_bspline, control_points=points)
    if kind == "Kalman":
        return partial(filter_kalman, measurement_error=number)
    average = recursive_average if "past" in kind else symmetric_average
    return partial(average, window=int(number))


_Pair = tuple[float, float]


def _measure(before: FloatArray, after: FloatArray) -> tuple[_Pair, _Pair, _Pair]:
    """SM1 and SM2 before, after, and percent less, means over columns."""
    first = [(metric(before), metric(after)) for metric in (sm1, sm2)]
    less = [float(percent_less(b, a).mean()) for b, a in first]
    was, now = [float(b.mean()) for b, _ in first], [float(a.mean()) for _, a in first]
    return (was[0], was[1]), (now[0], now[1]), (less[0], less[1])
