"""Like with like: artifacts of one sort decided together, and what rejections teach."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, replace

from markermend.artifact import Artifact, Kind, Status
from markermend.review.edits import Change, SetArtifacts
from markermend.review.session import Session

SEVERAL = 3
"""Rejections of one class on one marker after which the others of it are in doubt."""


def alike(
    artifacts: Iterable[Artifact],
    kind: Kind,
    *,
    markers: Collection[str] | None = None,
    min_confidence: float = 0.0,
) -> tuple[Artifact, ...]:
    """Pick the open artifacts of one sort.

    Parameters
    ----------
    artifacts : to pick from; decided ones are passed over
    kind : class
    markers : on which; None for all
    min_confidence : those less sure are passed over

    Returns
    -------
    In the order given.
    """
    return tuple(
        a
        for a in artifacts
        if a.status is Status.PENDING
        and a.kind is kind
        and (markers is None or a.marker in markers)
        and a.confidence >= min_confidence
    )


@dataclass(frozen=True)
class Doubt:
    """A sort of artifact on a marker that mostly turned out to be a false alarm.

    Attributes
    ----------
    marker, kind : what it is about
    rejected, upheld : artifacts of it that were rejected, and accepted or repaired
    rest : those still open
    """

    marker: str
    kind: Kind
    rejected: int
    upheld: int
    rest: tuple[Artifact, ...]

    @property
    def share(self) -> float:
        """Share of the rest that is expected to be real, by the rule of succession (Laplace)."""
        return (self.upheld + 1) / (self.rejected + self.upheld + 2)


def doubts(
    artifacts: Sequence[Artifact], listed: Collection[Artifact] | None = None
) -> tuple[Doubt, ...]:
    """Find where several rejections, and more of them than not, leave others open.

    Gaps are never in doubt: a missing sample is a fact.

    Parameters
    ----------
    artifacts : all of the review
    listed : those that are asked about; None for all
    """
    asked = {a.id for a in (artifacts if listed is None else listed)}
    sorts = Counter((a.marker, a.kind) for a in artifacts if a.status is Status.REJECTED)
    found = []
    for (marker, kind), rejected in sorts.items():
        if rejected < SEVERAL or kind is Kind.GAP:
            continue
        same = [a for a in artifacts if (a.marker, a.kind) == (marker, kind)]
        upheld = sum(a.status in (Status.ACCEPTED, Status.REPAIRED) for a in same)
        rest = tuple(a for a in same if a.status is Status.PENDING and a.id in asked)
        if rest and rejected > upheld:
            found.append(Doubt(marker, kind, rejected, upheld, rest))
    return tuple(found)


def lower(session: Session, *found: Doubt) -> Change:
    """Make the rest less sure, as one step, so that they come last and no bulk repair takes them.

    Their confidence is multiplied by :attr:`Doubt.share`; see :func:`answered`.

    Parameters
    ----------
    session : the review
    found : one or more, of one class
    """
    changes = {a.id: replace(a, confidence=a.confidence * d.share) for d in found for a in d.rest}
    return session.perform(f"Lower {_named(found)}", SetArtifacts(changes))


def leave(session: Session, *found: Doubt) -> Change:
    """Leave the rest as sure as they are; a step that changes nothing, so that it is remembered."""
    return session.perform(f"Leave {_named(found)}", SetArtifacts({}))


def answered(session: Session, doubt: Doubt) -> bool:
    """Whether artifacts of this sort were made less sure in this review before, or left so."""
    for step in session.history:
        told = _ANSWER.fullmatch(step)
        if told and told["kind"] == doubt.kind and f", {doubt.marker}, " in f", {told['on']}, ":
            return True
    return False


_ANSWER = re.compile(r"(Lower|Leave) \d+ artifacts? \((?P<kind>\w+) on (?P<on>.+)\)")


def _named(found: Sequence[Doubt]) -> str:
    """How many artifacts of which sort; of all the markers, since these are not asked again."""
    number = sum(len(d.rest) for d in found)
    markers = ", ".join(d.marker for d in found)
    return f"{number} artifact{'s' * (number > 1)} ({found[0].kind} on {markers})"
