"""Going to what a step was about, once it was taken back or done again."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer

from markermend.review.edits import extent
from markermend.review.step import Step
from markermend_app.walk import about

if TYPE_CHECKING:
    from markermend_app.document import Document

REST_MS = 120


class Following(QObject):
    """Shows what a step was about: at once, and while a key is held now and then.

    To show an artifact takes longer than a held key takes to come again. What is under review is
    always that of the last step, whether it is shown already or not.
    """

    def __init__(self, document: Document) -> None:
        super().__init__(document)
        self._document = document
        self._last: Sequence[Step] = ()
        self._rest = QTimer(self, singleShot=True, interval=REST_MS)
        self._rest.timeout.connect(self._rested)

    def after(self, last: Sequence[Step]) -> None:
        """Go to what the last step was about, soon at the latest."""
        self._last = tuple(last)
        if self._rest.isActive():
            found = self._found()
            if found is not None:
                self._document.put_under_review(found)
        else:
            self._rested()

    def catch_up(self) -> None:
        """Show now what is to be shown soon."""
        if self._last:
            self._go()

    def forget(self) -> None:
        """Leave it: something else is shown."""
        self._last = ()

    def _rested(self) -> None:
        if self._last:
            self._go()
            self._rest.start()

    def _found(self) -> str | None:
        """Id of the artifact that the last step is about, if it is left."""
        d = self._document
        if d.session is None:
            return None
        now = None if d.current is None else d.current.id
        found = [about(d.session, d.queue, step, now) for step in self._last]
        return found[0] if found else None

    def _go(self) -> None:
        """Put that artifact under review, or bring the samples that the step changed in view."""
        document, found = self._document, self._found()
        last, self._last = self._last, ()
        if found is not None:
            document.select(found, unless_seen=True)
            return
        document.stay()
        for changed in (extent(step.edit) for step in last):
            if changed.markers:
                document.reveal(
                    [document.foremost_of(changed.markers)], changed.start, changed.stop
                )
