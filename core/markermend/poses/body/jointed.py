"""The joints of a body that it can settle by: those that were seen, turned or not."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.poses.body.bending import OthersBends
from markermend.poses.pose import Pose

# So many of a body's joints must have a rotation for it to settle.
_TURNED = 0.5


@dataclass(frozen=True, eq=False)
class Jointed:
    """Joints that hang on each other, parents first, the root among them.

    Attributes
    ----------
    joints : indices among all
    parents : index of each one's parent among these, -1 for the root
    unturned : (joints,) bool, those that never have a rotation, and turn with their parents here
    others : how others bend, as far as joints hang on the same ones and in axes of their own
    """

    joints: tuple[int, ...]
    parents: tuple[int, ...]
    unturned: BoolArray
    others: OthersBends | None

    @property
    def order(self) -> range:
        """Indices of joints, parents first."""
        return range(len(self.joints))

    def of(self, features: FloatArray) -> FloatArray:
        """(frames, joints, 7) of these joints, all of them turned.

        Parameters
        ----------
        features : (frames, all joints, 7)
        """
        some = features[:, self.joints]
        for joint in np.flatnonzero(self.unturned).tolist():
            some[:, joint, 3:] = some[:, self.parents[joint], 3:]
        return some

    def back(self, settled: FloatArray, features: FloatArray) -> FloatArray:
        """(frames, all joints, 7) with these as they have settled, but for turns they have not.

        Parameters
        ----------
        settled : (frames, joints, 7)
        features : (frames, all joints, 7) before
        """
        out = features.copy()
        settled = settled.copy()
        settled[:, self.unturned, 3:] = np.nan
        out[:, self.joints] = settled
        return out

    def unsure(self, variance: FloatArray) -> FloatArray:
        """(frames, joints, 7) variance of these joints; 1 where nothing is turned.

        Parameters
        ----------
        variance : (frames, all joints, 7)
        """
        some = variance[:, self.joints]
        some[:, self.unturned, 3:] = 1.0
        return some

    def hidden(self, seen: BoolArray, turned: BoolArray) -> BoolArray:
        """(frames,) bool, something of these joints is hidden that was ever known.

        Parameters
        ----------
        seen, turned : (frames, all joints) bool
        """
        whole = seen[:, self.joints] & (turned[:, self.joints] | self.unturned)
        return np.asarray(~whole.all(axis=1))


def jointed(
    pose: Pose, seen: BoolArray, turned: BoolArray, others: OthersBends | None
) -> Jointed | None:
    """Find the joints that a body can settle by.

    Parameters
    ----------
    pose : any skeleton with one root
    seen, turned : (joints,) bool, that were so in some frame, the root among them
    others : how others bend, of all joints but the root, parents first

    Returns
    -------
    None where most joints but the root were never turned: places in the root's axes tell no more of
    a body than they do without (:mod:`markermend.poses.body.stretching`)
    """
    kept = [joint for joint in pose.order if seen[joint]]
    if np.mean(turned[kept[1:]]) < _TURNED:
        return None
    at = {joint: n for n, joint in enumerate(kept)}
    above = [above_seen(pose.parents, joint, seen) for joint in kept]
    unturned = ~turned[kept]
    if others is not None:
        others = told_of(others, pose, kept[1:], seen, turned)
    return Jointed(tuple(kept), tuple(at.get(a, -1) for a in above), unturned, others)


def told_of(
    others: OthersBends, pose: Pose, joints: Sequence[int], seen: BoolArray, turned: BoolArray
) -> OthersBends:
    """What others tell of some joints, which hang on what is seen of a body.

    Parameters
    ----------
    others : how they bend, of all joints of the body but the root, parents first
    pose : the body
    joints : indices of those that are asked for, without the root
    seen, turned : (all joints,) bool, joints that have a place, and a rotation
    """
    bent = [joint for joint in pose.order if pose.parents[joint] >= 0]
    places = np.array([bent.index(joint) for joint in joints], dtype=int)
    above = [above_seen(pose.parents, joint, seen) for joint in joints]
    pairs = zip(joints, above, strict=True)
    hangs = np.array([on == pose.parents[joint] and turned[on] for joint, on in pairs], dtype=bool)
    return others.of(places, hangs, turned[list(joints)])


def above_seen(parents: Sequence[int], joint: int, seen: BoolArray) -> int:
    """Return the next joint above that was seen; -1 for the root."""
    parent = parents[joint]
    while parent >= 0 and not seen[parent]:
        parent = parents[parent]
    return parent
