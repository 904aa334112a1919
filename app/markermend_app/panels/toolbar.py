"""The toolbar: words beside the icons where they have room."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QResizeEvent
from PySide6.QtWidgets import QToolBar, QToolButton, QWidget

from markermend_app.actions.menus import fill_toolbar

_ICONS = ("undo", "redo", "previous", "next")


class Toolbar(QToolBar):
    """Icons alone once the words would hide some of them.

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
        self._wear(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Use words if all of them fit."""
        super().resizeEvent(event)
        self._wear(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        if self.sizeHint().width() > self.width():
            self._wear(Qt.ToolButtonStyle.ToolButtonIconOnly)

    def _wear(self, style: Qt.ToolButtonStyle) -> None:
        for button in self._buttons:
            button.setToolButtonStyle(style)
        layout = self.layout()
        assert layout is not None
        layout.invalidate()
