"""Work by hand on samples and names: cut, move to another marker, smooth, rename; split and join.

What is changed here becomes what repairs that are taken back return to. Every verb is one step
of the session's history.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from markermend.arrays import BoolArray, ByteArray, FloatArray, runs
from markermend.artifact import Artifact, Kind, Status
from markermend.errors import DataError
from markermend.patch import Patch
from markermend.review.edits import (
    Change,
    Group,
    RepairNote,
    SetArtifacts,
    SetBase,
    SetNames,
    SetNotes,
    SetSamples,
    merged,
)
from markermend.review.repairing import as_one, by_hand, describe, repairing
from markermend.review.restoring import overwritten, taking_back
from markermend.review.session import Session
from markermend.review.step import artifacts_of
from markermend.review.unseen import gaps_redone, told, unseen
from markermend.take import AXES, Origin, Take, is_unlabelled

if TYPE_CHECKING:
    from markermend.repairs.registry import Repair


def cut(session: Session, marker: str, start: int, stop: int) -> Change:
    """Make samples missing; the gap that opens is put on the list of artifacts.

    Parameters
    ----------
    session : the review
    marker : whose samples
    start, stop : half-open interval of 0-based frames

    Raises
    ------
    DataError
        when the marker is not seen there at all
    """
    if not _present(session, marker, start, stop).any():
        raise DataError(f"{marker} is not seen in these frames; there is nothing to cut.")
    patch = _patch(marker, start, np.full((stop - start, 3), np.nan), missing=True)
    label = f"Cut {marker} in {_frames(session, start, stop)}"
    return _perform(session, label, [patch])


def repair(session: Session, artifact: Artifact, proposal: Repair) -> Change:
    """Repair what was swept, as proposed.

    What was found inside and is not decided, or accepted, is answered by it and goes; of a gap that
    it fills in part, the rest stays. A swap answers steps and gaps only: what else was wrong is
    wrong still.

    Parameters
    ----------
    session : the review
    artifact : what was swept
    proposal : its repair

    Raises
    ------
    DataError
        when the proposal has no patches, or reaches outside
    """
    artifact = session.placed(artifact)
    edits = repairing(artifact, proposal, session.artifacts)
    swap = proposal.method == "swap"
    kinds = (Kind.STEP, Kind.GAP) if swap else tuple(Kind)
    open_ = {a.id for a in session.with_status(Status.PENDING, Status.ACCEPTED) if a.kind in kinds}
    answered = {
        i: a
        for i, a in _artifacts_after(session, proposal.patches).items()
        if a is not None or i in open_
    }
    notes = SetNotes(overwritten(session.state, proposal.patches))
    what = f"Repair {describe([artifact], proposal.method)}"
    if swap:
        what = f"Swap {artifact.marker} and {artifact.counterpart}"
    return session.perform(f"{what} by hand", Group((SetArtifacts(answered), *edits, notes)))


def move(session: Session, donor: str, receiver: str, start: int, stop: int) -> Change:
    """Give a marker's samples to another one that is missing there: they had the wrong name.

    Parameters
    ----------
    session : the review
    donor : whose samples they are; it is missing there afterwards
    receiver : whose they become, marked as edited
    start, stop : half-open interval of 0-based frames

    Raises
    ------
    DataError
        when the donor is not seen there, or the receiver is too in some of its frames
    """
    if donor == receiver:
        raise DataError("Choose another name; these samples have this one already.")
    given = _present(session, donor, start, stop)
    if not given.any():
        raise DataError(f"{donor} is not seen in these frames; there is nothing to take over.")
    both = int((given & _present(session, receiver, start, stop)).sum())
    if both:
        raise DataError(
            f"{receiver} has samples of its own in {both} of these frames; cut them first, or "
            "swap the two from here to there."
        )
    patches = []
    column = session.original.index(donor)
    for first, last in runs(given).tolist():
        low, high = start + first, start + last
        values = session.positions[low:high, column].copy()
        patches.append(_patch(receiver, low, values, missing=False))
        patches.append(_patch(donor, low, np.full_like(values, np.nan), missing=True))
    whole = (start, stop) == (0, session.original.frames)
    where = _frames(session, start, stop)
    label = f"Move {donor} to {receiver} in {where}"
    return _perform(session, f"Merge {donor} into {receiver}" if whole else label, patches)


def merge(session: Session, donor: str, receiver: str) -> Change:
    """Give all samples of a trajectory to another marker; errors as in :func:`move`."""
    return move(session, donor, receiver, 0, session.original.frames)


def replace_samples(
    session: Session,
    label: str,
    markers: Sequence[str],
    start: int,
    positions: FloatArray,
    origin: ByteArray,
) -> Change:
    """Write what was worked out for an interval of some markers, smoothed ones for instance.

    Parameters
    ----------
    session : the review
    label : name of the step; markers and frames are added
    markers, start : where
    positions : (n, markers, 3) float64, mm; NaN where missing
    origin : (n, markers) uint8
    """
    stop = start + len(positions)
    patches = [
        Patch(marker, AXES, start, stop, positions[:, i].copy(), origin[:, i].copy())
        for i, marker in enumerate(markers)
    ]
    many = "joints" if session.original.skeleton else "markers"
    what = markers[0] if len(markers) == 1 else f"{len(markers)} {many}"
    label = f"{label} {what} in {_frames(session, start, stop)}"
    return _perform(session, label, patches, keep_artifacts=True)


def rename(session: Session, names: Mapping[str, str]) -> Change:
    """Give markers other names in the whole take; two may change places.

    Raises
    ------
    DataError
        when there is no such marker, a name is empty, or two points would have the same
    """
    names = {old: new.strip() for old, new in names.items() if old != new.strip()}
    if not names:
        return Change()
    changes = {
        a.id: replace(
            a,
            marker=names.get(a.marker, a.marker),
            counterpart=names.get(a.counterpart, a.counterpart) if a.counterpart else None,
            further_counterparts=tuple(names.get(m, m) for m in a.further_counterparts),
        )
        for a in session.artifacts
        if names.keys() & set(a.markers)
    }
    label = "Rename " + ", ".join(f"{old} to {new}" for old, new in names.items())
    return session.perform(label, Group((SetNames(names), SetArtifacts(changes))))


def split(session: Session, artifact_id: str, at: int, *, others: Sequence[str] = ()) -> Change:
    """Make two artifacts of one; a repaired one reopens.

    Parameters
    ----------
    session : the review
    artifact_id : which
    at : first frame of the second one
    others : the rest of its event, split in the same step

    Raises
    ------
    DataError
        when the frame is not inside
    """
    chosen = [session.artifact(i) for i in (artifact_id, *others)]
    if any(not old.start < at < old.stop for old in chosen):
        raise DataError("Put the cursor inside the artifact, to split it there.")
    halves: dict[str, Artifact | None] = {}
    for old in chosen:
        status = Status.PENDING if old.status is Status.REPAIRED else old.status
        first = replace(old, stop=at, status=status)
        second = replace(old, start=at, status=status, id="")
        second = replace(second, id=session.free_id(second.id))
        parts = (
            _told(session, a) if a.kind is Kind.GAP else by_hand(old, a) for a in (first, second)
        )
        halves |= {a.id: a for a in parts}
    edits = (*taking_back(session.state, chosen), SetArtifacts(halves))
    return session.perform(f"Split {describe(chosen)}", Group(edits))


def join(session: Session, ids: Sequence[str]) -> Change:
    """Make one artifact of several on one marker, from the first frame to the last.

    It keeps the class of the one we are surest of, and is open again if any was repaired. In a
    skeleton recording whole events are joined: those on each joint, where there are several.

    Raises
    ------
    DataError
        when there are fewer than two, or they are on different markers
    """
    on: dict[str, list[Artifact]] = {}
    for artifact in map(session.artifact, ids):
        on.setdefault(artifact.marker, []).append(artifact)
    several = [alike for alike in on.values() if len(alike) > 1]
    if not several or (len(on) > 1 and not session.original.skeleton):
        raise DataError("Choose two or more artifacts of one name, to join them.")
    chosen = [a for alike in several for a in alike]
    joined = [_told(session, a) if a.kind is Kind.GAP else a for a in map(as_one, several)]
    changes = {a.id: None for a in chosen} | {a.id: a for a in joined}
    edits = (*taking_back(session.state, chosen), SetArtifacts(changes))
    more = f" +{len(joined) - 1}" if len(joined) > 1 else ""
    return session.perform(f"Join {describe(chosen)} on {joined[0].marker}{more}", Group(edits))


def _told(session: Session, gap: Artifact) -> Artifact:
    """A gap that was made by hand, with a reason that is still true."""
    return told(session.original, gap, unseen(session.state, gap.marker))


def without_emptied(take: Take, original: Take) -> Take:
    """Leave out unlabelled trajectories whose samples all went to other markers.

    Parameters
    ----------
    take : as it stands
    original : as it was read, with the same markers
    """
    from markermend.files.restructure import drop

    empty = [
        label
        for i, label in enumerate(take.labels)
        if is_unlabelled(label) and original.present[:, i].any() and not take.present[:, i].any()
    ]
    return drop(take, empty) if empty else take


def nudge(
    session: Session, artifact_id: str, *, start: int = 0, stop: int = 0, others: Sequence[str] = ()
) -> Change:
    """Move one edge of an artifact by frames; one nudge after the other is one step.

    Parameters
    ----------
    session : the review
    artifact_id : whose edge
    start, stop : frames by which the beginning or the end moves; the artifact stays within the
        take and at least one frame long
    others : the rest of its event, which is given the same edges

    Raises
    ------
    DataError
        when there is no such artifact
    """
    chosen = [session.artifact(i) for i in (artifact_id, *others)]
    old = chosen[0]
    first = max(0, old.start + start)
    last = min(session.original.frames, old.stop + stop)
    if first >= last or (first, last) == (old.start, old.stop):
        return Change()
    label = f"Nudge the {'beginning' if start else 'end'} of {describe(chosen)}"
    done = session.steps[0]
    # What was exported stays a step of its own, so that the history still knows it.
    goes_on = (
        bool(done)
        and done[-1].label == label
        and artifacts_of(done[-1])[: len(chosen)] == tuple(a.id for a in chosen)
        and session.exported_at != len(done)
    )
    back = [session.undo()] if goes_on else []
    edges = session.change(artifact_id, start=first, stop=last, others=others, label=label)
    return merged([*back, edges])


def _perform(
    session: Session, label: str, patches: Sequence[Patch], *, keep_artifacts: bool = False
) -> Change:
    """Write patches as one step, and make the artifacts of these markers true again."""
    written = tuple(patches)
    changes = {} if keep_artifacts else _artifacts_after(session, written)
    notes: dict[str, RepairNote | None] = {
        **overwritten(session.state, written, smoothed=keep_artifacts),
        **{i: None for i, a in changes.items() if a is None and i in session.notes},
    }
    edits = (SetSamples(written), SetBase(written), SetArtifacts(changes), SetNotes(notes))
    return session.perform(label, Group(edits))


def _artifacts_after(session: Session, patches: Sequence[Patch]) -> dict[str, Artifact | None]:
    """Which artifacts go and come when samples came or went: those inside go, gaps are redone."""
    changes: dict[str, Artifact | None] = {}
    for marker in dict.fromkeys(p.marker for p in patches):
        mine = [p for p in patches if p.marker == marker]
        start, stop = min(p.start for p in mine), max(p.stop for p in mine)
        absent = session.origin[:, session.original.index(marker)] == Origin.MISSING
        for p in mine:
            absent[p.start : p.stop] = np.isnan(p.values[:, 0])
        gaps = []
        for a in session.artifacts:
            if a.marker != marker or a.status is Status.REJECTED:
                continue
            inside = start <= a.start and a.stop <= stop
            touching = a.start <= stop and start <= a.stop
            if a.kind is Kind.GAP and touching and a.status is not Status.REPAIRED:
                gaps.append(a)
            elif inside:
                changes[a.id] = None
        if not is_unlabelled(marker):
            changes |= gaps_redone(session.state, marker, gaps, absent, (start, stop))
    return changes


def _present(session: Session, marker: str, start: int, stop: int) -> BoolArray:
    """(stop - start,) bool: the marker is seen."""
    column = session.original.index(marker)
    return ~np.isnan(session.positions[start:stop, column, 0])


def _patch(marker: str, start: int, values: FloatArray, *, missing: bool) -> Patch:
    """Samples that come or go."""
    origin = np.full(len(values), Origin.MISSING if missing else Origin.EDITED, dtype=np.uint8)
    return Patch(marker, AXES, start, start + len(values), values, origin)


def _frames(session: Session, start: int, stop: int) -> str:
    """Frames as the file counts them."""
    take = session.original
    if (start, stop) == (0, take.frames):
        return "all frames"
    return f"frames {take.frame_number(start)}–{take.frame_number(stop - 1)}"
