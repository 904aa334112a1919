"""Steps: a jump, and later a jump back of about the same size."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from markermend.detectors.joint.jumps import Jumps

LONGEST_S = 2.0
# What comes back differs by noise, and by the way the marker turns meanwhile.
LARGEST_MISMATCH = 0.35
LONG_S, LONG_MISMATCH = 0.8, 0.15
"""From here on strangers meet by chance, and what comes back must be as large as what went."""
LONE_MISMATCH = 0.1
STRONG_SCORE, STRONG_MM = 15.0, 10.0
"""Jumps that can be nothing else, as those of a swap: they may return far off, and late."""
LONGEST_STRONG_S = 10.0
SHORT_S = 0.3
"""From here on, others that jump as far in between make it doubtful that two belong together."""


def pair_jumps(
    jumps: Jumps, rate: float, explained: Collection[int] = (), lone: Collection[int] = ()
) -> list[tuple[int, int, float]]:
    """Pair jumps with the jumps that take them back, the surest pair first.

    Parameters
    ----------
    jumps : in order of channel and frame; blocks are passed over
    rate : frames per second
    explained : jumps that need no other to take them back
    lone : jumps with a single frame of the marker on one side. That frame may as well be wrong by
        itself, so they only take back what is as large

    Returns
    -------
    (i, j, score) of each pair, i before j, the shorter first of equals: indices into ``jumps``,
    and the geometric mean of both scores, less what they differ in standard errors. No jump is
    in two pairs, no pair overlaps another of its channel.
    """
    alone = [int(i) for i in np.flatnonzero(jumps.length == 0) if int(i) not in explained]
    usual, longest = LONGEST_S * rate, LONGEST_STRONG_S * rate
    pairs: list[tuple[float, int, int, int]] = []
    for n, i in enumerate(alone):
        for j in alone[n + 1 :]:
            if jumps.channel[j] != jumps.channel[i] or jumps.frame[j] - jumps.frame[i] > longest:
                break
            if (i in lone or j in lone) and not _as_large(jumps, i, j, LONE_MISMATCH):
                continue
            score = _pair_score(jumps, i, j)
            if jumps.frame[j] - jumps.frame[i] > SHORT_S * rate:
                score /= 1 + _rivals(jumps, i, j)
            apart = jumps.frame[j] - jumps.frame[i]
            near = apart <= usual and (
                apart <= LONG_S * rate or _as_large(jumps, i, j, LONG_MISMATCH)
            )
            if score > 0 and (near or _strong(jumps, i, j)):
                pairs.append((-score, int(jumps.frame[j] - jumps.frame[i]), i, j))
    used: set[int] = set()
    taken: dict[int, list[tuple[int, int]]] = {}
    kept: list[tuple[int, int, float]] = []
    for minus_score, _, i, j in sorted(pairs):
        a, b = int(jumps.frame[i]), int(jumps.frame[j])
        others = taken.setdefault(int(jumps.channel[i]), [])
        if i in used or j in used or any(a < y and x < b for x, y in others):
            continue
        used |= {i, j}
        others.append((a, b))
        kept.append((i, j, -minus_score))
    return kept


def _rivals(jumps: Jumps, i: int, j: int) -> int:
    """Jumps and blocks between two of a channel that are at least half as large."""
    between = np.abs(jumps.size[i + 1 : j])
    return int((between >= 0.5 * min(abs(jumps.size[i]), abs(jumps.size[j]))).sum())


def _pair_score(jumps: Jumps, i: int, j: int) -> float:
    """Mean score of two opposite jumps, less their difference in standard errors."""
    a, b = float(jumps.size[i]), float(jumps.size[j])
    larger = max(abs(a), abs(b))
    if a * b >= 0:
        return 0.0
    if abs(a + b) > LARGEST_MISMATCH * larger + 0.3:
        # Any better match comes first.
        smaller = float(min(jumps.score[i], jumps.score[j]))
        return 0.5 * smaller if _strong(jumps, i, j) else 0.0
    error = np.hypot(a / jumps.score[i], b / jumps.score[j])
    both = np.sqrt(jumps.score[i] * jumps.score[j])
    return float(both - max(0.0, abs(a + b) / error - 2.0))


def _as_large(jumps: Jumps, i: int, j: int, mismatch: float) -> bool:
    """Whether two jumps add up to no more than this share of the larger."""
    a, b = float(jumps.size[i]), float(jumps.size[j])
    return bool(abs(a + b) <= mismatch * max(abs(a), abs(b)) + 0.3)


def _strong(jumps: Jumps, i: int, j: int) -> bool:
    """Whether both jumps are large and clear beyond doubt."""
    return bool(
        min(jumps.score[i], jumps.score[j]) >= STRONG_SCORE
        and min(abs(jumps.size[i]), abs(jumps.size[j])) >= STRONG_MM
    )
