"""Import pyqtgraph without having all of Qt made at once.

PySide6 makes each of Qt's thousand classes when it is first asked for. pyqtgraph copies every name
of three modules when it is imported, and has all of them made: a tenth of the time until the first
picture of a take.
"""

from __future__ import annotations

import importlib
import sys
from types import ModuleType
from typing import Any

_MODULES = ("QtCore", "QtGui", "QtWidgets")


class _Lent(ModuleType):
    """A module of pyqtgraph's that finds names in one of PySide6's, once each."""

    def __init__(self, name: str, lender: ModuleType) -> None:
        super().__init__(name, lender.__doc__)
        self._lender = lender

    def __getattr__(self, name: str) -> Any:
        value = getattr(self._lender, name)
        setattr(self, name, value)
        return value

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *dir(self._lender)})


def import_pyqtgraph() -> None:
    """Import it, unless that was done before; afterwards it is like any other module."""
    if "pyqtgraph" in sys.modules:
        return
    lenders = [importlib.import_module(f"PySide6.{name}") for name in _MODULES]
    listing = [vars(lender).get("__dir__") for lender in lenders]
    for name, lender in zip(_MODULES, lenders, strict=True):
        sys.modules[f"pyqtgraph.Qt.{name}"] = _Lent(f"pyqtgraph.Qt.{name}", lender)
        vars(lender)["__dir__"] = list
    try:
        importlib.import_module("pyqtgraph")
    finally:
        for lender, before in zip(lenders, listing, strict=True):
            if before is None:
                del vars(lender)["__dir__"]
            else:
                vars(lender)["__dir__"] = before
