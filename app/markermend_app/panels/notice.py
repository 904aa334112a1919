"""A question asked once, in the window and not over it: the review goes on meanwhile."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QPushButton, QWidget

from markermend_app.actions import shortcuts
from markermend_app.style import theme
from markermend_app.verbs.bulk import Bulk


class Notice(QFrame):
    """Says that a sort of artifact was rejected several times, and offers to lower the rest."""

    def __init__(self, bulk: Bulk, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._bulk = bulk
        self.setObjectName("notice")
        self.sign, self.text = QLabel(), QLabel()
        self.text.setTextFormat(Qt.TextFormat.PlainText)
        self.text.setWordWrap(True)
        self.agree = QPushButton()
        self.agree.clicked.connect(bulk.lower_doubted)
        self.keep = QPushButton()
        self.keep.clicked.connect(bulk.keep_doubted)
        for button in (self.agree, self.keep):
            # The review keys go on working; the answer has a key of its own.
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        row = QHBoxLayout(self)
        row.setContentsMargins(12, 4, 8, 4)
        row.setSpacing(8)
        row.addWidget(self.sign)
        row.addWidget(self.text, 1)
        row.addWidget(self.agree)
        row.addWidget(self.keep)
        bulk.doubts_changed.connect(self._refresh)
        theme.watcher.changed.connect(self._recolour)
        shortcuts.watcher.changed.connect(self._refresh)
        self._recolour()
        self._refresh()

    def _refresh(self) -> None:
        """Ask what is to be asked, or nothing."""
        doubts = self._bulk.doubts
        self.setVisible(bool(doubts))
        if not doubts:
            return
        kind = theme.kind_name(doubts[0].kind, within=True)
        rejected = sum(d.rejected for d in doubts)
        more, rest = len(doubts) - 1, sum(len(d.rest) for d in doubts)
        one = self.tr(
            "You rejected {0} of {1} decided as {2} on {3}. Make the other one less sure, so that "
            "it comes last?"
        )
        many = self.tr(
            "You rejected {0} of {1} decided as {2} on {3}. Make the other {4} less sure, so "
            "that they come last?"
        )
        self.text.setText(
            (one if rest == 1 else many).format(
                rejected,
                rejected + sum(d.upheld for d in doubts),
                kind,
                f"{doubts[0].marker} +{more}" if more else doubts[0].marker,
                rest,
            )
        )
        lower = self.tr("Lower it") if rest == 1 else self.tr("Lower them")
        self.agree.setText(shortcuts.with_key(lower, "lower_doubted"))
        self.keep.setText(self.tr("Leave it") if rest == 1 else self.tr("Leave them"))

    def _recolour(self) -> None:
        self.sign.setPixmap(theme.icon("help").pixmap(16, 16))
