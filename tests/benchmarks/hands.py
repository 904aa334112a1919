"""An operator of the window: keys, wheel and mouse, as in half an hour of review."""

from __future__ import annotations

import sys
import time
from collections import defaultdict
from collections.abc import Callable
from pathlib import Path

from heart import Turns
from PySide6.QtCore import QEventLoop, QPoint, QPointF, Qt, QTimer
from PySide6.QtGui import QDesktopServices, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QFileDialog

from markermend.artifact import Artifact, Status
from markermend_app import settings
from markermend_app.dialogs.export import ExportDialog

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "helpers"))
from plots import SHIFT, Bench

PATIENCE_S = 300.0
NONE, CTRL = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ControlModifier
ROWS = ("x", "y", "z", "speed", "acceleration")


def wait(milliseconds: int) -> None:
    """Let the window work, waiting as it does for the operator."""
    loop = QEventLoop()
    QTimer.singleShot(milliseconds, loop.quit)
    loop.exec()


def spin(until: Callable[[], bool], least_s: float = 0.0) -> None:
    """Let the window work until something has come about."""
    begun = time.monotonic()
    while not until() or time.monotonic() - begun < least_s:
        if time.monotonic() - begun > PATIENCE_S:
            raise TimeoutError("the window did not get there")
        wait(5)


class Operator:
    """Drives a window by keys, wheel and mouse.

    Parameters
    ----------
    window : the main window, shown
    turns : told what is being done
    folder : where exports and reports are written
    """

    def __init__(self, window, turns: Turns, folder: Path) -> None:
        self.window, self.document, self.turns = window, window.document, turns
        self.mouse = Bench(window.trajectories, window.document)
        self.next_clock: list[float] = []
        self.next_processor: list[float] = []
        self.waited: list[bool] = []
        self.wheeled: dict[tuple[int, int], list[float]] = defaultdict(list)
        # What the system's own dialogs would answer, and the browser that it would start.
        answer = str(folder / "written")
        QFileDialog.getSaveFileName = staticmethod(  # type: ignore[method-assign,assignment]
            lambda _parent, _title, proposed, filters: (
                f"{answer}{Path(proposed).suffix}",
                filters,
            )
        )
        QDesktopServices.openUrl = staticmethod(lambda _url: True)  # type: ignore[method-assign,assignment]

    def key(self, key: Qt.Key, held: Qt.KeyboardModifier = NONE) -> None:
        """Press a key in the window."""
        self.window.activateWindow()
        spin(self.window.isActiveWindow)
        QTest.keyClick(self.window, key, held)

    # Opening

    def open(self, path: Path, found: list[Artifact] | None = None) -> None:
        """Open a take and wait until its first artifact is shown with its repair."""
        self.turns.doing = "open"
        settings.remember("detect_on_open", found is None)
        if self.document.file is not None:
            # The next take is the same to the last byte, and a review follows its take.
            self.document.file.discard()
        self.document.open(None, None)
        wait(50)
        self.window.commands.open_path(path)
        spin(lambda: self.document.session is not None and self.document.mesh is not None)
        if found is not None:
            spin(lambda: not self.window.lane.busy)
            self.document.decisions.add_detected(found, "planted")
            self.document.step(1)
        spin(lambda: not self.window.lane.busy and self.document.current is not None)
        spin(self.proposed)

    def proposed(self) -> bool:
        """Whether the repair of the current artifact is there, where it needs one."""
        current = self.document.current
        done = current is None or current.status is Status.REPAIRED
        return done or self.document.proposal is not None

    # Deciding

    def decide(self, count: int) -> None:
        """Repair, accept and reject one artifact after the other, looking at each for a moment."""
        keys = (Qt.Key.Key_F, Qt.Key.Key_F, Qt.Key.Key_A, Qt.Key.Key_F, Qt.Key.Key_R)
        for i in range(min(count, len(self.document.queue) - 1)):
            self.turns.doing = "decide"
            clock, processor = time.perf_counter(), time.thread_time()
            self.key(keys[i % len(keys)])
            self.waited.append(not self.proposed())
            QApplication.processEvents()
            self.next_clock.append(time.perf_counter() - clock)
            self.next_processor.append(time.thread_time() - processor)
            self.turns.doing = "look"
            spin(self.proposed, 0.3)

    def go_back_and_forth(self, count: int) -> None:
        """Undo and redo step by step, then as fast as a held key repeats."""
        self.turns.doing = "undo and redo"
        for pause_ms, steps in ((20, 5), (1, count)):
            for key in (Qt.Key.Key_Z, Qt.Key.Key_Y):
                for _ in range(steps):
                    self.key(key, CTRL)
                    wait(pause_ms)
                spin(self.proposed)

    def compare(self) -> None:
        """Hold the key that compares methods, walk through them, and let go."""
        self.turns.doing = "compare"
        self.window.activateWindow()
        spin(self.window.isActiveWindow)
        QTest.keyPress(self.window, Qt.Key.Key_C)
        spin(lambda: self.window.comparison.candidates is not None, 0.1)
        for key in (Qt.Key.Key_Down, Qt.Key.Key_Down, Qt.Key.Key_Up):
            self.key(key)
            spin(self.proposed, 0.1)
        QTest.keyRelease(self.window, Qt.Key.Key_C)
        spin(lambda: not self.window.comparison.shown)

    # Looking

    def wheel(self, steps: int, held: Qt.KeyboardModifier) -> None:
        """Turn the wheel over the plots."""
        view = self.window.trajectories.canvas.viewport()
        at = QPointF(view.width() / 2, view.height() / 3)
        event = QWheelEvent(
            at,
            QPointF(view.mapToGlobal(at.toPoint())),
            QPoint(),
            QPoint(0, 120 * steps),
            Qt.MouseButton.NoButton,
            held,
            Qt.ScrollPhase.NoScrollPhase,
            False,
        )
        processor = time.thread_time()
        QApplication.sendEvent(view, event)
        QApplication.processEvents()
        shown = len(self.document.shown), len(self.window.trajectories.rows)
        self.wheeled[shown].append(time.thread_time() - processor)
        wait(16)

    def look_around(self) -> None:
        """Zoom, pan, play, and turn the body."""
        self.turns.doing = "zoom and pan"
        self.key(Qt.Key.Key_0, CTRL)
        for steps in [1] * 12 + [-1] * 12:
            self.wheel(steps, NONE)
        for steps in (1, 1, -1, -1):
            self.wheel(steps, CTRL)
        self.turns.doing = "play"
        self.key(Qt.Key.Key_Space)
        spin(lambda: True, 1.5)
        self.key(Qt.Key.Key_Space)
        self.turns.doing = "turn the body"
        scene, left = self.window.scene, Qt.MouseButton.LeftButton
        QTest.mousePress(scene, left, NONE, QPoint(60, 60))
        for x in range(60, 160, 5):
            QTest.mouseMove(scene, QPoint(x, 60 + x // 4))
            wait(16)
        QTest.mouseRelease(scene, left, NONE, QPoint(160, 100))
        self.turns.doing = "switch the view"
        for key in (Qt.Key.Key_B, Qt.Key.Key_L, Qt.Key.Key_B, Qt.Key.Key_L):
            self.key(key)
            wait(50)

    def change_overview(self) -> None:
        """See the overview in each of its ways, and the panel of the take's quality."""
        self.turns.doing = "overview"
        for _ in range(3):
            self.key(Qt.Key.Key_H)
            spin(lambda: not self.window.lane.busy, 0.3)
        self.turns.doing = "quality"
        self.window.dock_layout.show("quality")
        wait(200)
        self.window.dock_layout.show("queue")
        wait(50)

    def show_more(self) -> None:
        """Show several markers in five rows, look around, and go back to what was there."""
        self.turns.doing = "more rows and markers"
        before, chosen = self.document.shown, self.window.trajectories.chosen
        for count in range(4, len(ROWS) + 1):
            self.window.trajectories.choose_rows(ROWS[:count])
            wait(50)
        labels = self.document.session.original.labels
        for count in range(2, 6):
            self.document.show(dict.fromkeys((*before, *labels[:count])))
            wait(50)
        for steps in (1, 1, -1, -1):
            self.wheel(steps, NONE)
        self.document.step(1)
        spin(self.proposed, 0.2)
        self.window.trajectories.choose_rows(chosen)
        wait(50)
        self.document.show(before)
        wait(50)

    # By hand, and the rest of a day

    def find(self, letters: str) -> None:
        """Type into the palette and go to what it finds first."""
        self.turns.doing = "palette"
        self.key(Qt.Key.Key_K, CTRL)
        wait(50)
        palette = QApplication.activePopupWidget()
        for letter in letters:
            QTest.keyClicks(palette.line, letter)
            wait(20)
        QTest.keyClick(palette, Qt.Key.Key_Return)
        spin(self.proposed, 0.1)

    def work_by_hand(self) -> None:
        """Sweep a range and mark it, another and repair it, and a third and cut it."""
        self.turns.doing = "by hand"
        for key, held in (
            (Qt.Key.Key_M, NONE),
            (Qt.Key.Key_F, SHIFT),
            (Qt.Key.Key_X, NONE),
        ):
            low, high = self.mouse.time
            self.mouse.drag(low + 0.80 * (high - low), low + 0.84 * (high - low), keys=SHIFT)
            wait(50)
            self.window.setFocus()
            self.key(key, held)
            spin(lambda: not self.window.lane.busy and self.proposed(), 0.1)

    def smooth(self) -> None:
        """Smooth a marker as proposed, seen before; then see another method and leave it."""
        for accept in (True, False):
            self.turns.doing = "smooth"
            self.key(Qt.Key.Key_S)
            dialog = self.window.smoothing.dialog

            def seen(dialog=dialog) -> bool:
                # What cannot be smoothed is told in words, without an answer.
                told = dialog.answer is None and bool(dialog.warning.text())
                return told or (dialog.answer is not None and dialog._found is not None)

            spin(seen, 0.1)
            if not accept:
                dialog.method.setCurrentIndex((dialog.method.currentIndex() + 1) % 3)
                spin(seen, 0.3)
                dialog.scope.setCurrentIndex(dialog.scope.count() - 1)
                spin(seen, 0.3)
                dialog.axis.setCurrentIndex(2)
                wait(50)
            self.turns.doing = "apply the smoothing" if accept else "smooth"
            good = accept and dialog.go.isEnabled()
            QTest.keyClick(dialog, Qt.Key.Key_Return if good else Qt.Key.Key_Escape)
            spin(self.proposed, 0.1)

    def write(self) -> None:
        """Export the take, and a report of its review."""
        self.turns.doing = "export"
        QTimer.singleShot(100, self._confirm)
        self.key(Qt.Key.Key_S, CTRL)
        spin(lambda: not self.window.lane.busy, 0.1)
        self.turns.doing = "report"
        self.key(Qt.Key.Key_S, CTRL | SHIFT)
        spin(lambda: not self.window.lane.busy, 0.1)

    def _confirm(self) -> None:
        """Press Return in the dialog that asks what to export, once it is there."""
        dialog = QApplication.activeModalWidget()
        if isinstance(dialog, ExportDialog):
            QTest.keyClick(dialog, Qt.Key.Key_Return)
        else:
            QTimer.singleShot(100, self._confirm)
