"""Lets the preferences hold in a window: axis, units, and saving from time to time."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, QTimer
from PySide6.QtWidgets import QWidget

from markermend.take import AXES
from markermend_app import settings, units
from markermend_app.dialogs.preferences import AUTOSAVE, AUTOSAVE_MIN, VERTICAL, Preferences
from markermend_app.document import Document
from markermend_app.style import theme


class Preferred(QObject):
    """Takes over what is chosen on the page of preferences.

    Parameters
    ----------
    document : what is shown
    save : saves the review as it stands
    stand_up : lets an axis (0, 1, 2) point up, or the one the take suggests (None)
    looks_changed : the theme or detecting after opening were changed
    window : the page's parent
    """

    def __init__(
        self,
        document: Document,
        save: Callable[[], None],
        stand_up: Callable[[int | None], None],
        looks_changed: Callable[[str], None],
        window: QWidget,
    ) -> None:
        super().__init__(window)
        self._document, self._stand_up, self._window = document, stand_up, window
        self._looks_changed = looks_changed
        self.saving = QTimer(self)
        self.saving.timeout.connect(save)
        document.opened.connect(self._opened)
        self._time_saving()

    def open(self) -> None:
        """Show the page."""
        page = Preferences(self._window)
        if self._document.joints:
            page.dial_does_nothing()
        page.changed.connect(self.take)
        page.exec()

    def take(self, name: str) -> None:
        """Let a setting hold that was changed."""
        if name == VERTICAL:
            self._set_vertical()
        elif name == AUTOSAVE:
            self._time_saving()
        elif name == units.SETTING:
            self._write_units()
        else:
            self._looks_changed(name)

    def _write_units(self) -> None:
        """Let everyone write anew what is open."""
        document = self._document
        theme.watcher.changed.emit()
        for signal in (
            document.artifacts_changed,
            document.current_changed,
            document.proposal_changed,
        ):
            signal.emit()
        document.frame_changed.emit(document.frame)

    def _opened(self) -> None:
        """Let the axis point up that was chosen once for all."""
        if not self._document.renaming and settings.text(VERTICAL, "auto") in AXES:
            self._set_vertical()

    def _set_vertical(self) -> None:
        if self._document.session is not None:
            axis = settings.text(VERTICAL, "auto")
            self._stand_up(AXES.index(axis) if axis in AXES else None)

    def _time_saving(self) -> None:
        """Save as often as was chosen."""
        minutes = settings.number(AUTOSAVE, AUTOSAVE_MIN)
        if minutes > 0:
            self.saving.start(round(minutes * 60_000))
        else:
            self.saving.stop()
