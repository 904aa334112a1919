"""In which order a review goes on."""

from __future__ import annotations

from collections.abc import Sequence

from markermend.artifact import Status
from markermend.session import Session


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
    pending = {a.id for a in session.with_status(Status.PENDING)} - {artifact_id, *besides}
    order = list(queue)
    if artifact_id in order:
        i = order.index(artifact_id)
        order = order[i + 1 :] + order[:i]
    return tuple(i for i in order if i in pending)
