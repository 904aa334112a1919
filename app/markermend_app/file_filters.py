"""Which files the dialogs for opening and exporting offer, those of plugins too."""

from __future__ import annotations

from markermend_app.words import tr


def open_filter() -> str:
    """Files that can be opened, in Qt's notation."""
    from markermend.plugins.formats import OURS, formats

    endings = [*(f".{name}" for name in OURS), *formats()]
    patterns = " ".join(f"*{e} *{e.upper()}" for e in endings)
    return f"{tr('Takes')} ({patterns});;{tr('All files')} (*)"


def export_filter() -> str:
    """Files that can be written, one filter each, in Qt's notation."""
    from markermend.plugins.formats import writable

    return ";;".join(f"{e[1:].upper()} (*{e})" for e in writable())
