"""``markermend open``: find the desktop application by its entry point and start it."""

from __future__ import annotations

import argparse
from importlib.metadata import entry_points
from pathlib import Path

from markermend.errors import MarkermendError

GROUP = "markermend.app"


def run(options: argparse.Namespace) -> int:
    """Open the window, with a take when one is named, or a list of them to be reviewed."""
    for take in options.takes:
        if not Path(take).exists():
            raise MarkermendError(f"There is no file “{take}”.")
    found = tuple(entry_points(group=GROUP))
    try:
        start = found[0].load() if found else None
    except ImportError as error:
        raise MarkermendError(
            f"The window cannot start ({error}); "
            'install it with: python -m pip install "markermend[app]"'
        ) from error
    if start is None:
        raise MarkermendError(
            'The window is not installed; get it with: python -m pip install "markermend[app]"'
        )
    return int(start(options.takes) or 0)
