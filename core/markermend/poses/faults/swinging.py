"""Joints turned with the bones that they carry, where these point elsewhere than before."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.spatial.transform import Rotation

from markermend.arrays import BoolArray, FloatArray, median_of_seen
from markermend.poses.pose import Pose
from markermend.poses.quaternion import NO_TURN, between, inverse, multiply, turn, upright

# A bone whose direction in a joint's axes strays by less than this, in radians and on the mean, is
# fixed in them; by more than the other, it is not carried by that joint.
_FIXED, _LOOSE = 1e-3, 0.2
# What a joint's turning counts against its bones' pointing: several that lie along one line tell
# little of the twist about it.
_STAY = 1e-3
# Places of bones in a joint's axes change no faster than over this time.
_FOLLOW_S = 0.2
# One that is further from its usual place than this share of its length is misplaced.
_MISPLACED = 0.5


def swung(pose: Pose, positions: FloatArray, moved: BoolArray, still: BoolArray) -> FloatArray:
    """Turn joints so that their bones point where joints that were moved have them.

    Parameters
    ----------
    pose : the recording as it was
    positions : (frames, joints, 3) mm, as they are now; NaN where a joint is not seen
    moved : (frames, joints) bool, joints with which bones swing
    still : (frames, joints) bool, joints that are not turned

    Returns
    -------
    FloatArray
        (frames, joints, 4) rotations; each is turned by as little as makes its bone, fixed in its
        axes, point where it does now, so that the twist about the bone stays, and of several bones
        by least squares. Where none of a joint's bones swings its rotation is what it was; NaN
        stays NaN.
    """
    rotations = pose.rotations.copy()
    bones = _bones(positions, pose.parents)
    whole = ~np.isnan(bones).any(axis=2) & (np.abs(bones).max(axis=2) > 0)
    swings = moved.copy()
    for joint, parent in enumerate(pose.parents):
        if parent >= 0:
            swings[:, joint] |= moved[:, parent]
    for joint, ends in enumerate(carried(pose)):
        rows = (whole & swings)[:, ends].any(axis=1) & ~still[:, joint]
        rows &= ~np.isnan(rotations[:, joint, 3])
        if rows.any():
            there, own = whole[rows][:, ends, None], rotations[rows, joint]
            places = _steady(_own(pose, joint, ends), pose.rate)[rows]
            known = (
                np.where(there, b, 0.0) for b in (turn(own[:, None], places), bones[rows][:, ends])
            )
            rotations[rows, joint] = multiply(_least(*known), own)
    return rotations


def carried(pose: Pose) -> list[list[int]]:
    """Bones that turn with each joint, named by the joint at their end.

    Parameters
    ----------
    pose : whose files may have a joint's rotation mean the bone that ends at it (Acclaim) or those
        that begin there (Biovision, Nuitrack); its movement tells

    Returns
    -------
    A list for each joint; a bone fixed to both of its joints is in two of them, one that no
    rotation tells of, as where a sensor gives none, in none
    """
    found: list[list[int]] = [[] for _ in pose.joints]
    for joint, parent in enumerate(pose.parents):
        if parent >= 0:
            ends = (joint, parent)
            strays = [_strays(_own(pose, end, [joint])[:, 0]) for end in ends]
            most = max(min(strays), _FIXED)
            for end, stray in zip(ends, strays, strict=True):
                if stray <= most and stray < _LOOSE:
                    found[end].append(joint)
    return found


def _bones(positions: FloatArray, parents: tuple[int, ...]) -> FloatArray:
    """(frames, joints, 3) from each joint's parent to it; NaN for a root."""
    above = positions[:, [max(parent, 0) for parent in parents]]
    roots = np.asarray(parents) < 0
    return np.asarray(np.where(roots[:, None], np.nan, positions - above))


def _own(pose: Pose, joint: int, ends: list[int]) -> FloatArray:
    """(frames, ends, 3) mm, bones that end at some joints, in the axes of one."""
    bones = _bones(pose.positions, pose.parents)[:, ends]
    return turn(inverse(pose.rotations[:, joint, None]), bones)


def _strays(own: FloatArray) -> float:
    """How far a bone, (frames, 3), strays from its usual direction; infinite if never known."""
    far = np.sqrt(np.sum(own**2, axis=1))
    own = own[far > 0] / far[far > 0, None]
    if not len(own):
        return float("inf")
    return float(np.sqrt(np.sum((own - np.median(own, axis=0)) ** 2, axis=1)).mean())


def _steady(own: FloatArray, rate: float) -> FloatArray:
    """(frames, bones, 3) the same without what is noise in positions or rotations.

    Bones that are not quite fixed go where they go, but do not tremble. Where one is far from its
    usual place, since a joint is misplaced, it stays there, and does not draw others along.
    """
    usual = median_of_seen(own)
    most = _MISPLACED**2 * np.sum(usual**2, axis=1)
    known = (np.sum((own - usual) ** 2, axis=2) <= most)[..., None]
    width = _FOLLOW_S * rate
    total = gaussian_filter1d(np.where(known, own, 0.0), width, axis=0, mode="nearest")
    weight = gaussian_filter1d(known.astype(np.float64), width, axis=0, mode="nearest")
    elsewhere = np.where(np.isnan(own), usual, own)
    return np.asarray(np.where(known, total / np.maximum(weight, 1e-12), elsewhere))


def _least(before: FloatArray, after: FloatArray) -> FloatArray:
    """(frames, 4) the least turn of bones, (frames, bones, 3) mm each; 0 where one is not known."""
    known = (before != 0).any(axis=2) & (after != 0).any(axis=2)
    first = np.argmax(known, axis=1)
    turned = np.tile(NO_TURN, (len(before), 1))
    some = np.flatnonzero(known.any(axis=1))
    turned[some] = between(before[some, first[some]], after[some, first[some]])
    several = np.flatnonzero(known.sum(axis=1) > 1)
    if len(several):
        turned[several] = nearest_turns(before[several], after[several])
    return turned


def nearest_turns(before: FloatArray, after: FloatArray) -> FloatArray:
    """(frames, 4) turns that bring bones nearest to where they are now.

    Least squares (Wahba 1965, by the singular values of Markley 1988), and no further turned than
    the bones tell.
    """
    spread = np.einsum("fbi,fbj->fij", after, before)
    weight = np.sum(before**2, axis=(1, 2))[:, None, None]
    left, _, right = np.linalg.svd(spread + _STAY * weight * np.eye(3))
    left[:, :, 2] *= np.linalg.det(left @ right)[:, None]
    return upright(Rotation.from_matrix(left @ right).as_quat())
