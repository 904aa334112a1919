"""Lengths and times as files name them, in millimetres and seconds."""

from __future__ import annotations

USUAL = ("mm", "cm", "m", "in", "ft")
"""Names of units of length, to choose from."""

MILLIMETRES = {
    "mm": 1.0,
    "millimet": 1.0,
    "mill": 1.0,
    "cm": 10.0,
    "centimet": 10.0,
    "cent": 10.0,
    "dm": 100.0,
    "m": 1000.0,
    "met": 1000.0,
    "mete": 1000.0,
    "meter": 1000.0,
    "metre": 1000.0,
    "in": 25.4,
    "inch": 25.4,
    "inche": 25.4,
    "ft": 304.8,
    "feet": 304.8,
    "foot": 304.8,
}

SECONDS = {
    "s": 1.0,
    "sec": 1.0,
    "second": 1.0,
    "ms": 1e-3,
    "msec": 1e-3,
    "millisecond": 1e-3,
    "us": 1e-6,
    "µs": 1e-6,
    "usec": 1e-6,
    "microsecond": 1e-6,
    "ns": 1e-9,
    "nsec": 1e-9,
    "nanosecond": 1e-9,
}


def unit_mm(name: str) -> float | None:
    """Millimetres of a unit of length by its name, whole or cut short; None if unknown."""
    word = name.strip().lower().rstrip(".")
    for known in (word, word.rstrip("s"), word[:8]):
        if known in MILLIMETRES:
            return MILLIMETRES[known]
    return None


def unit_s(name: str) -> float | None:
    """Seconds of a unit of time by its name; None if unknown."""
    word = name.strip().lower().replace("μ", "µ")
    return SECONDS.get(word, SECONDS.get(word.rstrip("s")))
