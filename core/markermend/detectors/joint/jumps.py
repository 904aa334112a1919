"""Jumps and short blocks on each coordinate, the clearest first, each taken out of the signal."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import convolve1d

from markermend.arrays import BoolArray, FloatArray, IntArray, runs
from markermend.detectors.joint.scale import jitter
from markermend.detectors.joint.shapes import Judged, judge

# The sixth difference, of unit gain for white noise: motion hardly reaches it, every edge does.
SIXTH = np.array([1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0]) / np.sqrt(924.0)
SCREEN = 3.0
"""An edge is looked at closely when the sixth difference is so many times the jitter."""
FLOOR_MM = 0.03
"""Added to every standard error: rounding, quantisation and filters leave some markers without
any noise of their own."""
PASSES = 3
CLEAR_SCORE = 7.5
"""What is as clear as this does not count for noise where others beside it are judged; what is
less may be motion that was taken for jumps."""


@dataclass(frozen=True, eq=False)
class Jumps:
    """Jumps and blocks, one entry each, in order of channel and frame.

    Attributes
    ----------
    channel, frame : (n,) coordinate, and first frame after the jump
    length : (n,) frames of a block; 0 for a jump that does not come back soon
    size : (n,) signed, mm
    score : (n,) size over its standard error
    """

    channel: IntArray
    frame: IntArray
    length: IntArray
    size: FloatArray
    score: FloatArray

    def __len__(self) -> int:
        return len(self.channel)

    def take(self, which: BoolArray | IntArray) -> Jumps:
        """Some of them."""
        return Jumps(
            self.channel[which],
            self.frame[which],
            self.length[which],
            self.size[which],
            self.score[which],
        )


def reach_at(rate: float) -> int:
    """Frames a fit looks at on either side: 6 up to 120 Hz, 0.05 s above."""
    return max(6, round(0.05 * rate))


def find_jumps(
    signal: FloatArray, seen: BoolArray, rate: float, *, least_score: float, longest: int
) -> tuple[Jumps, FloatArray]:
    """Find jumps and blocks.

    Parameters
    ----------
    signal : (frames, channels) mm, without NaN
    seen : (frames, channels) bool; no fit reaches into what was not seen
    rate : frames per second
    least_score : smallest size over its standard error
    longest : longest block, in frames; beyond, its two edges are jumps

    Returns
    -------
    the jumps, and the signal (frames, channels) without them
    """
    rest = signal.copy(order="F")
    begin, end = segments(seen)
    reach = reach_at(rate)
    noise = jitter(sixth_difference(signal), seen, rate)
    found, where = _none(), seen
    for _ in range(PASSES):
        new = _one_pass(rest, where, begin, end, noise, reach, least_score, longest)
        if not len(new):
            break
        where = np.zeros_like(seen)
        for i, (c, f, n) in enumerate(zip(new.channel, new.frame, new.length, strict=True)):
            _push(rest, new, i, end, -1.0)
            # Elsewhere nothing has changed.
            where[max(0, f - 2 * reach) : f + n + 2 * reach, c] = True
        where &= seen
        found = _merged(found, new)
    found = _judged_again(found, rest, begin, end, noise, reach)
    order = np.lexsort((found.frame, found.channel))
    return found.take(order), rest


def sixth_difference(signal: FloatArray) -> FloatArray:
    """High pass of unit gain for white noise, (frames, channels)."""
    return np.asarray(convolve1d(signal, SIXTH, axis=0, mode="nearest"))


def segments(seen: BoolArray) -> tuple[IntArray, IntArray]:
    """First frame, and the frame behind the last, of the unbroken run each sample lies in.

    Parameters
    ----------
    seen : (frames, channels) bool

    Returns
    -------
    Two (frames, channels) int64; equal where the sample was not seen.
    """
    frames, channels = seen.shape
    begin = np.zeros((frames, channels), dtype=np.int64)
    end = np.full((frames, channels), frames, dtype=np.int64)
    for channel in np.flatnonzero(~seen.all(axis=0)):
        begin[:, channel] = end[:, channel] = 0
        for a, b in runs(seen[:, channel]):
            begin[a:b, channel], end[a:b, channel] = a, b
    return begin, end


def _one_pass(
    signal: FloatArray,
    where: BoolArray,
    begin: IntArray,
    end: IntArray,
    noise: FloatArray,
    reach: int,
    least_score: float,
    longest: int,
) -> Jumps:
    """The jumps that stand out most within their reach."""
    change = np.abs(sixth_difference(signal))
    frame, channel = np.nonzero((change > SCREEN * noise + FLOOR_MM / 3) & where)
    # The sixth difference of an edge is largest within three frames of it.
    near = np.zeros(signal.shape, dtype=bool)
    for shift in range(-2, 4):
        at = frame + shift
        inside = (at > 0) & (at < len(signal))
        near[at[inside], channel[inside]] = True
    frame, channel = np.nonzero(near & where)
    first, stop = begin[frame, channel], end[frame, channel]
    level = noise[frame, channel]
    candidates = []
    for length in range(longest + 1):
        judged = judge(signal, channel, frame, length, reach, first, stop)
        score = np.abs(judged.size) / _error(judged, level)
        keep = score >= least_score
        candidates.append(
            Jumps(
                channel[keep],
                frame[keep],
                np.full(int(keep.sum()), length, dtype=np.int64),
                judged.size[keep],
                score[keep],
            )
        )
    return _clearest(_joined(candidates), reach)


def _judged_again(
    found: Jumps,
    rest: FloatArray,
    begin: IntArray,
    end: IntArray,
    noise: FloatArray,
    reach: int,
) -> Jumps:
    """With the scores that they have once the clear ones beside them are gone, where higher."""
    score, faint = found.score.copy(), found.score < CLEAR_SCORE
    signal = rest.copy(order="F")
    for i in np.flatnonzero(faint):
        _push(signal, found, int(i), end, 1.0)
    for length in np.unique(found.length):
        at = np.flatnonzero(found.length == length)
        channel, frame = found.channel[at], found.frame[at]
        first, stop = begin[frame, channel], end[frame, channel]
        judged = judge(signal, channel, frame, int(length), reach, first, stop)
        # A shape that is put back changes the fit's size, and nothing of what it leaves.
        size = np.where(faint[at], 0.0, found.size[at]) + judged.size
        again = np.abs(size) / _error(judged, noise[frame, channel])
        score[at] = np.maximum(again, score[at])
    return Jumps(found.channel, found.frame, found.length, found.size, score)


def _push(signal: FloatArray, jumps: Jumps, i: int, end: IntArray, sign: float) -> None:
    """Add one jump to a signal, in place."""
    channel, frame, length = int(jumps.channel[i]), int(jumps.frame[i]), int(jumps.length[i])
    stop = frame + length if length else int(end[frame, channel])
    signal[frame:stop, channel] += sign * jumps.size[i]


def _error(judged: Judged, level: FloatArray) -> FloatArray:
    """Standard error: from the window itself, from the long run, and a floor."""
    own = np.where(np.isfinite(judged.unit), judged.unit, 0.0) * level
    return np.asarray(np.sqrt(judged.error**2 + own**2 + FLOOR_MM**2))


def _clearest(jumps: Jumps, reach: int) -> Jumps:
    """Of those that lie within each other's windows only the one with the highest score."""
    order = np.argsort(-jumps.score, kind="stable")
    taken: dict[int, list[tuple[int, int]]] = {}
    kept = []
    for i in order:
        a, b = int(jumps.frame[i]), int(jumps.frame[i] + jumps.length[i])
        others = taken.setdefault(int(jumps.channel[i]), [])
        if all(b + reach <= x or a - reach >= y for x, y in others):
            others.append((a, b))
            kept.append(i)
    return jumps.take(np.array(kept, dtype=np.int64))


def _none() -> Jumps:
    """No jumps."""
    nowhere = np.zeros(0, dtype=np.int64)
    return Jumps(nowhere, nowhere, nowhere, np.zeros(0), np.zeros(0))


def _joined(parts: list[Jumps]) -> Jumps:
    """All of several."""
    return Jumps(
        np.concatenate([p.channel for p in parts]),
        np.concatenate([p.frame for p in parts]),
        np.concatenate([p.length for p in parts]),
        np.concatenate([p.size for p in parts]),
        np.concatenate([p.score for p in parts]),
    )


def _merged(old: Jumps, new: Jumps) -> Jumps:
    """Old and new; what touches up an old one at the same place only corrects its size."""
    known = {
        (int(c), int(f), int(n)): i
        for i, (c, f, n) in enumerate(zip(old.channel, old.frame, old.length, strict=True))
    }
    size, fresh = old.size.copy(), []
    for j, key in enumerate(zip(new.channel, new.frame, new.length, strict=True)):
        i = known.get((int(key[0]), int(key[1]), int(key[2])))
        if i is None:
            fresh.append(j)
        else:
            size[i] += new.size[j]
    corrected = Jumps(old.channel, old.frame, old.length, size, old.score)
    return _joined([corrected, new.take(np.array(fresh, dtype=np.int64))])
