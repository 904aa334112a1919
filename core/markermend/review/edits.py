"""The few changes a review is made of. Each applies to a state and returns its inverse.

An edit is a small immutable value: applying it costs what it touches, not what the take holds,
and applying its inverse restores the state bit for bit. Undo, redo, journal and history are all
built on this one property.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass

from markermend.arrays import ByteArray, FloatArray
from markermend.artifact import Artifact
from markermend.errors import DataError
from markermend.patch import Patch, apply_patch
from markermend.review.base import Base, Held
from markermend.take import Take


@dataclass(frozen=True)
class RepairNote:
    """How an artifact was repaired: what JSON and report say of it.

    Attributes
    ----------
    method : name in the registry
    error_mm : expected mean error, or None when unknown
    leaves : what the detector still found there after the repair, in words; may be empty
    band_mm : expected deviation per frame (one standard deviation), or None
    """

    method: str
    error_mm: float | None = None
    leaves: str = ""
    band_mm: tuple[float, ...] | None = None


class State:
    """Working copy of a review: samples, artifacts by id, and how they were repaired.

    Attributes
    ----------
    original : the take as it was read, under the names its markers have now
    positions, origin : the working samples
    written : (start, stop) frames that were ever written to, by column; all others stand as they
        were read
    region : frames that matter, half-open; None for all of the take
    """

    def __init__(self, take: Take) -> None:
        self.original = take
        self.positions: FloatArray = take.positions.copy()
        self.origin: ByteArray = take.origin.copy()
        self.written: dict[int, set[tuple[int, int]]] = {}
        self.base = Base(take)
        self.artifacts: dict[str, Artifact] = {}
        self.notes: dict[str, RepairNote] = {}
        self.region: tuple[int, int] | None = None

    def held(self) -> Callable[[], Take]:
        """Hold on to the samples as they stand: what is called makes a take of them, at any time.

        Only what was written to is copied now, since copying a long take takes long.
        """
        original = self.original
        parts = [
            (
                slice(*span),
                column,
                self.positions[slice(*span), column].copy(),
                self.origin[slice(*span), column].copy(),
            )
            for column, spans in self.written.items()
            for span in spans
        ]

        def make() -> Take:
            positions, origin = original.positions.copy(), original.origin.copy()
            for frames, column, samples, origins in parts:
                positions[frames, column], origin[frames, column] = samples, origins
            return original.viewing(positions, origin)

        return make


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
                state.written.setdefault(column, set()).add((patch.start, patch.stop))
                undo.append(apply_patch(state.positions, state.origin, column, patch))
        except DataError:
            for patch in reversed(undo):
                apply_patch(
                    state.positions, state.origin, state.original.index(patch.marker), patch
                )
            raise
        return SetSamples(tuple(reversed(undo)))


@dataclass(frozen=True)
class SetBase:
    """Write patches into what repairs that are taken back return to: hand work stays."""

    patches: tuple[Patch, ...]

    def apply(self, state: State) -> PutBack:
        """Write the patches; each names all axes, so that none can fail."""
        columns = [state.original.index(p.marker) for p in self.patches]
        held = [state.base.write(c, p) for c, p in zip(columns, self.patches, strict=True)]
        return PutBack(tuple(zip(columns, held, strict=True))[::-1])


@dataclass(frozen=True)
class PutBack:
    """Let hand work of some markers be what it was: what undoes :class:`SetBase`."""

    held: tuple[tuple[int, Held], ...]

    def apply(self, state: State) -> PutBack:
        """Put it back."""
        return PutBack(tuple((c, state.base.put(c, held)) for c, held in self.held)[::-1])


@dataclass(frozen=True)
class SetNames:
    """Give markers other names, new by old; artifacts are told of it by an edit of their own."""

    names: Mapping[str, str]

    def apply(self, state: State) -> SetNames:
        """Rename."""
        state.original = state.original.renamed(self.names)
        return SetNames({new: old for old, new in self.names.items()})


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
class SetRegion:
    """Choose the frames that matter, a half-open interval; None for all of the take."""

    region: tuple[int, int] | None

    def apply(self, state: State) -> SetRegion:
        """Choose them.

        Raises
        ------
        DataError
            when they are none, or not all in the take
        """
        if self.region is not None:
            start, stop = self.region
            if not 0 <= start < stop <= state.original.frames:
                raise DataError(
                    "A region of interest needs a frame at least, and ends with the take."
                )
        before, state.region = state.region, self.region
        return SetRegion(before)


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


Edit = SetSamples | SetBase | PutBack | SetNames | SetArtifacts | SetNotes | SetRegion | Group


@dataclass(frozen=True)
class Change:
    """What an edit touched, so that views refresh no more than that.

    Attributes
    ----------
    markers : labels whose samples changed
    start, stop : frames within which they changed; equal when none did
    artifacts : whether any artifact or note changed, or which of them are asked about
    names : whether markers have other names
    """

    markers: tuple[str, ...] = ()
    start: int = 0
    stop: int = 0
    artifacts: bool = False
    names: bool = False


def _single(edit: Edit) -> Iterator[Edit]:
    """The edits that an edit is made of, however deep."""
    if isinstance(edit, Group):
        for part in edit.edits:
            yield from _single(part)
    else:
        yield edit


def samples_in(edit: Edit) -> int:
    """Number of samples that an edit holds, counting those that it holds twice."""
    return sum(
        len(patch.values)
        for item in _single(edit)
        if isinstance(item, SetSamples | SetBase)
        for patch in item.patches
    )


def extent(edit: Edit) -> Change:
    """Work out what an edit touches."""
    patches: list[Patch] = []
    artifacts = names = False
    for item in _single(edit):
        if isinstance(item, SetSamples):
            patches.extend(item.patches)
        elif isinstance(item, SetNames):
            names = names or bool(item.names)
        elif isinstance(item, SetArtifacts | SetNotes):
            artifacts = artifacts or bool(item.changes)
        elif isinstance(item, SetRegion):
            artifacts = True
    if not patches:
        return Change(artifacts=artifacts, names=names)
    return Change(
        markers=tuple(dict.fromkeys(p.marker for p in patches)),
        start=min(p.start for p in patches),
        stop=max(p.stop for p in patches),
        artifacts=artifacts,
        names=names,
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
        names=any(c.names for c in known),
    )
