"""From what is wrong on coordinates to artifacts: axes of a marker joined, put into words."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

import numpy as np

from markermend.arrays import FloatArray
from markermend.artifact import Artifact, Kind
from markermend.detectors.finding import how_long, in_mm, overlap
from markermend.detectors.joint.sudden import Course, Sudden
from markermend.take import AXES, Take

SAME = 0.5
"""Intervals on two axes are one artifact when they share this much of their union."""
FAINT = 0.2
"""What is as sure as this counts where another axis of the marker is surely wrong as well."""

NOTICED = 0.05
"""What the neighbours jump is told from this share of the marker's own jump on."""


def to_artifacts(
    take: Take,
    markers: Sequence[int],
    found: Sequence[Sudden],
    confidence: FloatArray,
    least: float,
) -> list[Artifact]:
    """Join what is wrong on the axes of one marker, and say why.

    Parameters
    ----------
    take : the recording
    markers : columns of the take, in the order the channels of ``found`` count
    found : sudden artifacts of single coordinates
    confidence : (n,) of each
    least : smallest confidence of an artifact, that of its surest axis

    Returns
    -------
    Artifacts in no particular order. Each spans its axes' intervals and has the confidence of
    the surest and the amplitude of all (root of summed squares).
    """
    order = np.lexsort((-confidence, np.array([s.channel // 3 for s in found], dtype=np.int64)))
    artifacts = []
    for marker, same in groupby(order, key=lambda i: found[i].channel // 3):
        groups: list[list[int]] = []
        for i in same:
            home = next((g for g in groups if _belongs(found[i], [found[k] for k in g])), None)
            if home is not None and confidence[i] >= min(FAINT, least):
                home.append(int(i))
            elif home is None and confidence[i] >= least:
                groups.append([int(i)])
        for group in groups:
            sure = float(confidence[group].max())
            artifacts.append(_artifact(take, markers[marker], [found[i] for i in group], sure))
    return artifacts


def _belongs(one: Sudden, group: Sequence[Sudden]) -> bool:
    """Whether it is the same artifact on another axis."""
    first = group[0]
    return (
        all(one.channel != other.channel for other in group)
        and one.kind is first.kind
        and overlap((one.start, one.stop), (first.start, first.stop)) >= SAME
    )


def _artifact(take: Take, marker: int, group: Sequence[Sudden], confidence: float) -> Artifact:
    """One artifact for the same damage on some axes of a marker."""
    start, stop = min(s.start for s in group), max(s.stop for s in group)
    size = float(np.sqrt(sum(s.size_mm**2 for s in group)))
    return Artifact(
        marker=take.labels[marker],
        axes="".join(AXES[axis] for axis in sorted(s.channel % 3 for s in group)),
        start=start,
        stop=stop,
        kind=group[0].kind,
        confidence=confidence,
        amplitude_mm=size,
        why=_explain(group, size, stop - start, take.rate, alone=_alone(take, marker, start, stop)),
    )


def _alone(take: Take, marker: int, start: int, stop: int) -> bool:
    """Whether no other marker is seen then, which could move along or not."""
    seen = ~np.isnan(take.positions[max(start - 1, 0) : stop + 1, :, 0])
    seen[:, marker] = False
    return not seen.any()


def _explain(group: Sequence[Sudden], size: float, length: int, rate: float, *, alone: bool) -> str:
    """The evidence in one sentence."""
    surest = max(group, key=lambda s: s.score)
    lasting, mm = how_long(length, rate), in_mm(size)
    if surest.kind is Kind.NOISE:
        calm = "" if alone else "; its neighbours are calm"
        return (
            f"jitters by about {mm} mm for {lasting}, {6 * surest.score:.0f} times its usual{calm}"
        )
    beside = ", its neighbours do not"
    if surest.beside_mm >= NOTICED * size:
        beside = f", its neighbours by {in_mm(surest.beside_mm)} mm"
    # What fell off is known by its neighbours, wherever they are seen.
    alone = alone and surest.course is not Course.FALLEN
    beside, then = ("", " and") if alone else (beside, ", and")
    clear = f"{surest.score:.0f} times its usual scatter"
    if surest.course is Course.CUT_OFF:
        return f"lies {mm} mm off for {lasting} beside a gap or an end, one jump away; {clear}"
    if surest.kind is Kind.PEAK:
        return f"sticks out by {mm} mm for {lasting}{beside}; {clear}"
    if surest.course is Course.FALLEN:
        return (
            f"jumps {mm} mm in one frame{beside}{then} stays off for {lasting}, up to an end of "
            f"the take, at another distance from them: it moved on the body or fell off; {clear}"
        )
    if surest.course is Course.BUILDS_UP:
        return f"slides {mm} mm off within {lasting} and jumps back{beside}; {clear}"
    if surest.course is Course.RELAXES:
        return f"jumps {mm} mm in one frame{beside}{then} slides back within {lasting}; {clear}"
    if surest.course is Course.OVERSHOOTS:
        return (
            f"slides {mm} mm off, jumps past its course and slides back, {lasting} in all; {clear}"
        )
    return f"jumps {mm} mm in one frame{beside}{then} comes back {lasting} later; {clear}"
