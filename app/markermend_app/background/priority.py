"""Workers come after the window where there are more of them than processors."""

from __future__ import annotations

import os
import sys
import threading
from contextlib import suppress

# A third of the window's share. Much less would starve workers on a machine that is busy with
# something else, and with them the window, which waits for what they hold.
_NICER = 5


def give_way() -> None:
    """Let this thread, and processes it starts, come after the window's, where the system can."""
    if sys.platform == "linux":
        # There a thread is nice by itself, and what it starts inherits that.
        here = threading.get_native_id()
        with suppress(OSError):
            os.setpriority(os.PRIO_PROCESS, here, os.getpriority(os.PRIO_PROCESS, here) + _NICER)
