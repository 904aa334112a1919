"""Whom the camera stays with: all there is, or the subject of the marker that is looked at."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from markermend.arrays import FloatArray
from markermend.take import is_unlabelled
from markermend_app.document import Document
from markermend_app.panels.scene.camera import Camera
from markermend_app.panels.scene.stage import centre_at, reach_of


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
        self.everyone = True

    def start(self) -> None:
        """Begin with another take, with all of its markers that have a name."""
        session = self._document.session
        self._body = []
        if session is not None:
            take = session.original
            self._body = list(take.named or range(take.markers))
        self._centre, self.everyone = None, True

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
        self._body, self._centre, self.everyone = body, None, False
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
        centre = centre_at(session.positions, self._document.frame, self._body)
        if np.isnan(centre).any():
            return camera
        before, self._centre = self._centre, centre
        if before is not None:
            return camera.moved(centre - before)
        x, y, z = centre.tolist()
        return replace(camera, target=(x, y, z))
