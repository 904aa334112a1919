"""A take's samples marker by marker, laid out on the worker that opens it.

In a take the samples of a frame lie side by side, so that who reads one marker goes through the
memory of all. Where memory is slow to come by, as in a virtual machine, that takes ten times as
long now and then, which the window's thread has no time for.
"""

from __future__ import annotations

import weakref

import numpy as np

from markermend.arrays import ByteArray, FloatArray
from markermend.take import Take

_BLOCK = 1024
"""Frames turned at a time: as many as stay in the processor's own memory."""
_laid: dict[int, tuple[FloatArray, ByteArray]] = {}
"""By the array of positions, which a take shares with what it is under other names."""


def lay_out(take: Take) -> None:
    """Keep a copy of a take marker by marker, as long as its samples are held by anything."""
    positions = np.empty((take.markers, 3, take.frames))
    origin = np.empty((take.markers, take.frames), dtype=np.uint8)
    for start in range(0, take.frames, _BLOCK):
        part = slice(start, start + _BLOCK)
        positions[:, :, part] = take.positions[part].transpose(1, 2, 0)
        origin[:, part] = take.origin[part].T
    positions.flags.writeable = origin.flags.writeable = False
    key = id(take.positions)
    _laid[key] = positions, origin
    weakref.finalize(take.positions, _laid.pop, key)


def column_of(take: Take, column: int) -> tuple[FloatArray, ByteArray]:
    """One marker of a take; not to be written to.

    Returns
    -------
    (frames, 3) float64 mm, NaN = missing, each axis without a break in memory; and (frames,) uint8,
    see :class:`markermend.take.Origin`
    """
    laid = _laid.get(id(take.positions))
    if laid is None:
        return np.asfortranarray(take.positions[:, column]), take.origin[:, column].copy()
    return laid[0][column].T, laid[1][column]
