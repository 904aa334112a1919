"""Turn the segments of a skeleton until its joints are where they should be."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.poses.quaternion import cross
from markermend.poses.skeleton import TURNS, Segment, Skeleton

SHIFTS = ("tx", "ty", "tz")
"""Degrees of freedom that are places."""
TURN_MM = 1.0
"""A turn one radian from where it begins counts as much as a joint this far off; so does a root a
millimetre from where it begins."""
PASSES, SETTLED, NOTHING_MM2 = 40, 1e-2, 1e-12
"""Passes at most; a frame is done when one makes it better by less than that share, or when no more
than that is left of its squared error."""
FIRST_DAMPING, MOST_DAMPING = 1e-4, 1e4
FARTHEST = 0.5
"""No pass turns about an axis by more radians: slopes do not tell how ends move farther on."""


def reach(
    skeleton: Skeleton,
    channels: Mapping[str, FloatArray],
    places: FloatArray,
    free: BoolArray,
    *,
    held: Collection[tuple[str, int]] = (),
) -> dict[str, FloatArray]:
    """Find channels that put joints as near to their places as the skeleton allows.

    Parameters
    ----------
    skeleton : rigid segments
    channels : segment's name to (frames, dofs) to begin with, as of a movement, and to stay with as
        far as places leave that open; NaN where a segment is not seen
    places : (frames, segments, 3) mm, where their ends should be; NaN where that is not known
    free : (frames, segments) bool, those whose channels may change
    held : names and columns of channels that may not, whatever is free

    Returns
    -------
    The channels. Lengths, and shifts of segments that hang on others, stay.

    Notes
    -----
    Least squares, each frame by itself, damped by shares of the diagonal (Levenberg 1944,
    Marquardt 1963).
    """
    limbs = _Limbs.of(skeleton, channels)
    places = np.where(_absent(skeleton, channels)[:, :, None], np.nan, places)
    fixed = ~free[:, limbs.segment] | np.isnan(limbs.start)
    fixed |= [(name, column) in held for name, column, _ in limbs.columns]
    values = _settled(limbs, places, fixed)
    found = {name: np.array(given) for name, given in channels.items()}
    for n, (name, column, unit) in enumerate(limbs.columns):
        rows = ~fixed[:, n]
        found[name][rows, column] = values[rows, n] / unit
    return found


def _absent(skeleton: Skeleton, channels: Mapping[str, FloatArray]) -> BoolArray:
    """(frames, segments) that are not seen, or hang on one that is not."""
    frames = len(next(iter(channels.values())))
    absent = np.zeros((frames, len(skeleton.segments)), dtype=bool)
    for i, segment in enumerate(skeleton.segments):
        if segment.name in channels:
            absent[:, i] = np.isnan(channels[segment.name]).any(axis=1)
        if segment.parent >= 0:
            absent[:, i] |= absent[:, segment.parent]
    return absent


@dataclass(frozen=True, eq=False)
class _Limbs:
    """A skeleton taken apart into the degrees of freedom that are looked for.

    Attributes
    ----------
    skeleton : the segments
    columns : of each degree of freedom its segment's name, its channel, and its unit in rad or mm
    segment : (n,) that it moves
    below : (n, segments) bool, what moves with it
    start : (frames, n) radians and mm, to begin with
    frame : (segments, 3, 3) from the axes that a segment turns about to those at rest
    offset : (frames, segments, 3) mm, where it begins, from its parent's end in its parent's axes
    bone : (frames, segments, 3) mm, from there to its end in its own axes
    turns : (n,) bool, what is an angle
    """

    skeleton: Skeleton
    columns: tuple[tuple[str, int, float], ...]
    segment: IntArray
    below: BoolArray
    start: FloatArray
    frame: FloatArray
    offset: FloatArray
    bone: FloatArray
    turns: BoolArray

    @classmethod
    def of(cls, skeleton: Skeleton, channels: Mapping[str, FloatArray]) -> _Limbs:
        """Those of segments with channels: their angles, and where the root is."""
        segments, scale = skeleton.segments, skeleton.scale_mm
        frames = len(next(iter(channels.values())))
        below = np.eye(len(segments), dtype=bool)
        for i in range(len(segments) - 1, 0, -1):
            below[segments[i].parent] |= below[i]
        offset, bone = (np.zeros((frames, len(segments), 3)) for _ in range(2))
        columns, turns = [], list[bool]()
        segment, start = list[int](), list[FloatArray]()
        for i, one in enumerate(segments):
            there = one.name in channels
            values = channels[one.name] if there else np.zeros((frames, len(one.dofs)))
            length = np.full(frames, one.length)
            if one.parent < 0:
                offset[:, i] = skeleton.position
            for k, dof in enumerate(one.dofs):
                given = np.nan_to_num(values[:, k])
                if there and (dof in TURNS or (dof in SHIFTS and one.parent < 0)):
                    unit = np.pi / 180 if dof in TURNS else scale
                    columns.append((one.name, k, unit))
                    turns.append(dof in TURNS)
                    segment.append(i)
                    start.append(values[:, k] * unit)
                elif dof in SHIFTS:
                    offset[:, i, SHIFTS.index(dof)] += given
                else:
                    length = length + given
            bone[:, i] = length[:, None] * np.asarray(one.direction)
        return cls(
            skeleton,
            tuple(columns),
            np.array(segment, dtype=np.int64),
            below[segment],
            np.stack(start, axis=1),
            np.stack([axes_of(one).as_matrix() for one in segments]),
            scale * offset,
            scale * bone,
            np.array(turns, dtype=bool),
        )


def axes_of(segment: Segment) -> Rotation:
    """From the axes that a segment turns about to the global ones at rest."""
    return Rotation.from_euler(segment.axis_order, segment.axis, degrees=True)


@dataclass(frozen=True, eq=False)
class _Placed:
    """Where values put the segments.

    Attributes
    ----------
    begins, ends : (frames, segments, 3) mm
    axes : (frames, n, 3) what each degree of freedom turns about, or shifts along
    """

    begins: FloatArray
    ends: FloatArray
    axes: FloatArray


def _settled(limbs: _Limbs, places: FloatArray, fixed: BoolArray) -> FloatArray:
    """Values that leave the least error, (frames, n)."""
    start = np.nan_to_num(limbs.start)
    values = start.copy()
    left = _away(_placed(limbs, start, np.arange(len(start))), places)
    cost = (left**2).sum(axis=1)
    damping = np.full(len(values), FIRST_DAMPING)
    rows = np.flatnonzero(cost > NOTHING_MM2)
    for _ in range(PASSES):
        if not len(rows):
            break
        slope = _slope(limbs, _placed(limbs, values[rows], rows), places[rows])
        slope[fixed[rows]] = 0.0
        gram = slope @ slope.swapaxes(1, 2)
        diagonal = np.einsum("fnn->fn", gram)
        diagonal += damping[rows, None] * diagonal + TURN_MM**2
        pull = (slope @ left[rows, :, None])[:, :, 0] - TURN_MM**2 * (values - start)[rows]
        step = np.linalg.solve(gram, pull[:, :, None])[:, :, 0]
        step = np.where(limbs.turns, np.clip(step, -FARTHEST, FARTHEST), step)
        tried = values[rows] + step
        # The same turn without what went round.
        rounds = np.round((tried - start[rows]) / (2 * np.pi))
        tried -= np.where(limbs.turns, 2 * np.pi * rounds, 0.0)
        error = _away(_placed(limbs, tried, rows), places[rows])
        now = (error**2).sum(axis=1) + TURN_MM**2 * ((tried - start[rows]) ** 2).sum(axis=1)
        before = cost[rows]
        better = now < before
        won = rows[better]
        values[won], left[won], cost[won] = tried[better], error[better], now[better]
        damping[rows] *= np.where(better, 0.1, 10.0)
        done = better & ((before - now < SETTLED * before) | (now < NOTHING_MM2))
        rows = rows[~done & (damping[rows] < MOST_DAMPING)]
    return values


def _placed(limbs: _Limbs, values: FloatArray, rows: IntArray) -> _Placed:
    """Forward kinematics of some frames, with the axes of every degree of freedom."""
    segments, frames = limbs.skeleton.segments, len(values)
    begins, ends = (np.empty((frames, len(segments), 3)) for _ in range(2))
    turned = np.empty((frames, len(segments), 3, 3))
    axes = np.empty((frames, len(limbs.columns), 3))
    for i, segment in enumerate(segments):
        if segment.parent >= 0:
            above, begin = turned[:, segment.parent], ends[:, segment.parent]
        else:
            above, begin = np.broadcast_to(np.eye(3), (frames, 3, 3)), np.zeros((frames, 3))
        begin = begin + _turn(above, limbs.offset[rows, i])
        own = above @ limbs.frame[i]
        # The turn listed last is made last, about axes that the others do not move.
        for n in np.flatnonzero(limbs.segment == i)[::-1]:
            dof = segment.dofs[limbs.columns[n][1]]
            if dof in SHIFTS:
                axes[:, n] = np.eye(3)[SHIFTS.index(dof)]
                begin = begin + values[:, n, None] * axes[:, n]
            else:
                axes[:, n] = own[:, :, TURNS.index(dof)]
                own = own @ _about(TURNS.index(dof), values[:, n])
        turned[:, i] = own @ limbs.frame[i].T
        begins[:, i] = begin
        ends[:, i] = begin + _turn(turned[:, i], limbs.bone[rows, i])
    return _Placed(begins, ends, axes)


def _turn(turned: FloatArray, vectors: FloatArray) -> FloatArray:
    """Vectors (frames, 3), each turned."""
    return np.asarray((turned @ vectors[:, :, None])[:, :, 0])


def _about(axis: int, angles: FloatArray) -> FloatArray:
    """(frames, 3, 3) turns about x, y or z."""
    matrix = np.zeros((len(angles), 3, 3))
    b, c = (axis + 1) % 3, (axis + 2) % 3
    matrix[:, axis, axis] = 1.0
    matrix[:, b, b] = matrix[:, c, c] = np.cos(angles)
    matrix[:, c, b] = np.sin(angles)
    matrix[:, b, c] = -matrix[:, c, b]
    return matrix


def _away(placed: _Placed, places: FloatArray) -> FloatArray:
    """(frames, 3 segments) mm, how far ends are off; 0 where their places are not known."""
    return np.nan_to_num(places - placed.ends).reshape(len(places), -1)


def _slope(limbs: _Limbs, placed: _Placed, places: FloatArray) -> FloatArray:
    """(frames, n, 3 segments) how ends whose places are known move with each degree of freedom."""
    slope = np.zeros((len(places), len(limbs.columns), *places.shape[1:]))
    for n, (_, column, _) in enumerate(limbs.columns):
        segment = limbs.segment[n]
        moved, axis = np.flatnonzero(limbs.below[n]), placed.axes[:, n, None]
        if limbs.skeleton.segments[segment].dofs[column] in SHIFTS:
            slope[:, n, moved] = axis
        else:
            slope[:, n, moved] = cross(
                axis, placed.ends[:, moved] - placed.begins[:, segment, None]
            )
    slope *= ~np.isnan(places[:, None])
    return slope.reshape(len(places), len(limbs.columns), -1)
