"""The rows of the marker tree as Qt holds them: check marks, counts, colours."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Sequence
from itertools import zip_longest
from typing import Any

from PySide6.QtCore import QModelIndex, QObject, QPersistentModelIndex, QSignalBlocker, Qt
from PySide6.QtGui import QFont, QIcon, QStandardItem, QStandardItemModel

from markermend.artifact import Artifact, Kind, Status
from markermend.heat import count_missing
from markermend.take import Take
from markermend_app.panels.markers.badge import dot_icon
from markermend_app.panels.markers.rows import Node
from markermend_app.style import theme

Index = QModelIndex | QPersistentModelIndex
NAME, OPEN, MISSING = range(3)
COLUMNS = 3
NODE = Qt.ItemDataRole.UserRole
_CHECKED, _COLOR = Qt.ItemDataRole.CheckStateRole, Qt.ItemDataRole.ForegroundRole
_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter


class MarkerModel(QStandardItemModel):
    """Rows of :class:`Node`; check marks say what is shown in the plots, and beside them.

    Qt goes through the rows hundreds of times for each picture of them: what it asks for is laid
    down in its own items, so that it need not ask Python.

    Parameters
    ----------
    show : called with the labels to show when a check mark was set or taken away
    show_beside : the same for the keys of channels that are no markers
    """

    def __init__(
        self,
        show: Callable[[Iterable[str]], None],
        show_beside: Callable[[Iterable[str]], None],
        parent: QObject | None = None,
    ) -> None:
        super().__init__(0, COLUMNS, parent)
        self._show, self._show_beside = show, show_beside
        self._beside: tuple[str, ...] = ()
        self._root = Node("")
        self._items: dict[Node, list[QStandardItem]] = {}
        self._by_label: dict[str, Node] = {}
        self._twice: dict[Node, Counter[Kind]] = {}
        self._shown: tuple[str, ...] = ()
        self._missing_tip = self.tr("Share of the frames in which the marker is missing")
        self._small = QFont()
        self._small.setPointSize(theme.SMALL_PT)
        self.setHorizontalHeaderLabels([self.tr("Marker"), self.tr("Open"), "%"])
        tip = Qt.ItemDataRole.ToolTipRole
        for column, text in (
            (OPEN, self.tr("Artifacts that are not decided yet, by class")),
            (MISSING, self._missing_tip),
        ):
            self.setHeaderData(column, Qt.Orientation.Horizontal, text, tip)
        align = Qt.ItemDataRole.TextAlignmentRole
        self.setHeaderData(MISSING, Qt.Orientation.Horizontal, _RIGHT, align)

    def set_heading(self, text: str) -> None:
        """Say what the rows are."""
        self.setHeaderData(NAME, Qt.Orientation.Horizontal, text)

    def set_missing_tip(self, text: str) -> None:
        """Say what the share of missing frames is of; empty for markers."""
        tip = Qt.ItemDataRole.ToolTipRole
        self.setHeaderData(MISSING, Qt.Orientation.Horizontal, text or self._missing_tip, tip)

    def set_root(self, root: Node) -> None:
        """Show other rows; what is missing of markers that stay is known already."""
        self.removeRows(0, self.rowCount())
        self._root, self._items, self._twice = root, {}, {}
        before, self._by_label = self._by_label, {n.label: n for n in root.all_markers()}
        for label, node in self._by_label.items():
            node.missing = before[label].missing if label in before else None
        for node in root.rows:
            self.appendRow(self._grown(node))

    def set_counts(self, artifacts: Iterable[Artifact]) -> None:
        """Count open artifacts, for markers and for everything above them.

        A mix-up is told of each of its markers, and of what holds these once.
        """
        counts: dict[str, Counter[Kind]] = defaultdict(Counter)
        twice: dict[Node, Counter[Kind]] = defaultdict(Counter)
        for a in artifacts:
            if a.status is Status.PENDING:
                for marker in a.markers:
                    counts[marker][a.kind] += 1
                for node in self._holding_several(a.markers):
                    twice[node][a.kind] += 1
        # Counts never go below nothing, so that what was left out is put back first.
        for row, told in self._twice.items():
            row.counts = row.counts + told
        changed: dict[Node, None] = dict.fromkeys((*self._twice, *twice))
        nothing: Counter[Kind] = Counter()
        for label, node in self._by_label.items():
            before, now = node.own, counts.get(label, nothing)
            if now == before:
                continue
            node.own, row = now, node
            while row.parent is not None:
                row.counts = row.counts - before + now
                changed[row] = None
                row = row.parent
        for row, told in twice.items():
            row.counts = row.counts - told
        self._twice = twice
        self._write(OPEN, changed)

    def _holding_several(self, labels: Sequence[str]) -> list[Node]:
        """Rows that hold more than one of some markers, once for each beyond the first."""
        if len(labels) < 2:
            return []
        above: Counter[Node] = Counter()
        for label in labels:
            row = self._by_label.get(label)
            while row is not None and row.parent is not None:
                above[row] += 1
                row = row.parent
        return [row for row, times in above.items() for _ in range(times - 1)]

    def open_counts(self) -> list[Counter[Kind]]:
        """Counts of the markers that have open artifacts."""
        return [node.own for node in self._by_label.values() if node.own]

    def set_missing(self, take: Take, labels: Iterable[str], frames: slice) -> None:
        """Work out in what share of some frames these markers are missing."""
        nodes = [self._by_label[label] for label in labels if label in self._by_label]
        columns = [take.index(node.label) for node in nodes]
        whole, origin = columns == list(range(take.markers)), take.origin[frames]
        counts = count_missing(origin if whole else origin[:, columns])
        for node, count in zip(nodes, counts.tolist(), strict=True):
            node.missing = count / max(1, len(origin))
        self._write(MISSING, nodes)

    @property
    def any_missing(self) -> bool:
        """Whether any marker is missing anywhere."""
        return any(node.missing for node in self._by_label.values())

    def set_shown(self, shown: tuple[str, ...]) -> None:
        """Set the check marks and colours."""
        changed = {a for a, b in zip_longest(self._shown, shown) if a != b}
        changed |= {b for a, b in zip_longest(self._shown, shown) if a != b}
        self._shown = shown
        self._write(NAME, [self._by_label[c] for c in changed if c in self._by_label])

    def set_beside(self, keys: tuple[str, ...]) -> None:
        """Set the check marks of channels."""
        changed = set(self._beside) ^ set(keys)
        self._beside = keys
        self._write(NAME, [n for n in self._root.below() if n.key in changed])

    def recolour(self) -> None:
        """Draw icons and colours anew."""
        for column in (NAME, MISSING):
            self._write(column, self._items)

    def index_of(self, label: str) -> QModelIndex:
        """Where a marker stands, or an invalid index."""
        node = self._by_label.get(label)
        return QModelIndex() if node is None else self._items[node][NAME].index()

    def node(self, index: Index) -> Node:
        """Row behind an index."""
        return index.sibling(index.row(), NAME).data(NODE) if index.isValid() else self._root

    def setData(self, index: Index, value: Any, role: int = Qt.ItemDataRole.EditRole) -> bool:  # noqa: D102
        if role != _CHECKED:
            return False
        node = self.node(index)
        shown, show = (self._beside, self._show_beside) if node.key else (self._shown, self._show)
        name = node.key or node.label
        if Qt.CheckState(value) == Qt.CheckState.Checked:
            show([*shown, name])
        else:
            show([s for s in shown if s != name])
        return True

    # Writing down

    def _grown(self, node: Node) -> list[QStandardItem]:
        """A row with all that is beneath it."""
        items = [QStandardItem() for _ in range(COLUMNS)]
        self._items[node] = items
        name, _, missing = items
        name.setData(node, NODE)
        name.setText(node.name)
        missing.setFont(self._small)
        missing.setTextAlignment(_RIGHT)
        flags = Qt.ItemFlag.ItemIsEnabled
        if node.label or node.selects:
            flags |= Qt.ItemFlag.ItemIsSelectable
        for item in items:
            item.setFlags(flags)
        if node.label or node.key:
            name.setFlags(flags | Qt.ItemFlag.ItemIsUserCheckable)
        for row in node.rows:
            name.appendRow(self._grown(row))
        for column in range(COLUMNS):
            self._write_one(column, node)
        return items

    def _write(self, column: int, nodes: Iterable[Node]) -> None:
        """Write down a column of some rows, and say so once for all beneath one row.

        Each time costs the views a while, whether it is about one row or about many.
        """
        places: dict[Node, list[int]] = defaultdict(list)
        with QSignalBlocker(self):
            for node in nodes:
                self._write_one(column, node)
                if node.parent is not None:
                    places[node.parent].append(self._items[node][column].row())
        for parent, rows in places.items():
            self.dataChanged.emit(
                self._items[parent.rows[min(rows)]][column].index(),
                self._items[parent.rows[max(rows)]][column].index(),
            )

    def _write_one(self, column: int, node: Node) -> None:
        """Write down a cell of a row."""
        items = self._items[node]
        if column == NAME:
            self._write_name(items[NAME], node)
        elif column == MISSING:
            self._write_missing(items[MISSING], node)
        if column != NAME:
            tip = self._tip(node)
            for item in items:
                item.setToolTip(tip)

    def _write_name(self, item: QStandardItem, node: Node) -> None:
        """Whether a row is shown, and in which colour."""
        look = theme.current()
        if node.label or node.key:
            shown = node.key in self._beside if node.key else node.label in self._shown
            item.setCheckState(Qt.CheckState.Checked if shown else Qt.CheckState.Unchecked)
        if node.label and node.label in self._shown:
            item.setIcon(dot_icon(theme.marker_color(self._shown.index(node.label))))
        else:
            item.setIcon(theme.icon(node.icon) if node.icon and not node.label else QIcon())
        if node.note:
            item.setData(look.muted, _COLOR)

    def _write_missing(self, item: QStandardItem, node: Node) -> None:
        """Share of frames missing."""
        look, percent = theme.current(), 100 * (node.missing or 0.0)
        # With a decimal all of them would not fit.
        exact = "100" if percent >= 99.95 else f"{percent:.1f}"
        item.setText(("<0.1" if percent < 0.1 else exact) if percent else "")
        item.setData(look.warning if percent >= 10 else look.muted, _COLOR)

    def _tip(self, node: Node) -> str:
        """What a row is, in words."""
        parts = [node.label or node.name]
        if node.note:
            parts.append(node.note)
        counts = node.own if node.label else node.counts
        open_ = ", ".join(
            f"{counts[k]} {theme.kind_name(k, within=True)}" for k in Kind if counts[k]
        )
        if open_:
            parts.append(self.tr("Open: {0}").format(open_))
        if node.missing:
            parts.append(self.tr("Missing in {0:.2f} % of the frames").format(100 * node.missing))
        return "\n".join(parts)
