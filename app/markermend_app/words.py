"""Translation of what is written outside of widgets: tables of actions, dialogs, names of classes.

Widgets say ``self.tr``. Everything else says :func:`tr`, in no context of its own.
"""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication


def tr(text: str) -> str:
    """The text in the language of the app."""
    return QCoreApplication.translate("", text)


def literal(name: str) -> str:
    """A name as menus and buttons show it whole: a lone ampersand would mark the letter behind."""
    return name.replace("&", "&&")
