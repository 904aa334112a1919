"""Steps of which one edge is clear and the other faint, lost in fast motion."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.detectors.joint.jumps import FLOOR_MM, Jumps, reach_at, segments, sixth_difference
from markermend.detectors.joint.scale import jitter
from markermend.detectors.joint.shapes import judge
from markermend.detectors.joint.steps import LONGEST_S

CLEAR_SCORE, CLEAR_MM, FAINT_SCORE = 8.0, 0.8, 3.3
LARGEST_MISMATCH, SHORTEST = 0.3, 10


def find_partners(
    jumps: Jumps,
    alone: list[int],
    signal: FloatArray,
    seen: BoolArray,
    rate: float,
    taken: list[tuple[int, int, int]],
) -> list[tuple[int, int, float]]:
    """Look for the faint jump that takes a clear one back.

    Parameters
    ----------
    jumps : all jumps and blocks
    alone : those jumps no other clear one takes back
    signal, seen : (frames, channels) mm without NaN, bool; where not seen nothing is looked for
    rate : frames per second
    taken : channel, start and stop of steps found already; no other may overlap them

    Returns
    -------
    (i, frame, score): the jump, the frame at which the other one is, and the geometric mean of
    both scores less what their sizes differ in standard errors. Only for jumps that have a
    partner, which need not be among ``jumps``.
    """
    begin, end = segments(seen)
    reach, longest = reach_at(rate), round(LONGEST_S * rate)
    clear = [i for i in alone if jumps.score[i] >= CLEAR_SCORE and abs(jumps.size[i]) >= CLEAR_MM]
    if not clear:
        return []
    noise = jitter(sixth_difference(signal), seen, rate)
    steps, found = list(taken), []
    for i in sorted(clear, key=lambda i: (-float(jumps.score[i]), i)):
        size, score = float(jumps.size[i]), float(jumps.score[i])
        channel, frame = int(jumps.channel[i]), int(jumps.frame[i])
        first = max(int(begin[frame, channel]) + 1, frame - longest)
        last = min(int(end[frame, channel]), frame + longest)
        at = np.arange(first, last, dtype=np.int64)
        at = at[np.abs(at - frame) >= SHORTEST]
        where = np.full(len(at), channel, dtype=np.int64)
        there = judge(signal, where, at, 0, reach, begin[at, channel], end[at, channel])
        own = np.where(np.isfinite(there.unit), there.unit, 0.0) * noise[at, channel]
        error = np.sqrt(there.error**2 + own**2 + FLOOR_MM**2)
        mismatch = np.abs(there.size + size)
        other = np.abs(there.size) / error
        fits = (
            (there.size * size < 0)
            & (other >= FAINT_SCORE)
            & (mismatch <= np.maximum(LARGEST_MISMATCH * abs(size), 1.5 * error))
        )
        if not fits.any():
            continue
        both = np.sqrt(np.minimum(other, score) * score) - np.maximum(mismatch / error - 1.0, 0.0)
        best = int(np.argmax(np.where(fits, both, -np.inf)))
        start, stop = sorted((frame, int(at[best])))
        if any(c == channel and start < b and a < stop for c, a, b in steps):
            continue
        steps.append((channel, start, stop))
        found.append((i, int(at[best]), float(both[best])))
    return found
