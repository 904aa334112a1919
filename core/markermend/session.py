"""A review: a take, its artifacts, the operator's decisions, and every step undoable.

Pure Python and NumPy: the window only shows it, the command line and scripts drive it alike.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from markermend.arrays import ByteArray, FloatArray, runs
from markermend.artifact import Artifact, Kind, Status, in_order, repair_in_words
from markermend.edits import (
    Change,
    Edit,
    Group,
    RepairNote,
    SetArtifacts,
    SetNotes,
    SetSamples,
    State,
    extent,
    merged,
    restoring,
)
from markermend.errors import DataError
from markermend.take import Take

if TYPE_CHECKING:
    # The repair methods bring SciPy along; a review can be opened without it.
    from markermend.repairs.registry import Repair


@dataclass(frozen=True)
class Step:
    """One entry of the history: what it is called, what it does and what takes it back."""

    label: str
    edit: Edit
    inverse: Edit


class Session:
    """One review of one take.

    Parameters
    ----------
    take : the recording; it is never changed, work happens on a copy

    Attributes
    ----------
    original : the take as it was opened
    revision : grows with every change, also by undo and redo; what was computed at one revision
        may be applied only while it is unchanged
    on_step : called after each change with ``("do", step)``, ``("undo", step)`` or
        ``("redo", step)``; the journal hangs here
    """

    def __init__(self, take: Take) -> None:
        self.original = take
        self.revision = 0
        self.on_step: Callable[[str, Step], None] | None = None
        self._state = State(take)
        self._done: list[Step] = []
        self._undone: list[Step] = []
        self._take: tuple[int, Take] | None = None
        self._artifacts: tuple[int, tuple[Artifact, ...]] | None = None
        self._clean_at: Step | None = None

    def __repr__(self) -> str:
        counts = Counter(a.status for a in self.artifacts)
        told = ", ".join(f"{counts[s]} {s}" for s in Status if counts[s]) or "no artifacts"
        return f"<Session of {self.original!r}: {told}, {len(self._done)} steps>"

    # What stands now

    @property
    def take(self) -> Take:
        """The take as it stands, a view of the working samples: good for this revision."""
        if self._take is None or self._take[0] != self.revision:
            positions, origin = self._state.positions.view(), self._state.origin.view()
            positions.flags.writeable = origin.flags.writeable = False
            view = self.original.viewing(positions, origin)
            self._take = (self.revision, view)
        return self._take[1]

    @property
    def positions(self) -> FloatArray:
        """(frames, markers, 3) float64, mm, read-only view of the working samples."""
        return self.take.positions

    @property
    def origin(self) -> ByteArray:
        """(frames, markers) uint8, read-only view, see :class:`markermend.take.Origin`."""
        return self.take.origin

    @property
    def artifacts(self) -> tuple[Artifact, ...]:
        """Every artifact, by start and marker."""
        if self._artifacts is None or self._artifacts[0] != self.revision:
            self._artifacts = (self.revision, in_order(self._state.artifacts.values()))
        return self._artifacts[1]

    @property
    def notes(self) -> Mapping[str, RepairNote]:
        """How repaired artifacts were repaired, by id."""
        return self._state.notes

    def artifact(self, artifact_id: str) -> Artifact:
        """Look an artifact up.

        Raises
        ------
        DataError
            when there is none of that id
        """
        found = self.find(artifact_id)
        if found is None:
            raise DataError("That artifact is no longer in the list.")
        return found

    def find(self, artifact_id: str) -> Artifact | None:
        """Look an artifact up; None when there is none of that id."""
        return self._state.artifacts.get(artifact_id)

    def with_status(self, *statuses: Status) -> tuple[Artifact, ...]:
        """Artifacts whose status is one of these."""
        return tuple(a for a in self.artifacts if a.status in statuses)

    def repairs_in_words(self) -> tuple[str, ...]:
        """Say what was repaired and how, one line each, for the record in an exported file."""
        return tuple(
            repair_in_words(self.original, a, note.method if note else "")
            for a in self.with_status(Status.REPAIRED)
            for note in [self._state.notes.get(a.id)]
        )

    # Decisions

    def add_detected(self, found: Iterable[Artifact], method: str) -> Change:
        """Take over what a detector found.

        Flags that are still pending are replaced; what the operator decided, marked or changed
        stays, and a new flag that one of these of the same marker and kind already covers by
        half is left out.
        """
        touched = _touched_by_hand(self._done)
        staying: dict[str, list[Artifact]] = {}
        changes: dict[str, Artifact | None] = {}
        for artifact in self.artifacts:
            if artifact.status is Status.PENDING and artifact.id not in touched:
                changes[artifact.id] = None
            else:
                staying.setdefault(artifact.marker, []).append(artifact)
        for artifact in found:
            if artifact.id in self._state.artifacts and artifact.id not in changes:
                continue
            if not any(_same_finding(artifact, d) for d in staying.get(artifact.marker, ())):
                changes[artifact.id] = artifact
        return self.perform(f"Detect ({method})", SetArtifacts(changes))

    def set_status(self, ids: Sequence[str], status: Status) -> Change:
        """Accept, reject or reopen; reopening or rejecting a repaired one restores its samples."""
        chosen = [self.artifact(i) for i in ids]
        edits: list[Edit] = []
        repaired = [a for a in chosen if a.status is Status.REPAIRED]
        if repaired and status is not Status.REPAIRED:
            edits.append(self._restore(repaired))
            edits.append(SetNotes({a.id: None for a in repaired}))
        edits.append(SetArtifacts({a.id: a.with_status(status) for a in chosen}))
        verb = {
            Status.ACCEPTED: "Accept",
            Status.REJECTED: "Reject",
            Status.PENDING: "Reopen",
            Status.REPAIRED: "Mark as repaired",
        }[status]
        return self.perform(f"{verb} {_describe(chosen)}", Group(tuple(edits)))

    def repair(self, repairs: Sequence[tuple[str, Repair]], label: str = "") -> Change:
        """Replace samples by proposed repairs, all as one step.

        An artifact that was repaired before goes back to its source samples first.

        Raises
        ------
        DataError
            when a proposal has no patches, or leaves the interval or the axes of its artifact
        """
        edits: list[Edit] = []
        chosen = [self.artifact(i) for i, _ in repairs]
        repaired = [a for a in chosen if a.status is Status.REPAIRED]
        if repaired:
            edits.append(self._restore(repaired))
        for artifact, (_, proposal) in zip(chosen, repairs, strict=True):
            if not proposal.patches:
                why = proposal.reason or "the method has no answer here"
                raise DataError(f"The {_describe([artifact])} cannot be repaired: {why}")
            _check_within(artifact, proposal)
            edits.append(SetSamples(proposal.patches))
            note = RepairNote(proposal.method, proposal.error_mm)
            edits.append(SetNotes({artifact.id: note}))
            edits.append(SetArtifacts({artifact.id: artifact.with_status(Status.REPAIRED)}))
        return self.perform(label or f"Repair {_describe(chosen)}", Group(tuple(edits)))

    def mark(self, artifact: Artifact) -> Change:
        """Add an artifact by hand."""
        if artifact.marker not in self.original:
            raise DataError(f"The take has no marker called “{artifact.marker}”.")
        if artifact.stop > self.original.frames:
            raise DataError("An artifact cannot reach beyond the last frame.")
        i = artifact.id
        while i in self._state.artifacts:
            i += "+"
        artifact = replace(artifact, id=i)
        return self.perform(f"Mark {_describe([artifact])}", SetArtifacts({i: artifact}))

    def remove(self, ids: Sequence[str]) -> Change:
        """Take artifacts off the list; samples of repaired ones go back to the source."""
        chosen = [self.artifact(i) for i in ids]
        repaired = [a for a in chosen if a.status is Status.REPAIRED]
        edits: list[Edit] = []
        if repaired:
            edits.append(self._restore(repaired))
            edits.append(SetNotes({a.id: None for a in repaired}))
        edits.append(SetArtifacts(dict.fromkeys(ids)))
        return self.perform(f"Remove {_describe(chosen)}", Group(tuple(edits)))

    def change(
        self,
        artifact_id: str,
        *,
        kind: Kind | None = None,
        axes: str | None = None,
        start: int | None = None,
        stop: int | None = None,
    ) -> Change:
        """Give an artifact another class, other axes or other edges; a repaired one reopens."""
        old = self.artifact(artifact_id)
        new = replace(
            old,
            kind=old.kind if kind is None else kind,
            axes=old.axes if axes is None else axes,
            start=old.start if start is None else max(0, start),
            stop=old.stop if stop is None else min(stop, self.original.frames),
        )
        if new == old:
            return Change()
        edits: list[Edit] = []
        if old.status is Status.REPAIRED:
            edits.append(self._restore([old]))
            edits.append(SetNotes({old.id: None}))
            new = new.with_status(Status.PENDING)
        edits.append(SetArtifacts({old.id: new}))
        what = f"Call {_describe([old])} {new.kind}" if new.kind != old.kind else ""
        return self.perform(what or f"Adjust {_describe([old])}", Group(tuple(edits)))

    # History

    @property
    def history(self) -> tuple[str, ...]:
        """Labels of the steps done, oldest first."""
        return tuple(s.label for s in self._done)

    @property
    def undone(self) -> tuple[str, ...]:
        """Labels of the steps that redo would bring back, next first."""
        return tuple(s.label for s in reversed(self._undone))

    def perform(self, label: str, edit: Edit) -> Change:
        """Apply an edit as one undoable step."""
        inverse = edit.apply(self._state)
        step = Step(label, edit, inverse)
        self._done.append(step)
        self._undone.clear()
        return self._after("do", step)

    def undo(self) -> Change:
        """Take the last step back; does nothing when there is none."""
        if not self._done:
            return Change()
        step = self._done.pop()
        step.inverse.apply(self._state)
        self._undone.append(step)
        return self._after("undo", step)

    def redo(self) -> Change:
        """Bring the last undone step back; does nothing when there is none."""
        if not self._undone:
            return Change()
        step = self._undone.pop()
        step.edit.apply(self._state)
        self._done.append(step)
        return self._after("redo", step)

    def travel(self, steps_done: int) -> Change:
        """Undo or redo until so many steps are done; the changes are told as one."""
        changes = []
        while len(self._done) > max(0, steps_done):
            changes.append(self.undo())
        while len(self._done) < steps_done and self._undone:
            changes.append(self.redo())
        return merged(changes)

    @property
    def exported(self) -> bool:
        """Whether the samples and decisions as they stand have been exported (or are untouched)."""
        last = self._done[-1] if self._done else None
        return last is self._clean_at or not any(_decides(s) for s in self._done)

    def mark_exported(self) -> None:
        """Remember that what stands now is in a file."""
        self._clean_at = self._done[-1] if self._done else None

    @property
    def steps(self) -> tuple[tuple[Step, ...], tuple[Step, ...]]:
        """Steps done (oldest first) and undone (as a stack), for saving."""
        return tuple(self._done), tuple(self._undone)

    def _after(self, what: str, step: Step) -> Change:
        """Count the change and tell the journal."""
        self.revision += 1
        if self.on_step is not None:
            self.on_step(what, step)
        return extent(step.edit)

    def _restore(self, artifacts: Sequence[Artifact]) -> Edit:
        """Edit that puts the source's samples back, but for those another repair still covers."""
        leaving = {a.id for a in artifacts}
        staying: dict[str, list[Artifact]] = {}
        for a in self.with_status(Status.REPAIRED):
            if a.id not in leaving:
                for name in self._repaired_markers(a):
                    staying.setdefault(name, []).append(a)
        patches = []
        for a in artifacts:
            for name in self._repaired_markers(a):
                free = np.ones(a.length, dtype=bool)
                for other in staying.get(name, ()):
                    if set(other.axes) & set(a.axes):
                        free[max(0, other.start - a.start) : max(0, other.stop - a.start)] = False
                for start, stop in runs(free).tolist():
                    patches.append(
                        restoring(self._state, name, a.axes, a.start + start, a.start + stop)
                    )
        return SetSamples(tuple(patches))

    def _repaired_markers(self, artifact: Artifact) -> tuple[str, ...]:
        """Markers whose samples a repair of this artifact replaced."""
        note = self._state.notes.get(artifact.id)
        if artifact.counterpart and note is not None and note.method == "swap":
            return (artifact.marker, artifact.counterpart)
        return (artifact.marker,)


def _decides(step: Step) -> bool:
    """Whether a step holds an operator's decision, not just a detection run."""
    return not step.label.startswith("Detect (")


def _touched_by_hand(steps: Iterable[Step]) -> set[str]:
    """Ids of artifacts that the operator marked, changed or decided about in these steps."""
    queue: list[Edit] = [s.edit for s in steps if _decides(s)]
    touched: set[str] = set()
    while queue:
        item = queue.pop()
        if isinstance(item, Group):
            queue.extend(item.edits)
        elif isinstance(item, SetArtifacts):
            touched |= set(item.changes)
    return touched


def _same_finding(new: Artifact, decided: Artifact) -> bool:
    """Whether a decided artifact already covers half of a new flag."""
    if new.marker != decided.marker or new.kind != decided.kind:
        return False
    shared = min(new.stop, decided.stop) - max(new.start, decided.start)
    return shared * 2 >= new.length


def _describe(artifacts: Sequence[Artifact]) -> str:
    """Name artifacts in a history label."""
    if len(artifacts) == 1:
        return f"{artifacts[0].kind} on {artifacts[0].marker}"
    return f"{len(artifacts)} artifacts"


def _check_within(artifact: Artifact, proposal: Repair) -> None:
    """Refuse a proposal that would touch anything its artifact does not name."""
    allowed = {artifact.marker, artifact.counterpart}
    for p in proposal.patches:
        inside = artifact.start <= p.start and p.stop <= artifact.stop
        if p.marker not in allowed or not inside or not set(p.axes) <= set(artifact.axes):
            raise DataError(
                f"The method “{proposal.method}” reached outside the artifact on "
                f"{artifact.marker}; nothing was changed."
            )
