"""Something done before keys and the mouse reach a list: what they mean must be as it is seen."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QAbstractItemView

_HANDS = (
    QEvent.Type.ShortcutOverride,
    QEvent.Type.KeyPress,
    QEvent.Type.MouseButtonPress,
    QEvent.Type.MouseButtonDblClick,
    QEvent.Type.ContextMenu,
)


class BeforeHands(QObject):
    """Brings a list up to date that follows the document in turns of its own.

    Parameters
    ----------
    view : the list, with which it ends
    do : is called before a key or a button of the mouse does something there
    """

    def __init__(self, view: QAbstractItemView, do: Callable[[], object]) -> None:
        super().__init__(view)
        self._do = do
        for widget in (view, view.viewport()):
            widget.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Look at what comes; nothing is kept from the list."""
        if event.type() in _HANDS:
            self._do()
        return False
