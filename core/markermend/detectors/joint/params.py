"""Tunables of the joint detector."""

from __future__ import annotations

from dataclasses import dataclass

from markermend.parameters import check_ranges, tunable


@dataclass(frozen=True)
class JointParams:
    """Parameters of the joint detector.

    Raises
    ------
    MethodError
        when a value lies outside the range its field names
    """

    sensitivity: float = tunable(
        0.5, "Flag what is at least 1 − this sure; higher finds more and errs more", "", 0.0, 1.0
    )
    slow: bool = tunable(True, "Look for slow changes too, which takes most of the time")
    least_mm: float = tunable(0.5, "Leave out sudden changes smaller than this", "mm")
    peak_ms: float = tunable(50.0, "Longest single peak; longer blocks are steps", "ms", 1.0, 500)

    jobs: int = tunable(-1, "Processes for slow changes; -1 as many as there are cores", "", -1)

    def __post_init__(self) -> None:
        check_ranges(self)
