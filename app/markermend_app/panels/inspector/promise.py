"""What a repair promises, or why there is none: long reasons leave room for what is above."""

from __future__ import annotations

import math

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QFontMetricsF
from PySide6.QtWidgets import QFrame, QLabel, QScrollArea, QSizePolicy, QWidget

LEAST_LINES, SHARE = 3, 0.2


class Promise(QScrollArea):
    """A text as high as it needs, up to a share of the panel; the rest is scrolled to.

    Parameters
    ----------
    text : wraps its words
    """

    def __init__(self, text: QLabel, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._text, self._said = text, ""
        text.setAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop)
        self.setWidget(text)
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)
        # Read while the keys decide; Tab passes it over.
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)

    def fit(self, panel: QSize) -> None:
        """Be as high as the text asks for, within a panel that is as wide and so high.

        Whole lines are seen, three at least.
        """
        if self._text.text() != self._said:
            self._said = self._text.text()
            self.verticalScrollBar().setValue(0)
        # Of nothing at all Qt knows no height.
        wanted = max(0, self._text.heightForWidth(panel.width()))
        # In whole pixels a line is less high than labels make it.
        line = math.ceil(QFontMetricsF(self._text.font()).lineSpacing())
        margins = self._text.contentsMargins()
        edge = margins.top() + margins.bottom()
        lines = max(LEAST_LINES, int((SHARE * panel.height() - edge) / line))
        self.setFixedHeight(min(wanted, lines * line + edge))
