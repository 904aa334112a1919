"""Jumps with a slow side: a marker slides off and jumps back, or jumps off and slides back.

A camera that is about to lose a marker draws it away little by little, and the marker jumps back
when another takes over; the other way round when a camera finds it again. Such damage has one
edge, so no second jump takes it back, and paired with a stranger it would seem to last for
seconds. skurowski2022 calls it “step changes followed by slow relaxing” and “slow error
accumulation followed by immediate correction” (section 4.2.2), and misses it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.detectors.joint.jumps import FLOOR_MM, Jumps, segments
from markermend.detectors.joint.shapes import ORDER

WINDOWS_S = (0.07, 0.11, 0.17)
"""What is looked at on either side of the jump."""
LENGTHS = (0.2, 0.28, 0.37, 0.47, 0.6, 0.8)
"""Slow sides tried, as parts of that window."""
LEAST_SIDE, LEAST_SPARE = 3, 4
FLEXIBLE = 3
"""More terms of the polynomial for motion that has no slow side."""
LEAST_EVIDENCE = 25.0
"""How much better than by a plain jump or by motion a window must be explained, in BIC."""
LEAST_SCORE, LEAST_JUMP_SCORE = 6.0, 7.0
LARGEST_MISMATCH = 0.3
LARGE = 0.25


@dataclass(frozen=True)
class Slide:
    """A jump with one or two slow sides.

    Attributes
    ----------
    jump : its position among the jumps
    before, after : frames the marker needs to slide off before the jump, and to slide back after
    size_mm : largest deviation
    score : that over its standard error
    """

    jump: int
    before: int
    after: int
    size_mm: float
    score: float


def find_slides(
    jumps: Jumps, own: BoolArray, signal: FloatArray, seen: BoolArray, rate: float
) -> list[Slide]:
    """Find jumps that are the sudden side of something slow.

    Parameters
    ----------
    jumps : all jumps and blocks
    own : (jumps,) bool, those that a marker's neighbours do not share
    signal : (frames, channels) mm, without NaN
    seen : (frames, channels) bool; no fit reaches into what was not seen
    rate : frames per second

    Returns
    -------
    Slides, at most one a jump. A slow side may end where the marker is lost.
    """
    begin, end = segments(seen)
    found = []
    for i in np.flatnonzero((jumps.length == 0) & (jumps.score >= LEAST_JUMP_SCORE) & own):
        channel, frame = int(jumps.channel[i]), int(jumps.frame[i])
        first, stop = int(begin[frame, channel]), int(end[frame, channel])
        best: tuple[float, Slide] | None = None
        for seconds in WINDOWS_S:
            half = max(round(seconds * rate), ORDER + LEAST_SPARE)
            a, b = max(first, frame - half), min(stop, frame + half)
            if frame - a < LEAST_SIDE or b - frame < LEAST_SIDE or b - a < 2 * ORDER + LEAST_SPARE:
                continue
            values = _without_others(jumps, int(i), signal[a:b, channel], a)
            one = _best(values - values[0], frame - a, half, float(jumps.size[i]))
            if one is not None and (best is None or one[0] > best[0]):
                evidence, before, after, size, score = one
                best = evidence, Slide(int(i), before, after, size, score)
        if best is not None:
            found.append(best[1])
    return found


def _best(
    values: FloatArray, edge: int, half: int, jump_mm: float
) -> tuple[float, int, int, float, float] | None:
    """The slow sides that explain a window best: evidence, frames before, after, mm, score."""
    window = len(values)
    # A slow side bends the curve; so may motion, with or without a plain jump.
    bends = [(_bend(window, at), ORDER + 1 + FLEXIBLE + (at < window)) for at in (edge, window)]
    plain = min(_criterion(values, projector, terms) for projector, terms in bends)

    def judged(before: int, after: int) -> float:
        terms = ORDER + 1 + (before > 0) + (after > 0)
        return _criterion(values, _projector(window, edge, before, after), terms)

    lengths = sorted({max(3, round(part * half)) for part in LENGTHS})
    first = min((n for n in lengths if n <= edge), key=lambda n: judged(n, 0), default=0)
    last = min((n for n in lengths if n <= window - edge), key=lambda n: judged(0, n), default=0)
    best: tuple[float, int, int] | None = None
    for before, after in ((first, 0), (0, last), (first, last)):
        if not before and not after:
            continue
        evidence = plain - judged(before, after)
        if evidence < LEAST_EVIDENCE or (best is not None and evidence <= best[0]):
            continue
        if _agrees(_solver(window, edge, before, after)[0] @ values, before, after, jump_mm):
            best = evidence, before, after
    if best is None:
        return None
    evidence, before, after = best
    weights, errors = _solver(window, edge, before, after)
    sizes = np.abs(weights @ values)
    misfit = _misfit(values, _projector(window, edge, before, after))
    spread = np.sqrt(misfit / (window - ORDER - 1 - len(sizes)))
    scores = sizes / (errors * spread)
    if scores.min() < LEAST_SCORE:
        return None
    return evidence, before, after, float(sizes.max()), float(scores.max())


def _agrees(sizes: FloatArray, before: int, after: int, jump_mm: float) -> bool:
    """Whether the slow sides are what the jump takes back, and no motion taken for one."""
    signed = (0.0 if not before else -float(sizes[0])) + (0.0 if not after else float(sizes[-1]))
    off = abs(signed - jump_mm) > LARGEST_MISMATCH * abs(jump_mm) + 0.3
    opposite = not (before and after) or sizes[0] * sizes[1] < 0
    return bool(opposite and not off)


def _without_others(jumps: Jumps, i: int, values: FloatArray, first: int) -> FloatArray:
    """A window of the signal without the other jumps and blocks that are large beside one."""
    cleaned = values.copy()
    near = (jumps.channel == jumps.channel[i]) & (jumps.frame < first + len(values))
    near &= (jumps.frame > first) & (np.abs(jumps.size) > LARGE * abs(jumps.size[i]))
    near[i] = False
    for k in np.flatnonzero(near):
        a, n = int(jumps.frame[k]) - first, int(jumps.length[k])
        cleaned[a : a + n if n else len(cleaned)] -= jumps.size[k]
    return cleaned


def _criterion(values: FloatArray, projector: FloatArray, terms: int) -> float:
    """Bayesian information criterion of a model."""
    window = len(values)
    return float(window * np.log(_misfit(values, projector)) + terms * np.log(window))


def _misfit(values: FloatArray, projector: FloatArray) -> float:
    """Sum of squares a model leaves over, with what no camera resolves added."""
    rest = projector.T @ values
    return float(rest @ rest) + len(values) * FLOOR_MM**2


def _design(window: int, edge: int, before: int, after: int) -> FloatArray:
    """Polynomial of smooth motion, and the slow sides of a jump, as columns."""
    place = (np.arange(window) - (window - 1) / 2) / (window / 2)
    columns = [np.vander(place, ORDER + 1)]
    frames = np.arange(window)
    if before:
        ramp = np.clip((frames - edge + 1 + before) / before, 0.0, 1.0)
        columns.append(np.where(frames < edge, ramp, 0.0)[:, None])
    if after:
        ramp = np.clip((edge + after - frames) / after, 0.0, 1.0)
        columns.append(np.where(frames >= edge, ramp, 0.0)[:, None])
    return np.hstack(columns)


@lru_cache(maxsize=4096)
def _projector(window: int, edge: int, before: int, after: int) -> FloatArray:
    """Orthonormal weights of what a model leaves over, (window, free)."""
    q, _ = np.linalg.qr(_design(window, edge, before, after), mode="complete")
    return np.asarray(q[:, ORDER + 1 + (before > 0) + (after > 0) :])


@lru_cache(maxsize=512)
def _bend(window: int, edge: int) -> FloatArray:
    """What a plain jump, if within the window, and a more flexible polynomial leave over."""
    place = (np.arange(window) - (window - 1) / 2) / (window / 2)
    jump = (np.arange(window) >= edge).astype(np.float64)[:, None]
    design = np.vander(place, ORDER + 1 + FLEXIBLE)
    if edge < window:
        design = np.hstack([design, jump])
    q, _ = np.linalg.qr(design, mode="complete")
    return np.asarray(q[:, design.shape[1] :])


@lru_cache(maxsize=512)
def _solver(window: int, edge: int, before: int, after: int) -> tuple[FloatArray, FloatArray]:
    """Weights of the sizes of the slow sides, and their errors for noise of 1."""
    weights = np.asarray(np.linalg.pinv(_design(window, edge, before, after))[ORDER + 1 :])
    return weights, np.asarray(np.linalg.norm(weights, axis=1))
