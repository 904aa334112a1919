"""Smoothers: taking noise out of trajectories without inventing or crossing anything.

Importing this package registers every method in :data:`SMOOTHERS`.
"""

from markermend.smoothers import (  # noqa: F401, importing a module registers its method
    adaptive,
    bspline,
    butterworth,
    kalman,
    moving_average,
    rts,
    savgol,
    whittaker,
    woltring,
)
from markermend.smoothers.inspect import Inspection, inspect, percent_sm1
from markermend.smoothers.metrics import TOO_MUCH, percent_less, sm1, sm2
from markermend.smoothers.registry import SMOOTHERS, Signals, Smoother, find_smoother
from markermend.smoothers.run import Derivatives, derivatives, smooth

__all__ = [
    "SMOOTHERS",
    "TOO_MUCH",
    "Derivatives",
    "Inspection",
    "Signals",
    "Smoother",
    "derivatives",
    "find_smoother",
    "inspect",
    "percent_less",
    "percent_sm1",
    "sm1",
    "sm2",
    "smooth",
]
