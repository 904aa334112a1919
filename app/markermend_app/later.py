"""Work that waits for a turn of its own, so that no turn of the window takes long."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QCoreApplication, QObject, QTimer
from shiboken6 import isValid

# Not zero: such timers wait until nothing else is left to do, which while playing is never.
SOON_MS = 1


class Later(QObject):
    """Does something once in a later turn, however often it was asked for in this one.

    What the operator looks at first is drawn at once; what stands beside it follows, after keys
    that were pressed meanwhile. Whatever waits in the window, each gets a turn of its own.

    Parameters
    ----------
    do : what is to be done
    parent : with which it ends; what waits then is not done
    """

    def __init__(self, do: Callable[[], object], parent: QObject) -> None:
        super().__init__(parent)
        self._do = do
        self.waiting = False

    def ask(self, *_: object) -> None:
        """Have it done soon; what a signal tells is passed over."""
        if not self.waiting:
            self.waiting = True
            _queue().append(self)

    def do(self) -> None:
        """Do it now, and no longer later."""
        self.waiting = False
        self._do()

    def catch_up(self) -> None:
        """Do it now if it waits."""
        if self.waiting:
            self.do()


class OneByOne(QObject):
    """Does what was asked for one thing after the other, each in a later turn of its own.

    Parameters
    ----------
    parent : with which it ends; what waits then is not done
    """

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._waiting: dict[Callable[[], object], None] = {}
        self._soon = Later(self._next, self)

    def ask(self, do: Callable[[], object]) -> None:
        """Have something done, behind what waits already; what waits is not asked for twice."""
        self._waiting.setdefault(do)
        self._soon.ask()

    def _next(self) -> None:
        do = next(iter(self._waiting))
        del self._waiting[do]
        if self._waiting:
            self._soon.ask()
        do()


class _Queue(QObject):
    """What waits in the whole window, first come, first done."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._waiting: list[Later] = []
        self._asked = False
        self._timer = QTimer(self, singleShot=True, interval=SOON_MS)
        self._timer.timeout.connect(self._next)

    def append(self, later: Later) -> None:
        self._waiting.append(later)
        if not self._timer.isActive():
            self._asked = True
            self._timer.start()

    def _next(self) -> None:
        if self._asked:
            # Run out while the turn that asked went on, it would be ahead of what came meanwhile.
            self._asked = False
            self._timer.start()
            return
        later = self._waiting.pop(0)
        if self._waiting:
            self._timer.start()
        if isValid(later) and later.waiting:
            later.do()


_queues: list[_Queue] = []


def _queue() -> _Queue:
    """The queue of the application that runs."""
    application = QCoreApplication.instance()
    assert application is not None
    if not _queues or not isValid(_queues[0]):
        _queues[:] = [_Queue(application)]
    return _queues[0]
