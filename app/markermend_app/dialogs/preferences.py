"""The preferences, on one page; each holds as soon as it is chosen."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable

from PySide6.QtCore import QSignalBlocker, QSize, Qt, Signal
from PySide6.QtGui import QColor, QIcon, QPixmap
from PySide6.QtWidgets import (
    QApplication,
    QCheckBox,
    QColorDialog,
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QScrollArea,
    QSlider,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from markermend.artifact import Kind
from markermend_app import detection, languages, own_prior, settings, units
from markermend_app.actions import shortcuts
from markermend_app.actions.shortcut_sheet import ShortcutSheet
from markermend_app.dialogs.help_key import help_in
from markermend_app.dialogs.params_form import inset
from markermend_app.dialogs.prior_choice import PriorChoice
from markermend_app.style import theme
from markermend_app.wheel import leave_wheel
from markermend_app.words import tr

VERTICAL, AUTOSAVE, AUTOSAVE_MIN = "vertical", "autosave_min", 5
_ABREAST = 3
OWN_DIAL = "dial"
OFFERED = (
    "theme",
    theme.COLOUR_BLIND,
    *(f"{theme.CLASS_COLOUR}/{kind}" for kind in Kind),
    languages.SETTING,
    units.SETTING,
    VERTICAL,
    "detect_on_open",
    detection.PRESET,
    detection.SENSITIVITY,
    detection.PROCESSES,
    own_prior.SETTING,
    AUTOSAVE,
)
"""Names of the settings this page changes."""


class Preferences(QDialog):
    """Looks, language, units, detection, saving.

    Signals
    -------
    changed(str) : the setting of that name has another value
    """

    changed = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        help_in(self)
        self.setWindowTitle(self.tr("Preferences"))
        self._idle = False
        self._page = QWidget()
        self._form = QFormLayout(self._page)
        self._form.setHorizontalSpacing(16)
        self._form.setVerticalSpacing(8)
        self._form.setLabelAlignment(Qt.AlignmentFlag.AlignLeft)
        self._looks()
        self._shown()
        self._detection()
        self._skeletons()
        self._work()
        scroll = QScrollArea()
        scroll.setWidget(self._page)
        scroll.setWidgetResizable(True)
        scroll.setFrameShape(QScrollArea.Shape.NoFrame)
        # Else it takes the keyboard first, and shows nowhere that it has it.
        scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        leave_wheel(self._page)
        self._buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        again = self._buttons.addButton(
            self.tr("Restore defaults"), QDialogButtonBox.ButtonRole.ResetRole
        )
        again.clicked.connect(self._restore)
        self._buttons.rejected.connect(self.reject)
        column = QVBoxLayout(self)
        column.addWidget(scroll)
        column.addWidget(self._buttons)
        theme.watcher.changed.connect(self._paint_kinds)
        self._read()
        for button in self.findChildren(QPushButton):
            # Return in a field would press the first of them, which asks for a colour.
            button.setAutoDefault(False)
        self.theme.setFocus()
        self._fit()

    def _fit(self) -> None:
        """Be as large as the page, where the screen is."""
        beside = QSize(48, self._buttons.sizeHint().height() + 48)
        whole = self._page.sizeHint() + beside
        self.resize(whole.expandedTo(QSize(600, 0)).boundedTo(self.screen().availableSize() * 0.9))

    # The page

    def _looks(self) -> None:
        self._heading(self.tr("Look"))
        self.theme = self._choice(
            self.tr("Theme"),
            "theme",
            [
                (self.tr("As the system"), "system"),
                (self.tr("Light"), "light"),
                (self.tr("Dark"), "dark"),
                (self.tr("High contrast"), "contrast"),
            ],
        )
        self.blind = self._check(
            self.tr("Colours for colour-blind eyes"), theme.COLOUR_BLIND, self._recoloured
        )
        self.kinds: dict[Kind, QPushButton] = {}
        grid = QGridLayout()
        grid.setSpacing(4)
        for i, kind in enumerate(Kind):
            button = QPushButton(theme.kind_name(kind))
            tip = self.tr("Choose the colour of {0}").format(theme.kind_name(kind, within=True))
            button.setToolTip(tip)
            button.setAccessibleName(tip)
            button.clicked.connect(lambda _=False, kind=kind: self._ask_colour(kind))
            self.kinds[kind] = button
            grid.addWidget(button, i // _ABREAST, i % _ABREAST)
        self._form.addRow(self.tr("Classes"), grid)
        named = [(name, code) for code, name in languages.LANGUAGES.items()]
        self.language = self._choice(
            self.tr("Language"),
            languages.SETTING,
            [(self.tr("As the system"), "system"), *named],
            self.tr("Holds from the next start on."),
        )

    def _shown(self) -> None:
        self._heading(self.tr("Numbers and space"))
        self.unit = self._choice(
            self.tr("Lengths in"),
            units.SETTING,
            [
                (self.tr("millimetres"), "mm"),
                (self.tr("centimetres"), "cm"),
                (self.tr("metres"), "m"),
            ],
            self.tr("What the window shows; files keep their own unit."),
        )
        self.vertical = self._choice(
            self.tr("Axis that points up"),
            VERTICAL,
            [(self.tr("As the take suggests"), "auto"), ("X", "x"), ("Y", "y"), ("Z", "z")],
        )

    def _detection(self) -> None:
        self._heading(self.tr("Detection"))
        self.on_open = self._check(self.tr("Detect after opening a take"), "detect_on_open")
        self.preset = QComboBox()
        self._row(self.tr("How"), self.preset)
        self.preset.activated.connect(lambda _: self._preset_chosen())
        self.dial = QSlider(Qt.Orientation.Horizontal)
        self.dial.setRange(0, 100)
        self.dial.setPageStep(10)
        self.dial_value = QLabel()
        self.dial_value.setMinimumWidth(48)
        self.dial_value.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        row = QHBoxLayout()
        row.setSpacing(8)
        row.addWidget(self.dial, 1)
        row.addWidget(self.dial_value)
        self.dial.setAccessibleName(self.tr("Sensitivity"))
        self._form.addRow(self.tr("Sensitivity"), row)
        self.dial_hint = self._hint(
            self.tr("Higher finds more, and more false alarms, from the next search on.")
        )
        self.dial.valueChanged.connect(self._dialled)

    def _skeletons(self) -> None:
        self._heading(self.tr("Skeleton recordings"))
        self.prior = PriorChoice()
        self._row(self.tr("How bodies move"), self.prior)
        self.prior.changed.connect(self.changed)
        self.finished.connect(self.prior.stop)

    def _work(self) -> None:
        self._heading(self.tr("Work"))
        self.autosave = QSpinBox()
        inset(self.autosave)
        self.autosave.setRange(0, 60)
        self.autosave.setSpecialValueText(self.tr("only when a take is closed"))
        self.autosave.setPrefix(self.tr("every "))
        self.autosave.setSuffix(self.tr(" min"))
        self._row(self.tr("Save the review"), self.autosave)
        self._hint(self.tr("Each step is kept at once in any case, also through a crash."))
        self.autosave.valueChanged.connect(lambda value: self._store(AUTOSAVE, value))
        self.processes = QSpinBox()
        inset(self.processes)
        self.processes.setRange(0, os.cpu_count() or 1)
        self.processes.setSpecialValueText(self.tr("as many as there are cores"))
        self._row(self.tr("Processes"), self.processes)
        self._hint(self.tr("Used to look for slow drifts in long takes."))
        self.processes.valueChanged.connect(
            lambda value: self._store(detection.PROCESSES, value or -1)
        )
        self.keys = QPushButton()
        self.keys.clicked.connect(self._open_keys)
        self._form.addRow(self.tr("Keys as in"), self.keys)
        self._hint(self.tr("All keys on one sheet, each to be changed, with presets."))

    # Its parts

    def _heading(self, text: str) -> None:
        label = QLabel(text)
        label.setProperty("role", "heading")
        label.setContentsMargins(0, 12 if self._form.rowCount() else 0, 0, 0)
        self._form.addRow(label)

    def _hint(self, text: str) -> QLabel:
        label = QLabel(text)
        label.setProperty("role", "small")
        self._form.addRow("", label)
        return label

    def _row(self, text: str, widget: QWidget) -> None:
        widget.setAccessibleName(text)
        self._form.addRow(text, widget)

    def _choice(
        self, text: str, name: str, choices: Iterable[tuple[str, str]], hint: str = ""
    ) -> QComboBox:
        box = QComboBox()
        for label, value in choices:
            box.addItem(label, value)
        self._row(text, box)
        if hint:
            self._hint(hint)
        box.activated.connect(lambda _: self._store(name, box.currentData()))
        return box

    def _check(self, text: str, name: str, then: Callable[[], None] | None = None) -> QCheckBox:
        box = QCheckBox(text)
        self._form.addRow("", box)
        box.clicked.connect(lambda on: self._store(name, on))
        if then is not None:
            box.clicked.connect(lambda _: then())
        return box

    # What holds

    def _read(self) -> None:
        """Show what holds now."""
        for box, name, value in (
            (self.theme, "theme", "system"),
            (self.language, languages.SETTING, "system"),
            (self.unit, units.SETTING, "mm"),
            (self.vertical, VERTICAL, "auto"),
        ):
            box.setCurrentIndex(max(0, box.findData(settings.text(name, value))))
        self.blind.setChecked(settings.flag(theme.COLOUR_BLIND, False))
        self.on_open.setChecked(settings.flag("detect_on_open", True))
        with QSignalBlocker(self.autosave), QSignalBlocker(self.processes):
            self.autosave.setValue(round(settings.number(AUTOSAVE, AUTOSAVE_MIN)))
            self.processes.setValue(max(0, round(settings.number(detection.PROCESSES, -1))))
        self._read_detection()
        self.prior.read()
        self._paint_kinds()
        self._tell_keys()

    def dial_does_nothing(self) -> None:
        """Say that what is open is searched without them."""
        text = self.tr(
            "Not for the open recording: its joints are looked at in one way.\n"
            "Close it to set this for the next take."
        )
        self._idle = True
        self.dial_hint.setText(text)
        self._fit()
        for widget in (self.preset, self.dial, self.dial_value):
            widget.setEnabled(False)

    def _read_detection(self) -> None:
        """Show dial and preset."""
        from markermend.presets import list_presets

        value = settings.number(detection.SENSITIVITY, detection.BALANCED)
        kept = settings.text(detection.PRESET, "")
        self.preset.clear()
        for text, dial in detection.DIALS.items():
            self.preset.addItem(tr(text), dial)
        for name in list_presets():
            self.preset.addItem(self.tr("Preset “{0}”").format(name), name)
        if kept and self.preset.findData(kept) < 0:
            self.preset.addItem(self.tr("Preset “{0}”, which is gone").format(kept), kept)
        place = self.preset.findData(kept or value)
        if place < 0:
            self.preset.addItem(self.tr("As dialled"), OWN_DIAL)
            place = self.preset.count() - 1
        self.preset.setCurrentIndex(place)
        with QSignalBlocker(self.dial):
            self.dial.setValue(round(100 * value))
        self.dial.setEnabled(not kept and not self._idle)
        self.dial_value.setText("" if kept else f"{100 * value:.0f} %")

    def _paint_kinds(self) -> None:
        """Show the classes' colours."""
        for kind, button in self.kinds.items():
            patch = QPixmap(16, 16)
            patch.fill(theme.current().kinds[kind])
            button.setIcon(QIcon(patch))

    def _store(self, name: str, value: object) -> None:
        settings.remember(name, value)
        self.changed.emit(name)

    def _preset_chosen(self) -> None:
        """Take a position of the dial, or a preset."""
        chosen = self.preset.currentData()
        if isinstance(chosen, float):
            settings.remember(detection.PRESET, "")
            self._store(detection.SENSITIVITY, chosen)
        elif chosen != OWN_DIAL:
            self._store(detection.PRESET, chosen)
        self._read_detection()

    def _dialled(self, percent: int) -> None:
        self._store(detection.SENSITIVITY, percent / 100)
        self._read_detection()

    def _ask_colour(self, kind: Kind) -> None:
        """Ask for the colour of a class."""
        asked = self.tr("Colour of {0}").format(theme.kind_name(kind, within=True))
        color = QColorDialog.getColor(theme.current().kinds[kind], self, asked)
        if color.isValid():
            self.set_colour(kind, color)

    def set_colour(self, kind: Kind, color: QColor) -> None:
        """Give a class a colour."""
        self._store(f"{theme.CLASS_COLOUR}/{kind}", color.name())
        self._recoloured()

    def _recoloured(self) -> None:
        app = QApplication.instance()
        if isinstance(app, QApplication):
            theme.recolour(app)

    def _open_keys(self) -> None:
        """Open the sheet of keys, which keeps what is chosen there itself."""
        ShortcutSheet(self).exec()
        self._tell_keys()

    def _tell_keys(self) -> None:
        """Name the preset of keys in use."""
        text = f"{shortcuts.PRESET_LABEL[shortcuts.preset()]}…"
        self.keys.setText(text)
        self.keys.setAccessibleName(self.tr("Keys as in {0}").format(text))

    def _restore(self) -> None:
        """Forget all that was chosen on this page."""
        self.prior.stop()
        for name in OFFERED:
            settings.remember(name, None)
        self._read()
        for name in OFFERED:
            self.changed.emit(name)
        self._recoloured()
