"""In which order a review goes on."""

from __future__ import annotations

from collections.abc import Sequence

from markermend.artifact import Artifact, Status, within
from markermend.review.session import Session
from markermend.review.step import Step, artifacts_of

# Each restores the recording anew, which takes seconds.
_MOST_SLOW = 8


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


def ahead_and_beside(
    session: Session, at_once: Sequence[Artifact], ahead: Sequence[Artifact]
) -> tuple[Artifact, ...]:
    """Artifacts whose repairs are proposed beside others, in the order in which they are made.

    Of a recording of joints they are those that come next and those of the same moment: a body
    that is carried off has an artifact for each of its joints. What restoring the recording told
    already comes first, however much it is; of the rest of the same moment there are a few.

    Parameters
    ----------
    session : the review
    at_once : what is repaired at once, the one under review first
    ahead : those that come next
    """
    if not session.original.skeleton:
        return tuple(ahead)
    from markermend.poses.take import at_hand, pose_of

    take = session.original
    known = at_hand(pose_of(take))
    waiting = session.listed_with(Status.PENDING, Status.ACCEPTED)
    same = within(waiting, (at_once[0].start, at_once[0].stop))
    every = dict.fromkeys((*ahead, *(a for a in same if a not in at_once)))
    quick, slow = list[Artifact](), list[Artifact]()
    for a in every:
        joints = [take.index(marker) for marker in a.markers]
        (quick if known[a.start : a.stop, joints].all() else slow).append(a)
    return (*quick, *slow[: len(ahead) + _MOST_SLOW])


def about(session: Session, queue: Sequence[str], step: Step, current: str | None) -> str | None:
    """Id of the artifact that a step is about, or None when none of its artifacts is left.

    Of several it is the one under review, else the first in the order of the queue.
    """
    left = [i for i in artifacts_of(step) if session.find(i) is not None]
    if current in left or not left:
        return current if left else None
    listed = set(left)
    return next((i for i in queue if i in listed), left[0])
