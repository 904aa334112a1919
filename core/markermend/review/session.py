"""A review: a take, its artifacts, the operator's decisions, and every step undoable.

Pure Python and NumPy: the window only shows it, the command line and scripts drive it alike.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from operator import index
from typing import TYPE_CHECKING

from markermend.arrays import ByteArray, FloatArray
from markermend.artifact import Artifact, Kind, Status, in_order, repair_in_words, within
from markermend.errors import DataError
from markermend.review.detected import taking_over
from markermend.review.edits import (
    Change,
    Edit,
    Group,
    RepairNote,
    SetArtifacts,
    SetBase,
    SetNames,
    SetRegion,
    State,
    extent,
    merged,
)
from markermend.review.left_at import LeftAt
from markermend.review.pace import Pace, Stopwatch, pace_of
from markermend.review.repairing import altered, describe, repairing
from markermend.review.restoring import taking_back
from markermend.review.step import Step, decides, parts, touched_by_hand
from markermend.take import Take

if TYPE_CHECKING:
    # The repair methods bring SciPy along; a review can be opened without it.
    from markermend.repairs.registry import Repair


class Session:
    """One review of one take.

    Parameters
    ----------
    take : the recording; it is never changed, work happens on a copy

    Attributes
    ----------
    stopwatch : measures the operator's time; told by whoever sees what the operator does
    revision : grows with every change, also by undo and redo; what was computed at one revision
        may be applied only while it is unchanged
    left_at : where the operator stood last; told as the stopwatch is, or None
    on_step : called after each change with ``("do", step)``, ``("undo", step)`` or
        ``("redo", step)``; the journal hangs here
    """

    def __init__(self, take: Take) -> None:
        self.revision = 0
        self.stopwatch = Stopwatch()
        self.left_at: LeftAt | None = None
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
    def original(self) -> Take:
        """The take as it was read, under the names its markers have now."""
        return self._state.original

    @property
    def state(self) -> State:
        """What edits apply to; to be read, not written."""
        return self._state

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
    def region(self) -> tuple[int, int] | None:
        """Frames that matter, a half-open interval; None for all of the take."""
        return self._state.region

    @property
    def asked(self) -> slice:
        """Frames that are asked about: the region of interest, or all of the take."""
        return slice(*(self.region or (0, self.original.frames)))

    @property
    def listed(self) -> tuple[Artifact, ...]:
        """Artifacts that are asked about: those that reach into the region of interest."""
        region = self.region
        return self.artifacts if region is None else within(self.artifacts, region)

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
        """Artifacts whose status is one of these, in the region of interest or not."""
        return tuple(a for a in self.artifacts if a.status in statuses)

    def listed_with(self, *statuses: Status) -> tuple[Artifact, ...]:
        """Artifacts that are asked about and whose status is one of these."""
        return tuple(a for a in self.listed if a.status in statuses)

    @property
    def expected_errors(self) -> Mapping[str, float]:
        """How far off repairs may be, mm, by the artifact's id, where it is known."""
        notes = self._state.notes.items()
        return {n: note.error_mm for n, note in notes if note.error_mm is not None}

    def repairs_in_words(self, frames: tuple[int, int] | None = None) -> tuple[str, ...]:
        """Say what was repaired and how, one line each, for the record in an exported file.

        Work by hand on samples and names follows, in the words of the history.

        Parameters
        ----------
        frames : half-open interval of what is exported; repairs outside it are left out
        """
        repaired = (
            repair_in_words(self.original, a, note.method if note else "")
            for a in self.with_status(Status.REPAIRED)
            if frames is None or within([a], frames)
            for note in [self._state.notes.get(a.id)]
        )
        return (*repaired, *self.by_hand)

    @property
    def by_hand(self) -> tuple[str, ...]:
        """Work by hand on samples and names, in the words of the history."""
        return tuple(s.label for s in self._done if parts(s.edit, SetBase, SetNames))

    @property
    def renamed(self) -> bool:
        """Whether markers were given other names."""
        return any(parts(s.edit, SetNames) for s in self._done)

    @property
    def pace(self) -> Pace:
        """How many artifacts are decided, and in how much time."""
        return pace_of(self.listed, self.stopwatch.spent_s, self.artifacts)

    @property
    def begun(self) -> bool:
        """Whether anything was done but to choose the frames that matter."""
        return any(not isinstance(s.edit, SetRegion) for s in self._done)

    # Decisions

    def add_detected(
        self, found: Iterable[Artifact], method: str, *, by_itself: bool = False
    ) -> Change:
        """Take over what a detector found.

        Flags that are still pending are replaced; what the operator decided, marked or changed
        stays, and a new flag that one of these of the same marker and kind already covers by
        half is left out. What was searched ``by_itself`` when the take was opened is no step of
        the operator's.
        """
        changes = taking_over(found, self.artifacts, touched_by_hand(self._done))
        return self.perform(f"Detect ({method})", SetArtifacts(changes), by_itself=by_itself)

    def set_status(self, ids: Sequence[str], status: Status) -> Change:
        """Accept, reject or reopen; reopening or rejecting a repaired one restores its samples.

        Those that have the status already stay as they are; where all have, no step is made.
        """
        chosen = [a for a in map(self.artifact, ids) if a.status is not status]
        if not chosen:
            return Change()
        edits: list[Edit] = []
        if status is not Status.REPAIRED:
            edits.extend(taking_back(self._state, chosen))
        edits.append(SetArtifacts({a.id: a.with_status(status) for a in chosen}))
        verb = {
            Status.ACCEPTED: "Accept",
            Status.REJECTED: "Reject",
            Status.PENDING: "Reopen",
            Status.REPAIRED: "Mark as repaired",
        }[status]
        return self.perform(f"{verb} {describe(chosen)}", Group(tuple(edits)))

    def repair(
        self, repairs: Sequence[tuple[str, Repair]], label: str = "", *, by_itself: bool = False
    ) -> Change:
        """Replace samples by proposed repairs, all as one step; ``by_itself`` as for finding.

        An artifact that was repaired before goes back to its source samples first.

        Raises
        ------
        DataError
            when a proposal has no patches, or leaves the interval or the axes of its artifact
        """
        chosen = [self.artifact(i) for i, _ in repairs]
        edits: list[Edit] = [*taking_back(self._state, chosen)]
        known = self.artifacts
        for artifact, (_, proposal) in zip(chosen, repairs, strict=True):
            edits.extend(repairing(artifact, proposal, known))
        method = repairs[0][1].method if len(repairs) == 1 else None
        label = label or f"Repair {describe(chosen, method)}"
        return self.perform(label, Group(tuple(edits)), by_itself=by_itself)

    def mark(self, artifact: Artifact) -> Change:
        """Add an artifact by hand."""
        artifact = self.placed(artifact)
        return self.perform(f"Mark {describe([artifact])}", SetArtifacts({artifact.id: artifact}))

    def placed(self, artifact: Artifact) -> Artifact:
        """An artifact under a name that is not in use.

        Raises
        ------
        DataError
            when there is no such marker, or it reaches beyond the take
        """
        self.original.index(artifact.marker)
        if artifact.stop > self.original.frames:
            raise DataError("An artifact cannot reach beyond the last frame.")
        return replace(artifact, id=self.free_id(artifact.id))

    def free_id(self, wanted: str) -> str:
        """An artifact's name that is not in use, the wanted one if it can be."""
        while wanted in self._state.artifacts:
            wanted += "+"
        return wanted

    def remove(self, ids: Sequence[str]) -> Change:
        """Take artifacts off the list; samples of repaired ones go back to the source."""
        chosen = [self.artifact(i) for i in ids]
        edits = (*taking_back(self._state, chosen), SetArtifacts(dict.fromkeys(ids)))
        return self.perform(f"Remove {describe(chosen)}", Group(edits))

    def annotate(self, artifact_id: str, note: str, *, others: Sequence[str] = ()) -> Change:
        """Write a note on an artifact and the ``others`` of its event; an empty one takes it away.

        Those that have it already stay as they are; where all have, no step is made.
        """
        note = note.strip()
        chosen = [a for i in (artifact_id, *others) if (a := self.artifact(i)).note != note]
        if not chosen:
            return Change()
        changes = {a.id: replace(a, note=note) for a in chosen}
        return self.perform(f"Note on {describe(chosen)}", SetArtifacts(changes))

    def change(
        self,
        artifact_id: str,
        *,
        kind: Kind | None = None,
        axes: str | None = None,
        start: int | None = None,
        stop: int | None = None,
        others: Sequence[str] = (),
        label: str = "",
    ) -> Change:
        """Give an artifact another class, other axes or other edges; a repaired one reopens.

        The ``others`` of its event are given the same in the same step.
        """
        frames, rate = self.original.frames, self.original.rate
        given = (kind, axes, start, stop)
        before = [self.artifact(i) for i in (artifact_id, *others)]
        changes = {a.id: new for a in before if (new := altered(a, *given, frames, rate)) != a}
        before = [a for a in before if a.id in changes]
        if not changes:
            return Change()
        edits = (*taking_back(self._state, before), SetArtifacts(changes))
        called = any(a.kind is not changes[a.id].kind for a in before)
        what = f"Call {describe(before)} {kind}" if called else f"Adjust {describe(before)}"
        return self.perform(label or what, Group(edits))

    def set_region(self, region: tuple[int, int] | None) -> Change:
        """Choose the frames that matter: what lies outside them is not asked about.

        Parameters
        ----------
        region : half-open interval of 0-based frames; None, or all of them, for the whole take

        Raises
        ------
        DataError
            when it is empty or reaches beyond the take
        """
        frames = self.original.frames
        if region is not None:
            try:
                start, stop = map(index, region)
            except (TypeError, ValueError):
                raise DataError("A region of interest is two whole numbers of frames.") from None
            region = (start, stop)
        if region == (0, frames):
            region = None
        if region == self.region:
            return Change()
        label = "Review the whole take"
        if region is not None:
            first, last = self.original.frame_numbers(*region)
            label = f"Review frames {first}–{last} only"
        return self.perform(label, SetRegion(region))

    # History

    @property
    def history(self) -> tuple[str, ...]:
        """Labels of the steps done, oldest first."""
        return tuple(s.label for s in self._done)

    @property
    def undone(self) -> tuple[str, ...]:
        """Labels of the steps that redo would bring back, next first."""
        return tuple(s.label for s in reversed(self._undone))

    @property
    def undoable(self) -> bool:
        """Whether the last step is one that the operator would take back, who did it."""
        return bool(self._done) and not self._done[-1].by_itself

    def perform(
        self, label: str, edit: Edit, spent_s: float | None = None, by_itself: bool = False
    ) -> Change:
        """Apply an edit as one undoable step; one that was stored knows the time of its making."""
        inverse = edit.apply(self._state)
        if spent_s is None:
            spent_s = self.stopwatch.touch()
        else:
            self.stopwatch.spent_s = max(self.stopwatch.spent_s, spent_s)
        step = Step(label, edit, inverse, spent_s, by_itself)
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
        return last is self._clean_at or not any(decides(s) for s in self._done)

    @property
    def exported_at(self) -> int | None:
        """How many steps were done when it was exported last; None if that state is gone."""
        return next((i + 1 for i, s in enumerate(self._done) if s is self._clean_at), None)

    def mark_exported(self, steps_done: int | None = None) -> None:
        """Remember that what stands now is in a file, or what stood after so many steps."""
        done = self._done if steps_done is None else self._done[:steps_done]
        self._clean_at = done[-1] if done else None

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
