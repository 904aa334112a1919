"""The rows of the marker tree as Qt asks for them: check marks, counts, colours."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable
from itertools import zip_longest
from typing import Any

from PySide6.QtCore import QAbstractItemModel, QModelIndex, QObject, QPersistentModelIndex, Qt
from PySide6.QtGui import QFont

from markermend.artifact import Artifact, Kind, Status
from markermend.heat import count_missing
from markermend.take import Take
from markermend_app.panels.markers.badge import dot_icon
from markermend_app.panels.markers.rows import Node
from markermend_app.style import theme

Index = QModelIndex | QPersistentModelIndex
NAME, OPEN, MISSING = range(3)
COLUMNS = 3
COUNTS = Qt.ItemDataRole.UserRole
LABEL = Qt.ItemDataRole.UserRole + 1
SORT = Qt.ItemDataRole.UserRole + 2
OWN = Qt.ItemDataRole.UserRole + 3


class MarkerModel(QAbstractItemModel):
    """Rows of :class:`Node`; check marks say what is shown in the plots, and beside them.

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
        super().__init__(parent)
        self._show, self._show_beside = show, show_beside
        self._beside: tuple[str, ...] = ()
        self._root = Node("")
        self._by_label: dict[str, Node] = {}
        self._shown: tuple[str, ...] = ()
        self._headers = [self.tr("Marker"), self.tr("Open"), "%"]
        self._header_tips = (
            "",
            self.tr("Artifacts that are not decided yet, by class"),
            self.tr("Share of the frames in which the marker is missing"),
        )

    def set_heading(self, text: str) -> None:
        """Say what the rows are."""
        self._headers[NAME] = text
        self.headerDataChanged.emit(Qt.Orientation.Horizontal, NAME, NAME)

    def set_root(self, root: Node) -> None:
        """Show other rows."""
        self.beginResetModel()
        self._root = root
        self._by_label = {n.label: n for n in root.all_markers()}
        self.endResetModel()

    def set_counts(self, artifacts: Iterable[Artifact]) -> None:
        """Count open artifacts, for markers and for everything above them."""
        counts: dict[str, Counter[Kind]] = defaultdict(Counter)
        for a in artifacts:
            if a.status is Status.PENDING:
                counts[a.marker][a.kind] += 1
        changed: dict[int, Node] = {}
        nothing: Counter[Kind] = Counter()
        for label, node in self._by_label.items():
            before, now = node.own, counts.get(label, nothing)
            if now == before:
                continue
            node.own, row = now, node
            while row.parent is not None:
                row.counts = row.counts - before + now
                changed[id(row)] = row
                row = row.parent
        self._announce(OPEN, changed.values())

    def open_counts(self) -> list[Counter[Kind]]:
        """Counts of the markers that have open artifacts."""
        return [node.own for node in self._by_label.values() if node.own]

    def set_missing(self, take: Take, labels: Iterable[str]) -> None:
        """Work out the share of frames without these markers."""
        nodes = [self._by_label[label] for label in labels if label in self._by_label]
        columns = [take.index(node.label) for node in nodes]
        whole = columns == list(range(take.markers))
        counts = count_missing(take.origin if whole else take.origin[:, columns])
        for node, count in zip(nodes, counts.tolist(), strict=True):
            node.missing = count / max(1, take.frames)
        self._announce(MISSING, nodes)

    def set_shown(self, shown: tuple[str, ...]) -> None:
        """Set the check marks and colours."""
        changed = {a for a, b in zip_longest(self._shown, shown) if a != b}
        changed |= {b for a, b in zip_longest(self._shown, shown) if a != b}
        self._shown = shown
        self._announce(NAME, (self._by_label[c] for c in changed if c in self._by_label))

    def set_beside(self, keys: tuple[str, ...]) -> None:
        """Set the check marks of channels."""
        changed = set(self._beside) ^ set(keys)
        self._beside = keys
        self._announce(NAME, (n for n in self._root.below() if n.key in changed))

    def recolour(self) -> None:
        """Draw icons and colours anew."""
        self._announce(NAME, self._root.below())

    def index_of(self, label: str) -> QModelIndex:
        """Where a marker stands, or an invalid index."""
        node = self._by_label.get(label)
        return QModelIndex() if node is None else self._index(node, NAME)

    def node(self, index: Index) -> Node:
        """Row behind an index."""
        return index.internalPointer() if index.isValid() else self._root

    def _index(self, node: Node, column: int) -> QModelIndex:
        if node.parent is None:
            return QModelIndex()
        return self.createIndex(node.parent.rows.index(node), column, node)

    def _announce(self, column: int, nodes: Iterable[Node]) -> None:
        """Say that a column of some rows has other contents, once for all beneath one row.

        Each time costs the views a while, whether it is about one row or about many.
        """
        places: dict[Node, list[int]] = defaultdict(list)
        for node in nodes:
            if node.parent is not None:
                places[node.parent].append(node.parent.rows.index(node))
        for parent, rows in places.items():
            first, last = min(rows), max(rows)
            self.dataChanged.emit(
                self.createIndex(first, column, parent.rows[first]),
                self.createIndex(last, column, parent.rows[last]),
            )

    # What Qt asks

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008, D102
        return 0 if parent.column() > 0 else len(self.node(parent).rows)

    def columnCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008, D102
        return COLUMNS

    def index(self, row: int, column: int, parent: Index = QModelIndex()) -> QModelIndex:  # noqa: B008, D102
        rows = self.node(parent).rows if parent.column() <= 0 else ()
        if not (0 <= row < len(rows) and 0 <= column < COLUMNS):
            return QModelIndex()
        return self.createIndex(row, column, rows[row])

    def parent(self, index: Index) -> QModelIndex:  # type: ignore[override]  # noqa: D102
        above = self.node(index).parent
        return QModelIndex() if above is None else self._index(above, NAME)

    def headerData(  # noqa: D102
        self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole
    ) -> Any:
        if orientation is not Qt.Orientation.Horizontal:
            return None
        if role == Qt.ItemDataRole.DisplayRole:
            return self._headers[section]
        if role == Qt.ItemDataRole.ToolTipRole:
            return self._header_tips[section]
        if role == Qt.ItemDataRole.TextAlignmentRole and section == MISSING:
            return Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        return None

    def flags(self, index: Index) -> Qt.ItemFlag:  # noqa: D102
        node = self.node(index)
        flags = Qt.ItemFlag.ItemIsEnabled
        if node.label or node.selects:
            flags |= Qt.ItemFlag.ItemIsSelectable
        if index.column() == NAME and (node.label or node.key):
            flags |= Qt.ItemFlag.ItemIsUserCheckable
        return flags

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:  # noqa: D102
        node = self.node(index)
        if role == LABEL:
            return node.label
        if role == SORT:
            return (sum(node.counts.values()), node.missing or 0.0)
        column = index.column()
        if role == Qt.ItemDataRole.ToolTipRole:
            return self._tip(node)
        if column == NAME:
            return self._name_data(node, role)
        if column == OPEN:
            return {COUNTS: node.counts, OWN: node.own}.get(role)
        return self._missing_data(node, role)

    def setData(self, index: Index, value: Any, role: int = Qt.ItemDataRole.EditRole) -> bool:  # noqa: D102
        if role != Qt.ItemDataRole.CheckStateRole:
            return False
        node = self.node(index)
        shown, show = (self._beside, self._show_beside) if node.key else (self._shown, self._show)
        name = node.key or node.label
        if Qt.CheckState(value) == Qt.CheckState.Checked:
            show([*shown, name])
        else:
            show([s for s in shown if s != name])
        return True

    def _name_data(self, node: Node, role: int) -> Any:
        """Name column."""
        if role == Qt.ItemDataRole.DisplayRole:
            return node.name
        if role == Qt.ItemDataRole.CheckStateRole and (node.label or node.key):
            shown = node.key in self._beside if node.key else node.label in self._shown
            return Qt.CheckState.Checked if shown else Qt.CheckState.Unchecked
        if role == Qt.ItemDataRole.DecorationRole:
            if node.label in self._shown and node.label:
                return dot_icon(theme.marker_color(self._shown.index(node.label)))
            return None if node.label or not node.icon else theme.icon(node.icon)
        if role == Qt.ItemDataRole.ForegroundRole and node.note:
            return theme.current().muted
        return None

    def _missing_data(self, node: Node, role: int) -> Any:
        """Column of the share of frames missing."""
        if role == Qt.ItemDataRole.DisplayRole and node.missing:
            percent = 100 * node.missing
            # With a decimal all of them would not fit.
            exact = "100" if percent >= 99.95 else f"{percent:.1f}"
            return "<0.1" if percent < 0.1 else exact
        if role == Qt.ItemDataRole.FontRole:
            font = QFont()
            font.setPointSize(theme.SMALL_PT)
            return font
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        if role == Qt.ItemDataRole.ForegroundRole:
            t = theme.current()
            return t.warning if (node.missing or 0) >= 0.1 else t.muted
        return None

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
