"""Repairing an artifact as it was proposed: the edits of a review that this takes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from markermend.artifact import PAIRED, Artifact, Kind, Status, changed_markers
from markermend.artifact_json import rounded
from markermend.errors import DataError
from markermend.review.edits import Edit, RepairNote, SetArtifacts, SetNotes, SetSamples
from markermend.review.events import events
from markermend.take import AXES

if TYPE_CHECKING:
    # The repair methods bring SciPy along; a review can be opened without it.
    from markermend.repairs.registry import Repair


def repairing(
    artifact: Artifact, proposal: Repair, known: Iterable[Artifact] = ()
) -> tuple[Edit, ...]:
    """Edits that repair an artifact as proposed.

    Where a mix-up is repaired on some of its markers only, the others become artifacts of their
    own, which are open; they go when that repair is taken back.

    Parameters
    ----------
    artifact : of the review
    proposal : its patches may reach no further than the artifact and its axes
    known : the others of the review; what they tell of a marker is not told once more

    Raises
    ------
    DataError
        when the proposal has no patches, or reaches outside
    """
    if not proposal.patches:
        why = proposal.reason or "the method has no answer here"
        raise DataError(f"The {describe([artifact])} cannot be repaired: {why}")
    _check_within(artifact, proposal)
    from markermend.repairs.look_again import in_words

    band = None if proposal.band_mm is None else tuple(rounded(proposal.band_mm))
    note = RepairNote(proposal.method, proposal.error_mm, in_words(proposal.leaves or ()), band)
    mended = {p.marker for p in proposal.patches}
    left = [m for m in artifact.markers if m not in mended]
    others = _parted(artifact, left, known) if left else []
    return (
        SetSamples(proposal.patches),
        SetNotes({artifact.id: note}),
        SetArtifacts({a.id: a for a in (artifact.with_status(Status.REPAIRED), *others)}),
    )


def altered(
    old: Artifact,
    kind: Kind | None,
    axes: str | None,
    start: int | None,
    stop: int | None,
    frames: int,
) -> Artifact:
    """An artifact with what is given of class, axes and edges; a repaired one is open again.

    Parameters
    ----------
    old : before; it is the answer where nothing is another
    kind, axes, start, stop : None to leave them
    frames : of the take; edges stay within it
    """
    new = replace(
        old,
        kind=old.kind if kind is None else kind,
        axes=old.axes if axes is None else axes,
        start=old.start if start is None else max(0, start),
        stop=old.stop if stop is None else min(stop, frames),
    )
    if new != old and old.status is Status.REPAIRED:
        new = new.with_status(Status.PENDING)
    return by_hand(old, new)


def by_hand(old: Artifact, new: Artifact) -> Artifact:
    """An artifact whose frames or class were changed by hand, with a reason that is still true.

    What gaps hold :func:`markermend.review.unseen.told` says.

    Parameters
    ----------
    old, new : before and after; what has the same frames and class keeps its reason
    """
    if (old.start, old.stop, old.kind) == (new.start, new.stop, new.kind):
        return new
    if new.kind is not old.kind:
        return replace(new, why=f"called {new.kind.value} by hand")
    return replace(new, why="its frames were set by hand")


def as_one(alike: Sequence[Artifact]) -> Artifact:
    """Join artifacts of one marker; of the class of the one we are surest of.

    Parameters
    ----------
    alike : one or more; what is made of them is open again if any was repaired
    """
    best = max(alike, key=lambda a: (a.confidence, a.length))
    statuses = {a.status for a in alike}
    joined = replace(
        best,
        start=min(a.start for a in alike),
        stop=max(a.stop for a in alike),
        axes="".join(x for x in AXES if any(x in a.axes for a in alike)),
        note="\n".join(dict.fromkeys(a.note for a in alike if a.note)),
        status=statuses.pop() if statuses == {Status.ACCEPTED} else Status.PENDING,
    )
    return by_hand(best, joined)


def describe(artifacts: Sequence[Artifact], method: str | None = None) -> str:
    """Name artifacts in a history label, a mix-up by all of its markers that a method changes."""
    first, more = artifacts[0], len(artifacts) - 1
    if len(events(artifacts)) > 1:
        return f"{len(artifacts)} artifacts"
    named = f"{first.kind} on {PAIRED.join(changed_markers(first, method))}"
    return f"{named} +{more}" if more else named


def _parted(artifact: Artifact, left: Sequence[str], known: Iterable[Artifact]) -> list[Artifact]:
    """An artifact for each marker of a mix-up that is left, but where the review tells of it."""
    others = [a for a in known if a.id != artifact.id]
    anew = {a.id for a in left_by(artifact, others)}
    told = {a.marker for a in others if a.id not in anew and _mostly_covers(a, artifact)}
    return [_on_its_own(artifact, marker) for marker in left if marker not in told]


def left_by(artifact: Artifact, known: Iterable[Artifact]) -> list[Artifact]:
    """Artifacts that :func:`repairing` made of a mix-up's other markers, and nobody decided."""
    mine = {_on_its_own(artifact, marker).id for marker in artifact.markers[1:]}
    if not mine:
        return []
    return [a for a in known if a.id in mine and a.status is Status.PENDING]


def _on_its_own(artifact: Artifact, marker: str) -> Artifact:
    """What is wrong on one marker of a mix-up once another one was repaired by itself."""
    alone = replace(
        artifact,
        marker=marker,
        counterpart=None,
        further_counterparts=(),
        status=Status.PENDING,
        note="",
        why=f"was taken for a mix-up with {artifact.marker}, which was repaired by itself",
        id="",
    )
    # A name that nothing else has: what was marked there by hand may be the same otherwise.
    return replace(alone, id=f"{alone.id}-{artifact.id}")


def _mostly_covers(one: Artifact, other: Artifact) -> bool:
    """Whether an artifact has half of another one's frames."""
    return 2 * (min(one.stop, other.stop) - max(one.start, other.start)) >= other.length


def _check_within(artifact: Artifact, proposal: Repair) -> None:
    """Refuse a proposal that would touch anything its artifact does not name."""
    for p in proposal.patches:
        inside = artifact.start <= p.start and p.stop <= artifact.stop
        if p.marker not in artifact.markers or not inside or not set(p.axes) <= set(artifact.axes):
            raise DataError(
                f"The method “{proposal.method}” reached outside the artifact on "
                f"{artifact.marker}; nothing was changed."
            )
