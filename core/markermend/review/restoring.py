"""Taking repairs back, or writing over them: which samples return, and what is noted of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from markermend.arrays import runs
from markermend.artifact import Artifact, Status, axis_columns
from markermend.patch import Patch
from markermend.review.edits import Edit, RepairNote, SetArtifacts, SetNotes, SetSamples, State
from markermend.review.repairing import left_by
from markermend.take import AXES

OVERWRITTEN = "Edited by hand since; how far off it may be is not known any more."
SMOOTHED = "Smoothed since; the expected error is that of the repair."


def taking_back(state: State, artifacts: Sequence[Artifact]) -> tuple[Edit, ...]:
    """Edits that undo the repairs of artifacts.

    Parameters
    ----------
    state : the review as it stands
    artifacts : those that are not repaired are passed over

    Returns
    -------
    Samples go back to what they were before any repair, but for those that the repair of
    another artifact still covers; the notes of how they were repaired go, and what a mix-up that
    was repaired on one marker left of the others. Empty when none of the artifacts is repaired.
    """
    repaired = [a for a in artifacts if a.status is Status.REPAIRED]
    if not repaired:
        return ()
    leaving = {a.id for a in repaired}
    staying: dict[str, list[Artifact]] = {}
    for a in state.artifacts.values():
        if a.status is Status.REPAIRED and a.id not in leaving:
            for name in _markers(state, a):
                staying.setdefault(name, []).append(a)
    patches = []
    for a in repaired:
        for name in _markers(state, a):
            free = np.ones(a.length, dtype=bool)
            for other in staying.get(name, ()):
                if set(other.axes) & set(a.axes):
                    free[max(0, other.start - a.start) : max(0, other.stop - a.start)] = False
            for start, stop in runs(free).tolist():
                patches.append(_restoring(state, name, a.axes, a.start + start, a.start + stop))
    edits: list[Edit] = [SetSamples(tuple(patches)), SetNotes(dict.fromkeys(leaving))]
    parted = [b.id for a in repaired for b in left_by(a, state.artifacts.values())]
    if parted:
        edits.append(SetArtifacts(dict.fromkeys(parted)))
    return tuple(edits)


def overwritten(
    state: State, patches: Sequence[Patch], *, smoothed: bool = False
) -> dict[str, RepairNote]:
    """Notes of the repairs whose samples are written over by hand.

    Parameters
    ----------
    state : the review as it stands
    patches : what is written
    smoothed : it is what was there, with less noise, so that the expected error still tells

    Returns
    -------
    By artifact; expected error and band go, unless it was smoothed, and the note says what was done
    """
    notes = {}
    for i, note in state.notes.items():
        a = state.artifacts.get(i)
        if a is None or a.status is not Status.REPAIRED:
            continue
        names = _markers(state, a)
        if not any(p.marker in names and a.overlaps(p.start, p.stop) for p in patches):
            continue
        if not smoothed:
            notes[i] = replace(note, error_mm=None, band_mm=None, leaves=OVERWRITTEN)
        elif not note.leaves.endswith((SMOOTHED, OVERWRITTEN)):
            notes[i] = replace(note, leaves=f"{note.leaves} {SMOOTHED}".strip())
    return notes


def _markers(state: State, artifact: Artifact) -> tuple[str, ...]:
    """Markers whose samples a repair of this artifact replaced."""
    note = state.notes.get(artifact.id)
    if artifact.counterpart and note is not None and note.method == "swap":
        return artifact.markers
    return (artifact.marker,)


def _restoring(state: State, marker: str, axes: str, start: int, stop: int) -> Patch:
    """Patch that puts the samples back as they were before any repair."""
    column = state.original.index(marker)
    before, base_origin = state.base.read(column, start, stop)
    # Where the working copy gained or lost whole samples, one axis cannot go back alone.
    if (np.isnan(before[:, 0]) != np.isnan(state.positions[start:stop, column, 0])).any():
        axes = AXES
    values = before[:, axis_columns(axes)].copy()
    others = [i for i, a in enumerate(AXES) if a not in axes]
    untouched = state.positions[start:stop, column][:, others] == before[:, others]
    origin = np.where(
        untouched.all(axis=1),
        base_origin,
        state.origin[start:stop, column],
    )
    return Patch(marker, axes, start, stop, values, origin.astype(np.uint8))
