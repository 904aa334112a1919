"""One list of smoothing methods, from which forms, command line and docs are generated.

A method is a frozen dataclass of parameters and a pure function that sees the trajectories as
:class:`Signals` and returns new values of the same shape, NaN where they were.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray, runs
from markermend.plugins.discover import SMOOTHERS as PLUGINS
from markermend.plugins.guards import guard_smoother
from markermend.registry import Registry


@dataclass(frozen=True, eq=False)
class Signals:
    """Trajectories to be smoothed.

    Attributes
    ----------
    values : (frames, markers, 3) float64, mm; NaN where the marker was not seen
    rate : frames per second
    measured : (frames, markers) bool; false where missing, filled or edited
    event_frames : frames near which a movement may change at once (foot strikes…)
    """

    values: FloatArray
    rate: float
    measured: BoolArray
    event_frames: IntArray

    @classmethod
    def of(cls, values: FloatArray, rate: float) -> Signals:
        """Signals without events, every sample that is present measured.

        Parameters
        ----------
        values : (frames, markers, 3) float64, mm; NaN where missing
        rate : frames per second
        """
        return cls(values, rate, ~np.isnan(values[:, :, 0]), np.zeros(0, dtype=np.int64))

    def stretches(self) -> Iterator[tuple[slice, IntArray]]:
        """Frames without a gap, each with the markers that are seen in exactly those."""
        together: dict[tuple[int, int], list[int]] = defaultdict(list)
        for marker, seen in enumerate(~np.isnan(self.values[:, :, 0]).T):
            for start, stop in runs(seen):
                together[int(start), int(stop)].append(marker)
        for (start, stop), markers in together.items():
            yield slice(start, stop), np.array(markers, dtype=np.int64)

    def each_stretch(self, smooth: Callable[[FloatArray], FloatArray], least: int) -> FloatArray:
        """Smooth every stretch on its own, so that nothing crosses a gap.

        Parameters
        ----------
        smooth : ``(n, channels) -> (n, channels)``, without NaN
        least : shorter stretches, in frames, are left as they are

        Returns
        -------
        (frames, markers, 3) float64, mm; NaN where the input is
        """
        result = self.values.copy()
        for frames, markers in self.stretches():
            n = frames.stop - frames.start
            if n >= least:
                part = self.values[frames, markers].reshape(n, -1)
                result[frames, markers] = smooth(part).reshape(n, -1, 3)
        return result


SmootherFunction = Callable[[Signals, Any], FloatArray]


@dataclass(frozen=True)
class Smoother:
    """A registered smoothing method.

    Attributes
    ----------
    name : short name for command line and files
    label : name for people
    summary : one sentence on what it does and when it is right
    params : frozen dataclass; each field's metadata may give ``unit``, ``min``, ``max``, ``help``
    run : ``(signals, params) -> (frames, markers, 3)``
    source : paper and equation, or empty
    plugin : the package that brings it, empty for ours
    """

    name: str
    label: str
    summary: str
    params: type
    run: SmootherFunction
    source: str = ""
    plugin: str = ""


SMOOTHERS = Registry("smoother", Smoother, PLUGINS, guard_smoother)
"""Every smoothing method by name."""


def register(
    name: str, *, label: str, summary: str, params: type, source: str = ""
) -> Callable[[SmootherFunction], SmootherFunction]:
    """Add a method to :data:`SMOOTHERS`; used as a decorator.

    Parameters
    ----------
    name, label, summary, params, source : of the :class:`Smoother`, whose ``run`` is the function
        below the decorator
    """

    def add(run: SmootherFunction) -> SmootherFunction:
        SMOOTHERS.add(Smoother(name, label, summary, params, run, source))
        return run

    return add


def find_smoother(name: str) -> Smoother:
    """Look a method up.

    Raises
    ------
    MethodError
        when there is none of that name; the message lists those there are
    """
    return SMOOTHERS.find(name)
