"""Work in several processes: in order, ended early, and deaf to Ctrl-C."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from markermend.processes import deaf, in_processes


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
