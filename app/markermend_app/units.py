"""Lengths as the window writes them: millimetres, centimetres or metres.

The engine counts in millimetres; what is written here is for people's eyes only.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType

from markermend_app import settings

SETTING = "unit"
FACTORS: Mapping[str, float] = MappingProxyType({"mm": 1.0, "cm": 0.1, "m": 0.001})
_TOLD_MM = re.compile(r"(?<![\w.+-])(\d+(?:\.(\d+))?) mm\b(?!/)")
_MORE_PLACES = MappingProxyType({"mm": 0, "cm": 1, "m": 3})


def unit() -> str:
    """The unit of length in use."""
    name = settings.text(SETTING, "mm")
    return name if name in FACTORS else "mm"


def length(mm: float, places: int = 1) -> str:
    """A length with its unit; ``places`` are the decimals it would have in millimetres."""
    return f"{number(mm, places)} {unit()}"


def error(mm: float) -> str:
    """An expected error with its unit; one that would be rounded to nothing is told as a limit."""
    name = unit()
    places = 1 + _MORE_PLACES[name]
    limit = 0.5 * 10.0**-places
    return f"< {limit:.{places + 1}f} {name}" if mm * FACTORS[name] < limit else length(mm)


def give_or_take(mm: float) -> str:
    """An expected error as what stands behind a value or a method."""
    told = error(mm)
    return told if told.startswith("<") else f"± {told}"


def in_words(text: str) -> str:
    """A sentence that tells millimetres, with the unit in use."""
    if unit() == "mm":
        return text
    return _TOLD_MM.sub(lambda told: length(float(told[1]), len(told[2] or "")), text)


def number(mm: float, places: int = 1) -> str:
    """A length without its unit."""
    name = unit()
    return f"{mm * FACTORS[name]:.{places + _MORE_PLACES[name]}f}"


def scaled(text: str) -> tuple[str, float, int]:
    """A unit that may hold millimetres as it is written now.

    Parameters
    ----------
    text : ``mm``, ``mm/s``, ``mm/s²``, or another that stays as it is

    Returns
    -------
    Its text, what values in it are multiplied by, and how many more decimals they have
    """
    if text != "mm" and not text.startswith("mm/"):
        return text, 1.0, 0
    name = unit()
    return name + text[2:], FACTORS[name], _MORE_PLACES[name]
