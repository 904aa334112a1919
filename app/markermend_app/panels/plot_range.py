"""Which values and frames a plot should show: what matters, not what is farthest out."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.arrays import FloatArray

# A trajectory that stands still gets at least this much room, in mm.
_LEAST_MM = 8.0
_MOST_SAMPLES = 40_000
_LEAST_FRAMES = 6.0


def value_range(
    curves: Sequence[FloatArray], important: Sequence[FloatArray] = (), bottom: float = 0.0
) -> tuple[float, float] | None:
    """Range of values to show.

    The central 99 percent of the samples, and beyond them what is there up to once their
    spread, so that one wild sample does not flatten everything; ``important`` samples (the
    artifact under review, its proposed repair) may take up to six times the spread.

    Parameters
    ----------
    curves : (n,) arrays in mm, NaN = missing
    important : (n,) arrays in mm
    bottom : share of the height to be kept free below, for the strip of artifacts

    Returns
    -------
    low, high in mm with margins, or None where there are no samples at all
    """
    known = _finite(curves)
    special = _finite(important)
    if known.size == 0:
        known = special
    if known.size == 0:
        return None
    sample = known[:: max(1, known.size // _MOST_SAMPLES)]
    low, high = (float(v) for v in np.percentile(sample, (0.5, 99.5)))
    spread = max(high - low, _LEAST_MM)
    bounds = [_clip(known, low - spread, high + spread)]
    if special.size:
        bounds.append(_clip(special, low - 6 * spread, high + 6 * spread))
    low = min(low, *(b[0] for b in bounds))
    high = max(high, *(b[1] for b in bounds))
    if high - low < _LEAST_MM:
        middle = (low + high) / 2
        low, high = middle - _LEAST_MM / 2, middle + _LEAST_MM / 2
    span = (high - low) * 1.16
    margin = (high - low) * 0.08
    return low - margin - span * bottom / (1 - bottom), high + margin


def time_range(start: float, stop: float, frames: int) -> tuple[float, float]:
    """Move and cut a range of frames so that it lies on a take, with a little margin."""
    margin = max(1.0, 0.01 * frames)
    least, most = -0.5 - margin, frames - 0.5 + margin
    span = float(np.clip(stop - start, min(_LEAST_FRAMES, most - least), most - least))
    low = float(np.clip((start + stop - span) / 2, least, most - span))
    return low, low + span


def whole_frames(start: float, stop: float, frames: int) -> tuple[int, int]:
    """Round a range to whole frames of a take: half-open, at least one frame long."""
    first = int(np.clip(round(start), 0, frames - 1))
    return first, int(np.clip(round(stop), first + 1, frames))


def _finite(arrays: Sequence[FloatArray]) -> FloatArray:
    """All samples that are there."""
    if not arrays:
        return np.zeros(0)
    joined = np.concatenate([np.ravel(a) for a in arrays])
    return joined[np.isfinite(joined)]


def _clip(values: FloatArray, low: float, high: float) -> tuple[float, float]:
    """Extremes, within bounds."""
    return max(low, float(values.min())), min(high, float(values.max()))
