"""The manual in a window of its own, opened at the page about the panel one is in."""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType

from PySide6.QtCore import Qt, QUrl
from PySide6.QtGui import (
    QDesktopServices,
    QKeySequence,
    QShortcut,
    QTextBlock,
    QTextCursor,
    QTextFrameFormat,
    QTextTable,
)
from PySide6.QtWidgets import (
    QDockWidget,
    QHBoxLayout,
    QLineEdit,
    QMainWindow,
    QSplitter,
    QToolButton,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from markermend_app.dialogs.manual_page import ManualPage
from markermend_app.style import theme
from markermend_resources import manual_folder

FRONT = "index.md"
PAGES: Mapping[str, str] = MappingProxyType(
    {
        "markers": "window.md#markers",
        "scene": "window.md#3d-view",
        "queue": "artifacts.md",
        "quality": "window.md#quality",
        "takes": "many-takes.md",
        "inspector": "repairs.md",
        "history": "by-hand.md",
        "SmoothDialog": "smoothing.md",
        "ExportDialog": "files.md#what-is-written",
        "AlikeDialog": "first-ten-minutes.md#3-do-many-at-once",
        "JointCentresDialog": "poses.md#joints-from-markers",
        "Preferences": "window.md#preferences",
        "ShortcutSheet": "window.md#keys",
        "TrajectoryPanel": "window.md#plots",
        "Overview": "window.md#overview",
    }
)
"""Page about a panel or dialog, by its object name or the name of its class."""

_PAGE = Qt.ItemDataRole.UserRole


def page_about(widget: QWidget | None) -> str:
    """Page of the manual about the innermost panel that a widget stands in."""
    while widget is not None:
        for name in (widget.objectName(), type(widget).__name__):
            if name in PAGES and (name != "markers" or isinstance(widget, QDockWidget)):
                return PAGES[name]
        widget = widget.parentWidget()
    return FRONT


class Manual(QMainWindow):
    """Contents on the left, a page on the right, a line to find words in all pages."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(self.tr("Markermend's manual"))
        self.resize(980, 760)
        self.text = ManualPage(manual_folder())
        self.text.setAccessibleName(self.tr("Page of the manual"))
        self.text.anchorClicked.connect(lambda url: self.show_page(url.toString()))
        self.contents = QTreeWidget()
        self.contents.setAccessibleName(self.tr("Contents"))
        self.contents.setHeaderHidden(True)
        self.contents.setRootIsDecorated(False)
        self.contents.currentItemChanged.connect(self._chosen)
        self.finder = QLineEdit()
        self.finder.setPlaceholderText(self.tr("Find in the manual"))
        self.finder.setAccessibleName(self.tr("Find in the manual"))
        self.finder.setClearButtonEnabled(True)
        self.finder.textChanged.connect(self._narrow)
        self.finder.returnPressed.connect(self._find_next)
        back = QToolButton()
        back.setIcon(theme.icon("chevron-left"))
        back.setToolTip(self.tr("Back"))
        back.setAccessibleName(self.tr("Back"))
        back.clicked.connect(self.back)
        self._visited: list[str] = []
        self._pages = {path.name: path for path in sorted(manual_folder().glob("*.md"))}

        top = QHBoxLayout()
        top.setContentsMargins(8, 8, 8, 8)
        top.addWidget(back)
        top.addWidget(self.finder, 1)
        left = QWidget()
        column = QVBoxLayout(left)
        column.setContentsMargins(0, 0, 0, 0)
        column.addLayout(top)
        column.addWidget(self.contents, 1)
        split = QSplitter()
        split.addWidget(left)
        split.addWidget(self.text)
        split.setSizes([280, 700])
        split.setStretchFactor(1, 1)
        self.setCentralWidget(split)
        for keys, verb in (
            (QKeySequence.StandardKey.Find, self.finder.setFocus),
            (QKeySequence.StandardKey.Back, self.back),
            (QKeySequence("Esc"), self.close),
        ):
            QShortcut(keys, self).activated.connect(verb)
        self._fill()
        # The arrow and page keys turn the text; without this the way back has the focus.
        self.text.setFocus()

    @property
    def page(self) -> str:
        """Name of the page that is shown, with the heading asked for."""
        return self._visited[-1] if self._visited else ""

    def show_page(self, page: str) -> None:
        """Show a page; ``name.md#heading`` goes to the heading.

        An address on the web goes to the system's browser.
        """
        name, _, heading = page.partition("#")
        if name not in self._pages:
            if page.startswith("https://"):
                QDesktopServices.openUrl(QUrl(page))
            return
        self._visited.append(page)
        self.text.setMarkdown(self._pages[name].read_text(encoding="utf-8"))
        self._widen_tables()
        self.text.fit_pictures()
        block = self._heading(heading)
        self.text.setTextCursor(QTextCursor(block))
        if heading:
            place = self.text.document().documentLayout().blockBoundingRect(block).top()
            self.text.verticalScrollBar().setValue(int(place) - 12)
        self.contents.blockSignals(True)
        for i in range(self.contents.topLevelItemCount()):
            item = self.contents.topLevelItem(i)
            if item is not None and item.data(0, _PAGE) == name:
                self.contents.setCurrentItem(item)
        self.contents.blockSignals(False)

    def back(self) -> None:
        """Show the page before."""
        if len(self._visited) > 1:
            self._visited.pop()
            self.show_page(self._visited.pop())

    def _fill(self) -> None:
        """List the pages in the order of the front page."""
        front = self._pages[FRONT].read_text(encoding="utf-8")
        for title, name in [
            (self.tr("Contents"), FRONT),
            *re.findall(r"\[(.+?)\]\((.+?)\)", front),
        ]:
            item = QTreeWidgetItem([title])
            item.setData(0, _PAGE, name)
            item.setToolTip(0, title)
            self.contents.addTopLevelItem(item)

    def _chosen(self, item: QTreeWidgetItem | None) -> None:
        if item is not None:
            self.show_page(item.data(0, _PAGE))

    def _narrow(self, words: str) -> None:
        """Leave the pages that hold all the words."""
        wanted = words.casefold().split()
        for i in range(self.contents.topLevelItemCount()):
            item = self.contents.topLevelItem(i)
            if item is not None:
                text = self._pages[item.data(0, _PAGE)].read_text(encoding="utf-8").casefold()
                item.setHidden(not all(word in text for word in wanted))

    def _find_next(self) -> None:
        """Go to where the words stand next, on this page or on the next that holds them."""
        if self.text.find(self.finder.text()):
            return
        for i in range(self.contents.topLevelItemCount()):
            item = self.contents.topLevelItem(i)
            if item is not None and not item.isHidden() and item.data(0, _PAGE) != self.page:
                self.show_page(item.data(0, _PAGE))
                self.text.find(self.finder.text())
                return

    def _heading(self, slug: str) -> QTextBlock:
        """Block of a heading, or the first one."""
        block = self.text.document().begin()
        while slug and block.isValid():
            if block.blockFormat().headingLevel() and slug_of(block.text()) == slug:
                return block
            block = block.next()
        return self.text.document().begin()

    def _widen_tables(self) -> None:
        """Give tables room and thin lines, which Markdown cannot ask for."""
        for frame in self.text.document().rootFrame().childFrames():
            if isinstance(frame, QTextTable):
                form = frame.format()
                form.setCellPadding(6)
                form.setCellSpacing(0)
                form.setBorder(1)
                form.setBorderCollapse(True)
                form.setBorderStyle(QTextFrameFormat.BorderStyle.BorderStyle_Solid)
                form.setBorderBrush(self.palette().mid())
                frame.setFormat(form)


def slug_of(heading: str) -> str:
    """Name of a heading in a link: ``"3D view"`` is ``"3d-view"``."""
    return re.sub(r"[^\w\- ]", "", heading).strip().lower().replace(" ", "-")
