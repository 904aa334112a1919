"""Tunables of the joint detector."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import Any

from markermend.errors import MethodError


def _tunable(default: Any, help: str, unit: str = "", low: float = 0, high: float = 1e6) -> Any:
    """Make a field with the metadata that forms and the command line are made from."""
    return field(default=default, metadata={"help": help, "unit": unit, "min": low, "max": high})


@dataclass(frozen=True)
class JointParams:
    """Parameters of the joint detector.

    Raises
    ------
    MethodError
        when a value lies outside the range its field names
    """

    sensitivity: float = _tunable(
        0.5, "Flag what is at least 1 − this sure; higher finds more and errs more", "", 0.0, 1.0
    )
    slow: bool = _tunable(True, "Look for slow changes too, which takes most of the time")
    least_mm: float = _tunable(0.5, "Leave out sudden changes smaller than this", "mm")
    peak_ms: float = _tunable(50.0, "Longest single peak; longer blocks are steps", "ms", 1.0, 500)

    jobs: int = _tunable(-1, "Processes for slow changes; -1 as many as there are cores", "", -1)

    def __post_init__(self) -> None:
        for f in fields(self):
            value, low, high = getattr(self, f.name), f.metadata["min"], f.metadata["max"]
            if not low <= value <= high:
                raise MethodError(
                    f"Parameter {f.name} must lie between {low:g} and {high:g}, not {value}."
                )
