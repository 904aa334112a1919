"""Which way a body faces that no rotation tells of: by where its sides and its spine are."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from markermend.arrays import FloatArray
from markermend.poses.nuitrack import side_of, twins
from markermend.poses.pose import Pose
from markermend.poses.quaternion import cross, lengths_of

# Directions of spine and sides this near to each other, as a sine, tell no third one.
_APART = 0.1


@dataclass(frozen=True)
class Sides:
    """Joints that hang on a root, which tell how it is turned.

    Attributes
    ----------
    root : index of it
    left, right : indices of each other's counterparts
    middle : of those without one
    """

    root: int
    left: tuple[int, ...]
    right: tuple[int, ...]
    middle: tuple[int, ...]

    def facing(self, places: FloatArray) -> FloatArray:
        """Turn the root as they stand: x to its left, y along its spine.

        Parameters
        ----------
        places : (frames, joints, 3) mm, NaN where not seen; left-handed, its axes are, too

        Returns
        -------
        (frames, 4) rotations; NaN where one of the joints that it takes was not seen
        """
        left, right, middle = (
            places[:, joints].mean(axis=1) for joints in (self.left, self.right, self.middle)
        )
        rotation = np.full((len(places), 4), np.nan)
        with np.errstate(invalid="ignore", divide="ignore"):
            up, across = (
                x / lengths_of(x)[:, None] for x in (middle - places[:, self.root], left - right)
            )
            forth = cross(across, up)
            size = lengths_of(forth)
            forth /= size[:, None]
        known = size > _APART
        axes = np.stack([cross(up, forth), up, forth], axis=2)[known]
        if known.any():
            rotation[known] = Rotation.from_matrix(axes).as_quat()
        return rotation


def sides_of(joints: Sequence[str], parents: Sequence[int]) -> Sides | None:
    """Find the joints that tell how a root is turned.

    Parameters
    ----------
    joints : names, which tell sides
    parents : index of each joint's parent, -1 for the root

    Returns
    -------
    None where no two of the joints that hang on the root are each other's counterparts, or all are
    """
    root = list(parents).index(-1)
    hanging = [joint for joint, parent in enumerate(parents) if parent == root]
    other = twins(joints)
    # A side by itself, or what is left of a name with one in the same word: “left” before “right”.
    side = [(named or rest) for named, rest in map(side_of, joints)]
    left = tuple(j for j in hanging if other[j] in hanging and side[j] < side[other[j]])
    middle = tuple(j for j in hanging if other[j] == j)
    if not (left and middle):
        return None
    return Sides(root, left, tuple(other[j] for j in left), middle)


def facing(pose: Pose) -> FloatArray:
    """(frames, 4) how a root is turned, by :meth:`Sides.facing`; NaN where that does not tell."""
    sides = sides_of(pose.joints, pose.parents)
    if sides is None:
        return np.full((pose.frames, 4), np.nan)
    return sides.facing(np.where(pose.seen[..., None], pose.positions, np.nan))
