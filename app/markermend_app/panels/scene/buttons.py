"""The column of buttons beside the 3D view."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QMenu, QToolButton, QVBoxLayout, QWidget

from markermend_app.style import theme


class SceneButtons(QWidget):
    """What is seen, and what a drag with the left button does.

    Signals
    -------
    fit_wanted() : show everything
    follow_changed() : keep the body in the middle, or not
    changed() : something else is seen
    """

    fit_wanted = Signal()
    follow_changed = Signal()
    changed = Signal()

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._icons: list[tuple[QToolButton, str]] = []
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.setSpacing(0)
        self.fit = self._button("frame", self.tr("Show everything (double click)"), False)
        self.follow = self._button("body", self.tr("Keep the body in the middle"))
        self.trails = self._button("trail", "")
        self.labels = self._button("labels", "")
        self._column.addSpacing(6)
        self.box = self._button("select-box", "")
        self.lasso = self._button("select-lasso", "")
        self._column.addSpacing(6)
        self.more = self._button("more", self.tr("Colours, ghost, segments, vertical axis"), False)
        self.menu = QMenu(self.more)
        self.more.setMenu(self.menu)
        self.more.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.follow.setChecked(True)
        self.fit.clicked.connect(self.fit_wanted)
        self.follow.clicked.connect(self.follow_changed)
        for button in (self.trails, self.labels):
            button.clicked.connect(self.changed)
        # One tool at a time; a second click on it goes back to turning.
        self.box.clicked.connect(lambda on: self.lasso.setChecked(False))
        self.lasso.clicked.connect(lambda on: self.box.setChecked(False))
        theme.watcher.changed.connect(self._recolour)
        self._recolour()
        self.say_joints(False)

    def say_joints(self, joints: bool) -> None:
        """Say what the buttons do to joints, or to markers."""
        for button, of_joints, of_markers in (
            (self.trails, self.tr("Trails of all joints"), self.tr("Trails of all markers")),
            (self.labels, self.tr("Names of all joints"), self.tr("Names of all markers")),
            (
                self.box,
                self.tr("Select joints with a box (Esc ends it)"),
                self.tr("Select markers with a box (Esc ends it)"),
            ),
            (
                self.lasso,
                self.tr("Select joints with a lasso (Esc ends)"),
                self.tr("Select markers with a lasso (Esc ends)"),
            ),
        ):
            text = of_joints if joints else of_markers
            button.setToolTip(text)
            button.setAccessibleName(text)

    @property
    def tool(self) -> str:
        """What a drag selects with: ``"box"``, ``"lasso"`` or, when it turns the view, nothing."""
        return "box" if self.box.isChecked() else "lasso" if self.lasso.isChecked() else ""

    def drop_tool(self) -> None:
        """Let a drag turn the view again."""
        self.box.setChecked(False)
        self.lasso.setChecked(False)

    def _button(self, icon: str, tip: str, checkable: bool = True) -> QToolButton:
        button = QToolButton(self)
        button.setToolTip(tip)
        button.setAccessibleName(tip)
        button.setCheckable(checkable)
        button.setCursor(Qt.CursorShape.ArrowCursor)
        button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self._column.addWidget(button)
        self._icons.append((button, icon))
        return button

    def _recolour(self) -> None:
        for button, icon in self._icons:
            button.setIcon(theme.icon(icon))
