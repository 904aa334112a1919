"""Which files the dialogs for opening and exporting offer, those of plugins too."""

from __future__ import annotations

from PySide6.QtWidgets import QFileDialog

from markermend.take import Take
from markermend_app.words import tr

WITHOUT_PATTERNS = QFileDialog.Option.HideNameFilterDetails
"""How a dialog shows these filters."""


def open_filter() -> str:
    """Files that can be opened, in Qt's notation, to be shown :data:`WITHOUT_PATTERNS`.

    Some dialogs of the system tell capitals apart, so that patterns are there for both; the name
    has each ending once.
    """
    from markermend.plugins.formats import OURS, SKELETONS, formats

    endings = [*(f".{name}" for name in OURS), *SKELETONS, *formats()]
    patterns = " ".join(f"*{e} *{e.upper()}" for e in endings)
    takes, everything = tr("Takes"), tr("All files")
    named = ", ".join(e[1:].upper() for e in endings)
    return f"{takes}: {named} ({patterns});;{everything} (*)"


def skeleton_filter() -> str:
    """Skeleton recordings that Markermend reads, in Qt's notation."""
    from markermend.files.pose import READABLE

    patterns = " ".join(f"*{e} *{e.upper()}" for e in READABLE)
    named = tr("Skeleton recordings")
    return f"{named} ({patterns})"


def export_filter(take: Take, proposed: str = "") -> str:
    """Files a take can be written as, one filter each, in Qt's notation; the proposed one first."""
    from markermend.plugins.formats import writable

    endings = sorted(writable(skeleton=take.skeleton), key=lambda e: e != proposed.lower())
    return ";;".join(f"{e[1:].upper()} (*{e})" for e in endings)
