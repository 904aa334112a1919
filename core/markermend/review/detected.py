"""What becomes of a review's artifacts once a detector has looked again."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import replace

from markermend.artifact import Artifact, Kind, Status
from markermend.review.unseen import free_id, uncovered


def taking_over(
    found: Iterable[Artifact], known: Sequence[Artifact], touched: Collection[str]
) -> dict[str, Artifact | None]:
    """Changes that put what was found in place of flags that nobody has decided about.

    Parameters
    ----------
    found : by the detector
    known : of the review
    touched : ids of those that the operator decided, marked or changed

    Returns
    -------
    By id: None for a pending flag that goes, the artifact for one that comes. One that stays keeps
    out a new flag of the same marker and kind that it covers by half; of a gap what it covers:
    that frames are missing is nothing to decide about.
    """
    ids = {a.id for a in known}
    staying: dict[str, list[Artifact]] = {}
    taken: set[str] = set()
    changes: dict[str, Artifact | None] = {}
    for artifact in known:
        if artifact.status is Status.PENDING and artifact.id not in touched:
            changes[artifact.id] = None
        else:
            staying.setdefault(artifact.marker, []).append(artifact)
            taken.add(artifact.id)
    for artifact in found:
        mine = staying.get(artifact.marker, ())
        if artifact.kind is Kind.GAP:
            for gap in uncovered(artifact, mine):
                # A marker that was renamed keeps its artifacts' ids, which another's may have now.
                name = free_id(gap.id, taken)
                changes[name] = replace(gap, id=name)
                taken.add(name)
        elif artifact.id in ids and artifact.id not in changes:
            continue
        elif not any(_same_finding(artifact, d) for d in mine):
            changes[artifact.id] = artifact
    return changes


def _same_finding(new: Artifact, decided: Artifact) -> bool:
    """Whether a decided artifact already covers half of a new flag."""
    if new.marker != decided.marker or new.kind != decided.kind:
        return False
    shared = min(new.stop, decided.stop) - max(new.start, decided.start)
    return shared * 2 >= new.length
