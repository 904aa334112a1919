"""Playback at true speed, and where in the take we are."""

from __future__ import annotations

import math

from PySide6.QtCore import QElapsedTimer, Qt, QTimer, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QComboBox,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QSlider,
    QSpinBox,
    QToolButton,
    QWidget,
)

from markermend_app.actions import shortcuts
from markermend_app.actions.shortcuts import KeyTip
from markermend_app.document import Document
from markermend_app.panels.spared import show_if_it_fits, spare
from markermend_app.style import theme

SPEEDS = (0.1, 0.25, 0.5, 1.0, 2.0, 4.0)
TICK_MS = 15
_MARGIN = 8


class Transport(QWidget):
    """Buttons, slider and fields for the frame; frames are skipped rather than slowed down.

    Signals
    -------
    left() : a frame number was typed, and the keyboard is free again
    """

    left = Signal()

    def __init__(self, document: Document, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self._view: tuple[int, int] | None = None
        self._moving = False
        self._from = 0
        self._clock = QElapsedTimer()
        self._timer = QTimer(self)
        self._timer.setTimerType(Qt.TimerType.PreciseTimer)
        self._timer.setInterval(TICK_MS)
        self._timer.timeout.connect(self.tick)

        self.slider = QSlider(Qt.Orientation.Horizontal)
        self.slider.setAccessibleName(self.tr("Frame"))
        self.slider.valueChanged.connect(document.go_to)
        self.number = QSpinBox()
        self.number.setAccessibleName(self.tr("Frame number"))
        self.number.setToolTip(self.tr("Frame number, as in the file"))
        self.number.setKeyboardTracking(False)
        self.number.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.number.setFixedWidth(88)
        self.number.valueChanged.connect(self._number_changed)
        self.number.lineEdit().returnPressed.connect(self.left.emit)
        self.time = QLabel()
        self.time.setProperty("role", "small")
        self.time.setToolTip(self.tr("Time since the first frame, and length of the take"))
        self.speed = QComboBox()
        self.speed.setAccessibleName(self.tr("Speed"))
        self.speed.setToolTip(self.tr("Speed of playback"))
        for speed in SPEEDS:
            self.speed.addItem(f"{speed:g}×", speed)
        self.speed.setFixedWidth(76)
        self.speed.setCurrentIndex(SPEEDS.index(1.0))
        self.speed.currentIndexChanged.connect(self._rebase)

        self.first = self._button(self.tr("To the first frame"), "to_start")
        self.back = self._button(self.tr("One frame back"), "frame_back")
        self.play = self._button("")
        self.forward = self._button(self.tr("One frame forward"), "frame_forward")
        self.last = self._button(self.tr("To the last frame"), "to_end")
        self.loop = self._button(self.tr("Repeat what the plots show"))
        self.loop.setCheckable(True)
        self.first.clicked.connect(lambda: document.go_to(0))
        self.back.clicked.connect(lambda: self.step(-1))
        self.play.clicked.connect(self.toggle_play)
        self.forward.clicked.connect(lambda: self.step(1))
        self.last.clicked.connect(lambda: document.go_to(self._frames - 1))
        for button in (self.back, self.forward):
            button.setAutoRepeat(True)
            button.setAutoRepeatInterval(40)
        self._lay_out()

        document.opened.connect(self._opened)
        document.frame_changed.connect(self._frame_changed)
        document.frame_requested.connect(self._brought_into_view)
        theme.watcher.changed.connect(self._recolour)
        shortcuts.watcher.changed.connect(self._recolour)
        self._recolour()
        self._opened()

    def _button(self, tip: str, name: str = "") -> QToolButton:
        """A button; with the name of an action that does the same, its tooltip names the key."""
        button = QToolButton()
        KeyTip(button, tip, name)
        return button

    def _lay_out(self) -> None:
        """Slider above, buttons and fields below: fits a narrow dock."""
        self._row = buttons = QHBoxLayout()
        buttons.setSpacing(0)
        for button in (self.first, self.back, self.play, self.forward, self.last, self.loop):
            buttons.addWidget(button)
        buttons.addSpacing(4)
        buttons.addWidget(self.speed)
        buttons.addSpacing(4)
        self.time.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        spare(self.time)
        buttons.addWidget(self.time, 1)
        grid = QGridLayout(self)
        grid.setContentsMargins(_MARGIN, 4, _MARGIN, 4)
        grid.setVerticalSpacing(4)
        grid.setHorizontalSpacing(8)
        grid.addWidget(self.slider, 0, 0)
        grid.addWidget(self.number, 0, 1)
        grid.addLayout(buttons, 1, 0, 1, 2)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Leave the time to the plots, which tell it too, where room is scarce."""
        super().resizeEvent(event)
        self._fit_time()

    def _fit_time(self) -> None:
        show_if_it_fits(self.time, self._row, self.contentsRect().width() - 2 * _MARGIN)

    # Playing

    @property
    def playing(self) -> bool:
        """Whether the take is being played."""
        return self._timer.isActive()

    def toggle_play(self) -> None:
        """Play from the cursor, or pause; at the end it plays from the start again."""
        if self.playing:
            self._timer.stop()
        elif self._frames > 1:
            start, stop = self._range()
            if self._document.frame >= stop - 1:
                self._document.go_to(start)
            self._timer.start()
            self._rebase()
        self._recolour()

    def step(self, by: int) -> None:
        """Move the cursor by frames; pauses."""
        if self.playing:
            self.toggle_play()
        self._document.go_to(self._document.frame + by)

    def set_view(self, start: float, stop: float) -> None:
        """Tell which frames the plots show: what a loop repeats."""
        self._view = (math.ceil(start), math.floor(stop))

    def tick(self) -> None:
        """Go to the frame that is due now."""
        session = self._document.session
        if session is None:
            return
        seconds = self._clock.elapsed() / 1000
        frame = self._from + int(seconds * session.original.rate * self.speed.currentData())
        start, stop = self._range()
        if frame >= stop:
            if self.loop.isChecked():
                self._go(start)
                self._rebase()
            else:
                self._go(stop - 1)
                self.toggle_play()
            return
        self._go(frame)

    @property
    def _frames(self) -> int:
        session = self._document.session
        return 0 if session is None else session.original.frames

    def _range(self) -> tuple[int, int]:
        """Frames that are played: with loop those in view, if the cursor is among them.

        Else those of the region of interest, from within it.
        """
        if self.loop.isChecked() and self._view is not None:
            start, stop = max(self._view[0], 0), min(self._view[1], self._frames)
            if start <= self._document.frame < stop and stop - start > 1:
                return start, stop
        session = self._document.session
        region = None if session is None else session.region
        if region is not None and region[0] <= self._document.frame < region[1]:
            return region
        return 0, self._frames

    def _rebase(self) -> None:
        """Count from here and now."""
        self._from = self._document.frame
        self._clock.start()

    def _go(self, frame: int) -> None:
        """Move the cursor while playing."""
        self._moving = True
        self._document.go_to(frame)
        self._moving = False

    # Following the document

    def _opened(self) -> None:
        """Another take, or none."""
        self._timer.stop()
        self._view = None
        session = self._document.session
        self.setEnabled(session is not None)
        first = 1 if session is None else session.original.first_frame
        for field, low in ((self.slider, 0), (self.number, first)):
            field.blockSignals(True)
            field.setRange(low, low + max(self._frames - 1, 0))
            field.blockSignals(False)
        self._recolour()
        self._frame_changed(self._document.frame)

    def _frame_changed(self, frame: int) -> None:
        """Show where the cursor is; whoever moved it while playing moved the playback."""
        session = self._document.session
        take = None if session is None else session.original
        for field, value in (
            (self.slider, frame),
            (self.number, frame + (1 if take is None else take.first_frame)),
        ):
            field.blockSignals(True)
            field.setValue(value)
            field.blockSignals(False)
        if take is None:
            self.time.setText("")
        else:
            self.time.setText(f"{frame / take.rate:.2f} / {take.duration_s:.2f} s")
        self._fit_time()
        if self.playing and not self._moving:
            self._rebase()

    def _brought_into_view(self, *_: int) -> None:
        """Pause where an artifact is looked at, which playing would leave; a loop stays there."""
        if self.playing and not self.loop.isChecked():
            self.toggle_play()

    def _number_changed(self, number: int) -> None:
        """Go to the frame typed in."""
        session = self._document.session
        if session is not None:
            self._document.go_to(number - session.original.first_frame)

    def _recolour(self) -> None:
        for button, name in (
            (self.first, "first"),
            (self.back, "step-back"),
            (self.play, "pause" if self.playing else "play"),
            (self.forward, "step-forward"),
            (self.last, "last"),
            (self.loop, "loop"),
        ):
            button.setIcon(theme.icon(name))
        text = self.tr("Pause") if self.playing else self.tr("Play")
        self.play.setToolTip(shortcuts.with_key(text, "play"))
        self.play.setAccessibleName(text)
