"""A skeleton of rigid segments, and where its movement puts them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from markermend.arrays import FloatArray
from markermend.poses.pose import Pose

ROOT = "root"
TURNS = ("rx", "ry", "rz")
"""Degrees of freedom that are angles."""


@dataclass(frozen=True)
class Segment:
    """One rigid segment, from its parent's end to its own.

    Attributes
    ----------
    name : unique; :data:`ROOT` for the root, which has no length
    parent : index in the skeleton, -1 for the root
    direction : unit vector at rest, global axes
    length : in the file's own unit
    axis : rotations in degrees from the global axes to those the movement turns about
    axis_order : the order of these rotations, first applied first, such as ``"xyz"``
    dofs : degrees of freedom in the order the movement file lists them, rotations applied in
        that order: of rx, ry, rz, tx, ty, tz, l
    """

    name: str
    parent: int
    direction: tuple[float, float, float]
    length: float
    axis: tuple[float, float, float] = (0.0, 0.0, 0.0)
    axis_order: str = "xyz"
    dofs: tuple[str, ...] = ()


@dataclass(frozen=True)
class Skeleton:
    """Segments, parents before children.

    Attributes
    ----------
    segments : the root first
    scale_mm : millimetres per unit of length
    degrees : the angles of the skeleton file and, unless it says otherwise, of its movements
    position : of the root at rest, in units of length
    file : that it was read from
    """

    segments: tuple[Segment, ...]
    scale_mm: float
    degrees: bool = True
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    file: Path | None = field(default=None, compare=False)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the segments."""
        return tuple(segment.name for segment in self.segments)


@dataclass(frozen=True, eq=False)
class Movement:
    """What was read: a skeleton, and how it moves.

    Attributes
    ----------
    skeleton : the segments
    channels : segment's name to (frames, dofs) float64 in the order of its ``dofs``: degrees, and
        the file's units of length; NaN in frames that leave the segment out. A segment that is
        not here stays as at rest.
    frames : number of poses
    file : that it was read from
    first : number of the first pose
    before, after : poses of the file that come before and after these, which are a part of it
    """

    skeleton: Skeleton
    channels: Mapping[str, FloatArray]
    frames: int
    file: Path | None = None
    first: int = 1
    before: int = 0
    after: int = 0

    def part(self, start: int, stop: int) -> Movement:
        """The movement in an interval of poses, half-open."""
        return replace(
            self,
            channels={name: values[start:stop] for name, values in self.channels.items()},
            frames=stop - start,
            first=self.first + start,
            before=self.before + start,
            after=self.after + self.frames - stop,
        )


def forward_kinematics(movement: Movement, rate: float, *, warnings: tuple[str, ...] = ()) -> Pose:
    """Put every segment where its movement has it.

    Parameters
    ----------
    movement : skeleton and channels; a segment whose channels are NaN, and all that hangs on it,
        is unseen in that frame
    rate : poses per second
    warnings : kept with the result

    Returns
    -------
    Pose
        one joint per segment: its end, in mm, and its global rotation

    Notes
    -----
    goncalves2024, 3.1: M = M_parent C R C⁻¹, end = parent's end + M (direction length). Bones
    keep their length to the last digits that a position has.
    """
    skeleton, frames = movement.skeleton, movement.frames
    count = len(skeleton.segments)
    positions = np.zeros((frames, count, 3))
    rotations = np.empty((frames, count, 4))
    seen = np.ones((frames, count))
    turned: list[Rotation] = []
    for i, segment in enumerate(skeleton.segments):
        values = movement.channels.get(segment.name)
        if values is None:
            values = np.zeros((frames, len(segment.dofs)))
        absent = np.asarray(np.isnan(values).any(axis=1))
        values = np.where(absent[:, None], 0.0, values)
        frame = Rotation.from_euler(segment.axis_order, segment.axis, degrees=True)
        local = frame * local_rotation(segment, values) * frame.inv()
        offset = _shift(segment, values, skeleton)
        if segment.parent >= 0:
            above = turned[segment.parent]
            end = positions[:, segment.parent] + above.apply(offset)
            local = above * local
            absent = absent | (seen[:, segment.parent] == 0)
        else:
            end = offset
        bone = np.asarray(segment.direction) * segment.length * skeleton.scale_mm
        stretch = _channel(segment, values, "l") * skeleton.scale_mm
        along = bone + stretch[:, None] * np.asarray(segment.direction)
        positions[:, i] = end + local.apply(along)
        rotations[:, i] = local.as_quat()
        seen[absent, i] = 0
        turned.append(local)
    parents = tuple(segment.parent for segment in skeleton.segments)
    return Pose(
        positions,
        rotations,
        skeleton.names,
        parents,
        rate,
        seen,
        movement,
        warnings=warnings,
        first_frame=movement.first,
    )


def local_rotation(segment: Segment, values: FloatArray) -> Rotation:
    """Rotations about the segment's own axes, the first listed applied first.

    Parameters
    ----------
    segment : whose ``dofs`` say what the columns are
    values : (frames, dofs) degrees where rotations
    """
    columns = [i for i, dof in enumerate(segment.dofs) if dof in TURNS]
    if not columns:
        return Rotation.identity(len(values))
    order = "".join(segment.dofs[i][1] for i in columns)
    return Rotation.from_euler(order, values[:, columns], degrees=True)


def _shift(segment: Segment, values: FloatArray, skeleton: Skeleton) -> FloatArray:
    """(frames, 3) mm by which a segment starts from its parent's end."""
    shift = np.stack([_channel(segment, values, dof) for dof in ("tx", "ty", "tz")], axis=1)
    if segment.parent < 0:
        shift += np.asarray(skeleton.position)
    return np.asarray(shift * skeleton.scale_mm)


def _channel(segment: Segment, values: FloatArray, dof: str) -> FloatArray:
    """(frames,) one degree of freedom, 0 where the segment has it not."""
    if dof not in segment.dofs:
        return np.zeros(len(values))
    return np.asarray(values[:, segment.dofs.index(dof)])
