"""Garbage is collected between events of the window, and nowhere else."""

from __future__ import annotations

import gc
from functools import cache

from PySide6.QtCore import QObject, QTimer

YOUNG, ALL = 1, 2
EVERY_MS, ALL_EVERY = 1000, 60
MANY, PUT_OFF = 50_000, 30
"""So many new objects take some 30 ms; while there are as many, they wait for so many rounds."""


class Collector(QObject):
    """Collects Python's garbage in the window's thread, until it is stopped.

    Python by itself collects in whichever thread allocates, amid whatever it does. Widgets among
    the garbage are then destroyed by a worker, or while Qt goes through them, as when the theme
    changes: either ends the process.
    """

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._times = self._put_off = 0
        self._timer = QTimer(self)
        self._timer.timeout.connect(self._collect)
        self._timer.start(EVERY_MS)
        gc.disable()

    def stop(self) -> None:
        """Leave it to Python again."""
        self._timer.stop()
        gc.enable()

    def _collect(self) -> None:
        """Collect what is young, and now and then everything; not what a worker is amid of making.

        The rows of a long table are hundreds of thousands of objects, all of them young. To walk
        through them holds the window up, and once the table is read they are gone.
        """
        self._put_off = self._put_off + 1 if gc.get_count()[0] > MANY else 0
        if 0 < self._put_off <= PUT_OFF:
            return
        self._put_off = 0
        self._times += 1
        gc.collect(ALL if self._times % ALL_EVERY == 0 else YOUNG)


@cache
def keep_what_is_loaded() -> None:
    """Leave what is there now out of all later collections; only the first call does anything.

    To be called once the libraries are loaded and before a take's own work begins. With them and
    the window there are some 125,000 objects, and to walk through them takes 60 to 90 ms.
    """
    gc.freeze()
