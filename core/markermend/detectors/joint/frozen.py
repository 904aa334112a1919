"""Frozen stretches: a marker repeats its position, sample by sample, while the body moves on.

Some systems write the last known position of a marker they lost, or of all when the recording
stalls. Cameras never measure the same to the last digit, but rounding repeats what rests, so
that repetition alone proves nothing: the body must say that the marker moved, and the marker
must jump when it is seen again.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray, runs
from markermend.artifact import Artifact, Kind
from markermend.detectors.finding import how_long, in_mm
from markermend.detectors.joint.body import belief, beside_body
from markermend.take import AXES, Take

LEAST_FRAMES, LEAST_S = 4, 0.05
MOVED_MM = 5.0
"""Neighbours that move less in that time say nothing."""
LEAST_MM, TIMES_USUAL = 5.0, 3.0
BACK = 0.5
"""Share of the deviation by which the marker jumps when it is seen again."""
ALL_S, ALL_MARKERS, ELSEWHERE = 0.25, 3, 0.01
"""A recording stands still when so many markers repeat so long; not where that is usual."""
REST_MM_S = 50.0
"""A body that hardly moves shows whether rounding alone makes it repeat."""
SURE_OF_ALL = 0.9


def find_frozen(
    take: Take, markers: Sequence[int], neighbours: IntArray, trusted: BoolArray
) -> list[Artifact]:
    """Find markers that repeat one position while they should move.

    Parameters
    ----------
    take : the recording
    markers : columns looked at
    neighbours : (len(markers), k) positions in ``markers`` of the nearest others
    trusted : (frames, markers of the take) bool, samples to be believed

    Returns
    -------
    Steps of all axes, from the first repeated sample on
    """
    x = take.positions[:, markers]
    repeats = np.zeros(x.shape[:2], dtype=bool)
    repeats[1:] = (x[1:] == x[:-1]).all(axis=2)
    still = _still(x, repeats, take.rate)
    found = []
    least = max(LEAST_FRAMES, round(LEAST_S * take.rate))
    for i, marker in enumerate(markers):
        for start, stop in runs(repeats[:, i]).tolist():
            one = None
            if still[start:stop].any():
                one = _standing(take, marker, start, stop)
            elif stop - start >= least:
                mates = neighbours[i]
                moved = np.linalg.norm(x[stop - 1, mates] - x[start - 1, mates], axis=1)
                far = float(np.nanmedian(moved)) if np.isfinite(moved).any() else 0.0
                if far >= MOVED_MM:
                    one = _frozen(take, marker, start, stop, trusted, far)
            found += [] if one is None else [one]
    return found


def _still(x: FloatArray, repeats: BoolArray, rate: float) -> BoolArray:
    """(frames,) bool: where every marker repeats for long, unless that is how the take rests."""
    seen = ~np.isnan(x[:, :, 0])
    all_repeat = (repeats == seen).all(axis=1) & (seen.sum(axis=1) >= ALL_MARKERS)
    still = np.zeros_like(all_repeat)
    for start, stop in runs(all_repeat):
        if stop - start >= ALL_S * rate:
            still[start:stop] = True
    usual = (all_repeat & ~still).sum() > ELSEWHERE * max(1, (~still).sum())
    speed = np.linalg.norm(np.diff(x, axis=0), axis=2) * rate
    slow = (speed < REST_MM_S).sum(axis=1) > 0.5 * np.isfinite(speed).sum(axis=1)
    at_rest = (slow & ~all_repeat[1:] & ~still[1:]).sum()
    return np.zeros_like(still) if usual or at_rest < ALL_S * rate else still


def _standing(take: Take, marker: int, start: int, stop: int) -> Artifact:
    """A stretch in which everything repeats."""
    why = (
        f"repeats one position for {how_long(stop - start, take.rate)}, as every marker does: "
        "the recording stands still"
    )
    return Artifact(take.labels[marker], AXES, start, stop, Kind.STEP, SURE_OF_ALL, why=why)


def _frozen(
    take: Take, marker: int, start: int, stop: int, trusted: BoolArray, moved_mm: float
) -> Artifact | None:
    """A stretch that repeats, if the body moves on and the marker jumps at its end."""
    believed = trusted.copy()
    believed[start:stop, marker] = False
    beside = beside_body(take, marker, start, stop, believed)
    if beside is None:
        return None
    size, after = beside.size_mm, take.positions[stop : stop + 1, marker]
    jump = np.linalg.norm(after - take.positions[stop - 1, marker])
    back = not len(after) or np.isnan(jump) or jump >= BACK * size
    if not back or size < LEAST_MM or size < TIMES_USUAL * beside.usual_mm:
        return None
    return Artifact(
        take.labels[marker],
        AXES,
        start,
        stop,
        Kind.STEP,
        confidence=belief(size / beside.usual_mm, TIMES_USUAL),
        amplitude_mm=size,
        why=(
            f"repeats one position for {how_long(stop - start, take.rate)} while its neighbours "
            f"move {in_mm(moved_mm)} mm; in the end it is {in_mm(size)} mm off"
        ),
    )
