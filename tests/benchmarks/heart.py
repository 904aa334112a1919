"""What holds a window up: a heart that beats in its event loop, and a watcher that sees why not."""

from __future__ import annotations

import faulthandler
import os
import re
import tempfile
import threading
import time
from collections import Counter, defaultdict
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from PySide6.QtCore import Qt, QTimer

try:
    import resource
except ImportError:  # Windows
    resource = None  # type: ignore[assignment]

STALL_S, NOTED_S, BEAT_S = 0.100, 0.060, 0.010
DRIVERS = ("heart.py", "hands.py", "bench_window.py")
FRAME = re.compile(r'File "(.+)", line (\d+) in (.+)')


@dataclass
class Stall:
    """A time in which the heart could not beat.

    Attributes
    ----------
    doing : what the operator did
    clock, processor : seconds that it took, of which the window's own thread worked
    queued : seconds that it could have gone on but no processor was free, where the system tells
    stolen : seconds that the host of a virtual machine took away from its processors meanwhile
    fetched : pages of memory that had to come from the disk first, where the system tells
    seen : where the thread was, and how often the watcher found it there
    """

    doing: str
    clock: float
    processor: float
    queued: float = 0.0
    stolen: float = 0.0
    fetched: int = 0
    seen: Counter[str] = field(default_factory=Counter)

    def __str__(self) -> str:
        places = "; ".join(f"{n}x {place}" for place, n in self.seen.most_common(3))
        return (
            f"{self.processor * 1e3:6.1f} ms processor {self.clock * 1e3:7.1f} ms clock "
            f"{self.queued * 1e3:4.0f} ms queued "
            f"{self.stolen * 1e3:4.0f} ms stolen, {self.fetched} pages fetched, {self.doing}: "
            f"{places or 'not seen'}"
        )


class Turns:
    """A heart that beats every 10 ms and notes when it was kept from it, and by what.

    The clock's time holds what other threads and processes took; the processor's time of the
    window's own thread does not. But where a virtual machine's host takes its processors away, both
    grow: what the host says of that is noted beside them.
    """

    def __init__(self) -> None:
        self.doing = "start"
        self.clock: dict[str, list[float]] = defaultdict(list)
        self.processor: dict[str, list[float]] = defaultdict(list)
        self.stalls: list[Stall] = []
        self._seen: Counter[str] = Counter()
        self._stolen = self._stolen_last = stolen()
        self._fetched_last, self._queued_last = fetched(), queued()
        self._last = time.perf_counter(), time.thread_time()
        self._thread = threading.get_ident()
        self._timer = QTimer()
        self._timer.setTimerType(Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._beat)
        self._timer.start(round(BEAT_S * 1000))
        threading.Thread(target=self._watch, name="watcher", daemon=True).start()

    def skip(self) -> None:
        """Pass over what was done since the last beat; it was none of the window's."""
        self._last, self._seen = (time.perf_counter(), time.thread_time()), Counter()

    def _beat(self) -> None:
        now = time.perf_counter(), time.thread_time()
        clock, processor = max(0.0, now[0] - self._last[0] - BEAT_S), now[1] - self._last[1]
        self.clock[self.doing].append(clock)
        self.processor[self.doing].append(processor)
        if max(clock, processor) > NOTED_S:
            waited, taken = queued() - self._queued_last, stolen() - self._stolen_last
            came = fetched() - self._fetched_last
            self.stalls.append(Stall(self.doing, clock, processor, waited, taken, came, self._seen))
        self._last, self._seen, self._stolen_last = now, Counter(), self._stolen
        self._fetched_last, self._queued_last = fetched(), queued()

    def _watch(self) -> None:
        """Look where the thread is whenever it is held for long."""
        with tempfile.TemporaryFile("w+") as file:
            while True:
                time.sleep(BEAT_S)
                self._stolen = stolen()
                if time.perf_counter() - self._last[0] > NOTED_S:
                    file.seek(0)
                    file.truncate()
                    # Frame objects, looked at from here, would keep painters alive in there.
                    faulthandler.dump_traceback(file, all_threads=True)
                    file.seek(0)
                    self._seen[place(file.read(), self._thread)] += 1


def fetched() -> int:
    """Pages of memory that this thread had to wait for until the disk had them."""
    if resource is None or not hasattr(resource, "RUSAGE_THREAD"):
        return 0
    return int(resource.getrusage(resource.RUSAGE_THREAD).ru_majflt)


def queued() -> float:
    """Seconds that this thread has waited for a processor to become free."""
    file = _schedule_of(threading.get_native_id())
    return int(os.pread(file, 80, 0).split()[1]) / 1e9 if file is not None else 0.0


@cache
def _schedule_of(thread: int) -> int | None:
    """What Linux tells of a thread's turns, opened once: it is read with each beat."""
    told = Path(f"/proc/self/task/{thread}/schedstat")
    return os.open(told, os.O_RDONLY) if told.exists() else None


def stolen() -> float:
    """Seconds that the host took away from a virtual machine's processors since it began, if any.

    Counted in hundredths of a second, over all processors.
    """
    counts = Path("/proc/stat")
    if not counts.exists():
        return 0.0
    with counts.open() as file:
        return int(file.readline().split()[8]) / 100


def place(dump: str, thread: int) -> str:
    """Where a thread is: what runs, and the functions of ours that led there.

    Parameters
    ----------
    dump : of all threads, by ``faulthandler``
    thread : its identity
    """
    mine = next(part for part in dump.split("\n\n") if f"0x{thread:016x}" in part)
    names: list[str] = []
    for path, line, function in FRAME.findall(mine):
        if Path(path).name in DRIVERS:
            break
        if not names or "/markermend" in path:
            names.append(f"{Path(path).stem}.{function}:{line}")
    return " < ".join(names[:6])
