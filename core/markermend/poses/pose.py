"""One skeleton recording: the container that everything about poses takes and returns."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.errors import DataError


@dataclass(frozen=True, eq=False)
class Pose:
    """A recording of joints, immutable.

    Attributes
    ----------
    positions : (frames, joints, 3) float64, mm, global, read-only; NaN where the joint was not seen
    rotations : (frames, joints, 4) float64 unit quaternions x, y, z, w, global, read-only; NaN
        where the joint was not seen. Of a joint whose child was not seen, the rotation is not to
        be trusted (see :attr:`turned`).
    joints : one name each, unique
    parents : index of each joint's parent, -1 for a root
    rate : poses per second
    confidence : (frames, joints) float64 in [0, 1], 0 where the joint was not seen; worked out
        from the positions when not given
    source : the skeleton and movement that were read, where the format has more than joints
    warnings : one sentence for each oddity met while reading
    first_frame : the file's number of pose 0
    first_time : seconds at pose 0, by the file

    Raises
    ------
    DataError
        when shapes, names, parents or rate do not fit together
    """

    positions: FloatArray
    rotations: FloatArray
    joints: tuple[str, ...]
    parents: tuple[int, ...]
    rate: float
    confidence: FloatArray = field(default_factory=lambda: np.empty((0, 0)))
    source: object | None = None
    warnings: tuple[str, ...] = ()
    first_frame: int = 0
    first_time: float = 0.0

    def __post_init__(self) -> None:
        positions = np.array(self.positions, dtype=np.float64)
        rotations = np.array(self.rotations, dtype=np.float64)
        if positions.ndim != 3 or positions.shape[2] != 3:
            raise DataError(f"Positions must be (frames, joints, 3), not {positions.shape}.")
        if rotations.shape != (*positions.shape[:2], 4):
            raise DataError(
                f"Rotations must be {(*positions.shape[:2], 4)} quaternions, not {rotations.shape}."
            )
        if len(self.joints) != positions.shape[1] or len(set(self.joints)) != len(self.joints):
            raise DataError("Every joint needs one name of its own.")
        if not (np.isfinite(self.rate) and self.rate > 0):
            raise DataError(f"The rate must be positive, not {self.rate}.")
        finite = np.asarray(np.isfinite(positions).all(axis=2))
        confidence = np.array(self.confidence, dtype=np.float64)
        if confidence.size == 0:
            confidence = finite.astype(np.float64)
        if confidence.shape != positions.shape[:2]:
            raise DataError(f"Confidence must be {positions.shape[:2]}, not {confidence.shape}.")
        confidence = np.where(finite, np.clip(np.nan_to_num(confidence), 0.0, 1.0), 0.0)
        unseen = confidence == 0
        positions[unseen] = np.nan
        length = np.sqrt(np.sum(rotations**2, axis=2, keepdims=True))
        with np.errstate(invalid="ignore", divide="ignore"):
            rotations = np.where(length > 0, rotations / length, np.nan)
        rotations[unseen] = np.nan
        for array in (positions, rotations, confidence):
            array.flags.writeable = False
        object.__setattr__(self, "positions", positions)
        object.__setattr__(self, "rotations", rotations)
        object.__setattr__(self, "confidence", confidence)
        object.__setattr__(self, "parents", tuple(int(p) for p in self.parents))
        object.__setattr__(self, "order", parents_first(self.parents, self.joints))

    order: tuple[int, ...] = field(init=False, repr=False)

    @property
    def frames(self) -> int:
        """Number of poses."""
        return int(self.positions.shape[0])

    @cached_property
    def seen(self) -> BoolArray:
        """(frames, joints) bool: the joint was seen."""
        return self.confidence > 0

    @cached_property
    def turned(self) -> BoolArray:
        """(frames, joints) bool: the joint's rotation can be trusted.

        Where a child was not seen, a sensor cannot know how its parent is turned.
        """
        known = ~np.isnan(self.rotations[:, :, 3])
        for joint, parent in enumerate(self.parents):
            if parent >= 0:
                known[:, parent] &= self.seen[:, joint]
        return known

    def index(self, joint: str) -> int:
        """Column of a joint.

        Raises
        ------
        DataError
            when there is none of that name
        """
        try:
            return self.joints.index(joint)
        except ValueError:
            raise DataError(f"The recording has no joint called “{joint}”.") from None

    def hanging_on(self, joint: int) -> tuple[int, ...]:
        """Columns of a joint and of all that hangs on it, parents first."""
        held = [joint]
        for below in self.order:
            if self.parents[below] in held:
                held.append(below)
        return tuple(held)

    def with_samples(
        self, positions: FloatArray, rotations: FloatArray, confidence: FloatArray | None = None
    ) -> Pose:
        """Return the same recording with other samples; confidence is worked out when not given."""
        given = np.empty((0, 0)) if confidence is None else confidence
        return replace(self, positions=positions, rotations=rotations, confidence=given)


def parents_first(parents: tuple[int, ...], joints: tuple[str, ...]) -> tuple[int, ...]:
    """Order of the joints in which every parent comes before its children.

    Raises
    ------
    DataError
        when a parent does not exist, or joints are each other's ancestors
    """
    if len(parents) != len(joints):
        raise DataError(f"There are {len(joints)} joints but {len(parents)} parents.")
    order: list[int] = []
    placed: set[int] = {-1}
    waiting = list(range(len(joints)))
    while waiting:
        ready = [joint for joint in waiting if parents[joint] in placed]
        if not ready:
            names = ", ".join(joints[joint] for joint in waiting[:5])
            raise DataError(f"No root can be reached from {names}; check the parents.")
        order += ready
        placed.update(ready)
        waiting = [joint for joint in waiting if joint not in placed]
    return tuple(order)
