"""A form for the parameters of any registered method, made from its dataclass."""

from __future__ import annotations

from dataclasses import Field, fields
from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QAbstractSpinBox,
    QCheckBox,
    QDoubleSpinBox,
    QFormLayout,
    QLabel,
    QSpinBox,
    QWidget,
)

from markermend_app.wheel import leave_wheel
from markermend_app.words import tr

_UNITS = ("_hz", "_mm")
_MOST = 2**31 - 1


class ParamsForm(QWidget):
    """One line a parameter: name, value with its unit and range, what it means.

    Signals
    -------
    changed() : a value is another one
    """

    changed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._form = QFormLayout(self)
        self._form.setContentsMargins(0, 0, 0, 0)
        self._form.setVerticalSpacing(4)
        self._form.setLabelAlignment(Qt.AlignmentFlag.AlignLeft)
        self.fields: dict[str, QSpinBox | QDoubleSpinBox | QCheckBox] = {}

    def show_params(self, params: Any) -> None:
        """Offer the fields of a parameter dataclass, with the values of this one."""
        while self._form.rowCount():
            self._form.removeRow(0)
        self.fields = {}
        for field in fields(params):
            made = self._field(field, getattr(params, field.name))
            self.fields[field.name] = made
            name = tr(words(field.name))
            made.setAccessibleName(name)
            leave_wheel(made)
            self._form.addRow(name, made)
            hint = QLabel(tr(field.metadata.get("help", "")))
            hint.setProperty("role", "small")
            hint.setWordWrap(True)
            self._form.addRow(hint)

    def values(self) -> dict[str, Any]:
        """Name and value of each parameter."""
        return {
            name: made.isChecked() if isinstance(made, QCheckBox) else made.value()
            for name, made in self.fields.items()
        }

    def _field(self, field: Field[Any], value: Any) -> QSpinBox | QDoubleSpinBox | QCheckBox:
        """What a value is typed into, by its type."""
        if isinstance(value, bool):
            box = QCheckBox()
            box.setChecked(value)
            box.toggled.connect(lambda _: self.changed.emit())
            return box
        made = QSpinBox() if isinstance(value, int) else _Number()
        inset(made)
        low, high = field.metadata.get("min", -_MOST), field.metadata.get("max", _MOST)
        made.setRange(low, high)
        made.setValue(value)
        made.setKeyboardTracking(False)
        made.setStepType(QAbstractSpinBox.StepType.AdaptiveDecimalStepType)
        unit = field.metadata.get("unit", "")
        made.setSuffix(f" {unit}" if unit else "")
        made.valueChanged.connect(lambda _: self.changed.emit())
        return made


def inset(box: QAbstractSpinBox) -> None:
    """Keep the text off the border: style sheets do not reach within, and paint it onto it."""
    box.lineEdit().setTextMargins(7, 0, 0, 0)


class _Number(QDoubleSpinBox):
    """Writes numbers of any size without idle zeros."""

    def __init__(self) -> None:
        super().__init__()
        self.setDecimals(9)

    def textFromValue(self, value: float) -> str:
        """The number with as many digits as it needs."""
        return self.locale().toString(value, "g", 6)


def words(name: str) -> str:
    """The name of a field for people."""
    for unit in _UNITS:
        name = name.removesuffix(unit)
    return name.replace("_", " ").capitalize()
