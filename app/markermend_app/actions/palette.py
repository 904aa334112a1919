"""The command palette: a few letters find any action, marker or artifact, or one of a few."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QPoint, Qt
from PySide6.QtGui import QAction, QIcon, QKeyEvent, QPainter, QPalette
from PySide6.QtWidgets import (
    QDialog,
    QLabel,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QVBoxLayout,
    QWidget,
)

from markermend.artifact import PAIRED
from markermend_app.actions import shortcuts
from markermend_app.actions.joints import tip_of
from markermend_app.actions.synonyms import SYNONYMS
from markermend_app.actions.table import ACTIONS
from markermend_app.document import Document
from markermend_app.later import Later
from markermend_app.style import theme
from markermend_app.words import tr

SHOWN = 60
Index = QModelIndex | QPersistentModelIndex
_ENTRY = Qt.ItemDataRole.UserRole
_LINE = Qt.AlignmentFlag.AlignVCenter | Qt.TextFlag.TextSingleLine
_WIDTH, _HEIGHT = 560, 420
_START, _HEAD, _WITHIN, _OTHER_WORD = 3.5, 3.0, 2.0, 1.5
"""How well a word fits; as scattered letters at most 1."""
_SCATTERED = 0.3
"""Letters further apart than that stand in any long text."""


@dataclass(frozen=True)
class Entry:
    """Something that can be found.

    Attributes
    ----------
    text : what it is called
    aside : its key, or where it lies
    icon : beside the text
    usable : whether it can be done now
    do : does it
    also : other words it is found by
    """

    text: str
    aside: str
    icon: QIcon
    usable: bool
    do: Callable[[], object]
    also: str = ""


def entries(made: Mapping[str, QAction], document: Document) -> list[Entry]:
    """Everything that can be done or gone to: actions, markers, artifacts."""
    found = []
    for spec in ACTIONS:
        if spec.name == "palette":
            continue
        action = made[spec.name]
        path = [tr(part) for part in spec.menu.lstrip("|").split("/")]
        # A menu below another one may say in its name what its entries say again.
        path = [part for part in path if not action.text().startswith(part)]
        words = ": ".join((*path, action.text()))
        key = shortcuts.first(spec.name)
        # Who has joints finds what is said of markers, too.
        tips = (tip_of(spec, joints=document.joints), tr(spec.tip))
        also = " ".join((*dict.fromkeys(tips), tr(SYNONYMS.get(spec.name, ""))))
        do: Callable[[], object] = action.trigger
        found.append(Entry(words, key, action.icon(), action.isEnabled(), do, also))
    session = document.session
    if session is None:
        return found
    take = session.original
    marker, aside = theme.icon("marker"), tr("joint") if take.skeleton else tr("marker")
    for label in take.labels:
        do = partial(document.show, (label,))
        found.append(Entry(label, aside, marker, True, do, aside))
    place = {artifact_id: i for i, artifact_id in enumerate(document.queue)}
    order = sorted(session.artifacts, key=lambda a: place.get(a.id, len(place)))
    for a in order:
        one = a.stop - a.start == 1
        text = tr("{0} on {1}, frame {2}") if one else tr("{0} on {1}, frames {2}–{3}")
        first, last = take.frame_number(a.start), take.frame_number(a.stop - 1)
        text = text.format(theme.kind_name(a.kind), PAIRED.join(a.markers), first, last)
        do = partial(document.select, a.id)
        found.append(Entry(text, f"{100 * a.confidence:.0f} %", theme.icon(a.kind), True, do))
    return found


def score(wanted: str, text: str, also: str = "") -> float | None:
    """How well a search fits a text, higher is better; None when it does not.

    Every word of the search has to be found, in any order: best where it begins the text, else a
    word of it, else within one, else where it begins one of the other words, else as letters in
    this order. Short texts go before long ones.
    """
    text, others = text.casefold(), re.findall(r"[\w-]+", also.casefold())
    total = -0.01 * len(text)
    for word in wanted.casefold().split():
        fit = _fit(word, text)
        if (fit is None or fit < _OTHER_WORD) and any(o.startswith(word) for o in others):
            fit = _OTHER_WORD
        if fit is None:
            return None
        total += fit
    return total


def _fit(word: str, text: str) -> float | None:
    """How well one word fits."""
    place = text.find(word)
    if place >= 0:
        heads = any(h == 0 or not text[h - 1].isalnum() for h in _places(word, text))
        return _START if place == 0 else _HEAD if heads else _WITHIN
    at = first = -1
    for letter in word:
        at = text.find(letter, at + 1)
        if at < 0:
            return None
        first = at if first < 0 else first
    fit = len(word) / (at - first + 1)
    return fit if fit >= _SCATTERED else None


def _places(word: str, text: str) -> list[int]:
    """Where a word stands in a text."""
    return [i for i in range(len(text)) if text.startswith(word, i)]


def ranked(wanted: str, found: Sequence[Entry]) -> list[Entry]:
    """Entries that fit a search, best first; of equals those that can be done now. Else all."""
    if not wanted.strip():
        return list(found)
    fits = [(score(wanted, entry.text, entry.also), entry) for entry in found]
    # Roughly, so that artifacts whose names are about as long stay in the order of the queue.
    good = [(round(fit + 0.4 * e.usable, 1), e) for fit, e in fits if fit is not None]
    good.sort(key=lambda pair: -pair[0])
    return [entry for _, entry in good]


class _EntryDelegate(QStyledItemDelegate):
    """Paints an entry's text and, at the end of its row, what stands aside.

    Widgets in every row would take longer to make than the palette may take to open.
    """

    def initStyleOption(self, option: QStyleOptionViewItem, index: Index) -> None:
        """As ever, but without the text, which is painted apart."""
        super().initStyleOption(option, index)
        option.text = ""

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Background and icon as ever, then the texts."""
        super().paint(painter, option, index)
        entry: Entry = index.data(_ENTRY)
        look, metrics = theme.current(), option.fontMetrics
        rect = option.rect.adjusted(36, 0, -8, 0)
        painter.save()
        painter.setFont(option.font)
        painter.setPen(look.muted)
        painter.drawText(rect, _LINE | Qt.AlignmentFlag.AlignRight, entry.aside)
        rect.adjust(0, 0, -metrics.horizontalAdvance(entry.aside) - 8, 0)
        dimmed = option.palette.color(QPalette.ColorGroup.Disabled, QPalette.ColorRole.Text)
        painter.setPen(look.text if entry.usable else dimmed)
        text = metrics.elidedText(entry.text, Qt.TextElideMode.ElideRight, rect.width())
        painter.drawText(rect, _LINE, text)
        painter.restore()


class Palette(QDialog):
    """A line to type in and what fits below it; Return does the first or the chosen one.

    With a question it stands above, and the entries are its answers, the likeliest first.

    Parameters
    ----------
    found : what is listed at once
    parent : the window that it lies on
    question : to be answered, or empty
    more : what else can be found; asked for once the palette is there, or letters are typed
    joints : whether what is open has joints instead of markers
    """

    def __init__(
        self,
        found: Sequence[Entry],
        parent: QWidget,
        question: str = "",
        more: Callable[[], Iterable[Entry]] = tuple,
        joints: bool = False,
    ) -> None:
        super().__init__(parent, Qt.WindowType.Popup)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setObjectName("palette")
        finds = self.tr("Type a few letters") if question else ""
        if not finds:
            finds = self.tr("Find a command, marker or artifact")
            finds = self.tr("Find a command, joint or artifact") if joints else finds
        self.setAccessibleName(question or finds)
        self._found = list(found)
        self._more = Later(lambda: self._found.extend(more()), self)
        self._shown: list[Entry] = []
        self._nothing = Entry(self.tr("Nothing fits these letters."), "", QIcon(), False, bool)
        self.line = QLineEdit()
        self.line.setPlaceholderText(finds)
        self.line.setAccessibleName(question or finds)
        self.line.textChanged.connect(self._search)
        self.list = QListWidget()
        self.list.setAccessibleName(self.tr("Found"))
        self.list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.list.setUniformItemSizes(True)
        self.list.setItemDelegate(_EntryDelegate(self.list))
        self.list.itemClicked.connect(lambda _: self._go())
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 8, 8, 8)
        column.setSpacing(8)
        if question:
            asked = QLabel(question)
            asked.setProperty("role", "heading")
            asked.setWordWrap(True)
            column.addWidget(asked)
        column.addWidget(self.line)
        column.addWidget(self.list)
        self.resize(min(_WIDTH, parent.width() - 40), min(_HEIGHT, parent.height() - 80))
        corner = QPoint((parent.width() - self.width()) // 2, 56)
        self.move(parent.mapToGlobal(corner))
        self._search("")
        self._more.ask()
        self.line.setFocus()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Walk the list, do what is chosen, or leave."""
        key = event.key()
        steps = {Qt.Key.Key_Down: 1, Qt.Key.Key_Up: -1, Qt.Key.Key_PageDown: 10}
        steps[Qt.Key.Key_PageUp] = -10
        if key in steps:
            row = self.list.currentRow() + steps[Qt.Key(key)]
            self.list.setCurrentRow(max(0, min(row, self.list.count() - 1)))
        elif key in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self._go()
        else:
            super().keyPressEvent(event)

    def _search(self, wanted: str) -> None:
        """List what fits."""
        if wanted:
            self._more.catch_up()
        self._shown = ranked(wanted, self._found)[:SHOWN] or [self._nothing]
        self.list.clear()
        for entry in self._shown:
            icon = theme.blank_icon() if entry.icon.isNull() else entry.icon
            item = QListWidgetItem(icon, entry.text, self.list)
            item.setData(Qt.ItemDataRole.AccessibleTextRole, f"{entry.text} {entry.aside}")
            item.setData(_ENTRY, entry)
        self.list.setCurrentRow(-1 if self._shown == [self._nothing] else 0)

    def _go(self) -> None:
        """Leave, and do what was chosen."""
        row = self.list.currentRow()
        if 0 <= row < len(self._shown) and self._shown[row].usable:
            self.close()
            self._shown[row].do()
