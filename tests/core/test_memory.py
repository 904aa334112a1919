"""Arrays that go leave their memory to those that come."""

from __future__ import annotations

import platform
import subprocess
import sys

import pytest

FAULTS = """
import resource
import numpy as np
from markermend.memory import keep_memory

assert {kept} is False or keep_memory()
np.ones(10_000_000)
before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
for _ in range(5):
    np.ones(10_000_000)
print(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)
"""


def faults(kept: bool) -> int:
    """Pages that five arrays of 80 MB had to get of the system, after one like them."""
    script = FAULTS.format(kept=kept)
    return int(subprocess.check_output([sys.executable, "-c", script], text=True))


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="only glibc can be asked")
def test_large_arrays_use_the_memory_of_those_before():
    assert faults(kept=False) > 100
    assert faults(kept=True) < 100
