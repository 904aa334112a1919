"""Gaps of a review: each tells truly what it holds, and no frame that is not seen goes unlisted."""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from markermend.arrays import BoolArray, runs
from markermend.artifact import Artifact, Kind, Status
from markermend.review.edits import State
from markermend.take import AXES, Origin, Take


def unseen(state: State, marker: str) -> BoolArray:
    """(frames,) bool: a marker is missing as read, or as hand work left it."""
    _, origin = state.base.read(state.original.index(marker), 0, state.original.frames)
    return np.asarray(origin == Origin.MISSING)


def told(original: Take, gap: Artifact, absent: BoolArray) -> Artifact:
    """A gap that says truly how much of it is not seen.

    Parameters
    ----------
    original : the take as it was read
    gap : whose frames may have been chosen by hand
    absent : (frames,) bool, its marker is not seen
    """
    from markermend.detectors.finding import how_long

    inside = slice(gap.start, gap.stop)
    missing = int(absent[inside].sum())
    why = f"not seen for {how_long(gap.length, original.rate)}"
    if missing < gap.length:
        why = f"not seen for {missing} of the {gap.length} frames that were chosen by hand"
    elif original.present[inside, original.index(gap.marker)].any():
        frames = f"{gap.length} frames" if gap.length > 1 else "1 frame"
        why = f"not seen for {frames}, since samples were cut or moved by hand"
    return replace(gap, why=why)


def free_id(wanted: str, taken: Container[str]) -> str:
    """An artifact's name that is not in use, the wanted one if it can be."""
    while wanted in taken:
        wanted += "+"
    return wanted


def gaps_redone(
    state: State,
    marker: str,
    gaps: Sequence[Artifact],
    absent: BoolArray,
    touched: tuple[int, int],
) -> dict[str, Artifact | None]:
    """Gap artifacts of a marker as its missing samples ask for, near the frames touched.

    Parameters
    ----------
    state : of the review
    marker : whose gaps
    gaps : those there that nothing was decided about; what is not one of them any more goes
    absent : (frames,) bool, frames that they are to hold
    touched : half-open interval of 0-based frames
    """
    low = min([touched[0], *(a.start for a in gaps)])
    high = max([touched[1], *(a.stop for a in gaps)])
    changes: dict[str, Artifact | None] = dict.fromkeys(a.id for a in gaps)
    for first, last in runs(absent[low:high]).tolist():
        start, stop = low + first, low + last
        kept = next((a for a in gaps if (a.start, a.stop) == (start, stop)), None)
        if kept is not None:
            del changes[kept.id]
            continue
        new = told(state.original, Artifact(marker, AXES, start, stop, Kind.GAP), absent)
        name = free_id(new.id, state.artifacts)
        changes[name] = replace(new, id=name)
    return changes


def with_edges_moved(
    state: State, before: Sequence[Artifact], after: Mapping[str, Artifact]
) -> dict[str, Artifact | None]:
    """What becomes of gaps when some are given other edges.

    Parameters
    ----------
    state : of the review, before
    before : artifacts that change
    after : what they become, by id

    Returns
    -------
    ``after``, whose gaps say what they hold now, and changes to gaps beside them that nobody has
    decided about: these take the frames that a gap leaves out, and leave it those it takes.
    """
    changes: dict[str, Artifact | None] = dict(after)
    for old in before:
        new = after[old.id]
        if old.kind is not Kind.GAP or new.kind is not Kind.GAP:
            continue
        absent = unseen(state, old.marker)
        changes[old.id] = told(state.original, new, absent)
        low, high = min(old.start, new.start), max(old.stop, new.stop)
        beside = []
        absent[new.start : new.stop] = False
        for a in state.artifacts.values():
            if a.kind is not Kind.GAP or a.marker != old.marker or a.id in after:
                continue
            if a.status is not Status.PENDING:
                absent[a.start : a.stop] = False
            elif a.start <= high and low <= a.stop:
                beside.append(a)
        changes |= gaps_redone(state, old.marker, beside, absent, (low, high))
    return changes


def uncovered(found: Artifact, known: Iterable[Artifact]) -> list[Artifact]:
    """What of a gap that was found is in none of the known ones of its marker: itself, or parts.

    Parameters
    ----------
    found : a gap
    known : other artifacts, of this marker or of others
    """
    left = np.ones(found.length, dtype=bool)
    for a in known:
        if a.kind is Kind.GAP and a.marker == found.marker:
            left[max(a.start - found.start, 0) : max(a.stop - found.start, 0)] = False
    if left.all():
        return [found]
    return [
        replace(found, start=found.start + start, stop=found.start + stop, id="")
        for start, stop in runs(left).tolist()
    ]
