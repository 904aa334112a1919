"""Taking jitter out of a prediction that the marker itself never had.

Predicted from markers far away, a marker trembles with their noise many times over, and does not
meet its own trajectory without a kink. Where that is so, the prediction is smoothed as far as the
marker's own movement around is smooth, and joined to it (Whittaker 1923, with third differences).
"""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray

# Jitter of more than so many times the marker's own noise is taken out.
TREMBLING = 2.0
# Fewer frames do not tell jitter from movement.
LEAST_FRAMES = 8
# Frames on either side to which it is joined, and how much more these count: they are known.
JOINED, KNOWN = 6, 1e6
LEAST_JERK_MM = 1e-3


def jitter(track: FloatArray) -> float:
    """Standard deviation of white noise on a trajectory, mm, from its fourth differences.

    Parameters
    ----------
    track : (frames, 3) mm, NaN where not known

    Returns
    -------
    NaN where no five known frames follow each other
    """
    rough = np.abs(np.diff(track, n=4, axis=0))
    rough = rough[np.isfinite(rough)]
    # Fourth differences of white noise have 70 times its variance; a quarter lies within 0.3186.
    return float(np.quantile(rough, 0.25) / 0.3186 / np.sqrt(70.0)) if len(rough) else np.nan


def calmed(
    values: FloatArray, track: FloatArray, seen: BoolArray, start: int, noise_mm: float, reach: int
) -> FloatArray:
    """Smooth a prediction that trembles more than the marker does; return any other as it is.

    Parameters
    ----------
    values : (n, 3) mm, predicted from frame `start` on
    track : (frames, 3) mm, the marker
    seen : (frames,) bool, where it may be believed
    start : first frame of the interval
    noise_mm : standard deviation of the marker's own noise
    reach : frames on either side that tell how smoothly it moves

    Returns
    -------
    (n, 3) mm
    """
    from scipy.linalg import solveh_banded

    stop = start + len(values)
    trembling = jitter(values) if len(values) >= LEAST_FRAMES else 0.0
    if not trembling > TREMBLING * noise_mm:
        return values
    around = slice(max(0, start - reach), stop + reach)
    jerk = np.diff(np.where(seen[around, None], track[around], np.nan), n=3, axis=0)
    jerk = jerk[np.isfinite(jerk)]
    usual = max(LEAST_JERK_MM, float(np.sqrt(np.mean(jerk**2)))) if len(jerk) else trembling
    first, last = max(0, start - JOINED), min(len(track), stop + JOINED)
    wanted = np.where(seen[first:last, None], track[first:last], 0.0)
    wanted[start - first : stop - first] = values
    weight = np.where(seen[first:last], KNOWN, 0.0)
    weight[start - first : stop - first] = 1.0
    bands = (trembling / usual) ** 2 * _third_differences(len(weight))
    bands[-1] += weight
    smooth = solveh_banded(bands, weight[:, None] * wanted)
    return np.asarray(smooth[start - first : stop - first])


def _third_differences(frames: int) -> FloatArray:
    """(4, frames) upper bands of the sum of squared third differences, as SciPy keeps them."""
    bands = np.zeros((4, frames))
    step = np.array([-1.0, 3.0, -3.0, 1.0])
    for i in range(4):
        for j in range(i, 4):
            bands[3 - (j - i), j : frames - 3 + j] += step[i] * step[j]
    return bands
