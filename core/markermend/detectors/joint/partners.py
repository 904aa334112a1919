"""Steps of which one edge is clear and the other faint, lost in fast motion.

What is lost in a marker's own motion often stands out beside its neighbours': a hip that is kicked
carries all its markers along. So the faint edge is looked for both ways.
"""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.detectors.joint.jumps import FLOOR_MM, Jumps, reach_at, segments, sixth_difference
from markermend.detectors.joint.scale import jitter
from markermend.detectors.joint.shapes import judge
from markermend.detectors.joint.steps import LONG_S, LONGEST_S

CLEAR_SCORE, CLEAR_MM, FAINT_SCORE = 8.0, 0.8, 3.3
"""What the clear edge must be, and the score of one faint in the marker's own course; beside
the neighbours it must be clear as well, since there all that they do apart stays in."""
LARGEST_MISMATCH, SHORTEST = 0.3, 10
NARROWER = 5 / 6
"""A faint edge is looked at in a narrower window, too: less of a kick bends it. In one narrower
still, jumps come out of nothing."""
FAINT_SIDE = 2
"""Frames needed beyond a faint edge: a single one may as well be wrong by itself."""
RIDGE = 1e-6
"""Keeps neighbours that move alike from being weighed against each other."""


def find_partners(
    jumps: Jumps,
    alone: list[int],
    signal: FloatArray,
    rest: FloatArray,
    seen: BoolArray,
    neighbours: IntArray,
    rate: float,
    taken: list[tuple[int, int, int]],
) -> list[tuple[int, int, float]]:
    """Look for the faint jump that takes a clear one back.

    Parameters
    ----------
    jumps : all jumps and blocks
    alone : those jumps no other clear one takes back
    signal, seen : (frames, channels) mm without NaN, bool; where not seen nothing is looked for
    rest : the signal without its jumps and blocks
    neighbours : (markers, k) columns of the nearest other markers
    rate : frames per second
    taken : channel, start and stop of steps found already; no other may overlap them

    Returns
    -------
    (i, frame, score): the jump, the frame at which the other one is, and the geometric mean of
    both scores less what their sizes differ in standard errors. Only for jumps that have a
    partner, which need not be among ``jumps``.
    """
    begin, end = segments(seen)
    reach, longest, wide = reach_at(rate), round(LONG_S * rate), round(LONGEST_S * rate)
    clear = [i for i in alone if jumps.score[i] >= CLEAR_SCORE and abs(jumps.size[i]) >= CLEAR_MM]
    if not clear:
        return []
    noise = jitter(sixth_difference(signal), seen, rate)
    steps, found = list(taken), []
    for i in sorted(clear, key=lambda i: (-float(jumps.score[i]), i)):
        size, score = float(jumps.size[i]), float(jumps.score[i])
        channel, frame = int(jumps.channel[i]), int(jumps.frame[i])
        first = max(int(begin[frame, channel]) + FAINT_SIDE, frame - longest)
        last = min(int(end[frame, channel]) - FAINT_SIDE + 1, frame + longest)
        at = np.arange(first, last, dtype=np.int64)
        at = at[np.abs(at - frame) >= SHORTEST]
        at = at[~np.isin(at, _edges_of_spikes(jumps, channel))]
        if not len(at):
            continue
        rows = slice(max(int(begin[frame, channel]), frame - wide - reach), frame + wide + reach)
        rows = slice(rows.start, min(rows.stop, int(end[frame, channel])))
        own = signal[rows, channel]
        views = [(own, reach, FAINT_SCORE), (own, round(NARROWER * reach), FAINT_SCORE)]
        beside = _beside(rest, seen, neighbours[channel // 3], rows, own)
        views += [] if beside is None else [(beside, reach, CLEAR_SCORE)]
        both = np.full(len(at), -np.inf)
        for view, side, least in views:
            there, error = _jump_at(view, at - rows.start, side, noise[at, channel])
            mismatch = np.abs(there + size)
            other = np.abs(there) / error
            fits = (
                (there * size < 0)
                & (other >= least)
                & (mismatch <= np.maximum(LARGEST_MISMATCH * abs(size), 1.5 * error))
            )
            agreed = np.sqrt(np.minimum(other, score) * score)
            agreed -= np.maximum(mismatch / error - 1.0, 0.0)
            both = np.maximum(both, np.where(fits & (agreed > 0), agreed, -np.inf))
        best = int(np.argmax(both))
        start, stop = sorted((frame, int(at[best])))
        if not np.isfinite(both[best]) or any(
            c == channel and start < b and a < stop for c, a, b in steps
        ):
            continue
        steps.append((channel, start, stop))
        found.append((i, int(at[best]), float(both[best])))
    return found


def _edges_of_spikes(jumps: Jumps, channel: int) -> IntArray:
    """Where single wrong frames begin and end: what came back at once takes no other jump back."""
    spike = (jumps.channel == channel) & (jumps.length == 1) & (jumps.score >= CLEAR_SCORE)
    frames = jumps.frame[spike]
    return np.concatenate([frames, frames + 1])


def _jump_at(
    view: FloatArray, at: IntArray, reach: int, noise: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Size of a jump at every frame of one unbroken curve, and its standard error."""
    n = len(at)
    nowhere, everywhere = np.zeros(n, dtype=np.int64), np.full(n, len(view), dtype=np.int64)
    there = judge(view[:, None], nowhere, at, 0, reach, nowhere, everywhere)
    own = np.where(np.isfinite(there.unit), there.unit, 0.0) * noise
    return there.size, np.sqrt(there.error**2 + own**2 + FLOOR_MM**2)


def _beside(
    rest: FloatArray, seen: BoolArray, mates: IntArray, rows: slice, values: FloatArray
) -> FloatArray | None:
    """A coordinate beside what its neighbours' coordinates tell of it by least squares.

    An affine combination of four markers of a rigid body follows every motion of a fifth.
    """
    mates = mates[seen[rows][:, 3 * mates].all(axis=0)]
    if not len(mates) or len(values) < 4 * 3 * len(mates):
        return None
    inputs = rest[rows][:, (3 * mates[:, None] + np.arange(3)).ravel()]
    inputs = inputs - inputs.mean(axis=0)
    target = values - values.mean()
    gram = inputs.T @ inputs
    gram[np.diag_indices_from(gram)] += RIDGE * np.trace(gram) / len(gram) + 1e-9
    return np.asarray(target - inputs @ np.linalg.solve(gram, inputs.T @ target))
