"""Whom the camera stays with: all there is, or the subject of the marker that is looked at."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from markermend.arrays import BoolArray, FloatArray, runs
from markermend.artifact import Kind, Status
from markermend.review.session import Session
from markermend.take import Origin, is_unlabelled
from markermend_app.document import Document
from markermend_app.panels.scene.camera import Camera
from markermend_app.panels.scene.stage import centre_at, reach_of

# Over a longer stretch a body may have gone anywhere.
_LOST_S = 5.0


class Follower:
    """Moves a camera along with a body.

    Attributes
    ----------
    everyone : whether no subject was turned to yet
    """

    def __init__(self, document: Document) -> None:
        self._document = document
        self._body: list[int] = []
        self._centre: FloatArray | None = None
        self._lost: BoolArray | None = None
        self.everyone = True

    def start(self) -> None:
        """Begin with another take, with all of its markers that have a name."""
        session = self._document.session
        self._body = []
        if session is not None:
            take = session.original
            self._body = list(take.named or range(take.markers))
        self._centre, self._lost, self.everyone = None, None, True

    def forget(self, *_: object) -> None:
        """Samples or artifacts changed; what a signal tells of them is passed over."""
        self._lost = None

    def turn(self) -> bool:
        """Turn to the subject of the foremost marker shown; whether it is another one.

        An unlabelled trajectory may be anybody's, so that it turns nothing.
        """
        session, shown = self._document.session, self._document.shown
        if session is None or not shown or is_unlabelled(shown[0]):
            return False
        take = session.original
        who = take.subject(shown[0])
        body = [i for i in take.named if take.subject(take.labels[i]) == who]
        if body == self._body:
            return False
        self._body, self._centre, self._lost, self.everyone = body, None, None, False
        return True

    def reach(self) -> float:
        """How far who is followed extends from the middle, mm."""
        session = self._document.session
        return 0.0 if session is None else reach_of(session.original, self._body)

    def aimed(self, camera: Camera) -> Camera:
        """The camera with the body in its middle."""
        self._centre = None
        return self.kept_up(camera)

    def kept_up(self, camera: Camera) -> Camera:
        """The camera, moved as the body has moved since the last time."""
        session = self._document.session
        if session is None:
            return camera
        if self._lost is None:
            self._lost = lost_frames(session, self._body)
        centre = centre_at(session.positions, self._document.frame, self._body, self._lost)
        if np.isnan(centre).any():
            return camera
        before, self._centre = self._centre, centre
        if before is not None:
            return camera.moved(centre - before)
        x, y, z = centre.tolist()
        return replace(camera, target=(x, y, z))


def lost_frames(session: Session, body: Sequence[int]) -> BoolArray:
    """Frames that do not tell where a body is.

    A camera that went along with a body that is carried off would hide just that.

    Parameters
    ----------
    session : the review
    body : columns of the markers

    Returns
    -------
    (frames,) bool, where open artifacts cover more than half of the markers that are seen, unless
    that lasts
    """
    take = session.original
    row = {take.labels[column]: i for i, column in enumerate(body)}
    wrong = [
        (row[marker], a.start, a.stop)
        for a in session.with_status(Status.PENDING, Status.ACCEPTED)
        for marker in (a.markers if a.kind is not Kind.GAP else ())
        if marker in row
    ]
    table = np.array(wrong, dtype=np.int64).reshape(-1, 3)
    starts, stops = (np.bincount(table[:, i], minlength=take.frames + 1) for i in (1, 2))
    most = np.cumsum(starts - stops)[: take.frames]
    at = np.flatnonzero(most)
    seen = np.count_nonzero(session.origin[at[:, None], body] != Origin.MISSING, axis=1)
    # Only in few frames it matters which markers have several artifacts.
    near = 2 * most[at] > seen
    lost = np.zeros(take.frames, dtype=bool)
    if near.any():
        covered = np.zeros((len(body), take.frames), dtype=bool)
        for i, start, stop in wrong:
            covered[i, start:stop] = True
        lost[at[near]] = 2 * np.count_nonzero(covered[:, at[near]], axis=0) > seen[near]
    for start, stop in runs(lost).tolist():
        if stop - start > _LOST_S * take.rate:
            lost[start:stop] = False
    return lost
