"""The few changes a review is made of. Each applies to a state and returns its inverse.

An edit is a small immutable value: applying it costs what it touches, not what the take holds,
and applying its inverse restores the state bit for bit. Undo, redo, journal and history are all
built on this one property.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from markermend.arrays import ByteArray, FloatArray
from markermend.artifact import Artifact
from markermend.errors import DataError
from markermend.patch import Patch, apply_patch
from markermend.take import Take


@dataclass(frozen=True)
class RepairNote:
    """How an artifact was repaired: what JSON and report say of it.

    Attributes
    ----------
    method : name in the registry
    error_mm : expected mean error, or None when unknown
    """

    method: str
    error_mm: float | None = None


class State:
    """Working copy of a review: samples, artifacts by id, and how they were repaired."""

    def __init__(self, take: Take) -> None:
        self.original = take
        self.positions: FloatArray = take.positions.copy()
        self.origin: ByteArray = take.origin.copy()
        self.artifacts: dict[str, Artifact] = {}
        self.notes: dict[str, RepairNote] = {}


@dataclass(frozen=True)
class SetSamples:
    """Write patches in order."""

    patches: tuple[Patch, ...]

    def apply(self, state: State) -> SetSamples:
        """Write the patches; all or none."""
        undo: list[Patch] = []
        try:
            for patch in self.patches:
                column = state.original.index(patch.marker)
                undo.append(apply_patch(state.positions, state.origin, column, patch))
        except DataError:
            for patch in reversed(undo):
                apply_patch(
                    state.positions, state.origin, state.original.index(patch.marker), patch
                )
            raise
        return SetSamples(tuple(reversed(undo)))


@dataclass(frozen=True)
class SetArtifacts:
    """Add, change (an artifact) or remove (None) artifacts by id."""

    changes: Mapping[str, Artifact | None]

    def apply(self, state: State) -> SetArtifacts:
        """Write the artifacts."""
        before = {i: state.artifacts.get(i) for i in self.changes}
        for i, artifact in self.changes.items():
            if artifact is None:
                state.artifacts.pop(i, None)
            else:
                state.artifacts[i] = artifact
        return SetArtifacts(before)


@dataclass(frozen=True)
class SetNotes:
    """Add, change or remove (None) repair notes by artifact id."""

    changes: Mapping[str, RepairNote | None]

    def apply(self, state: State) -> SetNotes:
        """Write the notes."""
        before = {i: state.notes.get(i) for i in self.changes}
        for i, note in self.changes.items():
            if note is None:
                state.notes.pop(i, None)
            else:
                state.notes[i] = note
        return SetNotes(before)


@dataclass(frozen=True)
class Group:
    """Several edits as one step."""

    edits: tuple[Edit, ...]

    def apply(self, state: State) -> Group:
        """Apply in order; when one fails, those before it are taken back."""
        undo: list[Edit] = []
        try:
            for edit in self.edits:
                undo.append(edit.apply(state))
        except DataError:
            for edit in reversed(undo):
                edit.apply(state)
            raise
        return Group(tuple(reversed(undo)))


Edit = SetSamples | SetArtifacts | SetNotes | Group


@dataclass(frozen=True)
class Change:
    """What an edit touched, so that views refresh no more than that.

    Attributes
    ----------
    markers : labels whose samples changed
    start, stop : frames within which they changed; equal when none did
    artifacts : whether any artifact or note changed
    """

    markers: tuple[str, ...] = ()
    start: int = 0
    stop: int = 0
    artifacts: bool = False


def extent(edit: Edit) -> Change:
    """Work out what an edit touches."""
    patches: list[Patch] = []
    artifacts = False
    queue: list[Edit] = [edit]
    while queue:
        item = queue.pop()
        if isinstance(item, Group):
            queue.extend(item.edits)
        elif isinstance(item, SetSamples):
            patches.extend(item.patches)
        else:
            artifacts = artifacts or bool(item.changes)
    if not patches:
        return Change(artifacts=artifacts)
    return Change(
        markers=tuple(dict.fromkeys(p.marker for p in patches)),
        start=min(p.start for p in patches),
        stop=max(p.stop for p in patches),
        artifacts=artifacts,
    )


def merged(changes: Iterable[Change]) -> Change:
    """What several edits touch together."""
    known = list(changes)
    moved = [c for c in known if c.markers]
    return Change(
        markers=tuple(dict.fromkeys(m for c in moved for m in c.markers)),
        start=min((c.start for c in moved), default=0),
        stop=max((c.stop for c in moved), default=0),
        artifacts=any(c.artifacts for c in known),
    )


def restoring(state: State, marker: str, axes: str, start: int, stop: int) -> Patch:
    """Patch that puts the samples of the source back."""
    column = state.original.index(marker)
    measured = state.original.positions[start:stop, column]
    # Where the working copy gained or lost whole samples, one axis cannot go back alone.
    if (np.isnan(measured[:, 0]) != np.isnan(state.positions[start:stop, column, 0])).any():
        axes = "xyz"
    values = measured[:, ["xyz".index(a) for a in axes]].copy()
    others = [i for i, a in enumerate("xyz") if a not in axes]
    untouched = state.positions[start:stop, column][:, others] == measured[:, others]
    origin = np.where(
        untouched.all(axis=1),
        state.original.origin[start:stop, column],
        state.origin[start:stop, column],
    )
    return Patch(marker, axes, start, stop, values, origin.astype(np.uint8))
