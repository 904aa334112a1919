"""Work in several processes: in order, ended early, and deaf to Ctrl-C."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from markermend.processes import deaf, in_processes, processes_start


def _noted(folder: Path, number: int) -> int:
    """Leave a file for a call, and give its square; later calls take longer."""
    time.sleep(0.02 * number)
    (folder / str(number)).touch()
    return number**2


# Who leaves early may meet loky handing out one more call: its thread, which ends there, says so.
@pytest.mark.filterwarnings("error", "ignore::pytest.PytestUnhandledThreadExceptionWarning")
@pytest.mark.parametrize("jobs", [1, 2])
def test_results_come_in_order_and_what_is_left_is_not_done(tmp_path: Path, jobs: int) -> None:
    with in_processes(_noted, ((tmp_path, n) for n in range(5)), jobs) as results:
        assert list(results) == [0, 1, 4, 9, 16]
    for path in tmp_path.iterdir():
        path.unlink()
    with in_processes(_noted, ((tmp_path, n) for n in range(40)), jobs) as results:
        assert next(results) == 0
    assert len(list(tmp_path.iterdir())) < 40


@pytest.mark.skipif(os.name != "posix", reason="sends what Ctrl-C sends")
def test_what_starts_deaf_does_not_hear_ctrl_c() -> None:
    before = signal.getsignal(signal.SIGINT)
    sleeper = [sys.executable, "-c", "import time; time.sleep(0.5)"]
    with deaf(), subprocess.Popen(sleeper) as deaf_one:
        deaf_one.send_signal(signal.SIGINT)
    assert deaf_one.returncode == 0
    assert signal.getsignal(signal.SIGINT) is before


def _kept(_: int) -> tuple[int, bool]:
    """Which process works, and whether the processes' module was there before its work came."""
    return os.getpid(), "markermend.detectors.joint.drift" in sys.modules


def test_processes_that_started_beside_have_the_module_and_do_the_work() -> None:
    with processes_start("markermend.detectors.joint.drift", 2):
        pass
    with in_processes(_kept, ((n,) for n in range(8)), 2) as results:
        done = list(results)
    assert os.getpid() not in {process for process, _ in done}
    # One that starts late may find nothing left to load beside the block.
    assert any(loaded for _, loaded in done)


def _large(_: int) -> int:
    """Use much memory, in parts, for a second; which process did."""
    begun = time.monotonic()
    while time.monotonic() - begun < 1.1:
        for array in [np.ones(4_000_000) for _ in range(16)]:
            array += 1.0
    return os.getpid()


@pytest.mark.filterwarnings("error")
def test_processes_that_need_much_memory_are_kept() -> None:
    with processes_start("markermend.detectors.joint.drift", 2):
        pass
    with in_processes(_large, ((n,) for n in range(6)), 2) as results:
        assert len(set(results)) <= 2


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_work_goes_on_after_a_start_that_was_broken_off() -> None:
    with pytest.raises(RuntimeError), processes_start("markermend.detectors.joint.drift", 2):
        raise RuntimeError
    with in_processes(_kept, ((n,) for n in range(4)), 2) as results:
        assert len(list(results)) == 4


def test_one_process_is_this_one() -> None:
    with processes_start("no.such.module", 1), in_processes(_kept, [(0,)], 1) as results:
        assert next(results)[0] == os.getpid()
