"""The button that chooses what the overview shows; remembered."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QMenu, QToolButton, QWidget

from markermend_app import settings
from markermend_app.panels.overview.picture import MODES


class ModeButton(QToolButton):
    """Damage, gaps, or how far markers are from where the body puts them.

    Signals
    -------
    chosen(str) : another of ``MODES`` was chosen
    """

    chosen = Signal(str)

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        mode = settings.text("overview", MODES[0])
        self.mode = mode if mode in MODES else MODES[0]
        self._names = {
            "damage": self.tr("Damage"),
            "gaps": self.tr("Gaps"),
            "residual": self.tr("Off body"),
        }
        self.setObjectName("overviewMode")
        self.setToolTip(self.tr("What the overview shows"))
        self.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        menu = QMenu(self)
        for name in MODES:
            action = menu.addAction(self._names[name])
            action.setData(name)
            action.setCheckable(True)
            action.triggered.connect(lambda _=False, name=name: self.choose(name))
        self.setMenu(menu)
        self._name()

    def choose(self, mode: str) -> None:
        """Show another picture."""
        if mode != self.mode:
            self.mode = mode
            settings.remember("overview", mode)
            self.chosen.emit(mode)
        self._name()

    def choose_next(self) -> None:
        """Show the next picture, going round."""
        self.choose(MODES[(MODES.index(self.mode) + 1) % len(MODES)])

    def _name(self) -> None:
        """Say and tick which picture is shown."""
        self.setText(f"{self._names[self.mode]} ▾")
        self.setAccessibleName(self.tr("Overview: {0}").format(self._names[self.mode]))
        for action in self.menu().actions():
            action.setChecked(action.data() == self.mode)
