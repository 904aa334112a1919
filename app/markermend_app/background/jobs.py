"""Engine work off the GUI thread: one job at a time, with true progress and cancel.

Jobs get immutable inputs and return values; whoever started one gets its result as a signal in
the GUI thread and decides there whether it still applies.
"""

from __future__ import annotations

import itertools
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal

from markermend.errors import Cancelled
from markermend.progress import Progress, heeded
from markermend_app.background.priority import give_way
from markermend_app.later import OneByOne

Work = Callable[[Progress], Any]
REST_S = 0.005
"""How often a job that rests looks whether it may go on."""
Callbacks = tuple[Callable[[Any], None], Callable[[Exception], None], Callable[[Any], None]]


class Lane(QObject):
    """A queue of jobs run one after the other on one worker thread.

    Parameters
    ----------
    name : of the thread
    behind : another lane; no job of this one begins while that one has any, and one that runs
        rests where it reports

    Signals
    -------
    started(str) : label of the job that begins
    progressed(float, str) : share done and what is being done
    finished() : the job that ran has ended, however it ended
    """

    started = Signal(str)
    progressed = Signal(float, str)
    finished = Signal()
    _ended = Signal(int, object, object)

    def __init__(
        self, name: str, parent: QObject | None = None, behind: Lane | None = None
    ) -> None:
        super().__init__(parent)
        self._pool = ThreadPoolExecutor(
            max_workers=1, thread_name_prefix=name, initializer=give_way
        )
        self._numbers = itertools.count()
        self._waiting: dict[int, Callbacks] = {}
        self._stop: dict[int, threading.Event] = {}
        self._closed = False
        self._turns = OneByOne(self)
        self._behind = behind
        self._held: list[Callable[[], None]] = []
        self._running = False
        if behind is not None:
            behind.finished.connect(self._ask_to_go_on)
        self._ended.connect(self._deliver, Qt.ConnectionType.QueuedConnection)

    @property
    def busy(self) -> bool:
        """Whether a job is running or waiting."""
        return bool(self._waiting)

    def submit(
        self,
        label: str,
        work: Work,
        done: Callable[[Any], None],
        failed: Callable[[Exception], None],
        dropped: Callable[[Any], None] | None = None,
    ) -> None:
        """Run ``work(progress)`` on the worker; ``done`` or ``failed`` is called in this thread.

        A cancelled job calls neither; what it had come to all the same is given to ``dropped``,
        so that files and locks it holds can be let go. Once the lane is closed nothing is run.
        """
        if self._closed:
            return
        number = next(self._numbers)
        stop = threading.Event()
        self._waiting[number] = (done, failed, dropped or _let_be)
        self._stop[number] = stop

        told = 0.0, ""

        def report(share: float, doing: str) -> None:
            nonlocal told
            while self._behind is not None and self._behind.busy and not stop.is_set():
                time.sleep(REST_S)
            if stop.is_set():
                raise Cancelled
            if (share, doing) != told:
                # Who only heeds whether it is still wanted tells the same again.
                told = share, doing
                self.progressed.emit(share, doing)

        def run() -> None:
            result: Any = None
            error: Exception | None = None
            try:
                if stop.is_set():
                    raise Cancelled
                self.started.emit(label)
                with heeded(report) as progress:
                    result = work(progress)
            except Exception as caught:
                error = caught
            self._ended.emit(number, result, error)

        # Beside a worker the window draws half as fast: first it draws what waits already.
        self._turns.ask(partial(self._begin, run))

    def cancel(self) -> None:
        """Ask every job that runs or waits to stop."""
        for stop in self._stop.values():
            stop.set()

    def close(self) -> None:
        """Cancel and wait for the worker to end."""
        self._closed = True
        self.cancel()
        self._waiting.clear()
        self._pool.shutdown(wait=True, cancel_futures=True)

    def _begin(self, run: Callable[[], None]) -> None:
        """Hand a job to the worker, once no other lane comes first."""
        if self._behind is None:
            self._hand_over(run)
        else:
            self._held.append(run)
            self._go_on()

    def _hand_over(self, run: Callable[[], None]) -> None:
        if not self._closed:
            self._pool.submit(run)

    def _ask_to_go_on(self) -> None:
        """Begin what is held back, in a turn of its own: the other lane may be given more now."""
        if self._held:
            self._turns.ask(self._go_on)

    def _go_on(self) -> None:
        """Begin one of the jobs held back, unless one runs or the other lane has any."""
        if self._held and not self._running and not (self._behind and self._behind.busy):
            self._running = True
            self._hand_over(self._held.pop(0))

    def _deliver(self, number: int, result: Any, error: Exception | None) -> None:
        """Hand a result over in the GUI thread."""
        stopped = self._stop.pop(number, None)
        callbacks = self._waiting.pop(number, None)
        self._running = False
        self._ask_to_go_on()
        self.finished.emit()
        if callbacks is None:
            return
        done, failed, dropped = callbacks
        if stopped is not None and stopped.is_set():
            if error is None:
                dropped(result)
        elif error is None:
            done(result)
        elif not isinstance(error, Cancelled):
            failed(error)


def _let_be(result: Any) -> None:
    """Do nothing about a result nobody wants."""
