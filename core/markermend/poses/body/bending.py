"""How a body bends: its joints in their parents' axes, and what each bend moves."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.transform import Rotation

from markermend.arrays import BoolArray, Float32Array, FloatArray, IntArray
from markermend.poses.filling.covariance import completed
from markermend.poses.normal import FEATURES
from markermend.poses.quaternion import (
    by_turning,
    cross_matrices,
    inverse,
    lengths_of,
    multiply,
    rotation_vector,
    turn,
)

LOCAL = 6
"""Of a joint: three numbers say how it is turned in its parent's axes, then three where it is."""
TURN = 3
"""The first of them, and as many after them."""
# Directions in which a body varies less than this share of its largest are those it cannot move in.
_LEAST = 1e-6
# Where a body bends less than this share of what others do, theirs are less by the square of it.
_CALM = 0.2
# A joint turned by so many radians from its mean is drawn back less, and not at all at half a turn.
_FAR_TURNED = 2.0
# A body whose features change by the root of this at most does not bend at all.
_STILL = 1e-20


@dataclass(frozen=True, eq=False)
class OthersBends:
    """How other bodies bend.

    Attributes
    ----------
    covariance : (joints · :data:`LOCAL`, joints · :data:`LOCAL`) of their
        :func:`local_coordinates`, all but the root: radians, and the recording's mean bone lengths
    told : (joints · :data:`LOCAL`,) bool, of which something is told
    share : how much they count, 0 to 1, beside a recording's own bends
    """

    covariance: FloatArray
    told: BoolArray
    share: float = 1.0

    def of(self, places: IntArray, hangs: BoolArray, turned: BoolArray) -> OthersBends:
        """The same of some joints, in another order.

        Parameters
        ----------
        places : (n,) of each among these
        hangs : (n,) bool, joints that hang on the same one here, in axes of that one's own
        turned : (n,) bool, joints that have a rotation of their own
        """
        columns = (places[:, None] * LOCAL + np.arange(LOCAL)).ravel()
        told = self.told[columns].reshape(-1, LOCAL) & hangs[:, None]
        told[~turned, :TURN] = False
        told = told.ravel()
        covariance = told[:, None] * self.covariance[np.ix_(columns, columns)] * told
        return replace(self, covariance=covariance, told=told)

    def longer(self, times: float) -> OthersBends:
        """The same of bodies whose positions are measured in units so many times as short."""
        scale = np.where(np.arange(len(self.told)) % LOCAL < TURN, 1.0, times)
        return replace(self, covariance=scale[:, None] * self.covariance * scale)


@dataclass(frozen=True, eq=False)
class Bends:
    """Poses as coordinates along the directions that a body bends in.

    Attributes
    ----------
    poses : (frames, joints, 7) the poses that bends were found from
    parents : index of each joint's parent, -1 for the root
    joints : all but the root, parents first
    at : (frames, n) the same poses as coordinates, of mean 0, and of variance 1 as bodies are taken
        to bend
    back : (frames, n) the same, but nearer to 0 where a joint is turned by more than bodies bend
    """

    poses: FloatArray
    parents: tuple[int, ...]
    joints: tuple[int, ...]
    at: FloatArray
    back: FloatArray
    _local: FloatArray
    _middle: dict[int, FloatArray]
    _mean: FloatArray
    _directions: FloatArray

    def of(self, frames: IntArray) -> Bends:
        """The same body in some of the frames."""
        poses, at, back, local = (x[frames] for x in (self.poses, self.at, self.back, self._local))
        return replace(self, poses=poses, at=at, back=back, _local=local)

    def slopes(self, frames: IntArray, at_once: int) -> Iterator[Float32Array]:
        """(at_once, joints · 7, n) how features change with coordinates, for some frames in turn.

        Single precision is enough for steps, which are small, and takes half the time.
        """
        yield from _linear(
            self._local[frames],
            self.poses[frames],
            self.parents,
            self.joints,
            self._middle,
            self._directions.astype(np.float32),
            at_once,
        )

    def features(self, at: FloatArray, like: FloatArray) -> FloatArray:
        """(frames, joints, 7) of coordinates; signs of rotations and the root as in ``like``."""
        local = self._mean + at @ self._directions.T
        return _from_local(local, like, self.parents, self.joints, self._middle)


def find_bends(
    poses: FloatArray,
    parents: Sequence[int],
    order: Sequence[int],
    others: OthersBends | None = None,
) -> Bends:
    """Find the directions that a body bends in.

    Parameters
    ----------
    poses : (frames, joints, 7) relative to the root, without NaN, rotations of unit length
    parents : index of each joint's parent, -1 for the root
    order : joints, parents first
    others : how others bend, joints in this order
    """
    joints = tuple(j for j in order if parents[j] >= 0)
    middle, local = local_coordinates(poses, parents, joints)
    mean = local.mean(axis=0, dtype=np.float64)
    away = local - mean
    covariance = away.T @ away / max(len(away) - 1, 1)
    if others is not None:
        theirs = _befitting(
            completed(others.covariance, covariance, others.told), covariance, others
        )
        covariance = (1.0 - others.share) * covariance + others.share * theirs
    spread, axes = np.linalg.eigh(covariance)
    kept = spread > max(_LEAST * spread[-1], _STILL)
    scale = np.sqrt(spread[kept])
    across = axes[:, kept] / scale
    at, back, mean, directions = (
        np.asarray(x, dtype=poses.dtype)
        for x in (away @ across, _less_turned(away) @ across, mean, axes[:, kept] * scale)
    )
    return Bends(poses, tuple(parents), joints, at, back, local, middle, mean, directions)


def _less_turned(away: FloatArray) -> FloatArray:
    """Local coordinates, turns nearer to 0 the nearer they are to half a turn.

    Beyond half a turn a joint would be drawn back the other way round. No joint is turned so, but
    what is filled may be: from one frame to the next it would be thrown about.
    """
    parts = away.reshape(len(away), -1, LOCAL).copy()
    angle = lengths_of(parts[..., :TURN])[..., None]
    parts[..., :TURN] *= np.clip((np.pi - angle) / (np.pi - _FAR_TURNED), 0.0, 1.0)
    return parts.reshape(away.shape)


def _befitting(theirs: FloatArray, own: FloatArray, others: OthersBends) -> FloatArray:
    """Others' covariance, no larger than befits a body.

    One who stands still bends less than others by far, and of joints that others have not, only
    the recording tells how far they bend.
    """
    told = others.told
    size, usual = (np.add.reduceat(c.diagonal(), np.arange(0, len(c), TURN)) for c in (own, theirs))
    whole = own.diagonal()[told].sum() / max(float(theirs.diagonal()[told].sum()), _STILL)
    share = np.where(told[::TURN], (whole / _CALM) ** 2, size / np.maximum(usual, _STILL))
    less = np.sqrt(np.minimum(share, 1.0)).repeat(TURN)
    return np.asarray(less[:, None] * theirs * less)


def _relative(features: FloatArray, parents: Sequence[int], joint: int) -> FloatArray:
    """(frames, 4) rotation of a joint in its parent's axes, or as it is where that is the root.

    Limbs do not shake with the root.
    """
    parent = parents[joint]
    if parents[parent] < 0:
        return features[:, joint, 3:]
    return multiply(inverse(features[:, parent, 3:]), features[:, joint, 3:])


def local_coordinates(
    features: FloatArray, parents: Sequence[int], joints: Sequence[int]
) -> tuple[dict[int, FloatArray], FloatArray]:
    """Mean rotation of each joint in its parent's axes, and rotation vectors about it and places.

    Parameters
    ----------
    features : (frames, joints, 7) without NaN, rotations of unit length
    parents : index of each joint's parent, -1 for the root
    joints : those that are asked for, parents first

    Returns
    -------
    middle : joint to (4,)
    local : (frames, joints · :data:`LOCAL`)
    """
    middle = {}
    local = np.empty((len(features), len(joints), LOCAL), dtype=features.dtype)
    for n, joint in enumerate(joints):
        turned = _relative(features, parents, joint)
        mean = Rotation.from_quat(turned).mean().as_quat()
        middle[joint] = np.asarray(mean, dtype=features.dtype)
        local[:, n, :3] = rotation_vector(multiply(inverse(middle[joint]), turned))
        parent = parents[joint]
        bone = features[:, joint, :3] - features[:, parent, :3]
        local[:, n, 3:] = turn(inverse(features[:, parent, 3:]), bone)
    return middle, local.reshape(len(features), -1)


def _from_local(
    local: FloatArray,
    like: FloatArray,
    parents: Sequence[int],
    joints: Sequence[int],
    middle: dict[int, FloatArray],
) -> FloatArray:
    """(frames, joints, 7); signs of rotations as in ``like``, from which the root is taken."""
    parts = local.reshape(len(local), len(joints), LOCAL)
    out = like.copy()
    for n, joint in enumerate(joints):
        parent = parents[joint]
        bent = np.asarray(Rotation.from_rotvec(parts[:, n, :3]).as_quat(), dtype=out.dtype)
        own = multiply(middle[joint], bent)
        turned = own if parents[parent] < 0 else multiply(out[:, parent, 3:], own)
        other = np.einsum("ti,ti->t", turned, like[:, joint, 3:]) < 0
        out[:, joint, 3:] = np.where(other[:, None], -turned, turned)
        out[:, joint, :3] = out[:, parent, :3] + turn(out[:, parent, 3:], parts[:, n, 3:])
    return out


def _linear(
    local: FloatArray,
    poses: FloatArray,
    parents: Sequence[int],
    joints: Sequence[int],
    middle: dict[int, FloatArray],
    directions: Float32Array,
    at_once: int,
) -> Iterator[Float32Array]:
    """(at_once, joints · 7, directions) how poses, given also as local, change, some at a time."""
    frames, columns, count = len(local), directions.shape[1], len(joints)
    above = [parents[j] for j in joints]
    # The small matrices of all joints and frames: (frames, joints, 3 or 4, 3).
    shape = (frames, count, 3, 3)
    frame = Rotation.from_quat(poses[:, above, 3:].reshape(-1, 4)).as_matrix().reshape(shape)
    own = np.stack([Rotation.from_quat(middle[j]).as_matrix() for j in joints])
    hung = np.array([parents[parent] < 0 for parent in above])[:, None, None]
    # Of small angles single precision leaves nothing in what is subtracted here.
    vectors = np.asarray(local.reshape(-1, LOCAL)[:, :3], dtype=np.float64)
    jacobian = _left_jacobian(vectors).reshape(shape)
    bone = cross_matrices((poses[:, joints, :3] - poses[:, above, :3]).reshape(-1, 3)).reshape(
        shape
    )
    turned = by_turning(poses[:, joints, 3:].reshape(-1, 4)).reshape(frames, count, 4, 3)
    bends, axes, across, turns = (
        np.asarray(m, dtype=np.float32)
        for m in (np.where(hung, own, frame @ own) @ jacobian, frame, bone, turned)
    )
    for first in range(0, frames, at_once):
        some = slice(first, min(first + at_once, frames))
        size = some.stop - first
        turning, moving = np.zeros((2, poses.shape[1], size, 3, columns), dtype=np.float32)
        slopes = np.empty((size, count, FEATURES, columns), dtype=np.float32)
        for n, joint in enumerate(joints):
            parent, k = above[n], LOCAL * n
            # As one product of matrices each, which many small ones take far longer than.
            bent, moved = (
                (m[some, n].reshape(-1, 3) @ by).reshape(size, 3, columns)
                for m, by in ((bends, directions[k : k + 3]), (axes, directions[k + 3 : k + 6]))
            )
            turning[joint] = turning[parent] + bent
            moving[joint] = moving[parent] - across[some, n] @ turning[parent] + moved
            slopes[:, n, :3] = moving[joint]
            slopes[:, n, 3:] = turns[some, n] @ turning[joint]
        yield slopes.reshape(size, -1, columns)


def _left_jacobian(v: FloatArray) -> FloatArray:
    """(n, 3, 3) how the rotation turns as its rotation vector changes."""
    angle = np.maximum(np.sqrt(np.sum(v**2, axis=1)), 1e-4)[:, None, None]
    across = cross_matrices(v)
    return np.asarray(
        np.eye(3)
        + (1.0 - np.cos(angle)) / angle**2 * across
        + (angle - np.sin(angle)) / angle**3 * (across @ across)
    )
