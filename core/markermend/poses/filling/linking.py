"""Where a joint that was not seen must be, by what is fixed in the axes of the joints around it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.poses.channels import Channels, to_features
from markermend.poses.normal import FEATURES
from markermend.poses.quaternion import inverse, lengths_of, turn

# What strays by more than this is not fixed.
_FIXED_MM = 1.0
# What was seen in fewer frames is not known to be fixed; so many are looked at first.
_LEAST_FRAMES, _FEW = 10, 100
# Of what is allowed, a joint is expected to stray by at least so much.
_SELDOM_EXACT = 0.1


def linked_channels(
    channels: Channels, known: tuple[BoolArray, BoolArray], parents: Sequence[int]
) -> tuple[Channels, FloatArray]:
    """Let joints that rigid links tell be known.

    Parameters
    ----------
    channels : a recording in columns
    known : (frames, joints) bool each, positions and rotations that are known
    parents : index of each joint's parent, -1 for the root

    Returns
    -------
    the channels, and (frames, joints) expected errors in mm (root mean square) of what links tell,
    0 elsewhere
    """
    features, mm = to_features(channels.values, channels), channels.normal.scale
    limit = _FIXED_MM / mm
    places, error = linked(features[..., :3], features[..., 3:], *known, parents, limit)
    values = channels.values.reshape(len(features), -1, FEATURES).copy()
    sure = channels.known.reshape(values.shape).copy()
    joints, shape = list(channels.joints), channels.values.shape
    values[..., :3] = places[:, joints]
    sure[..., :3] |= ~np.isnan(error[:, joints, None])
    more = replace(channels, values=values.reshape(shape), known=sure.reshape(shape))
    return more, np.nan_to_num(error) * mm


def linked(
    positions: FloatArray,
    rotations: FloatArray,
    seen: BoolArray,
    turned: BoolArray,
    parents: Sequence[int],
    strays: float,
) -> tuple[FloatArray, FloatArray]:
    """Place joints that were not seen where rigid links to the joints around them say.

    Parameters
    ----------
    positions : (frames, joints, 3); anything where not seen
    rotations : (frames, joints, 4) in the same axes; anything where not known
    seen, turned : (frames, joints) bool, positions and rotations that are known
    parents : index of each joint's parent, -1 for the root
    strays : root mean square up to which a joint counts as fixed, in the unit of positions

    Returns
    -------
    (frames, joints, 3) positions and (frames, joints) expected errors (root mean square): 0 where a
    joint was seen, NaN where no link tells, whose positions are as they were

    Notes
    -----
    A joint is fixed in its parent's axes where a rotation is that of what hangs on it, as in BVH.
    Where it is that of the bone from the parent, as in ASF, the bone's end is fixed in its own
    axes, and the end that it comes from in those of the joint below. Each such link is tried where
    all of it was seen. Links that are all rigid there and do not agree in a gap were never put to
    the test, so none of them is followed.
    """
    out, error = positions.copy(), np.where(seen, 0.0, np.nan)
    for joint in np.flatnonzero(~seen.all(axis=0)).tolist():
        wanted = ~seen[:, joint]
        for base, axes in _around(joint, parents):
            there = seen[:, base] & turned[:, axes]
            whole, gap = np.flatnonzero(there & ~wanted), np.flatnonzero(there & wanted)
            if len(whole) < _LEAST_FRAMES or not len(gap):
                continue
            link = joint, base, axes
            # Most links are not rigid, and a few frames show it.
            few = whole[:: max(len(whole) // _FEW, 1)]
            if _place(positions, rotations, few, *link)[1] > 2.0 * strays:
                continue
            place, off = _place(positions, rotations, whole, *link)
            if off > strays:
                continue
            off = max(off, _SELDOM_EXACT * strays)
            told = positions[gap, base] + turn(rotations[gap, axes], place)
            apart = lengths_of(told - out[gap, joint])
            first = np.isnan(error[gap, joint])
            out[gap[first], joint] = told[first]
            error[gap, joint] = np.where(first, off, np.hypot(error[gap, joint], apart))
        vague = np.flatnonzero(error[:, joint] > 2.0 * strays)
        out[vague, joint], error[vague, joint] = positions[vague, joint], np.nan
    return out, error


def _place(
    positions: FloatArray, rotations: FloatArray, frames: IntArray, joint: int, base: int, axes: int
) -> tuple[FloatArray, float]:
    """(3,) where a joint is on average, from another in some joint's axes, and how it strays."""
    away = positions[frames, joint] - positions[frames, base]
    places = turn(inverse(rotations[frames, axes]), away)
    place = places.mean(axis=0)
    return place, float(np.sqrt(np.mean(lengths_of(places - place) ** 2)))


def _around(joint: int, parents: Sequence[int]) -> Iterator[tuple[int, int]]:
    """Joints that one may be fixed to, and those whose axes tell how."""
    parent = parents[joint]
    if parent >= 0:
        yield parent, parent
        yield parent, joint
    for child, above in enumerate(parents):
        if above == joint:
            yield child, child
            yield child, joint
