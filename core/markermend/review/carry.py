"""What is kept of a review whose take was changed on disk."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from markermend.artifact import Status
from markermend.artifact_json import from_dict
from markermend.review.edits import (
    Edit,
    Group,
    PutBack,
    SetArtifacts,
    SetBase,
    SetNames,
    SetNotes,
    SetRegion,
    SetSamples,
)
from markermend.review.session import Session
from markermend.review.step import FOUND_BEFORE, Step, parts, touched_by_hand
from markermend.review.steps_json import step_from_dict
from markermend.take import Take


def marker_hashes(take: Take) -> dict[str, str]:
    """Fingerprint of each trajectory and the frame count, to tell which ones a change spared."""
    return {
        label: hashlib.sha1(take.positions[:, i].tobytes()).hexdigest()
        for i, label in enumerate(take.labels)
    }


def carry_over(session: Session, document: Mapping[str, Any], path: Path) -> str:
    """Apply what a review of another version of the take says of trajectories that are the same.

    Parameters
    ----------
    session : a new review of the take as it is now
    document : the stored review
    path : where that was stored

    Returns
    -------
    One sentence that tells what was kept
    """
    now = marker_hashes(session.original)
    then = document["source"].get("markers", {})
    same = {label for label in now if then.get(label) == now[label]}
    for entry in document["done"]:
        label, edit, _, by_itself = step_from_dict(entry)
        kept = _restricted(edit, same, set(session.notes) | {a.id for a in session.artifacts})
        if kept is not None:
            session.perform(label, kept, by_itself=by_itself)
    changed = len(now) - len(same)
    them = "joints" if session.original.skeleton else "markers"
    return (
        f"The take has changed since it was reviewed: what was decided on the {len(same)} {them} "
        f"that are the same was kept, on {changed} it was not; the old review stays in "
        f"“{path.name}.old”."
    )


def go_on(session: Session, document: Mapping[str, Any], path: Path) -> str:
    """List what a review still had open when the take was exported over its original.

    Parameters
    ----------
    session : a new review of the take as it was written then
    document : the stored review
    path : where that was stored

    Returns
    -------
    One sentence that tells what was kept
    """
    labels = set(session.original.labels)
    edits = [step_from_dict(entry)[:2] for entry in document["done"]]
    touched = touched_by_hand(Step(label, edit, edit) for label, edit in edits)
    left = [a for a in map(from_dict, document["artifacts"]) if a.status is not Status.REPAIRED]
    for name, own in ((FOUND_BEFORE, False), ("Decided before the export", True)):
        some = [a for a in left if (a.id in touched) is own and set(a.markers) <= labels]
        if some:
            session.perform(name, SetArtifacts({a.id: a for a in some}), by_itself=True)
    for region in [r for _, edit in edits for r in parts(edit, SetRegion)][-1:]:
        session.perform("Review the same frames", region, by_itself=True)
    session.mark_exported()
    return (
        "The take was exported over its original. What was not repaired of its review goes on "
        f"here; the review so far stays in “{path.name}.old”."
    )


def _restricted(edit: Edit, markers: set[str], known: set[str]) -> Edit | None:
    """The part of an edit that concerns only these markers, or None when nothing is left."""
    if isinstance(edit, Group):
        parts = []
        for part in edit.edits:
            kept = _restricted(part, markers, known)
            if kept is not None:
                parts.append(kept)
        return Group(tuple(parts)) if parts else None
    if isinstance(edit, SetSamples):
        patches = tuple(p for p in edit.patches if p.marker in markers)
        # Half a swap would tear two trajectories apart; half of a restoration (it names the
        # origin of its samples) is right for the markers that are left.
        whole = len(patches) == len(edit.patches) or all(p.origin is not None for p in patches)
        return SetSamples(patches) if patches and whole else None
    if isinstance(edit, SetArtifacts):
        changes = {
            i: a
            for i, a in edit.changes.items()
            if (a is None and i in known) or (a is not None and set(a.markers) <= markers)
        }
        known |= set(changes)
        return SetArtifacts(changes) if changes else None
    if isinstance(edit, PutBack):
        raise TypeError("What takes a step back is not carried over.")
    if isinstance(edit, SetBase):
        base = tuple(p for p in edit.patches if p.marker in markers)
        return SetBase(base) if len(base) == len(edit.patches) else None
    if isinstance(edit, SetNames):
        old, new = set(edit.names), set(edit.names.values())
        spared = old <= markers
        # Later steps know these markers by their new names only.
        markers -= old | new
        if spared:
            markers |= new
        return edit if spared else None
    if isinstance(edit, SetRegion):
        # A trajectory that is the same has the same frames, and so has the take.
        return edit if markers else None
    notes = {i: n for i, n in edit.changes.items() if i in known}
    return SetNotes(notes) if notes else None
