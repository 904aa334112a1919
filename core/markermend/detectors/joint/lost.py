"""The last frames before a marker is lost, and the first after it is found again.

Half hidden, a marker is seen by fewer cameras, and drifts off for some frames until it is gone. No
jump shows that, for what would take it back is not seen. What shows it is that the marker leaves
its place among its neighbours, which there moves little within so short a time.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from markermend.arrays import BoolArray, FloatArray, runs
from markermend.artifact import Artifact, Kind
from markermend.detectors.finding import how_long, in_mm
from markermend.detectors.joint.body import belief, beside_body
from markermend.take import AXES, Take

LONGEST_S, FIT_S, NEAR_S = 0.035, 0.07, 0.35
"""Time beside a gap that may be wrong, what leads there, and what says how well."""
OWN_MM, OWN_TIMES = 1.5, 2.0
"""How far off its own course a marker must be at the gap, and how many times the usual."""
USUAL = 0.9
"""Quantile of how far it usually is."""
LEAST_MM, TIMES_USUAL = 2.5, 1.5
"""How far from where its neighbours put it, and how many times what is usual around."""
ALIKE = 0.4
"""Share that it leaves its own course at least, of how far it leaves its neighbours, or they of it:
where these put it wrongly altogether, it goes on as before."""
SHARE = 0.3
"""Of the largest deviation, what still counts as off."""


def find_lost(take: Take, markers: Sequence[int], trusted: BoolArray) -> list[Artifact]:
    """Find samples beside gaps that went astray.

    Parameters
    ----------
    take : the recording
    markers : columns looked at
    trusted : (frames, markers of the take) bool, samples to be believed

    Returns
    -------
    Peaks of all axes that end, or begin, at a gap
    """
    longest, fit = max(2, round(LONGEST_S * take.rate)), max(6, round(FIT_S * take.rate))
    course = _course(fit, longest)
    found = []
    for marker in markers:
        x = take.positions[:, marker]
        for start, stop in runs(take.present[:, marker]).tolist():
            for at_end, inside in ((False, start > 0), (True, stop < take.frames)):
                piece = x[start:stop] if at_end else x[start:stop][::-1]
                # What is found there already reaches up to the gap.
                inside = inside and trusted[stop - 1 if at_end else start, marker]
                own = _astray(piece, course, take.rate) if inside else 0.0
                if not own:
                    continue
                a, b = (stop - longest, stop) if at_end else (start, start + longest)
                believed = trusted.copy()
                believed[a:b, marker] = False
                beside = beside_body(take, marker, a, b, believed)
                if beside is None:
                    continue
                off = np.linalg.norm(beside.deviation, axis=1)[:: 1 if at_end else -1]
                size, ratio = float(off[-1]), float(off[-1] / beside.usual_mm)
                wrong = _from_gap(off > np.maximum(SHARE * size, 0.5 * beside.usual_mm))
                alike = ALIKE * size <= own <= size / ALIKE
                if not (size >= LEAST_MM and ratio >= TIMES_USUAL and alike):
                    continue
                a, b = (stop - wrong, stop) if at_end else (start, start + wrong)
                when = "before it is lost" if at_end else "after it is found again"
                found.append(
                    Artifact(
                        take.labels[marker],
                        AXES,
                        a,
                        b,
                        Kind.PEAK,
                        confidence=belief(ratio, TIMES_USUAL),
                        amplitude_mm=size,
                        why=(
                            f"strays {in_mm(size)} mm from where its neighbours put it in the "
                            f"{how_long(wrong, take.rate)} {when}"
                        ),
                    )
                )
    return found


def with_lost(sudden: Sequence[Artifact], lost: Sequence[Artifact]) -> list[Artifact]:
    """Sudden artifacts with those beside gaps: peaks become part of them, and they of noise."""
    kept = list(sudden)
    for one in lost:
        beside = [
            a for a in kept if a.marker == one.marker and a.overlaps(one.start - 1, one.stop + 1)
        ]
        noise = next((a for a in beside if a.kind is Kind.NOISE), None)
        same = [a for a in beside if a.kind is Kind.PEAK or a is noise]
        start = min([one.start, *(a.start for a in same)])
        stop = max([one.stop, *(a.stop for a in same)])
        whole = replace(noise or one, start=start, stop=stop)
        kept = [*(a for a in kept if a not in same), whole]
    return kept


def _course(fit: int, ahead: int) -> FloatArray:
    """(ahead, fit) weights that lead a parabola on beyond the frames it is fitted to."""
    time = np.arange(fit + ahead) - fit
    design = np.vander(time, 3).astype(np.float64)
    return np.asarray(design[fit:] @ np.linalg.pinv(design[:fit]))


def _astray(piece: FloatArray, course: FloatArray, rate: float) -> float:
    """How far off its own course a trajectory ends at a gap, mm; 0 where that is nothing unusual.

    Cheap, so it comes before the body is asked.
    """
    ahead, fit = course.shape
    piece = piece[-(fit + 2 * ahead + round(NEAR_S * rate)) :]
    if len(piece) < fit + 2 * ahead:
        return 0.0
    windows = sliding_window_view(piece, fit + ahead, axis=0)
    off = np.linalg.norm(windows[:, :, -1] - windows[:, :, :fit] @ course[-1], axis=1)
    usual = float(np.quantile(off[:-ahead], USUAL)) if len(off) > ahead else np.inf
    return float(off[-1]) if off[-1] >= max(OWN_MM, OWN_TIMES * usual) else 0.0


def _from_gap(wrong: BoolArray) -> int:
    """How many frames in a row are wrong up to the gap, which is behind the last."""
    right = np.flatnonzero(~wrong)
    return len(wrong) if not len(right) else len(wrong) - 1 - int(right[-1])
