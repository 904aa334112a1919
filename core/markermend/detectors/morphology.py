"""Mathematical morphology of one-dimensional signals, along frames.

Equations 13 to 17 of skurowski2022. Its (13) and (14) are swapped in print: erosion is the
minimum and dilation the maximum, otherwise the top-hat (17) could never be positive.
Structuring elements are flat, centred and of odd length; beyond the ends the outermost sample
is repeated. Binary signals are booleans, for which minimum and maximum are "all" and "any".
"""

from __future__ import annotations

from typing import Any, TypeVar, cast

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter1d, minimum_filter1d

Signal = TypeVar("Signal", bound=NDArray[Any])


def erode(signal: Signal, size: int) -> Signal:
    """Smallest value within ``size`` frames (skurowski2022, eq. 13, read as the minimum).

    Parameters
    ----------
    signal : (frames, ...) float without NaN, or bool
    size : odd number of frames
    """
    return cast(Signal, _filter(minimum_filter1d, signal, size))


def dilate(signal: Signal, size: int) -> Signal:
    """Largest value within ``size`` frames (skurowski2022, eq. 14, read as the maximum)."""
    return cast(Signal, _filter(maximum_filter1d, signal, size))


def opening(signal: Signal, size: int) -> Signal:
    """Remove hills narrower than ``size`` frames (skurowski2022, eq. 15); never above the input."""
    return dilate(erode(signal, size), size)


def closing(signal: Signal, size: int) -> Signal:
    """Fill valleys narrower than ``size`` frames (skurowski2022, eq. 16); never below the input."""
    return erode(dilate(signal, size), size)


def top_hat(signal: Signal, size: int) -> Signal:
    """Keep only hills narrower than ``size`` frames (skurowski2022, eq. 17); never negative."""
    opened = opening(signal, size)
    kept = signal & ~opened if signal.dtype == np.bool_ else signal - opened
    return cast(Signal, kept)


def _filter(extreme: Any, signal: Any, size: int) -> Any:
    """Run a moving extreme; SciPy's works on numbers, so booleans travel as bytes."""
    if size % 2 == 0:
        raise ValueError(f"A structuring element has an odd number of frames, not {size}.")
    if signal.dtype == np.bool_:
        return extreme(signal.view(np.uint8), size, axis=0, mode="nearest").view(np.bool_)
    return extreme(signal, size, axis=0, mode="nearest")
