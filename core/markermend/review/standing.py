"""How a take under review stands: marker by marker, what is missing, open, decided and mended."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from markermend.arrays import IntArray
from markermend.artifact import Artifact, Kind, Status, changed_markers
from markermend.review.edits import RepairNote
from markermend.take import Origin, Take


@dataclass(frozen=True)
class Standing:
    """How one marker stands, or the whole take.

    Attributes
    ----------
    marker : its label; empty for the whole take
    gap_before, gap_now : share in [0, 1] of samples missing in the file, and as it stands
    mended : share in [0, 1] of samples that were filled or edited
    open, decided : artifacts by class; what has no class has none
    mean_mm, worst_mm : expected error of its repairs, each counted by its length, and the largest;
        None where none is known
    """

    marker: str
    gap_before: float
    gap_now: float
    mended: float
    open: Mapping[Kind, int]
    decided: Mapping[Kind, int]
    mean_mm: float | None
    worst_mm: float | None


def standings(
    original: Take,
    take: Take,
    artifacts: Iterable[Artifact],
    notes: Mapping[str, RepairNote],
    region: tuple[int, int] | None = None,
) -> tuple[Standing, ...]:
    """Sum up a review.

    Parameters
    ----------
    original, take : the recording as read and as it stands
    artifacts : those that the review asks about
    notes : how repaired ones were repaired, by id
    region : frames that shares count, a half-open interval; None for all of the take

    Returns
    -------
    The whole take, whose shares count the named markers only, then every marker in the take's
    order; what markers changed places in counts for each of them, and once for the take
    """
    rows = slice(*(region or (0, take.frames)))
    then, stands_now = original.origin[rows], take.origin[rows]
    frames = max(1, len(then))
    before = np.count_nonzero(then == Origin.MISSING, axis=0) / frames
    now = np.count_nonzero(stands_now == Origin.MISSING, axis=0) / frames
    mended = np.count_nonzero(stands_now >= Origin.FILLED, axis=0) / frames
    by_marker: dict[str, list[Artifact]] = {label: [] for label in take.labels}
    everything = list(artifacts)
    for artifact in everything:
        note = notes.get(artifact.id)
        for marker in changed_markers(artifact, note.method if note else None):
            by_marker[marker].append(artifact)
    named = np.array(take.named, dtype=np.int64)

    def stands(label: str, own: list[Artifact], columns: IntArray) -> Standing:
        undecided = Counter(a.kind for a in own if a.status is Status.PENDING)
        decided = Counter(a.kind for a in own if a.status is not Status.PENDING)
        mean, worst = _errors(own, notes)
        shares = [float(s[columns].mean()) if len(columns) else 0.0 for s in (before, now, mended)]
        return Standing(label, shares[0], shares[1], shares[2], undecided, decided, mean, worst)

    return (
        stands("", everything, named),
        *(stands(label, own, np.array([i])) for i, (label, own) in enumerate(by_marker.items())),
    )


def still_doubted(
    artifacts: Iterable[Artifact], notes: Mapping[str, RepairNote]
) -> tuple[Artifact, ...]:
    """Leave out mix-ups that were repaired on all of their markers.

    Their samples are those that were recorded, exchanged back, and tell of the body like any
    others; what other repairs put in is a guess, of which nothing is to be learned.

    Parameters
    ----------
    artifacts : of a review
    notes : how repaired ones were repaired, by id
    """

    def exchanged_back(artifact: Artifact) -> bool:
        note = notes.get(artifact.id)
        if artifact.counterpart is None or artifact.status is not Status.REPAIRED or note is None:
            return False
        return changed_markers(artifact, note.method) == artifact.markers

    return tuple(artifact for artifact in artifacts if not exchanged_back(artifact))


def changed_outside(original: Take, take: Take, region: tuple[int, int]) -> bool:
    """Whether samples outside an interval of frames are not as they were read.

    Parameters
    ----------
    original, take : the recording as read and as it stands
    region : half-open interval of 0-based frames
    """
    differs = original.origin != take.origin
    differs[slice(*region)] = False
    return bool(differs.any())


def _errors(
    artifacts: Iterable[Artifact], notes: Mapping[str, RepairNote]
) -> tuple[float | None, float | None]:
    """Mean and largest expected error of repairs; swaps invent nothing, and have none."""
    known = [
        (a.length, float(error))
        for a in artifacts
        if a.status is Status.REPAIRED and a.id in notes
        for error in [notes[a.id].error_mm]
        if error
    ]
    if not known:
        return None, None
    lengths, errors = zip(*known, strict=True)
    return float(np.average(errors, weights=lengths)), max(errors)
