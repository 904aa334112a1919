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
    gaps : those there; what is not one of them any more goes, with what was decided about it
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
    """What becomes of gaps when artifacts are given other edges, or another class.

    Parameters
    ----------
    state : of the review, before
    before : artifacts that change
    after : what they become, by id

    Returns
    -------
    ``after``, whose gaps say what they hold now, and changes to gaps beside them that are not
    decided about: what a gap takes of these they lose, and those of which nothing is left go,
    unless something was noted on them. Frames that are not seen and that a gap leaves out are added
    to one that begins or ends there, or become a gap.
    """
    changes: dict[str, Artifact | None] = dict(after)
    for old in before:
        if old.kind is not Kind.GAP:
            continue
        new, absent = after[old.id], unseen(state, old.marker)
        others = [
            a
            for a in state.artifacts.values()
            if a.kind is Kind.GAP and a.marker == old.marker and a.id not in after
        ]
        beside = {a.id: a for a in others if a.status is Status.PENDING}
        if new.kind is Kind.GAP:
            if (old.start, old.stop) != (new.start, new.stop):
                changes[old.id] = told(state.original, new, absent)
            inside = [a for a in beside.values() if new.start <= a.start and a.stop <= new.stop]
            changes |= {a.id: None for a in inside if not a.note}
            beside = {a.id: _without(a, new) for a in beside.values() if a not in inside}
        left = absent.copy()
        left[: old.start] = left[old.stop :] = left[new.start : new.stop] = False
        for a in others:
            left[a.start : a.stop] = False
        for start, stop in runs(left).tolist():
            _put(beside, state, replace(old, start=start, stop=stop), absent)
        for name, a in beside.items():
            if a is not state.artifacts.get(name):
                known = a.why.startswith("not seen for")
                changes[name] = told(state.original, a, absent) if known else a
    return changes


def _without(gap: Artifact, taken: Artifact) -> Artifact:
    """A gap less what another one holds of one of its ends."""
    if taken.start <= gap.start < taken.stop:
        return replace(gap, start=taken.stop)
    if taken.start < gap.stop <= taken.stop:
        return replace(gap, stop=taken.start)
    return gap


def _put(beside: dict[str, Artifact], state: State, left: Artifact, absent: BoolArray) -> None:
    """Add frames that a gap leaves out to one at their side that holds none but such, or anew."""
    for a in beside.values():
        if absent[a.start : a.stop].all() and left.start <= a.stop and a.start <= left.stop:
            first, last = min(a.start, left.start), max(a.stop, left.stop)
            beside[a.id] = replace(a, start=first, stop=last)
            return
    new = Artifact(left.marker, AXES, left.start, left.stop, Kind.GAP, why="not seen for")
    name = free_id(new.id, {*state.artifacts, *beside})
    beside[name] = replace(new, id=name)


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
