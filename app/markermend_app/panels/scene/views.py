"""Views along the axes of a take, offered in a menu."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtWidgets import QMenu

from markermend_app.words import tr

_AXES = "XYZ"


def add_views(menu: QMenu, up: int, look_from: Callable[[int, int], None]) -> None:
    """Offer to look from each side.

    Parameters
    ----------
    menu : where to
    up : axis that points up, 0, 1 or 2
    look_from : called with an axis and a side, 1 or -1
    """
    first, second = (up + 1) % 3, (up + 2) % 3
    below = menu.addMenu(tr("Look from"))
    for text, key, axis, side in (
        (tr("above"), "7", up, 1),
        (tr("below"), "Ctrl+7", up, -1),
        (f"+{_AXES[first]}", "1", first, 1),
        (f"−{_AXES[first]}", "Ctrl+1", first, -1),
        (f"+{_AXES[second]}", "3", second, 1),
        (f"−{_AXES[second]}", "Ctrl+3", second, -1),
    ):
        keypad = tr("keypad {0}").format(key)
        action = below.addAction(f"{text}\t{keypad}")
        action.setProperty("words", tr("camera view front back side top bottom"))
        look = partial(look_from, axis, side)
        action.triggered.connect(lambda _=False, look=look: look())
