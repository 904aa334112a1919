"""Step changes: a jump, and some time later the jump back.

Section 3.4.4 of skurowski2022. Its ``find_derivate_pairs`` is described in words only; this is
our reading of it. A jump rings in the high pass for half a filter window to either side, so of
the differentials above the threshold only those count that are the largest within that reach.
A pair are two of them with opposite signs, no nearer than the shortest and no farther than the
longest step, and the smaller at least two thirds of the larger, since a step comes back as far as
it went. The largest jump chooses its opponent first. A jump taken back within a few frames has its
opponent there, nearer than the shortest step: it is the flank of a peak that an earlier stage
left, and does not count. Without this precision falls from 100 to 68 % on a calm take, and to a
tenth on lively ones; the paper's was 73 to 88 %.
"""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.artifact import Kind
from markermend.detectors.channels import judged, thresholds
from markermend.detectors.finding import Finding
from markermend.detectors.highpass import scaled, scaled_odd
from markermend.detectors.morphology import dilate
from markermend.detectors.noise import high_passed_differential
from markermend.detectors.params import PaperParams

# A step comes back about as far as it went; noise adds to both jumps.
LEAST_BALANCE = 2 / 3
# The ringing of a lone jump reaches 0.43 of it at the default filter.
LARGEST_RINGING = 0.6


def find_steps(
    signal: FloatArray, seen: BoolArray, rate: float, params: PaperParams
) -> list[Finding]:
    """Find step changes on each channel.

    Parameters
    ----------
    signal : (frames, channels) mm, without NaN, clear of peaks and heavy noise
    seen : (frames, channels) bool; both jumps are seen, and most of what lies between
    rate : frames per second
    params : ``step_*``, ``savgol_*`` and ``confirm``

    Returns
    -------
    Findings whose ratio is that of the smaller jump to the threshold and whose amplitude is the
    mean of both jumps.
    """
    valid = judged(seen)
    change = high_passed_differential(signal, valid, rate, params)
    threshold = thresholds(params.step_k, change, valid, confirm=params.confirm)
    window = scaled_odd(params.savgol_window, rate, least=params.savgol_order + 2)
    magnitude = np.abs(change)
    jumps = (magnitude > threshold) & (magnitude >= dilate(magnitude, window))
    jumps &= ~_flanks(change, 2 * scaled(params.peak_size, rate) + 1)

    shortest, longest = scaled(params.step_length, rate), scaled(params.step_distance, rate)
    found = []
    for channel in np.flatnonzero(jumps.sum(axis=0) >= 2):
        at = np.flatnonzero(jumps[:, channel]).astype(np.int64)
        for i, j in find_derivate_pairs(at, change[at, channel], shortest, longest):
            start, stop = int(at[i]), int(at[j])
            if seen[start:stop, channel].mean() <= 0.5:
                continue
            smaller = magnitude[[start, stop], channel].min()
            jump = 0.5 * (_jump(signal[:, channel], start) + _jump(signal[:, channel], stop))
            found.append(
                Finding(
                    int(channel), start, stop, Kind.STEP, float(smaller / threshold[channel]), jump
                )
            )
    return found


def find_derivate_pairs(
    at: IntArray, change: FloatArray, shortest: int, longest: int
) -> list[tuple[int, int]]:
    """Pair jumps with their opponents.

    Parameters
    ----------
    at : (n,) frames of the jumps, ascending
    change : (n,) their signed size
    shortest, longest : bounds of the distance between the two of a pair, in frames

    Returns
    -------
    Pairs (i, j), i < j, of indices into ``at``, in order of i; no jump is in two pairs and no
    pair overlaps another.
    """
    free = np.ones(len(at), dtype=bool)
    pairs: list[tuple[int, int]] = []
    size = np.abs(change)
    for i in np.argsort(-size, kind="stable"):
        if not free[i]:
            continue
        distance = np.abs(at - at[i])
        fits = (
            free
            & (change * change[i] < 0)
            & (distance >= shortest)
            & (distance <= longest)
            & (size >= LEAST_BALANCE * size[i])
            & (size * LEAST_BALANCE <= size[i])
        )
        for j in np.flatnonzero(fits)[np.argsort(-size[fits], kind="stable")]:
            first, last = int(min(i, j)), int(max(i, j))
            if all(at[last] <= at[a] or at[first] >= at[b] for a, b in pairs):
                pairs.append((first, last))
                free[[i, j]] = False
                break
    return sorted(pairs)


def _flanks(change: FloatArray, window: int) -> BoolArray:
    """Jumps that are taken back within a few frames: flanks of a peak left over."""
    up, down = np.maximum(change, 0.0), np.maximum(-change, 0.0)
    return np.where(
        change > 0,
        dilate(down, window) > LARGEST_RINGING * up,
        dilate(up, window) > LARGEST_RINGING * down,
    )


def _jump(x: FloatArray, frame: int) -> float:
    """Size of a jump into ``frame``, less the motion of the frames around it."""
    around = [x[n] - x[n - 1] for n in (frame - 1, frame + 1) if 0 < n < len(x)]
    return float(abs(x[frame] - x[frame - 1] - np.mean(around)))
