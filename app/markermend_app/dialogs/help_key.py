"""The manual's key within dialogs, which keep the window's own keys from working."""

from __future__ import annotations

from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QDialog

from markermend_app.actions import shortcuts


def help_in(dialog: QDialog) -> None:
    """Let the manual's key open the page about a dialog."""

    def show() -> None:
        from markermend_app.dialogs.manual import Manual, page_about

        # As the dialog's own window it can be used while the dialog waits.
        manual = dialog.findChild(Manual) or Manual(dialog)
        manual.show()
        manual.show_page(page_about(dialog))
        manual.raise_()
        manual.activateWindow()

    for key in shortcuts.table()["manual"]:
        QShortcut(QKeySequence(key), dialog).activated.connect(show)
