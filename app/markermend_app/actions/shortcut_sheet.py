"""Every key and every gesture on one sheet; the keys can be changed there."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import (
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QHBoxLayout,
    QKeySequenceEdit,
    QLabel,
    QLineEdit,
    QMessageBox,
    QPushButton,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from markermend_app.actions import shortcuts
from markermend_app.actions.synonyms import SYNONYMS
from markermend_app.actions.table import ACTIONS
from markermend_app.dialogs.help_key import help_in
from markermend_app.panels.nothing import Nothing
from markermend_app.style import theme
from markermend_app.words import tr

_NAME = Qt.ItemDataRole.UserRole


class ShortcutSheet(QDialog):
    """All actions by menu with their keys, and the gestures of the mouse."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        help_in(self)
        self.setWindowTitle(self.tr("Keyboard and mouse"))
        self.filter = QLineEdit()
        self.filter.setPlaceholderText(self.tr("Find by name or key"))
        self.filter.setAccessibleName(self.tr("Find by name or key"))
        self.filter.setClearButtonEnabled(True)
        self.filter.textChanged.connect(self._narrow)
        self.preset = QComboBox()
        self.preset.setAccessibleName(self.tr("Keys as in"))
        for name, label in shortcuts.PRESET_LABEL.items():
            self.preset.addItem(label, name)
        self.preset.activated.connect(self._preset_chosen)
        top = QHBoxLayout()
        top.addWidget(self.filter, 1)
        top.addSpacing(8)
        top.addWidget(QLabel(self.tr("Keys as in")))
        top.addWidget(self.preset)

        self.tree = QTreeWidget()
        self.tree.setAccessibleName(self.tr("Actions and keys"))
        self.tree.setHeaderLabels([self.tr("What"), self.tr("Keys")])
        self._nothing = Nothing(self.tree, self.tr("No action or key is named so."))
        self.tree.setRootIsDecorated(False)
        self.tree.setIndentation(12)
        self.tree.currentItemChanged.connect(lambda *_: self._chosen())
        self.tree.itemActivated.connect(lambda *_: self.keys.setFocus())

        self.keys: QKeySequenceEdit = QKeySequenceEdit()
        self.keys.setMaximumSequenceLength(1)
        self.keys.setAccessibleName(self.tr("New key"))
        self.keys.setClearButtonEnabled(True)
        self.keys.setMinimumWidth(self.keys.fontMetrics().averageCharWidth() * 24)
        self.keys.keySequenceChanged.connect(lambda _: self._warn())
        self.set = QPushButton(self.tr("Use this key"))
        self.set.clicked.connect(self._set)
        self.without = QPushButton(self.tr("No key"))
        self.without.clicked.connect(lambda: self._give(()))
        self.standard = QPushButton(self.tr("As in the preset"))
        self.standard.clicked.connect(self._reset)
        edit = QHBoxLayout()
        edit.addWidget(QLabel(self.tr("New key")))
        for widget in (self.keys, self.set, self.without, self.standard):
            edit.addWidget(widget)
        self.warning = QLabel()
        self.warning.setProperty("role", "warning")
        self.warning.setWordWrap(True)
        self.warning.setMinimumHeight(self.warning.fontMetrics().height())

        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        buttons.rejected.connect(self.reject)
        column = QVBoxLayout(self)
        column.setSpacing(8)
        column.addLayout(top)
        column.addWidget(self.tree, 1)
        column.addLayout(edit)
        column.addWidget(self.warning)
        column.addWidget(buttons)
        self._fill()
        self.resize(640, 700)
        self.filter.setFocus()
        for key in (Qt.Key.Key_Down, Qt.Key.Key_Return, Qt.Key.Key_Enter):
            onward = QShortcut(key, self.filter, self._go_to_list)
            onward.setContext(Qt.ShortcutContext.WidgetShortcut)

    def select(self, name: str) -> None:
        """Choose an action, to change its keys."""
        for item in self._items():
            if item.data(0, _NAME) == name:
                self.tree.setCurrentItem(item)

    # Showing

    def _fill(self) -> None:
        """List everything, with the keys in effect."""
        here = self._name()
        self.preset.setCurrentIndex(self.preset.findData(shortcuts.preset()))
        keys = shortcuts.table()
        doubled = shortcuts.conflicts(keys)
        self.tree.clear()
        for menu in dict.fromkeys(spec.menu.lstrip("|") for spec in ACTIONS):
            section = self._section(" · ".join(tr(part) for part in menu.split("/")))
            for spec in ACTIONS:
                if spec.menu.lstrip("|") == menu:
                    had = keys[spec.name]
                    item = self._line(section, tr(spec.text), _either(had))
                    item.setData(0, _NAME, spec.name)
                    item.setIcon(0, theme.icon(spec.icon) if spec.icon else theme.blank_icon())
                    if set(had) & set(doubled):
                        item.setForeground(1, theme.current().warning)
        for title, gestures in _gestures():
            section = self._section(title)
            for gesture, text in gestures:
                self._line(section, text, gesture)
        self.tree.expandAll()
        self.tree.resizeColumnToContents(0)
        if here:
            self.select(here)
        self._narrow(self.filter.text())
        self._chosen()

    def _section(self, title: str) -> QTreeWidgetItem:
        item = QTreeWidgetItem(self.tree, [title])
        item.setFirstColumnSpanned(True)
        item.setFlags(Qt.ItemFlag.ItemIsEnabled)
        font = item.font(0)
        font.setBold(True)
        item.setFont(0, font)
        return item

    def _line(self, section: QTreeWidgetItem, text: str, keys: str) -> QTreeWidgetItem:
        return QTreeWidgetItem(section, [text, keys])

    def _items(self) -> list[QTreeWidgetItem]:
        """Every line below the headings."""
        return [item for section in self._sections() for item in _below(section)]

    def _sections(self) -> list[QTreeWidgetItem]:
        return _below(self.tree.invisibleRootItem())

    def _narrow(self, wanted: str) -> None:
        """Show only what fits what was typed."""
        for item in self._items():
            also = tr(SYNONYMS.get(item.data(0, _NAME) or "", ""))
            text = f"{item.text(0)} {item.text(1)} {also}".casefold()
            item.setHidden(not all(word in text for word in wanted.casefold().split()))
        for section in self._sections():
            section.setHidden(all(item.isHidden() for item in _below(section)))
        self._nothing.show(all(section.isHidden() for section in self._sections()))

    def _go_to_list(self) -> None:
        """Go on from the filter to the first action that is left."""
        left = [i for i in self._items() if i.data(0, _NAME) and not i.isHidden()]
        self.tree.setFocus()
        if left and self.tree.currentItem() not in left:
            self.tree.setCurrentItem(left[0])

    # Changing

    def _name(self) -> str:
        """The chosen action's name, or empty."""
        item = self.tree.currentItem()
        return (item.data(0, _NAME) or "") if item is not None else ""

    def _chosen(self) -> None:
        """Offer the chosen action's keys."""
        usable = bool(self._name())
        for widget in (self.keys, self.set, self.without, self.standard):
            widget.setEnabled(usable)
        self.keys.clear()
        self._warn()

    def _key(self) -> str:
        return self.keys.keySequence().toString(QKeySequence.SequenceFormat.PortableText)

    def _warn(self) -> None:
        """Say who has the key, before it is taken."""
        key, name = self._key(), self._name()
        others = [h for h in shortcuts.holders(key, shortcuts.table()) if h != name]
        self.set.setEnabled(bool(name and key))
        self.set.setText(self.tr("Take this key") if others else self.tr("Use this key"))
        text = {spec.name: tr(spec.text) for spec in ACTIONS}
        told = self.tr("{0} belongs to “{1}”, which would lose it.")
        self.warning.setText(told.format(shortcuts.native(key), text[others[0]]) if others else "")

    def _set(self) -> None:
        """Give the chosen action the key, as its first; a second one it had stays."""
        had = shortcuts.table()[self._name()]
        self._give((self._key(), *had[1:]))

    def _give(self, keys: tuple[str, ...]) -> None:
        shortcuts.change(self._name(), tuple(dict.fromkeys(keys)))
        self._changed()

    def _reset(self) -> None:
        """Give the chosen action back the keys of the preset."""
        shortcuts.restore(self._name())
        self._changed()

    def _changed(self) -> None:
        """Show what holds, and go back to the list: the button pressed may be disabled now."""
        self._fill()
        self.tree.setFocus()

    def _preset_chosen(self) -> None:
        """Take a preset, and ask first where keys chosen by hand would be lost."""
        if not shortcuts.own() or self._lets_go(self.preset.currentText()):
            shortcuts.use_preset(self.preset.currentData())
        self._fill()

    def _lets_go(self, preset: str) -> bool:
        """Whether the keys chosen by hand may go."""
        title, text = self.tr("Keyboard and mouse"), self.tr("Take all keys of {0}?").format(preset)
        lost = self.tr("What you changed by hand would be lost.")
        return QMessageBox.question(self, title, f"{text} {lost}") == QMessageBox.StandardButton.Yes


def _below(item: QTreeWidgetItem) -> list[QTreeWidgetItem]:
    """What stands under an item."""
    children = (item.child(i) for i in range(item.childCount()))
    return [child for child in children if child is not None]


def _either(keys: tuple[str, ...]) -> str:
    """Keys in words."""
    return tr("  or  ").join(map(shortcuts.native, keys))


def _gestures() -> list[tuple[str, list[tuple[str, str]]]]:
    """What the mouse does, by place."""
    return [
        (
            tr("In the plots"),
            [
                (tr("Click on an interval"), tr("Select it; double click repairs")),
                (tr("Wheel, Ctrl+wheel"), tr("Zoom time, zoom values")),
                (tr("Middle or right drag"), tr("Pan")),
                (tr("Shift+drag"), tr("Select a range of frames")),
                (tr("Drag an edge"), tr("Move the edge of the selected artifact")),
            ],
        ),
        (
            tr("In the 3D view"),
            [
                (tr("Drag"), tr("Orbit")),
                (tr("Middle, right or Shift+drag"), tr("Pan")),
                (tr("Wheel"), tr("Zoom")),
                (tr("Ctrl+drag"), tr("Scrub through time")),
                (tr("Alt+arrows, with Shift"), tr("Orbit, pan, once the view has the focus")),
                (tr("+ and −"), tr("Zoom, once the view has the focus")),
                (tr("Keypad 1, 3, 7"), tr("Look along an axis, from above")),
            ],
        ),
    ]
