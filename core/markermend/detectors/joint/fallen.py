"""Whether a marker that jumped sits at another place of its body for good."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray

LONGEST_S = 10.0
"""What is looked at before and after the jump."""
LEAST_MM, TIMES_SPREAD = 5.0, 2.0
AT_LEAST = 0.3
"""Share of the neighbours: those square to the jump keep their distance."""


def moved_on_body(
    signal: FloatArray,
    seen: BoolArray,
    neighbours: IntArray,
    marker: int,
    frame: int,
    rate: float,
) -> bool:
    """Whether the distances to the neighbours are lastingly different after a jump.

    Parameters
    ----------
    signal, seen : (frames, 3 × markers) mm without NaN, bool
    neighbours : (markers, k) columns of the nearest other markers
    marker : column of the one that jumped
    frame : first frame after the jump
    rate : frames per second

    Returns
    -------
    True when the median distance to three in ten neighbours changes by 5 mm and by twice
    the sum of its median absolute deviations before and after
    """
    reach = round(LONGEST_S * rate)
    rows = slice(max(0, frame - reach), frame + reach)
    x = signal[rows].reshape(len(signal[rows]), -1, 3)
    there = seen[rows, ::3]
    after = np.arange(len(x)) >= frame - rows.start
    changed = []
    for mate in neighbours[marker]:
        both = there[:, marker] & there[:, mate]
        apart = np.linalg.norm(x[:, marker] - x[:, mate], axis=1)
        old, new = apart[both & ~after], apart[both & after]
        if not len(old) or not len(new):
            continue
        middle = np.median(old), np.median(new)
        spread = np.median(np.abs(old - middle[0])) + np.median(np.abs(new - middle[1]))
        changed.append(abs(middle[1] - middle[0]) > LEAST_MM + TIMES_SPREAD * spread)
    return bool(changed) and bool(np.mean(changed) >= AT_LEAST)
