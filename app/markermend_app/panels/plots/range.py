"""Which values and frames a plot should show: what matters, not what is farthest out."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.arrays import FloatArray

# A trajectory that stands still gets at least this much room, in mm.
LEAST_MM = 8.0
_MOST_SAMPLES = 40_000
_LEAST_FRAMES = 6.0
_BESIDE_S = 0.2
_ROOMY = 4


def value_range(
    curves: Sequence[FloatArray],
    important: Sequence[FloatArray] = (),
    bottom: float = 0.0,
    top: float = 0.0,
    *,
    least: float = LEAST_MM,
    least_at: float | None = None,
    whole: bool = False,
) -> tuple[float, float] | None:
    """Range of values to show.

    The central 99 percent of the samples, and beyond them what is there up to once their
    spread, so that one wild sample does not flatten everything; ``important`` samples (the
    artifact under review, its proposed repair) may take up to six times the spread.

    Parameters
    ----------
    curves : (n,) arrays, NaN = missing
    important : (n,) arrays
    bottom : share of the height to be kept free below, for the strip of artifacts
    top : share of the height to be kept free above, for the names of events
    least : extent shown at least
    least_at : where the range begins, for values that cannot lie below it
    whole : show every sample, however far out

    Returns
    -------
    low, high with margins, or None where there are no samples at all
    """
    known = _sample(curves)
    special = _sample(important)
    if known.size == 0:
        curves, known = important, special
    if known.size == 0:
        return None
    low, high = (float(v) for v in np.percentile(known, (0.5, 99.5)))
    spread = np.inf if whole else max(high - low, least)
    bounds = [_clip(curves, low - spread, high + spread)]
    if special.size:
        bounds.append(_clip(important, low - 6 * spread, high + 6 * spread))
    low = min(low, *(b[0] for b in bounds))
    high = max(high, *(b[1] for b in bounds))
    if least_at is not None:
        low, high = least_at, max(high, least_at + least)
    if high - low < least:
        middle = (low + high) / 2
        low, high = middle - least / 2, middle + least / 2
    margin = (high - low) * 0.08
    extent = (high - low) * 1.16 / (1 - bottom - top)
    return low - margin - extent * bottom, high + margin + extent * top


def time_range(start: float, stop: float, frames: int) -> tuple[float, float]:
    """Move and cut a range of frames so that it lies on a take, with a little margin."""
    margin = max(1.0, 0.01 * frames)
    least, most = -0.5 - margin, frames - 0.5 + margin
    span = float(np.clip(stop - start, min(_LEAST_FRAMES, most - least), most - least))
    low = float(np.clip((start + stop - span) / 2, least, most - span))
    return low, low + span


def surrounded(start: int, stop: int, rate: float) -> tuple[float, float]:
    """An interval and as much around it as a peak needs to be seen, and a gap to be judged."""
    length = stop - start
    pad = max(length, min(8 * length, rate), _BESIDE_S * rate)
    return start - pad, stop + pad


def well_seen(start: int, stop: int, rate: float, view: tuple[float, float]) -> bool:
    """Whether an interval is in view as a whole, and large enough in it to be judged."""
    first, last = surrounded(start, stop, rate)
    low, high = view
    return low <= start and stop - 1 <= high and high - low <= _ROOMY * (last - first)


def snapped(frame: float, edges: Sequence[int], reach: float) -> float:
    """Move a frame to the nearest of some edges, if it is within reach; both in frames."""
    near = min(edges, key=lambda edge: abs(edge - frame), default=None)
    return frame if near is None or abs(near - frame) > reach else float(near)


def whole_frames(start: float, stop: float, frames: int) -> tuple[int, int]:
    """Round a range to whole frames of a take: half-open, at least one frame long."""
    first = int(np.clip(round(start), 0, frames - 1))
    return first, int(np.clip(round(stop), first + 1, frames))


def _sample(arrays: Sequence[FloatArray]) -> FloatArray:
    """Samples that are there, evenly from all where they are many."""
    step = max(1, sum(len(a) for a in arrays) // _MOST_SAMPLES)
    joined = np.concatenate([np.zeros(0), *(a[::step] for a in arrays)])
    joined = joined[np.isfinite(joined)]
    if joined.size == 0 and step > 1:
        joined = np.concatenate([a[np.isfinite(a)] for a in arrays])
    return joined


def _clip(arrays: Sequence[FloatArray], low: float, high: float) -> tuple[float, float]:
    """Extremes, within bounds; every sample counts, since a spike is a single one."""
    known = [a for a in arrays if len(a)]
    lowest = float(np.fmin.reduce([np.fmin.reduce(a) for a in known]))
    highest = float(np.fmax.reduce([np.fmax.reduce(a) for a in known]))
    return max(low, lowest), min(high, highest)
