"""Translation of what is written outside of widgets: tables of actions, dialogs, names of classes.

Widgets say ``self.tr``. Everything else says :func:`tr`, in no context of its own.
"""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication


def tr(text: str) -> str:
    """The text in the language of the app."""
    return QCoreApplication.translate("", text)
