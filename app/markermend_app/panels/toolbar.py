"""The toolbar: words beside the icons as far as they have room."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QResizeEvent
from PySide6.QtWidgets import QToolBar, QToolButton, QWidget

from markermend_app.actions.menus import fill_toolbar

_ICONS = ("undo", "redo", "previous", "next")
_SELDOM = ("repair_accepted", "before_after", "prediction")
_WORDS = Qt.ToolButtonStyle.ToolButtonTextBesideIcon
_ALONE = Qt.ToolButtonStyle.ToolButtonIconOnly


class Toolbar(QToolBar):
    """Icons alone once the words would hide some of them, those seldom used first.

    Parameters
    ----------
    title : its name
    made : the window's actions by name
    short : words shorter than those of the menus, by name of the action
    """

    def __init__(
        self, title: str, made: Mapping[str, QAction], short: Mapping[str, str], parent: QWidget
    ) -> None:
        super().__init__(title, parent)
        self.setObjectName("toolbar")
        self.setMovable(False)
        for name, text in short.items():
            made[name].setIconText(text)
        fill_toolbar(self, made)
        self._buttons = [
            button
            for action in self.actions()
            if action.objectName() not in _ICONS
            and isinstance(button := self.widgetForAction(action), QToolButton)
        ]
        seldom = [self.widgetForAction(made[name]) for name in _SELDOM]
        self._seldom = [button for button in self._buttons if button in seldom]
        self._wear(())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Use as many words as fit."""
        super().resizeEvent(event)
        for alone in ((), self._seldom, self._buttons):
            self._wear(alone)
            if self.sizeHint().width() <= self.width():
                break

    def _wear(self, alone: Sequence[QToolButton]) -> None:
        """Leave the words out beside some icons."""
        for button in self._buttons:
            button.setToolButtonStyle(_ALONE if button in alone else _WORDS)
        layout = self.layout()
        assert layout is not None
        layout.invalidate()
