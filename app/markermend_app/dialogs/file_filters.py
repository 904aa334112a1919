"""Which files the dialogs for opening and exporting offer, those of plugins too."""

from __future__ import annotations

from collections.abc import Sequence

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
    everything = tr("All files")
    takes = tr("Takes")
    return f"{_of_endings(takes, endings)};;{everything} (*)"


def skeleton_filter() -> str:
    """Files that hold recordings of skeletons, as :func:`open_filter` has it; no poses at rest."""
    from markermend.files.pose import WRITABLE

    return _of_endings(tr("Skeleton recordings"), WRITABLE)


def _of_endings(what: str, endings: Sequence[str]) -> str:
    """One filter; the name has each ending once, the patterns in small and large letters."""
    patterns = " ".join(f"*{e} *{e.upper()}" for e in endings)
    named = ", ".join(e[1:].upper() for e in endings)
    return f"{what}: {named} ({patterns})"


def export_filter(take: Take, proposed: str = "") -> str:
    """Files a take can be written as, one filter each, in Qt's notation; the proposed one first."""
    from markermend.plugins.formats import writable

    endings = sorted(writable(skeleton=take.skeleton), key=lambda e: e != proposed.lower())
    return ";;".join(f"{e[1:].upper()} (*{e})" for e in endings)
