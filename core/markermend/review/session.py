"""A review: a take, its artifacts, the operator's decisions, and every step undoable.

Pure Python and NumPy: the window only shows it, the command line and scripts drive it alike.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
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
    SetRegion,
    State,
)
from markermend.review.history import History
from markermend.review.left_at import LeftAt
from markermend.review.pace import Pace, pace_of
from markermend.review.repairing import altered, describe, repairing
from markermend.review.restoring import taking_back
from markermend.review.step import touched_by_hand
from markermend.review.unseen import free_id, told, unseen, with_edges_moved
from markermend.take import Take

if TYPE_CHECKING:
    # The repair methods bring SciPy along; a review can be opened without it.
    from markermend.repairs.registry import Repair


class Session(History):
    """One review of one take.

    Parameters
    ----------
    take : the recording; it is never changed, work happens on a copy

    Attributes
    ----------
    Those of :class:`~markermend.review.history.History`, and
    left_at : where the operator stood last; told as the stopwatch is, or None
    """

    def __init__(self, take: Take) -> None:
        super().__init__(State(take))
        self.left_at: LeftAt | None = None
        self._take: tuple[int, Take] | None = None
        self._artifacts: tuple[int, tuple[Artifact, ...]] | None = None

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
    def pace(self) -> Pace:
        """How many artifacts are decided, and in how much time."""
        return pace_of(self.listed, self.stopwatch.spent_s, self.artifacts)

    # Decisions

    def add_detected(
        self, found: Iterable[Artifact], method: str, *, by_itself: bool = False
    ) -> Change:
        """Take over what a detector found.

        Flags that are still pending are replaced; what the operator decided, marked or changed
        stays, and a new flag that one of these of the same marker and kind already covers by
        half is left out, of a new gap the frames that they cover. What was searched ``by_itself``
        when the take was opened is no step of the operator's.
        """
        found = tuple(found)
        changes = taking_over(found, self.artifacts, touched_by_hand(self._done))
        for i in changes.keys() - {a.id for a in found}:
            if (left := changes[i]) is not None:
                changes[i] = told(self.original, left, unseen(self._state, left.marker))
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
        return free_id(wanted, self._state.artifacts)

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

        The ``others`` of its event are given the same in the same step. Frames that are not seen
        and that a gap leaves out become a gap of their own.
        """
        given = (kind, axes, start, stop, self.original.frames)
        before = [self.artifact(i) for i in (artifact_id, *others)]
        after = {a.id: new for a in before if (new := altered(a, *given)) != a}
        before = [a for a in before if a.id in after]
        if not after:
            return Change()
        changes = with_edges_moved(self._state, before, after)
        edits = (*taking_back(self._state, before), SetArtifacts(changes))
        called = any(a.kind is not after[a.id].kind for a in before)
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
