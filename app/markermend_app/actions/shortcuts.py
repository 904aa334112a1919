"""Which keys do what: the table of actions, a preset over it, and the operator's own over both.

Presets give the keys that hands know from other programs to what Markermend does in their place;
what a preset does not name keeps the key of the table.
"""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Mapping
from functools import lru_cache
from types import MappingProxyType

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QKeySequence
from PySide6.QtWidgets import QWidget

from markermend_app import settings
from markermend_app.actions.table import ACTIONS
from markermend_app.words import tr

Keys = tuple[str, ...]

DEFAULT = "markermend"
PRESET_LABEL: Mapping[str, str] = MappingProxyType(
    {DEFAULT: "Markermend", "nexus": "Vicon Nexus", "qtm": "Qualisys QTM", "motive": "Motive"}
)
PRESETS: Mapping[str, Mapping[str, Keys]] = MappingProxyType(
    {
        DEFAULT: {},
        # Gaps are walked and filled from one panel; the arrows with Ctrl go to events.
        "nexus": {
            "next": ("Ctrl+Right", "N"),
            "previous": ("Ctrl+Left", "P"),
            "repair": ("Ctrl+F", "F"),
            "filter": ("Ctrl+Shift+F",),
            "fit": ("Ctrl+Home", "Ctrl+0"),
            "frames_forward": ("Shift+Right", "PgDown"),
            "frames_back": ("Shift+Left", "PgUp"),
        },
        # One hand stays on the arrows, G fills.
        "qtm": {
            "next": ("Ctrl+Right", "N"),
            "previous": ("Ctrl+Left", "P"),
            "repair": ("G", "F"),
            "frames_forward": ("Shift+Right", "PgDown"),
            "frames_back": ("Shift+Left", "PgUp"),
        },
        # F frames what is selected, as in programs for animation; so that repairing moves to I,
        # for interpolating.
        "motive": {
            "repair": ("I",),
            "repair_selection": ("Shift+I",),
            "region_start": ("Ctrl+I",),
            "region_selection": ("Ctrl+Shift+I",),
            "fit": ("F", "Ctrl+0"),
            "next": ("Ctrl+Right", "N", "."),
            "previous": ("Ctrl+Left", "P", ","),
        },
    }
)
_OWN, _PRESET = "shortcuts/own", "shortcuts/preset"


class Watcher(QObject):
    """Tells that keys have changed.

    Signals
    -------
    changed() : :func:`keys` gives others
    """

    changed = Signal()


watcher = Watcher()


def preset() -> str:
    """Name of the preset in use."""
    name = settings.text(_PRESET, DEFAULT)
    return name if name in PRESETS else DEFAULT


def own() -> dict[str, Keys]:
    """Keys the operator has chosen, by action."""
    return _read(settings.text(_OWN, "{}"))


def _read(stored: str) -> dict[str, Keys]:
    """Keys by action; what cannot be read is not there."""
    try:
        keys = json.loads(stored)
    except ValueError:
        return {}
    if not isinstance(keys, dict):
        return {}
    return {name: tuple(map(str, had)) for name, had in keys.items() if isinstance(had, list)}


def table() -> dict[str, Keys]:
    """Keys in effect, by action, as Qt writes them."""
    return _table(preset(), settings.text(_OWN, "{}"))


@lru_cache(maxsize=4)
def _table(base: str, stored: str) -> dict[str, Keys]:
    """Keys of a preset and of the operator's own, as they are stored."""
    chosen = {name: _plain(keys) for name, keys in {**PRESETS[base], **_read(stored)}.items()}
    taken = {key for keys in chosen.values() for key in keys}
    standard = {spec.name: _plain(spec.keys) for spec in ACTIONS}
    left = {name: tuple(k for k in keys if k not in taken) for name, keys in standard.items()}
    return {name: chosen.get(name, keys) for name, keys in left.items()}


def use_preset(name: str) -> None:
    """Take the keys of a preset and forget those chosen by hand."""
    settings.remember(_PRESET, name)
    settings.remember(_OWN, "{}")
    watcher.changed.emit()


def change(name: str, keys: Keys) -> None:
    """Give an action other keys; whoever had one of them loses it."""
    chosen = own()
    taken = set(keys)
    for other, had in table().items():
        if other != name and taken & set(had):
            chosen[other] = tuple(k for k in had if k not in taken)
    chosen[name] = keys
    settings.remember(_OWN, json.dumps(chosen))
    watcher.changed.emit()


def restore(name: str) -> None:
    """Give an action back the keys of the preset.

    Whoever had taken them loses them; whoever had lost one to the action gets it back.
    """
    chosen, standard = own(), _of_preset(name)
    freed = set(chosen.pop(name, ())) - set(standard)
    for other, had in chosen.items():
        back = freed - set(had)
        chosen[other] = (*(k for k in _of_preset(other) if k in back), *had)
    chosen = {other: had for other, had in chosen.items() if had != _of_preset(other)}
    settings.remember(_OWN, json.dumps(chosen))
    if table()[name] != standard or any(len(holders(k, table())) > 1 for k in standard):
        change(name, standard)
    else:
        watcher.changed.emit()


def _of_preset(name: str) -> Keys:
    """Keys that the preset in use gives an action."""
    spec = next(spec for spec in ACTIONS if spec.name == name)
    return _plain(PRESETS[preset()].get(name, spec.keys))


def holders(key: str, keys: Mapping[str, Keys]) -> list[str]:
    """Names of the actions that have a key."""
    return [name for name, had in keys.items() if key in had]


def conflicts(keys: Mapping[str, Keys]) -> dict[str, list[str]]:
    """Keys that more than one action has, with these actions."""
    found: dict[str, list[str]] = defaultdict(list)
    for name, had in keys.items():
        for key in had:
            found[key].append(name)
    return {key: names for key, names in found.items() if len(names) > 1}


def _plain(keys: Keys) -> Keys:
    """Keys as Qt writes them, the same on every desktop."""
    return tuple(QKeySequence(key).toString() for key in keys)


def native(key: str) -> str:
    """A shortcut as this desktop writes it."""
    return QKeySequence(key).toString(QKeySequence.SequenceFormat.NativeText)


def first(name: str) -> str:
    """The key shown for an action, as this desktop writes it, or empty."""
    had = table().get(name, ())
    return native(had[0]) if had else ""


def way_to(name: str) -> str:
    """How an action is done: the key shown for it, else where it stands in the menus."""
    spec = next(spec for spec in ACTIONS if spec.name == name)
    return first(name) or " › ".join(map(tr, (*spec.menu.lstrip("|").split("/"), spec.text)))


def with_key(text: str, name: str) -> str:
    """A text, and the action's key in brackets where it has one."""
    key = first(name)
    return f"{text} ({key})" if key else text


class KeyTip(QObject):
    """Keeps a widget's tooltip, which names the key of an action, true when keys change.

    Parameters
    ----------
    widget : gets the tooltip, and the text as its accessible name
    text : what it does
    name : the action that does the same
    """

    def __init__(self, widget: QWidget, text: str, name: str) -> None:
        super().__init__(widget)
        self._widget, self._text, self._name = widget, text, name
        widget.setAccessibleName(text)
        watcher.changed.connect(self._tell)
        self._tell()

    def _tell(self) -> None:
        self._widget.setToolTip(with_key(self._text, self._name))
