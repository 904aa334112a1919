"""Ghosts: a few stray frames inside a gap, far from where the body puts the marker.

While a marker is hidden, a reflection or another marker is taken for it for some frames. With
gaps on both sides no jump shows it; only the rest of the body does.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.arrays import BoolArray, FloatArray, runs
from markermend.artifact import Artifact, Kind
from markermend.detectors.finding import how_long, in_mm
from markermend.detectors.joint.body import belief, beside_body
from markermend.take import AXES, Take

LONGEST_S = 0.1
LEAST_GAP_S = 0.02
LEAST_MM, TIMES_USUAL = 10.0, 3.0


def find_strays(take: Take, markers: Sequence[int], trusted: BoolArray) -> list[Artifact]:
    """Find stray pieces inside gaps.

    Parameters
    ----------
    take : the recording
    markers : columns looked at
    trusted : (frames, markers of the take) bool, samples to be believed; pieces of which none is
        are known already

    Returns
    -------
    Steps of all axes, a whole piece each: with gaps beside it no curve can be drawn through
    """
    found = []
    longest, gap = LONGEST_S * take.rate, max(2, round(LEAST_GAP_S * take.rate))
    for marker in markers:
        pieces = runs(take.present[:, marker]).tolist()
        for (_, before), (start, stop), (after, _) in zip(
            pieces, pieces[1:], pieces[2:], strict=False
        ):
            hidden = (start - before, after - stop)
            known = not trusted[start:stop, marker].any()
            if stop - start > longest or min(hidden) < gap or known:
                continue
            if _off_line(take.positions[:, marker], before, start, stop, after) < LEAST_MM:
                continue
            believed = trusted.copy()
            believed[start:stop, marker] = False
            beside = beside_body(take, marker, start, stop, believed)
            if beside is None:
                continue
            ratio = beside.size_mm / beside.usual_mm
            if beside.size_mm < LEAST_MM or ratio < TIMES_USUAL:
                continue
            found.append(
                Artifact(
                    take.labels[marker],
                    AXES,
                    start,
                    stop,
                    Kind.STEP,
                    confidence=belief(ratio, TIMES_USUAL),
                    amplitude_mm=beside.size_mm,
                    why=(
                        f"seen for {how_long(stop - start, take.rate)} inside a gap, "
                        f"{in_mm(beside.size_mm)} mm from where its neighbours put it; "
                        f"around the gap that is {in_mm(beside.usual_mm)} mm"
                    ),
                )
            )
    return found


def _off_line(x: FloatArray, before: int, start: int, stop: int, after: int) -> float:
    """How far a piece is at most from the line across both gaps, mm; cheap, so it comes first."""
    share = (np.arange(start, stop) - before + 1) / (after - before + 1)
    line = x[before - 1] + share[:, None] * (x[after] - x[before - 1])
    return float(np.linalg.norm(x[start:stop] - line, axis=1).max())
