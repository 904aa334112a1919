"""In which order a review goes on."""

from __future__ import annotations

from collections.abc import Sequence

from markermend.artifact import Artifact, Status, within
from markermend.review.session import Session
from markermend.review.step import Step, artifacts_of

_MOST_BESIDE = 8


def open_after(
    session: Session, queue: Sequence[str], artifact_id: str | None, besides: Sequence[str] = ()
) -> tuple[str, ...]:
    """Undecided artifacts in the order of a queue, from one on, then from its beginning.

    Parameters
    ----------
    session : the review
    queue : ids in the order in which they are listed
    artifact_id : where to begin; it is left out itself
    besides : ids that are left out too
    """
    if artifact_id is None:
        return ()
    pending = {a.id for a in session.listed_with(Status.PENDING)} - {artifact_id, *besides}
    order = list(queue)
    if artifact_id in order:
        i = order.index(artifact_id)
        order = order[i + 1 :] + order[:i]
    return tuple(i for i in order if i in pending)


def same_moment(session: Session, artifact: Artifact) -> tuple[Artifact, ...]:
    """Others that are not repaired yet and share frames with an artifact, the first few."""
    waiting = session.listed_with(Status.PENDING, Status.ACCEPTED)
    same = within(waiting, (artifact.start, artifact.stop))
    return tuple(a for a in same if a.id != artifact.id)[:_MOST_BESIDE]


def about(session: Session, queue: Sequence[str], step: Step, current: str | None) -> str | None:
    """Id of the artifact that a step is about, or None when none of its artifacts is left.

    Of several it is the one under review, else the first in the order of the queue.
    """
    left = [i for i in artifacts_of(step) if session.find(i) is not None]
    if current in left or not left:
        return current if left else None
    listed = set(left)
    return next((i for i in queue if i in listed), left[0])
